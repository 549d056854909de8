// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/sphere_votes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "shapes/fit.hpp"
#include "shapes/sampler.hpp"

namespace velum::shapes {

SphereVotes::SphereVotes(const Field& field, const Search& search, const Votes& votes,
                         Context& context)
    : field_(field), bin_(votes.bin) {
  const LocalSampler sampler(field.positions);
  const Random random = context.random();
  const auto near = static_cast<float>(search.epsilon);
  const auto cosine = static_cast<float>(std::cos(search.angle));
  const auto cast = [&](Index number) -> std::optional<Vote> {
    Random own = random.split(static_cast<std::uint64_t>(number));
    const auto points = sampler.draw(own, static_cast<int>(own.below(sampler.levels())));
    if (!points) return std::nullopt;
    Sample sample;
    for (std::size_t i = 0; i < 3; ++i) {
      sample.points[i] = field.positions.col((*points)[i]).cast<double>();
      sample.normals[i] = field.normals.col((*points)[i]).cast<double>();
    }
    const auto sphere = through(Kind::sphere, sample);
    if (!sphere || !admissible(*sphere, search)) return std::nullopt;
    const SphereProbe probe(*sphere);
    for (const std::int32_t p : *points)
      if (!Field::agrees(probe(field.positions.col(p), field.normals.col(p)), near, cosine))
        return std::nullopt;
    return Vote{bin_of(*sphere), *sphere, *points};
  };
  votes_ = parallel_reduce(
      context, votes.samples, 256, std::vector<Vote>{},
      [&](Index begin, Index end) {
        std::vector<Vote> part;
        for (Index i = begin; i < end; ++i)
          if (const auto vote = cast(i)) part.push_back(*vote);
        return part;
      },
      [](std::vector<Vote>& all, const std::vector<Vote>& part) {
        all.insert(all.end(), part.begin(), part.end());
      });
  std::stable_sort(votes_.begin(), votes_.end(),
                   [](const Vote& a, const Vote& b) { return a.bin < b.bin; });
}

SphereVotes::Bin SphereVotes::bin_of(const Shape& sphere) const {
  const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / bin_)); };
  return {cell(sphere.point.x()), cell(sphere.point.y()), cell(sphere.point.z()),
          cell(sphere.radius)};
}

std::optional<Shape> SphereVotes::peak(Context& context) const {
  if (votes_.empty()) return std::nullopt;
  std::map<Bin, Index> counts;
  for (const Vote& vote : votes_) ++counts[vote.bin];
  const auto near = [](const Bin& a, const Bin& b) {
    for (std::size_t k = 0; k < 4; ++k)
      if (std::abs(a[k] - b[k]) > 1) return false;
    return true;
  };
  // Only the fullest cells can be the middle of the fullest neighbourhood.
  std::vector<std::pair<Index, Bin>> order;
  for (const auto& [bin, count] : counts) order.emplace_back(-count, bin);
  std::sort(order.begin(), order.end());
  if (order.size() > 64) order.resize(64);
  Bin best = order.front().second;
  Index most = 0;
  for (const auto& [unused, bin] : order) {
    context.check();
    Index sum = 0;
    for (const auto& [other, count] : counts)
      if (near(bin, other)) sum += count;
    if (sum > most) {
      most = sum;
      best = bin;
    }
  }
  Shape mean{.kind = Kind::sphere};
  std::vector<std::int32_t> voters;
  for (const Vote& vote : votes_) {
    if (!near(vote.bin, best)) continue;
    mean.point += vote.sphere.point / static_cast<double>(most);
    mean.radius += vote.sphere.radius / static_cast<double>(most);
    voters.insert(voters.end(), vote.points.begin(), vote.points.end());
  }
  return refine(mean, field_.positions, voters, context);
}

void SphereVotes::withdraw(const Eigen::VectorXi& labels) {
  std::erase_if(votes_, [&](const Vote& vote) {
    return std::any_of(vote.points.begin(), vote.points.end(),
                       [&](std::int32_t p) { return labels[p] >= 0; });
  });
}

void SphereVotes::refuse(const Shape& sphere) {
  const double limit = 3.0 * bin_;
  std::erase_if(votes_, [&](const Vote& vote) {
    return (vote.sphere.point - sphere.point).norm() <= limit &&
           std::abs(vote.sphere.radius - sphere.radius) <= limit;
  });
}

}  // namespace velum::shapes
