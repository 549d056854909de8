// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/region_growing.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

namespace velum::geometry {
namespace {

using Found = std::span<const Neighbour>;

// The smooth neighbours of each point: those that a seed there would take into its region.
class SmoothGraph {
 public:
  // Rows of a fixed width, left untouched (and so without memory) where they stay empty.
  SmoothGraph(Index points, Index width)
      : width_(static_cast<std::size_t>(width)),
        counts_(static_cast<std::size_t>(points), 0),
        entries_(new std::int32_t[static_cast<std::size_t>(points) * width_]) {}

  void add(Index point, std::int32_t neighbour) {
    const auto row = static_cast<std::size_t>(point);
    entries_[row * width_ + static_cast<std::size_t>(counts_[row]++)] = neighbour;
  }
  [[nodiscard]] std::span<const std::int32_t> of(Index point) const {
    const auto row = static_cast<std::size_t>(point);
    return {entries_.get() + row * width_, static_cast<std::size_t>(counts_[row])};
  }

 private:
  std::size_t width_;
  std::vector<std::int32_t> counts_;
  std::unique_ptr<std::int32_t[]> entries_;
};

class Growing {
 public:
  Growing(const Cloud& cloud, const GrowingOptions& options, Context& context)
      : cloud_(cloud),
        options_(options),
        context_(context),
        normals_(cloud.normals()),
        curvature_(cloud.curvature()),
        width_(std::clamp<Index>(options.neighbours, 1, cloud.size())),
        graph_(cloud.size(), width_) {
    regions_.labels.setConstant(cloud.size(), kFree);
    regions_.areas.resize(cloud.size());
  }

  Regions run() {
    connect();
    context_.progress(0.8);
    for (const std::int32_t seed : seeds())
      if (regions_.labels[seed] == kFree) grow(seed);
    number_by_size();
    return std::move(regions_);
  }

 private:
  static constexpr int kFree = -2;
  static constexpr int kNone = -1;

  [[nodiscard]] bool is_smooth(Index point) const {
    return static_cast<double>(curvature_[point]) < options_.curvature;
  }
  // A region that begins at a rough point ends with its neighbours: where that is too small to be
  // kept, rough seeds need not be tried (all smooth ones come before them).
  [[nodiscard]] bool rough_regions_count() const { return options_.min_size <= width_; }

  void connect() {
    const auto cosine = static_cast<float>(std::cos(options_.smoothness));
    cloud_.neighbours().each_nearest(width_, context_, [&](Index query, Found found) {
      measure_area(query, found);
      if (!is_smooth(query) && !rough_regions_count()) return;
      const Eigen::Vector3f normal = normals_.col(query);
      for (const Neighbour& n : found)
        if (n.index != query && std::abs(normal.dot(normals_.col(n.index))) > cosine)
          graph_.add(query, n.index);
    });
  }

  // The disc up to the eighth neighbour holds eight points beside the centre.
  void measure_area(Index query, Found found) {
    const std::size_t last = std::min<std::size_t>(8, found.size() - 1);
    regions_.areas[query] =
        last == 0 ? 0.0F
                  : std::numbers::pi_v<float> * found[last].distance2 / static_cast<float>(last);
  }

  [[nodiscard]] std::vector<std::int32_t> seeds() const {
    std::vector<std::int32_t> order;
    order.reserve(static_cast<std::size_t>(cloud_.size()));
    for (Index i = 0; i < cloud_.size(); ++i)
      if (is_smooth(i) || rough_regions_count()) order.push_back(static_cast<std::int32_t>(i));
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return curvature_[a] < curvature_[b] || (curvature_[a] == curvature_[b] && a < b);
    });
    return order;
  }

  // One region: all that smooth seeds reach from `seed`. What it takes stays taken, even where the
  // region is refused in the end.
  void grow(std::int32_t seed) {
    context_.check();
    const int number = static_cast<int>(regions_.sizes.size());
    members_.assign(1, seed);
    regions_.labels[seed] = number;
    for (std::size_t next = 0; next < members_.size(); ++next) {
      const std::int32_t at = members_[next];
      if (next != 0 && !is_smooth(at)) continue;
      for (const std::int32_t neighbour : graph_.of(at)) {
        if (regions_.labels[neighbour] != kFree) continue;
        regions_.labels[neighbour] = number;
        members_.push_back(neighbour);
      }
      if (next % 65536 == 65535) context_.check();
    }
    accept(static_cast<Index>(members_.size()));
  }

  void accept(Index size) {
    regions_.largest = std::max(regions_.largest, size);
    const bool small = size < options_.min_size;
    const bool large = size > options_.max_size;
    if (!small && !large) {
      regions_.sizes.push_back(size);
      return;
    }
    ++(small ? regions_.too_small : regions_.too_large);
    for (const std::int32_t member : members_) regions_.labels[member] = kNone;
  }

  void number_by_size() {
    std::vector<int> order(regions_.sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return regions_.sizes[static_cast<std::size_t>(a)] >
             regions_.sizes[static_cast<std::size_t>(b)];
    });
    std::vector<int> rank(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      rank[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    for (int& label : regions_.labels)
      label = label < 0 ? kNone : rank[static_cast<std::size_t>(label)];
    std::stable_sort(regions_.sizes.begin(), regions_.sizes.end(), std::greater<>());
  }

  const Cloud& cloud_;
  const GrowingOptions& options_;
  Context& context_;
  ConstPoints normals_;
  Eigen::Map<const Eigen::VectorXf> curvature_;
  Index width_;
  SmoothGraph graph_;
  Regions regions_;
  std::vector<std::int32_t> members_;
};

}  // namespace

Regions grow_regions(const Cloud& cloud, const GrowingOptions& options, Context& context) {
  context.check();
  if (cloud.empty()) return {};
  return Growing(cloud, options, context).run();
}

}  // namespace velum::geometry
