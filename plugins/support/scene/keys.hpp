// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "graph/toml.hpp"
#include "velum/types.hpp"
#include "velum/values.hpp"

namespace velum::scene {

using graph::toml::Entry;
using graph::toml::Node;

/// What all tables of one file share.
struct SceneFile {
  std::string name;    ///< as messages call it
  double metre = 1.0;  ///< metres in the unit of bare lengths
  /// Throws Error (Fault::input) at file:line:column.
  [[noreturn]] void fail(const graph::toml::Region& where, const std::string& message,
                         const std::string& hint = "") const;
};

/// Strict reader of one table: values are asked for by key, and finish() refuses the keys that
/// nobody asked for.
class Keys {
 public:
  Keys(const SceneFile& file, const Node& table, std::string subject);

  [[nodiscard]] bool has(std::string_view key);
  [[nodiscard]] const Node& node(std::string_view key);  ///< required
  [[nodiscard]] std::string text(std::string_view key);
  [[nodiscard]] std::int32_t integer(std::string_view key);
  /// A length [m]: a bare number in the file's unit, or text such as "5 mm".
  [[nodiscard]] double length(std::string_view key);
  [[nodiscard]] double length(std::string_view key, double otherwise);
  /// An angle [rad]: a bare number in degrees, or text such as "0.1 rad".
  [[nodiscard]] double angle(std::string_view key, double otherwise);
  [[nodiscard]] double number(std::string_view key, double otherwise);
  /// A number that must be in [low, high].
  [[nodiscard]] double number_between(std::string_view key, double low, double high);
  /// Three lengths [m].
  [[nodiscard]] Eigen::Vector3d place(std::string_view key);
  [[nodiscard]] Eigen::Vector3d place(std::string_view key, const Eigen::Vector3d& otherwise);
  /// `count` lengths [m].
  [[nodiscard]] std::vector<double> lengths(std::string_view key, std::size_t count);
  /// Three bare numbers, made a unit vector.
  [[nodiscard]] Eigen::Vector3d direction(std::string_view key, const Eigen::Vector3d& otherwise);
  /// Angles about the fixed axes x, y, z, applied in that order.
  [[nodiscard]] Eigen::Matrix3d rotation(std::string_view key);
  /// `position` and `rotation`.
  [[nodiscard]] Pose pose();
  [[nodiscard]] const std::vector<Node>& array(std::string_view key);

  /// Throws Error about the value of `key`.
  [[noreturn]] void fail(std::string_view key, const std::string& message,
                         const std::string& hint = "") const;
  void finish() const;

  [[nodiscard]] Eigen::Vector3d place_of(const Node& node, const std::string& what) const;

 private:
  [[nodiscard]] const Node* find(std::string_view key);
  [[nodiscard]] double length_of(const Node& node, const std::string& what) const;
  [[nodiscard]] double number_of(const Node& node, const std::string& what) const;
  [[nodiscard]] double angle_of(const Node& node, const std::string& what) const;
  [[nodiscard]] const std::vector<Node>& items(const Node& node, std::size_t count,
                                               const std::string& what) const;
  [[nodiscard]] std::string what(std::string_view key) const;

  const SceneFile& file_;
  const Node& table_;
  std::string subject_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace velum::scene
