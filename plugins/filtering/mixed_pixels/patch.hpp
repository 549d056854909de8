// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>
#include <velum/types.hpp>

namespace velum::mixed {

/// A neighbour in the frame of the ray: direction across it, and the inverse of its depth along it.
struct Seen {
  Eigen::Vector2d across;
  double inverse;
  bool sure;  ///< known to lie on a surface
};

/// The plane inverse = at + slope · across.
struct Sheet {
  double at = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  /// How far behind the plane [m], along the ray.
  [[nodiscard]] double behind(const Seen& seen) const;
  /// Tangent of the angle of incidence of the ray in the middle.
  [[nodiscard]] double tangent() const { return slope.norm() / at; }
};

/// A point under judgement with what is around it in direction.
class Patch {
 public:
  /// `range` and `noise` [m]; `width` is the angle of the spot [rad], which a strip must exceed.
  Patch(double range, double noise, double width);
  void add(const Seen& seen);

  /// Is anything farther away than noise explains?
  [[nodiscard]] bool something_behind() const;
  /// Do the neighbours of a whole quarter lie on one plane that predicts the point?
  [[nodiscard]] bool on_surface() const;
  /// Do neighbours that are sure lie on a plane that predicts the point?
  [[nodiscard]] bool beside_surface() const;
  /// Do neighbours in a strip wider than half a spot lie on a plane that predicts the point?
  [[nodiscard]] bool on_strip() const;

 private:
  static constexpr std::size_t kOctants = 8;
  struct Trust {
    double deviations;  // between the point and its prediction
    double leverage;    // variance of the prediction / variance of a range
    int least;          // neighbours
  };
  template <class Test>
  [[nodiscard]] bool any_plane(const std::vector<Seen>& of, double steepest,
                               const Test& test) const;
  [[nodiscard]] std::optional<Sheet> through(const Seen& a, const Seen& b) const;
  [[nodiscard]] bool on(const Sheet& sheet, const Seen& seen) const;
  [[nodiscard]] bool carried_by_quarter(const Sheet& sheet) const;
  [[nodiscard]] bool wide(const Sheet& sheet) const;
  [[nodiscard]] bool predicted(const Sheet& sheet, const std::vector<Seen>& by,
                               const Trust& trust) const;

  double range_;
  double noise_;
  double width_;
  std::vector<Seen> around_;
  std::vector<std::size_t> octant_;  // of each neighbour
  std::array<int, kOctants> totals_{};
};

}  // namespace velum::mixed
