// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/hough.hpp"

#include <algorithm>
#include <numeric>

#include "shapes/plane_votes.hpp"
#include "shapes/sphere_votes.hpp"

namespace velum::shapes {
namespace {

constexpr int kMostRefusals = 40;  // peaks that held too few points

class Hough {
 public:
  Hough(const Cloud& cloud, const Search& search, const Votes& votes, Context& context)
      : field_(cloud), search_(search), context_(context) {
    found_.labels = Eigen::VectorXi::Constant(cloud.size(), -1);
    free_.resize(static_cast<std::size_t>(cloud.size()));
    std::iota(free_.begin(), free_.end(), 0);
    if (cloud.size() < search.min_size) return;
    if (wanted(Kind::plane)) planes_.emplace(field_, search, context);
    if (wanted(Kind::sphere)) spheres_.emplace(field_, search, votes, context);
    found_.samples = spheres_ ? votes.samples : 0;
  }

  Detection run() {
    int refused = 0;
    while (static_cast<int>(found_.shapes.size()) < search_.most && refused < kMostRefusals) {
      context_.check();
      Peak plane = at(planes_);
      Peak sphere = at(spheres_);
      if (!plane.shape && !sphere.shape) break;
      const bool round = sphere.members.size() > plane.members.size();
      if (take(round ? sphere : plane)) continue;
      if (planes_ && plane.shape) planes_->refuse(*plane.shape);
      if (spheres_ && sphere.shape) spheres_->refuse(*sphere.shape);
      ++refused;
    }
    for (Found& one : found_.shapes) one.shape.point += field_.middle.cast<double>();
    return std::move(found_);
  }

 private:
  struct Peak {
    std::optional<Shape> shape;  ///< where the votes are
    Shape fitted;
    std::vector<std::int32_t> members;
  };

  [[nodiscard]] bool wanted(Kind kind) const {
    return std::find(search_.kinds.begin(), search_.kinds.end(), kind) != search_.kinds.end();
  }

  template <class Accumulator>
  Peak at(const std::optional<Accumulator>& votes) const {
    Peak peak;
    if (votes) peak.shape = votes->peak(context_);
    if (peak.shape && admissible(*peak.shape, search_))
      peak.fitted = polished(field_, *peak.shape, free_, search_, peak.members, context_);
    return peak;
  }

  bool take(const Peak& peak) {
    const auto count = static_cast<Index>(peak.members.size());
    if (count < search_.min_size) return false;
    for (const std::int32_t p : peak.members)
      found_.labels[p] = static_cast<int>(found_.shapes.size());
    found_.shapes.push_back({peak.fitted, count, count, search_.epsilon});
    std::erase_if(free_, [&](std::int32_t p) { return found_.labels[p] >= 0; });
    if (planes_) planes_->withdraw(found_.labels);
    if (spheres_) spheres_->withdraw(found_.labels);
    return true;
  }

  Field field_;
  const Search& search_;
  Context& context_;
  std::optional<PlaneVotes> planes_;
  std::optional<SphereVotes> spheres_;
  std::vector<std::int32_t> free_;
  Detection found_;
};

}  // namespace

Detection find_by_votes(const Cloud& cloud, const Search& search, const Votes& votes,
                        Context& context) {
  Detection found = Hough(cloud, search, votes, context).run();
  assign_points(cloud, search, found, context);
  return found;
}

}  // namespace velum::shapes
