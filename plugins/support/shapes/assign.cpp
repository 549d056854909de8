// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>

#include "shapes/consensus.hpp"
#include "shapes/fit.hpp"
#include "shapes/ransac.hpp"

namespace velum::shapes {
namespace {

constexpr Index kGrain = 2048;
constexpr Index kAround = 16;    // neighbours that speak for a point with a mixed normal
constexpr int kWitnesses = 2;    // of them that must already belong to the shape
constexpr int kMostPasses = 40;  // inwards from the edge, one row of points each
constexpr double kNoChoice = 1e9;

// How badly a point fits a shape: squared distance in units of the shape's scatter, and squared
// angle in units of half the limit, the latter bounded because normals at an edge say little.
class Cost {
 public:
  Cost(const Search& search, const std::vector<Found>& shapes) : search_(search) {
    for (const Found& one : shapes) scatter_.push_back(std::max(one.rms, search.epsilon / 50.0));
  }
  [[nodiscard]] double operator()(std::size_t shape, const Residual& residual) const {
    const double d = static_cast<double>(residual.distance) / scatter_[shape];
    const double angle = std::acos(std::min(1.0, static_cast<double>(residual.cosine)));
    const double turn = std::min(angle / search_.angle, 1.5) * 2.0;
    return d * d + turn * turn;
  }

 private:
  const Search& search_;
  std::vector<double> scatter_;
};

struct Choice {
  int best = -1;      ///< cheapest shape within ε
  bool sure = false;  ///< its normal agrees too
};

// Parts of one surface are shapes of their own where gaps part them: what was found as one part
// stays with it, and other points must be reached from it.
void keep_parts(const Detection& detection, std::vector<Choice>& choices) {
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const int label = detection.labels[static_cast<Index>(i)];
    choices[i].sure = choices[i].sure && label >= 0;
    if (choices[i].sure) choices[i].best = label;
  }
}

std::vector<Choice> choices(const Field& field, const Search& search, const Detection& detection,
                            Context& context) {
  const Cost cost(search, detection.shapes);
  const auto near = static_cast<float>(search.epsilon);
  const auto cosine = static_cast<float>(std::cos(search.angle));
  const Index count = field.positions.cols();
  std::vector<Choice> made(static_cast<std::size_t>(count));
  std::vector<double> least(made.size(), kNoChoice);
  for (std::size_t s = 0; s < detection.shapes.size(); ++s)
    with_probe(detection.shapes[s].shape, [&](const auto& probe) {
      parallel_for(context, count, kGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          const Residual residual = probe(field.positions.col(i), field.normals.col(i));
          if (!(residual.distance <= near)) continue;
          const double own = cost(s, residual);
          const auto k = static_cast<std::size_t>(i);
          if (!(own < least[k])) continue;
          least[k] = own;
          made[k] = {static_cast<int>(s), residual.cosine >= cosine};
        }
      });
    });
  if (search.gap > 0.0) keep_parts(detection, made);
  return made;
}

// Points on a shape whose normal is mixed join it row by row, from those that belong to it surely.
void grow_to_edges(const Cloud& cloud, const std::vector<Choice>& choices, Eigen::VectorXi& labels,
                   Context& context) {
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < choices.size(); ++i)
    if (choices[i].best >= 0 && !choices[i].sure) open.push_back(static_cast<std::int32_t>(i));
  if (open.empty()) return;
  const auto count = static_cast<Index>(open.size());
  Points queries(3, count);
  for (Index i = 0; i < count; ++i)
    queries.col(i) = cloud.positions().col(open[static_cast<std::size_t>(i)]);
  std::vector<std::vector<std::int32_t>> around(open.size());
  cloud.neighbours().each_nearest(ConstPoints(queries.data(), 3, count), kAround + 1, context,
                                  [&](Index query, std::span<const Neighbour> found) {
                                    auto& own = around[static_cast<std::size_t>(query)];
                                    for (const Neighbour& one : found) own.push_back(one.index);
                                  });
  for (int pass = 0; pass < kMostPasses; ++pass) {
    context.check();
    std::vector<std::size_t> joining;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const int wanted = choices[static_cast<std::size_t>(open[i])].best;
      if (labels[open[i]] >= 0) continue;
      const auto witnesses = std::count_if(around[i].begin(), around[i].end(),
                                           [&](std::int32_t n) { return labels[n] == wanted; });
      if (witnesses >= kWitnesses) joining.push_back(i);
    }
    if (joining.empty()) return;
    for (const std::size_t i : joining)
      labels[open[i]] = choices[static_cast<std::size_t>(open[i])].best;
  }
}

std::vector<std::vector<std::int32_t>> members_of(const Detection& detection) {
  std::vector<std::vector<std::int32_t>> members(detection.shapes.size());
  for (Index i = 0; i < detection.labels.size(); ++i)
    if (detection.labels[i] >= 0)
      members[static_cast<std::size_t>(detection.labels[i])].push_back(
          static_cast<std::int32_t>(i));
  return members;
}

// Numbers by points, the most first, without those that were left with too few.
void renumber(Detection& detection, Index min_size) {
  std::vector<std::size_t> order(detection.shapes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::erase_if(order, [&](std::size_t s) { return detection.shapes[s].points < min_size; });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return detection.shapes[a].points > detection.shapes[b].points;
  });
  std::vector<int> number(detection.shapes.size(), -1);
  std::vector<Found> shapes;
  for (const std::size_t s : order) {
    number[s] = static_cast<int>(shapes.size());
    shapes.push_back(detection.shapes[s]);
  }
  for (int& label : detection.labels)
    if (label >= 0) label = number[static_cast<std::size_t>(label)];
  detection.shapes = std::move(shapes);
}

}  // namespace

void assign_points(const Cloud& cloud, const Search& search, Detection& detection,
                   Context& context) {
  if (detection.shapes.empty()) {
    detection.labels = Eigen::VectorXi::Constant(cloud.size(), -1);
    return;
  }
  const Field field(cloud);
  const Eigen::Vector3d middle = field.middle.cast<double>();
  for (Found& one : detection.shapes) one.shape.point -= middle;
  for (int round = 0; round < 3; ++round) {
    const auto wanted = choices(field, search, detection, context);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      detection.labels[static_cast<Index>(i)] = wanted[i].sure ? wanted[i].best : -1;
    // The fit takes sure points only; the edges are given out when it stands.
    const auto members = members_of(detection);
    for (std::size_t s = 0; s < members.size(); ++s) {
      Found& one = detection.shapes[s];
      const Shape trial = refine(one.shape, field.positions, members[s], context);
      if (admissible(trial, search)) one.shape = trial;
      one.rms = rms(one.shape, field.positions, members[s], context);
    }
  }
  const auto wanted = choices(field, search, detection, context);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    detection.labels[static_cast<Index>(i)] = wanted[i].sure ? wanted[i].best : -1;
  if (search.edges) grow_to_edges(cloud, wanted, detection.labels, context);
  const auto members = members_of(detection);
  for (std::size_t s = 0; s < members.size(); ++s) {
    Found& one = detection.shapes[s];
    one.points = static_cast<Index>(members[s].size());
    one.rms = rms(one.shape, field.positions, members[s], context);
    one.shape.point += middle;
  }
  renumber(detection, search.min_size);
}

}  // namespace velum::shapes
