// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/neighbours.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <numeric>

#include "run/local_context.hpp"
#include "values/curve.hpp"
#include "values/selection.hpp"
#include "velum/cloud.hpp"
#include "velum/random.hpp"

using namespace velum;

namespace {

ConstPoints view(const Points& points) {
  return {points.data(), 3, points.cols()};
}

/// What the index must answer, by looking at every point.
std::vector<Neighbour> all_by_distance(const Points& points, const Eigen::Vector3f& query) {
  std::vector<Neighbour> all;
  for (Index i = 0; i < points.cols(); ++i) {
    const Eigen::Array3f d = points.col(i) - query;
    all.push_back({static_cast<std::int32_t>(i), d.x() * d.x() + d.y() * d.y() + d.z() * d.z()});
  }
  std::sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
  });
  return all;
}

std::vector<Neighbour> closer(const std::vector<Neighbour>& all, double radius) {
  std::vector<Neighbour> result;
  for (const Neighbour& neighbour : all)
    if (static_cast<double>(neighbour.distance2) <= radius * radius) result.push_back(neighbour);
  return result;
}

bool same(std::span<const Neighbour> a, std::span<const Neighbour> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.index == y.index && x.distance2 == y.distance2;
  });
}

std::span<const Neighbour> head(const std::vector<Neighbour>& all, Index k) {
  return std::span(all).first(std::min(all.size(), static_cast<std::size_t>(k)));
}

template <class Make>
Points made(Index count, const Make& make) {
  Random random(11);
  Points points(3, count);
  for (Index i = 0; i < count; ++i) points.col(i) = make(random, i).template cast<float>();
  return points;
}

Eigen::Vector3d anywhere(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

struct Set {
  std::string name;
  Points points;
};

std::vector<Set> sets() {
  const auto at = [](double x, double y, double z) { return Eigen::Vector3d(x, y, z); };
  std::vector<Set> all = {
      {"volume", made(700, [](Random& r, Index) { return anywhere(r); })},
      {"surface", made(700, [&](Random& r, Index) { return at(r.uniform(), r.uniform(), 0.1); })},
      {"grid with many ties",
       made(729, [&](Random&,
                     Index i) { return at(double(i % 9), double(i / 9 % 9), double(i / 81)); })},
      {"line", made(500, [&](Random& r, Index) { return at(r.uniform(), 0, 0); })},
      {"far away",
       made(500, [](Random& r,
                    Index) { return (Eigen::Vector3d(5e6, 4e5, 10) + 300 * anywhere(r)).eval(); })},
      {"tiny", made(500, [](Random& r, Index) { return (1e-22 * anywhere(r)).eval(); })},
      {"huge", made(500, [](Random& r, Index) { return (3e38 * anywhere(r)).eval(); })},
      {"clusters of uneven density",
       made(800, [](Random& r,
                    Index i) { return (std::pow(10.0, double(i % 7) - 5) * anywhere(r)).eval(); })},
      {"a stray point",
       made(600, [&](Random& r, Index i) { return i == 77 ? at(1e9, 0, -1e9) : anywhere(r); })},
      {"all equal", made(300, [&](Random&, Index) { return at(1, 2, 3); })},
      {"half equal",
       made(600, [&](Random& r, Index i) { return i % 2 ? at(0, 0, 0) : anywhere(r); })},
  };
  for (const Index count : {0, 1, 2, 3, 16, 17, 128, 129})
    all.push_back(
        {std::to_string(count), made(count, [](Random& r, Index) { return anywhere(r); })});
  return all;
}

std::vector<Eigen::Vector3f> queries_of(const Points& points) {
  std::vector<Eigen::Vector3f> queries = {{0, 0, 0}, {1, 2, 3}, {-1e6F, 1e7F, 3}};
  for (Index i = 0; i < points.cols(); i += 29) {
    queries.emplace_back(points.col(i));
    queries.emplace_back(points.col(i) * 1.001F);
  }
  return queries;
}

std::vector<double> radii_of(const Points& points) {
  if (points.cols() == 0) return {0.0, 1.0};
  const double diagonal = bounding_box(view(points)).diagonal().cast<double>().norm();
  return {0.0,
          0.01 * diagonal,
          0.2 * diagonal,
          2 * diagonal,
          1.0,
          std::numeric_limits<double>::infinity()};
}

}  // namespace

TEST_CASE("neighbours: single queries answer as a look at all points does") {
  for (const auto& [name, points] : sets()) {
    CAPTURE(name);
    const Neighbours index(view(points));
    REQUIRE(index.size() == points.cols());
    std::vector<Neighbour> found;
    for (const Eigen::Vector3f& query : queries_of(points)) {
      const auto all = all_by_distance(points, query);
      for (const Index k : {1, 2, 7, 50, 200, 10000}) {
        index.nearest(query, k, found);
        if (!same(found, head(all, k))) FAIL_CHECK("k = " << k);
      }
      for (const double radius : radii_of(points)) {
        index.within(query, radius, found);
        if (!same(found, closer(all, radius))) FAIL_CHECK("radius = " << radius);
        const Neighbour one = index.nearest_one(query, radius);
        const bool exists = !all.empty() && static_cast<double>(all[0].distance2) < radius * radius;
        if (one.index != (exists ? all[0].index : -1)) FAIL_CHECK("one within " << radius);
      }
    }
  }
}

TEST_CASE("neighbours: batches answer as a look at all points does, with 1 and 2 threads") {
  for (const auto& [name, points] : sets()) {
    CAPTURE(name);
    const Neighbours index(view(points));
    std::vector<std::vector<Neighbour>> all;
    for (Index i = 0; i < points.cols(); ++i) all.push_back(all_by_distance(points, points.col(i)));
    for (const int threads : {1, 2}) {
      run::LocalContext context(threads, 1);
      std::atomic<Index> visits = 0;
      std::atomic<Index> wrong = 0;
      for (const Index k : {1, 8, 50, 2000}) {
        index.each_nearest(k, context, [&](Index i, std::span<const Neighbour> found) {
          ++visits;
          if (!same(found, head(all[static_cast<std::size_t>(i)], k))) ++wrong;
        });
        CHECK(visits.exchange(0) == points.cols());
      }
      for (const double radius : radii_of(points)) {
        index.each_within(radius, context, [&](Index i, std::span<const Neighbour> found) {
          ++visits;
          if (!same(found, closer(all[static_cast<std::size_t>(i)], radius))) ++wrong;
        });
        CHECK(visits.exchange(0) == points.cols());
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("neighbours: batches of other positions") {
  const Points points = made(900, [](Random& r, Index) { return anywhere(r); });
  Points queries = made(333, [](Random& r, Index i) {
    return (i % 5 == 0 ? 100 * anywhere(r) : anywhere(r)).eval();
  });
  queries(1, 7) = std::numeric_limits<float>::quiet_NaN();
  queries(2, 300) = std::numeric_limits<float>::infinity();
  const Neighbours index(view(points));
  run::LocalContext context(2, 1);
  std::vector<int> visits(333);
  std::atomic<int> wrong = 0;
  const auto check = [&](Index i, std::span<const Neighbour> found,
                         std::vector<Neighbour> expected) {
    ++visits[static_cast<std::size_t>(i)];
    if (i == 7 || i == 300) expected.clear();
    if (!same(found, expected)) ++wrong;
  };
  index.each_nearest(view(queries), 12, context, [&](Index i, std::span<const Neighbour> found) {
    auto all = all_by_distance(points, queries.col(i));
    all.resize(12);
    check(i, found, all);
  });
  index.each_within(view(queries), 0.3, context, [&](Index i, std::span<const Neighbour> found) {
    check(i, found, closer(all_by_distance(points, queries.col(i)), 0.3));
  });
  CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 2; }));
  CHECK(wrong == 0);
}

TEST_CASE("neighbours: queries that have no answer") {
  const Points points = made(40, [](Random& r, Index) { return anywhere(r); });
  const Neighbours index(view(points));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Neighbour> found(3);
  index.nearest({nan, 0, 0}, 3, found);
  CHECK(found.empty());
  index.within({0, nan, 0}, 3, found);
  CHECK(found.empty());
  index.nearest({0, 0, 0}, 0, found);
  CHECK(found.empty());
  index.within({0, 0, 0}, -1, found);
  CHECK(found.empty());
  index.within({0, 0, 0}, std::numeric_limits<double>::quiet_NaN(), found);
  CHECK(found.empty());
  CHECK(index.nearest_one({0, 0, nan}, 3).index == -1);
  CHECK(index.nearest_one({0, 0, 0}, 0).index == -1);
  run::LocalContext context(2, 1);
  std::atomic<int> visits = 0;
  const auto count = [&](Index, std::span<const Neighbour> answer) {
    visits += answer.empty() ? 1 : 1000;
  };
  index.each_nearest(0, context, count);
  index.each_within(-1, context, count);
  Neighbours(view(Points(3, 0))).each_nearest(view(points), 5, context, count);
  CHECK(visits == 120);
}

TEST_CASE("neighbours: a radius is met exactly") {
  const Points points = made(3, [](Random&, Index i) { return Eigen::Vector3d(double(i), 0, 0); });
  const Neighbours index(view(points));
  std::vector<Neighbour> found;
  index.within({0, 0, 0}, 1.0, found);
  CHECK(found.size() == 2);
  index.within({0, 0, 0}, std::nextafter(1.0, 0.0), found);
  CHECK(found.size() == 1);
  CHECK(index.nearest_one({-1, 0, 0}, 1.0).index == -1);
  CHECK(index.nearest_one({-1, 0, 0}, std::nextafter(1.0, 2.0)).index == 0);
}

TEST_CASE("neighbours: many equal points cost no more than others") {
  const Points points =
      made(100000, [](Random&, Index i) { return Eigen::Vector3d(double(i % 3), 0, 0); });
  const Neighbours index(view(points));
  std::vector<Neighbour> found;
  index.nearest({2, 0, 0}, 5, found);
  REQUIRE(found.size() == 5);
  CHECK(found[0].index == 2);
  CHECK(found[4].index == 14);
  index.within({1, 0, 0}, 0, found);
  CHECK(found.size() == 33333);
}

TEST_CASE("neighbours: batches can be interrupted") {
  const Points points = made(20000, [](Random& r, Index) { return anywhere(r); });
  const Neighbours index(view(points));
  run::LocalContext context(2, 1);
  std::atomic<int> visits = 0;
  const auto cancel = [&](Index, std::span<const Neighbour>) {
    if (++visits == 100) context.cancel();
  };
  CHECK_THROWS_AS(index.each_nearest(5, context, cancel), Cancelled);
  CHECK(visits < 20000);
  CHECK_THROWS_AS(index.each_within(0.1, context, cancel), Cancelled);
}

TEST_CASE("neighbours: the curve visits every point once and steps to what is near") {
  const Points points = made(5000, [](Random& r, Index i) {
    return (i == 9 ? Eigen::Vector3d(1e8, 0, 0) : anywhere(r)).eval();
  });
  const auto order = spatial::curve_order(view(points), 16);
  std::vector<std::int32_t> sorted(order);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> expected(5000);
  std::iota(expected.begin(), expected.end(), 0);
  CHECK(sorted == expected);
  double length = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const double step =
        static_cast<double>((points.col(order[i]) - points.col(order[i - 1])).norm());
    if (step < 1e7) length += step;
  }
  // Mean spacing of 5000 points in this cube is 0.117; without an order steps are about 1.3.
  CHECK(length / 5000 < 0.2);
}

TEST_CASE("neighbours: selection by buckets gives what a sort gives") {
  Random random(5);
  spatial::Selector selector;
  for (int trial = 0; trial < 300; ++trial) {
    const auto count = static_cast<std::size_t>(random.below(300));
    const double power = random.uniform(0.2, 8);
    std::vector<Neighbour> candidates;
    for (std::size_t i = 0; i < count; ++i)
      candidates.push_back(
          {static_cast<std::int32_t>(i), static_cast<float>(std::pow(random.uniform(), power))});
    std::vector<Neighbour> expected(candidates);
    std::sort(expected.begin(), expected.end(), spatial::before);
    const auto k = static_cast<std::size_t>(random.below(320));
    if (!same(selector.first(candidates, k, 1.0F), head(expected, static_cast<Index>(k))))
      FAIL_CHECK("trial " << trial);
  }
}
