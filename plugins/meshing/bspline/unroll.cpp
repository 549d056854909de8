// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "unroll.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <queue>
#include <velum/neighbours.hpp>

namespace velum::meshing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kNeighbours = 10;
constexpr Index kLandmarks = 120;

struct Way {
  std::int32_t to;
  double length;
};
using Graph = std::vector<std::vector<Way>>;

void join(Graph& graph, std::int32_t a, std::int32_t b, double length) {
  graph[static_cast<std::size_t>(a)].push_back({b, length});
  graph[static_cast<std::size_t>(b)].push_back({a, length});
}

std::vector<int> parts_of(const Graph& graph, int& count) {
  std::vector<int> part(graph.size(), -1);
  count = 0;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (part[i] >= 0) continue;
    std::vector<std::size_t> stack{i};
    part[i] = count;
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      for (const Way& way : graph[at]) {
        auto& next = part[static_cast<std::size_t>(way.to)];
        if (next >= 0) continue;
        next = count;
        stack.push_back(static_cast<std::size_t>(way.to));
      }
    }
    ++count;
  }
  return part;
}

// The nearest point of another part than the query's own.
Neighbour nearest_elsewhere(const Neighbours& index, const Points& points,
                            const std::vector<int>& part, std::size_t from) {
  std::vector<Neighbour> near;
  for (Index k = 4 * kNeighbours;; k *= 2) {
    index.nearest(points.col(static_cast<Index>(from)), k, near);
    for (const Neighbour& one : near)
      if (part[static_cast<std::size_t>(one.index)] != part[from]) return one;
    if (k >= points.cols()) return {-1, 0.0F};
  }
}

// Joins what shadows have cut apart, across the whole length of the gap: a single bridge would be a
// hinge.
void bridge(Graph& graph, const Neighbours& index, const Points& points, Context& context) {
  for (int count = 0;;) {
    const std::vector<int> part = parts_of(graph, count);
    if (count < 2) return;
    std::vector<Index> sizes(static_cast<std::size_t>(count), 0);
    for (const int p : part) ++sizes[static_cast<std::size_t>(p)];
    const auto smallest =
        static_cast<int>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::vector<std::pair<std::int32_t, Neighbour>> bridges;
    float gap = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (part[i] != smallest) continue;
      context.check();
      const Neighbour other = nearest_elsewhere(index, points, part, i);
      bridges.emplace_back(static_cast<std::int32_t>(i), other);
      gap = std::min(gap, other.distance2);
    }
    for (const auto& [from, other] : bridges)
      if (other.distance2 <= 4.0F * gap)
        join(graph, from, other.index, std::sqrt(static_cast<double>(other.distance2)));
  }
}

Graph neighbour_graph(const Points& points, Context& context) {
  const Neighbours index(ConstPoints(points.data(), 3, points.cols()));
  std::vector<std::vector<Neighbour>> near(static_cast<std::size_t>(points.cols()));
  index.each_nearest(kNeighbours + 1, context, [&](Index i, std::span<const Neighbour> found) {
    near[static_cast<std::size_t>(i)].assign(found.begin(), found.end());
  });
  Graph graph(near.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    for (const Neighbour& one : near[i])
      if (static_cast<std::size_t>(one.index) != i)
        join(graph, static_cast<std::int32_t>(i), one.index,
             std::sqrt(static_cast<double>(one.distance2)));
  bridge(graph, index, points, context);
  return graph;
}

VectorXd lengths_from(const Graph& graph, std::size_t start) {
  VectorXd length =
      VectorXd::Constant(static_cast<Index>(graph.size()), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  length[static_cast<Index>(start)] = 0.0;
  queue.emplace(0.0, static_cast<std::int32_t>(start));
  while (!queue.empty()) {
    const auto [so_far, at] = queue.top();
    queue.pop();
    if (so_far > length[at]) continue;
    for (const Way& way : graph[static_cast<std::size_t>(at)]) {
      const double total = so_far + way.length;
      if (total >= length[way.to]) continue;
      length[way.to] = total;
      queue.emplace(total, way.to);
    }
  }
  return length;
}

}  // namespace

Eigen::Matrix2Xd unroll(const Points& points, Context& context) {
  const Index n = points.cols();
  if (n < 4) throw Error(Fault::stage, "fewer than four distinct points make no sheet");
  const Graph graph = neighbour_graph(points, context);
  // Each landmark is the point farthest from those before it.
  const Index marks = std::min(n, kLandmarks);
  MatrixXd squares(marks, n);
  std::vector<Index> landmark;
  VectorXd nearest = VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  Index next = 0;
  for (Index m = 0; m < marks; ++m) {
    context.check();
    landmark.push_back(next);
    const VectorXd length = lengths_from(graph, static_cast<std::size_t>(next));
    squares.row(m) = length.cwiseAbs2().transpose();
    nearest = nearest.cwiseMin(length);
    nearest.maxCoeff(&next);
  }
  MatrixXd among(marks, marks);
  for (Index m = 0; m < marks; ++m)
    among.col(m) = squares.col(landmark[static_cast<std::size_t>(m)]);
  const VectorXd mean = among.rowwise().mean();
  MatrixXd centred = among.colwise() - mean;
  const Eigen::RowVectorXd columns = centred.colwise().mean();
  centred.rowwise() -= columns;
  centred = (-0.25 * (centred + centred.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(centred);
  const VectorXd two = eigen.eigenvalues().tail(2);
  if (!(two[0] > 1e-6 * two[1]) || !std::isfinite(two[1]))
    throw Error(Fault::stage, "the points lie on a line, a surface was expected");
  const MatrixXd axes = eigen.eigenvectors().rightCols(2);
  Eigen::Matrix2Xd plane(2, n);
  for (Index i = 0; i < n; ++i) {
    const VectorXd off = squares.col(i) - mean;
    plane.col(i) = -0.5 * (axes.transpose() * off).cwiseQuotient(two.cwiseSqrt());
  }
  return plane;
}

}  // namespace velum::meshing
