// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <velum/stage.hpp>

#include "geometry/motion.hpp"
#include "geometry/rigid_fit.hpp"
#include "registration/pairs_file.hpp"
#include "registration/picked_pair.hpp"

namespace {

using velum::Error;
using velum::Fault;
using velum::registration::PickedPair;

/// Picks whose spread across their line is below this share of that along it fix the turn about the
/// line worse than everything else by a factor of twenty.
constexpr double kNearLine = 0.05;
/// And below this it is not fixed at all.
constexpr double kLine = 1e-5;

struct Svd {
  std::vector<PickedPair> pairs;
  std::optional<velum::InputFile> file;
  velum::LengthUnit units;

  static auto about() {
    return velum::About<Svd>("The rigid motion that brings picked points onto their partners.")
        .in("source")
        .in("target", "for the record only: the picks decide")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target")
        .out("table", "one row a pair: where it came to lie, and how far from its partner")
        .rows(&Svd::pairs, "pairs", "points of the source and the same points of the target",
              velum::Row<PickedPair>()
                  .field(&PickedPair::source, "source", "in the source's frame")
                  .field(&PickedPair::target, "target", "in the target's frame"))
        .param(
            &Svd::file, "file",
            "the same in a text file: six numbers a line, source x y z, target x y z; instead of "
            "`pairs`")
        .param(&Svd::units, "units", "of the lengths in `file`")
        .reference("Canciani thesis, 3.2.1, equations 3.5 to 3.11")
        .reference("Arun, Huang, Blostein: Least-squares fitting of two 3-D point sets. PAMI 1987")
        .reference("Umeyama: Least-squares estimation of transformation parameters. PAMI 1991")
        .deterministic();
  }

  void check() const {
    if (file && !pairs.empty())
      throw Error(Fault::graph, "the pairs are given twice: by 'pairs' and by 'file'").at("file");
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const std::optional<velum::Cloud>& /*target*/,
      velum::Context& context) const {
    context.check();
    const std::vector<PickedPair> picks = all_pairs();
    require_sound(picks);
    Eigen::Matrix3Xd from(3, static_cast<velum::Index>(picks.size()));
    Eigen::Matrix3Xd to(3, from.cols());
    for (std::size_t i = 0; i < picks.size(); ++i) {
      from.col(static_cast<velum::Index>(i)) = picks[i].source.metres;
      to.col(static_cast<velum::Index>(i)) = picks[i].target.metres;
    }
    const auto fit = velum::geometry::rigid_fit(from, to);
    require_spread(fit, context);

    velum::Transform transform;
    transform.matrix = fit.pose;
    transform.fitness = fit.rmse * fit.rmse;
    report(fit, from.cols(), context);
    return {source.transformed(fit.pose), transform, residuals(fit.pose, from, to)};
  }

 private:
  [[nodiscard]] std::vector<PickedPair> all_pairs() const {
    return file ? velum::registration::read_pairs(file->path, units.metres) : pairs;
  }

  static void require_sound(const std::vector<PickedPair>& picks) {
    if (picks.size() < 3)
      throw Error(Fault::stage,
                  fmt::format("{} pairs are given, at least 3 are needed", picks.size()))
          .hint("pick points that are far apart and not on one line");
    for (std::size_t i = 0; i < picks.size(); ++i) {
      if (!picks[i].source.metres.allFinite() || !picks[i].target.metres.allFinite())
        throw Error(Fault::stage, fmt::format("pair {} is not finite", i));
      for (std::size_t j = 0; j < i; ++j)
        if (picks[i].source.metres == picks[j].source.metres ||
            picks[i].target.metres == picks[j].target.metres)
          throw Error(Fault::stage, fmt::format("pairs {} and {} name the same point", j, i))
              .hint("each pair needs points of its own");
    }
  }

  static void require_spread(const velum::geometry::RigidFit& fit, velum::Context& context) {
    const double ratio = std::sqrt(fit.spread[1] / fit.spread[0]);
    context.measure("spread", ratio, "", velum::Better::higher);
    if (ratio < kLine)
      throw Error(Fault::stage, "the picked points lie on a line: the turn about it is free")
          .hint("pick one more pair well away from the line through the others");
    if (ratio < kNearLine)
      context.warn(
          fmt::format("the picked points are close to a line: their spread across it is {:.2g} of "
                      "that along it, "
                      "and errors of the picks turn the result {:.0f} times as far about it",
                      ratio, 1.0 / ratio));
  }

  static void report(const velum::geometry::RigidFit& fit, velum::Index pairs,
                     velum::Context& context) {
    context.measure("fitness", fit.rmse * fit.rmse, "m^2", velum::Better::lower);
    context.measure("rmse", fit.rmse, "m", velum::Better::lower);
    context.measure("overlap", 1.0, "", velum::Better::higher);
    context.measure("iterations", 1.0, "");
    context.measure("pairs", static_cast<double>(pairs), "");
  }

  static velum::Table residuals(const velum::Pose& pose, const Eigen::Matrix3Xd& from,
                                const Eigen::Matrix3Xd& to) {
    velum::Table table({{"pair", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}, {"residual", "m"}});
    for (velum::Index i = 0; i < from.cols(); ++i) {
      const Eigen::Vector3d moved = pose * from.col(i);
      table.add({static_cast<std::int64_t>(i), moved.x(), moved.y(), moved.z(),
                 (moved - to.col(i)).norm()});
    }
    return table;
  }
};

}  // namespace
VELUM_STAGE(Svd)
