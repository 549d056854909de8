// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "velum/api.hpp"

namespace velum {

/// What kind of thing went wrong. The value is the command's exit status.
enum class Fault : int {
  stage = 1,   ///< a stage failed, or its result was empty
  graph = 2,   ///< the command line or the graph is wrong
  plugin = 4,  ///< a plugin exists and cannot be loaded
  input = 5,   ///< the content of an input file is bad
  output = 6,  ///< an output cannot be written
  device = 7,  ///< a device does not do what it should
};

/// The error that stages and kernel throw. The message says what was found and what was expected;
/// `where` is a file with line or offset ("scan.pcd:12", "scan.ply: byte 480"); `hint` is the fix.
class VELUM_API Error : public std::runtime_error {
 public:
  Error(Fault fault, const std::string& message) : std::runtime_error(message), fault_(fault) {}
  ~Error() override;

  Error&& at(std::string where) && {
    where_ = std::move(where);
    return std::move(*this);
  }
  Error&& hint(std::string hint) && {
    hint_ = std::move(hint);
    return std::move(*this);
  }

  [[nodiscard]] Fault fault() const noexcept { return fault_; }
  [[nodiscard]] const std::string& where() const noexcept { return where_; }
  [[nodiscard]] const std::string& hint() const noexcept { return hint_; }

 private:
  Fault fault_;
  std::string where_;
  std::string hint_;
};

/// Thrown by Context::check() when the run was interrupted. Stages let it pass.
class VELUM_API Cancelled : public std::exception {
 public:
  ~Cancelled() override;
  [[nodiscard]] const char* what() const noexcept override;
};

}  // namespace velum
