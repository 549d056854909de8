// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>
#include <velum/stage.hpp>

#include "lms511/sweep.hpp"

namespace {

namespace lms = velum::lms511;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using velum::Index;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// A wall whose place is known: normal and a point of it, in the cloud's frame.
struct Plane {
  Vector3d normal = Vector3d::UnitZ();
  velum::Place point;
};

// A return before the mounting: where it lies in the plane of the beams, and the tilt.
struct Beam {
  Vector3d place;
  double tilt;
};

// Sums of one round of least squares.
struct Sums {
  Matrix6d normal = Matrix6d::Zero();
  Vector6d right = Vector6d::Zero();
  double squares = 0.0;
  Index count = 0;
};

constexpr std::array<const char*, 6> kNames = {
    "lever_x", "lever_y", "lever_z", "misalignment_x", "misalignment_y", "misalignment_z"};

Vector3d angles_of(const Matrix3d& turn) {
  return {std::atan2(turn(2, 1), turn(2, 2)), std::asin(std::clamp(-turn(2, 0), -1.0, 1.0)),
          std::atan2(turn(1, 0), turn(0, 0))};
}

struct Mounting {
  std::vector<Plane> planes;
  lms::Mounting mounting = lms::Mounting::plate;
  velum::Place lever_arm;
  std::vector<velum::Angle> misalignment;
  velum::Length tolerance = 0.1;
  int iterations = 30;

  static auto about() {
    return velum::About<Mounting>(
               "Lever arm and misalignment of a scanner on its tilt plate, from known planes.")
        .in("cloud", "a sweep, in the scanner's own frame")
        .out("cloud", "the same returns with the mounting that was found")
        .out("table", "lever arm and misalignment with their standard deviations")
        .needs("cloud", velum::column::kTilt)
        .rows(&Mounting::planes, "planes", "planes whose place is known",
              velum::Row<Plane>()
                  .field(&Plane::normal, "normal", "of any length")
                  .field(&Plane::point, "point", "a point of the plane"))
        .choice(&Mounting::mounting, "mounting", "what the scanner is turned about",
                {{"plate", lms::Mounting::plate, "its x axis, across the view"},
                 {"turntable", lms::Mounting::turntable,
                  "its 90-degree direction, which stands upright"}})
        .param(&Mounting::lever_arm, "lever_arm", "with which the cloud was made")
        .param(&Mounting::misalignment, "misalignment",
               "with which the cloud was made: three angles about x, y and z")
        .param(&Mounting::tolerance, "tolerance",
               "farther from all planes a return does not count; shrinks to three times the rms",
               velum::above(0.0))
        .param(&Mounting::iterations, "iterations", "at most that many rounds",
               velum::between(1, 1000))
        .deterministic()
        .reference("Gauss-Newton on the distances from planes; Canciani, thesis, 2.3 (tilt plate)");
  }

  void check() const {
    if (planes.empty()) throw velum::Error(velum::Fault::graph, "no plane is known").at("planes");
    for (const Plane& plane : planes)
      if (!(plane.normal.norm() > 0.0))
        throw velum::Error(velum::Fault::graph, "a normal of length 0").at("planes");
    if (!misalignment.empty() && misalignment.size() != 3)
      throw velum::Error(velum::Fault::graph, "expected three angles").at("misalignment");
  }

  std::tuple<velum::Cloud, velum::Table> operator()(const velum::Cloud& cloud,
                                                    velum::Context& context) const;

 private:
  struct State {
    Matrix3d turn;
    Vector3d lever;
  };
  [[nodiscard]] State given() const;
  [[nodiscard]] std::vector<Beam> beams_of(const velum::Cloud& cloud) const;
  [[nodiscard]] Sums sum(const std::vector<Beam>& beams, const State& state, double reach,
                         velum::Context& context) const;
  void add(Sums& sums, const Beam& beam, const State& state, double reach) const;
};

Mounting::State Mounting::given() const {
  Vector3d angles = Vector3d::Zero();
  for (std::size_t i = 0; i < misalignment.size(); ++i)
    angles[static_cast<Index>(i)] = misalignment[i];
  return {lms::misalignment_turn(angles), lever_arm.metres};
}

std::vector<Beam> Mounting::beams_of(const velum::Cloud& cloud) const {
  const State made = given();
  const auto tilt = cloud.column(velum::column::kTilt).vector<float>();
  std::vector<Beam> beams(static_cast<std::size_t>(cloud.size()));
  for (Index i = 0; i < cloud.size(); ++i) {
    const double angle = double{tilt[i]};
    const Vector3d on_plate = lms::axis_turn(mounting, -angle) *
                              (cloud.positions().col(i).cast<double>() + cloud.origin());
    beams[static_cast<std::size_t>(i)] = {made.turn.transpose() * (on_plate - made.lever), angle};
  }
  return beams;
}

// A return counts for the nearest plane. With q = turn * place the point is axis * (q + lever): its
// distance from the plane changes by (axisᵀ n) · dlever and (q × axisᵀ n) · dturn.
void Mounting::add(Sums& sums, const Beam& beam, const State& state, double reach) const {
  const Matrix3d axis = lms::axis_turn(mounting, beam.tilt);
  const Vector3d q = state.turn * beam.place;
  const Vector3d at = axis * (q + state.lever);
  double nearest = reach;
  Vector3d normal = Vector3d::Zero();
  double error = 0.0;
  for (const Plane& plane : planes) {
    const Vector3d n = plane.normal.normalized();
    const double distance = n.dot(at - plane.point.metres);
    if (std::abs(distance) >= nearest) continue;
    nearest = std::abs(distance);
    normal = n;
    error = distance;
  }
  if (nearest >= reach) return;
  const Vector3d turned = axis.transpose() * normal;
  Vector6d row;
  row << turned, q.cross(turned);
  sums.normal += row * row.transpose();
  sums.right -= row * error;
  sums.squares += error * error;
  ++sums.count;
}

Sums Mounting::sum(const std::vector<Beam>& beams, const State& state, double reach,
                   velum::Context& context) const {
  return velum::parallel_reduce(
      context, static_cast<Index>(beams.size()), 4096, Sums(),
      [&](Index begin, Index end) {
        context.check();
        Sums part;
        for (Index i = begin; i < end; ++i)
          add(part, beams[static_cast<std::size_t>(i)], state, reach);
        return part;
      },
      [](Sums& total, const Sums& part) {
        total.normal += part.normal;
        total.right += part.right;
        total.squares += part.squares;
        total.count += part.count;
      });
}

// The normal equations solved where the planes say something; what they leave open stays.
struct Solution {
  Vector6d step = Vector6d::Zero();
  Vector6d variance = Vector6d::Zero();
  Vector6d open = Vector6d::Zero();  ///< share of each unknown that is not determined
};
Solution solve(const Sums& sums) {
  constexpr double kOpen = 1e-6;  // of the largest eigenvalue
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(sums.normal);
  const double largest = std::max(eigen.eigenvalues()[5], 1e-300);
  Solution solution;
  for (int k = 0; k < 6; ++k) {
    const Vector6d v = eigen.eigenvectors().col(k);
    const double value = eigen.eigenvalues()[k];
    if (value < kOpen * largest) {
      solution.open += v.cwiseAbs2();
      continue;
    }
    solution.step += v * (v.dot(sums.right) / value);
    solution.variance += v.cwiseAbs2() / value;
  }
  return solution;
}

std::tuple<velum::Cloud, velum::Table> Mounting::operator()(const velum::Cloud& cloud,
                                                            velum::Context& context) const {
  const std::vector<Beam> beams = beams_of(cloud);
  State state = given();
  double reach = tolerance;
  Solution solution;
  Sums sums;
  int rounds = 0;
  for (; rounds < iterations; ++rounds) {
    sums = sum(beams, state, reach, context);
    constexpr Index kUnknowns = 6;
    if (sums.count <= kUnknowns)
      throw velum::Error(velum::Fault::stage,
                         fmt::format("{} returns lie within {:g} m of the planes, expected more "
                                     "than {}",
                                     sums.count, reach, kUnknowns))
          .hint("a larger tolerance, or planes in the cloud's frame");
    solution = solve(sums);
    state.lever += solution.step.head<3>();
    const Vector3d turn = solution.step.tail<3>();
    if (turn.norm() > 0.0)
      state.turn =
          Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * state.turn;
    const double rms = std::sqrt(sums.squares / static_cast<double>(sums.count));
    reach = std::min<double>(tolerance, std::max(3.0 * rms, 1e-3));
    constexpr double kStill = 1e-9;
    if (solution.step.norm() < kStill) break;
  }

  const double rms = std::sqrt(sums.squares / static_cast<double>(sums.count));
  const Vector3d angles = angles_of(state.turn);
  velum::Table table{{"parameter", ""}, {"value", ""}, {"deviation", ""}, {"unit", ""}};
  for (int i = 0; i < 6; ++i) {
    const bool length = i < 3;
    const double scale = length ? 1.0 : 180.0 / std::numbers::pi;
    const double value = length ? state.lever[i] : angles[i - 3];
    const double deviation = rms * std::sqrt(solution.variance[i]);
    const auto* name = kNames.at(static_cast<std::size_t>(i));
    table.add(
        {std::string(name), scale * value, scale * deviation, std::string(length ? "m" : "deg")});
    context.measure(name, value, length ? "m" : "rad");
    constexpr double kMostOpen = 0.5;
    if (solution.open[i] > kMostOpen)
      context.warn(fmt::format("the planes do not tell {}: it stays as given", name));
  }
  context.measure("rms", rms, "m", velum::Better::lower);
  context.measure("used", static_cast<double>(sums.count), "");
  context.measure("iterations", rounds, "");

  velum::Points positions(3, cloud.size());
  for (Index i = 0; i < cloud.size(); ++i) {
    const Beam& beam = beams[static_cast<std::size_t>(i)];
    positions.col(i) =
        (lms::axis_turn(mounting, beam.tilt) * (state.turn * beam.place + state.lever) -
         cloud.origin())
            .cast<float>();
  }
  return {cloud.with_positions(std::move(positions)), std::move(table)};
}

}  // namespace

VELUM_STAGE(Mounting)
