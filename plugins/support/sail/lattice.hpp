// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>
#include <velum/cloud.hpp>

namespace velum::sail {

/// The ray of a return: scanner, scan line, beam.
struct Cell {
  std::size_t sensor;
  std::int32_t line;
  std::int32_t beam;
};

/// Does a cloud know scanner, line and beam of its points?
[[nodiscard]] bool is_scan(const Cloud& cloud);

/// The returns of all scanners by line and beam. The cloud must outlive it.
class Lattice {
 public:
  explicit Lattice(const Cloud& cloud);
  [[nodiscard]] Cell cell(std::int32_t vertex) const {
    return {sensor_[static_cast<std::size_t>(vertex)], line_[vertex], beam_[vertex]};
  }
  /// The return `steps` cells from `cell`, lines or beams on; -1: none.
  [[nodiscard]] std::int32_t find(const Cell& cell, bool lines, int steps) const;

  /// Is nothing returned in the three cells beyond `cell`? A single one may be a shroud's shadow.
  [[nodiscard]] bool ends_at(const Cell& cell, bool lines, int sign) const;
  /// The nearest return at most `reach` cells inside, and how many.
  struct Inner {
    std::int32_t vertex = -1;
    int steps = 0;
  };
  [[nodiscard]] Inner inner(const Cell& cell, bool lines, int sign, int reach) const;

 private:
  Eigen::Map<const Eigen::VectorXi> beam_;
  Eigen::Map<const Eigen::VectorXi> line_;
  std::vector<std::size_t> sensor_;
  std::unordered_map<std::uint64_t, std::int32_t> by_cell_;
};

/// The point on the tangent plane at p half a step beyond it, seen from `eye`; `inner` is the
/// return `steps` cells inside. Nothing when the plane is seen at a grazing angle.
[[nodiscard]] std::optional<Eigen::Vector3d> half_step_on(const Eigen::Vector3d& eye,
                                                          const Eigen::Vector3d& p,
                                                          const Eigen::Vector3d& inner, int steps,
                                                          const Eigen::Vector3d& normal);

}  // namespace velum::sail
