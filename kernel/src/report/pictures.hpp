// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "run/observer.hpp"

namespace velum::report {

/// Draws a still picture of every cloud, mesh, surface and set of clusters that nodes make, into
/// <folder>/<node>.<output>.png.
class PictureWatch final : public run::Witness {
 public:
  /// `colour`: the column that colours those that have it; "" for the usual one. Makes the folder;
  /// throws Error (Fault::output) when it cannot.
  PictureWatch(std::filesystem::path folder, std::string colour);

  [[nodiscard]] bool wants(const graph::Node& node) const override;
  void made(const graph::Node& node, const std::vector<Wired>& inputs,
            const Results& results) override;

  /// The first picture that could not be written.
  [[nodiscard]] std::optional<Error> failed() const;
  [[nodiscard]] std::size_t count() const;

 private:
  std::filesystem::path folder_;
  std::string colour_;
  mutable std::mutex mutex_;
  std::optional<Error> failed_;
  std::size_t count_ = 0;
};

/// The picture of a value; does nothing for values that have no shape. Returns whether it has one.
bool draw_value(const Value& value, const std::string& title, const std::string& colour,
                const std::filesystem::path& file);

}  // namespace velum::report
