// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "mesh/build.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace velum::mesh {
namespace {

/// An edge of a triangle, without direction.
struct Side {
  std::int32_t low, high, triangle;
  bool ascending;
};

/// Two triangles that share an edge which no third one has.
struct Link {
  std::int32_t other;
  bool agree;  ///< they run along the edge in opposite directions, as they should
};

std::vector<std::vector<Link>> links_of(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangles[t][i];
      const std::int32_t b = triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  std::vector<std::vector<Link>> links(triangles.size());
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high)
      ++end;
    if (end - begin == 2) {
      const Side& a = sides[begin];
      const Side& b = sides[begin + 1];
      const bool agree = a.ascending != b.ascending;
      links[static_cast<std::size_t>(a.triangle)].push_back({b.triangle, agree});
      links[static_cast<std::size_t>(b.triangle)].push_back({a.triangle, agree});
    }
    begin = end;
  }
  return links;
}

void turn(Triangle& t) {
  std::swap(t[1], t[2]);
}

/// Sum over the part of what its area shows to the sensors; positive: it looks at them.
double towards_sensors(const std::vector<std::int32_t>& part,
                       const std::vector<Triangle>& triangles, const Cloud& cloud) {
  const ConstPoints positions = cloud.positions();
  double towards = 0.0;
  for (const std::int32_t number : part) {
    const Triangle& t = triangles[static_cast<std::size_t>(number)];
    const auto sensor = cloud.sensor_of(t[0]);
    if (!sensor) continue;
    const Eigen::Vector3f ray = cloud.sensor_position(*sensor) - positions.col(t[0]);
    towards += area_vector(t, positions).dot(ray.cast<double>().normalized());
  }
  return towards;
}

}  // namespace

Eigen::Vector3d area_vector(const Triangle& t, const ConstPoints& positions) {
  const Eigen::Vector3d a = positions.col(t[0]).cast<double>();
  return (positions.col(t[1]).cast<double>() - a).cross(positions.col(t[2]).cast<double>() - a);
}

Orientation orient(std::vector<Triangle>& triangles, const Cloud& cloud) {
  Orientation found;
  const std::vector<std::vector<Link>> links = links_of(triangles);
  std::vector<signed char> flip(triangles.size(), -1);  // -1: not reached
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (flip[first] >= 0) continue;
    ++found.parts;
    flip[first] = 0;
    std::vector<std::int32_t> part{static_cast<std::int32_t>(first)};
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto t = static_cast<std::size_t>(part[i]);
      for (const Link& link : links[t]) {
        const auto other = static_cast<std::size_t>(link.other);
        const auto wanted = static_cast<signed char>(link.agree ? flip[t] : 1 - flip[t]);
        if (flip[other] < 0) {
          flip[other] = wanted;
          part.push_back(link.other);
        } else if (flip[other] != wanted && t < other) {
          ++found.conflicts;
        }
      }
    }
    for (const std::int32_t t : part)
      if (flip[static_cast<std::size_t>(t)] == 1) turn(triangles[static_cast<std::size_t>(t)]);
    const bool away = towards_sensors(part, triangles, cloud) < 0.0;
    for (const std::int32_t number : part) {
      const auto t = static_cast<std::size_t>(number);
      if (away) turn(triangles[t]);
      if (away != (flip[t] == 1)) ++found.turned;
    }
  }
  return found;
}

Index keep_parts(std::vector<Triangle>& triangles, const ConstPoints& positions, double share) {
  const Components parts = components(adjacency(view(triangles)));
  if (parts.count <= 1) return 0;
  std::vector<double> areas(static_cast<std::size_t>(parts.count), 0.0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    areas[static_cast<std::size_t>(parts.of[t])] += area_vector(triangles[t], positions).norm();
  const auto largest =
      static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  std::vector<char> keep(areas.size(), 0);
  for (std::size_t p = 0; p < areas.size(); ++p)
    keep[p] = p == largest || (share < 1.0 && areas[p] >= share * areas[largest]) ? 1 : 0;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (keep[static_cast<std::size_t>(parts.of[t])] != 0) triangles[kept++] = triangles[t];
  triangles.resize(kept);
  return std::count(keep.begin(), keep.end(), 0);
}

Mesh mesh_over(const std::vector<Triangle>& triangles, const Cloud& cloud) {
  std::vector<std::int32_t> place(static_cast<std::size_t>(cloud.size()), -1);
  for (const Triangle& t : triangles)
    for (const std::int32_t v : t) place[static_cast<std::size_t>(v)] = 0;
  std::vector<std::int32_t> used;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] < 0) continue;
    place[v] = static_cast<std::int32_t>(used.size());
    used.push_back(static_cast<std::int32_t>(v));
  }
  Triangles out(3, static_cast<Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      out(static_cast<Index>(i), static_cast<Index>(t)) =
          place[static_cast<std::size_t>(triangles[t][i])];
  return Mesh(cloud.select(used), std::move(out));
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  const ConstTriangles from = mesh.triangles();
  std::vector<Triangle> triangles(static_cast<std::size_t>(from.cols()));
  for (Index t = 0; t < from.cols(); ++t)
    triangles[static_cast<std::size_t>(t)] = {from(0, t), from(1, t), from(2, t)};
  return triangles;
}

ConstTriangles view(const std::vector<Triangle>& triangles) {
  return {triangles.empty() ? nullptr : triangles.front().data(), 3,
          static_cast<Index>(triangles.size())};
}

std::vector<std::int32_t> first_of_equal(const ConstPoints& positions) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(positions.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return std::tuple(positions(0, a), positions(1, a), positions(2, a), a) <
           std::tuple(positions(0, b), positions(1, b), positions(2, b), b);
  });
  std::vector<std::int32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && positions.col(order[i]) == positions.col(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] =
        again ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

}  // namespace velum::mesh
