// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/values.hpp>

/// B-spline curves and surfaces: evaluation, derivatives, triangles.
namespace velum::bspline {

inline constexpr int kMostDegree = 15;

/// The basis functions that are not zero at one place: those of number first ... first + degree.
/// Row d of `values` holds their d-th derivatives.
struct Basis {
  Index first = 0;
  Eigen::MatrixXd values;
};

/// Basis functions of `degree` over `knots` (at least degree + 2 of them, not descending) at x,
/// with derivatives up to the given order (Piegl and Tiller, The NURBS Book, A2.1 to A2.3). Beyond
/// the ends of [knots[degree], knots[count]] the outermost polynomials go on.
[[nodiscard]] Basis basis(const Eigen::VectorXd& knots, int degree, double x, int derivatives = 0);

/// How many functions there are over `knots`.
[[nodiscard]] inline Index count_of(const Eigen::VectorXd& knots, int degree) {
  return knots.size() - degree - 1;
}

/// Knots over [low, high] with the ends repeated degree + 1 times and `spans` equal spans.
[[nodiscard]] Eigen::VectorXd uniform_knots(int degree, Index spans, double low = 0.0,
                                            double high = 1.0);

/// The mean of the `degree` inner knots of each function: where its control point belongs, so that
/// control values taken there give the straight line x (Greville abscissae).
[[nodiscard]] Eigen::VectorXd greville(const Eigen::VectorXd& knots, int degree);

/// Position and partial derivatives at one (u, v), about the surface's origin.
struct Derivatives {
  Eigen::Vector3d point, du, dv, duu, duv, dvv;
  /// Unit normal du × dv; zero where the surface has none (at a pole).
  [[nodiscard]] Eigen::Vector3d normal() const;
};

/// A surface that was found to be sound, and can be evaluated. Refers to it: it must live on.
class Patch {
 public:
  /// Throws Error (Fault::stage) when degrees, knots, control points or weights do not fit
  /// together, or are not finite.
  explicit Patch(const Surface& surface);

  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] Index count_u() const { return count_u_; }
  [[nodiscard]] Index count_v() const { return count_v_; }
  /// The corners of its range of parameters.
  [[nodiscard]] Eigen::Vector2d low() const;
  [[nodiscard]] Eigen::Vector2d high() const;
  /// Position about the surface's origin [m].
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector2d& uv) const;
  [[nodiscard]] Derivatives derivatives(const Eigen::Vector2d& uv) const;
  /// The place of the surface's range nearest to `p` that Newton's method reaches from `start`.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p,
                                        const Eigen::Vector2d& start) const;

 private:
  [[nodiscard]] double weight(Index k) const {
    return surface_.weights.size() == 0 ? 1.0 : surface_.weights[k];
  }
  const Surface& surface_;
  Index count_u_;
  Index count_v_;
};

/// Does (u, v) lie inside the trimming loops (even-odd rule)? Always true of an untrimmed surface.
[[nodiscard]] bool inside(const std::vector<Eigen::Matrix2Xd>& loops, const Eigen::Vector2d& uv);

}  // namespace velum::bspline
