// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/ransac.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shapes/candidate.hpp"
#include "shapes/components.hpp"
#include "shapes/consensus.hpp"
#include "shapes/fit.hpp"
#include "shapes/sampler.hpp"

namespace velum::shapes {
namespace {

constexpr Index kBatch = 256;        // samples between two looks at the pool
constexpr Index kFirstSubset = 512;  // points of the first test of a candidate
constexpr Index kRefitSubset = 4096;
constexpr std::size_t kPool = 48;
constexpr std::size_t kRefits = 4;     // of the candidates of a batch
constexpr Index kMostSamples = 60000;  // for one shape

class Ransac {
 public:
  Ransac(const Cloud& cloud, const Search& search, Context& context)
      : field_(cloud),
        search_(search),
        context_(context),
        random_(context.random()),
        sampler_(field_.positions),
        shuffled_(static_cast<std::size_t>(cloud.size())),
        cosine_(static_cast<float>(std::cos(search.angle))) {
    std::iota(shuffled_.begin(), shuffled_.end(), 0);
    Random shuffle = random_.split(0);
    for (std::size_t i = shuffled_.size(); i > 1; --i)
      std::swap(shuffled_[i - 1],
                shuffled_[static_cast<std::size_t>(shuffle.below(static_cast<Index>(i)))]);
    gains_.assign(static_cast<std::size_t>(sampler_.levels()), 1.0);
    found_.labels = Eigen::VectorXi::Constant(cloud.size(), -1);
  }

  Detection run() {
    while (static_cast<int>(found_.shapes.size()) < search_.most && next_shape()) {
    }
    for (Found& one : found_.shapes) one.shape.point += field_.middle.cast<double>();
    return std::move(found_);
  }

 private:
  [[nodiscard]] Index left() const { return static_cast<Index>(shuffled_.size()); }

  // Chance that in `samples` a shape of `size` points was never hit (Schnabel et al. 2007, eq. 9).
  [[nodiscard]] double missed(double size, Index samples) const {
    const double hit = size / static_cast<double>(left()) / (4.0 * sampler_.levels());
    return std::pow(1.0 - std::min(hit, 0.99), static_cast<double>(samples));
  }

  void test(Candidate& candidate, Index upto) const {
    const auto near = static_cast<float>(search_.epsilon);
    upto = std::min(upto, left());
    candidate.agreed += with_probe(candidate.shape, [&](const auto& probe) {
      Index agreed = 0;
      for (Index i = candidate.tested; i < upto; ++i) {
        const std::int32_t p = shuffled_[static_cast<std::size_t>(i)];
        agreed +=
            Field::agrees(probe(field_.positions.col(p), field_.normals.col(p)), near, cosine_);
      }
      return agreed;
    });
    candidate.tested = upto;
  }

  [[nodiscard]] bool fits_sample(const Shape& shape,
                                 const std::array<std::int32_t, 3>& points) const {
    const auto near = static_cast<float>(search_.epsilon);
    return with_probe(shape, [&](const auto& probe) {
      return std::all_of(points.begin(), points.end(), [&](std::int32_t p) {
        return Field::agrees(probe(field_.positions.col(p), field_.normals.col(p)), near, cosine_);
      });
    });
  }

  [[nodiscard]] int draw_level(Random& random) const {
    // Mostly the levels that gave good candidates so far, any other now and then.
    if (random.uniform() < 0.2) return static_cast<int>(random.below(sampler_.levels()));
    const double all = std::accumulate(gains_.begin(), gains_.end(), 0.0);
    double at = random.uniform() * all;
    for (std::size_t l = 0; l + 1 < gains_.size(); ++l) {
      at -= gains_[l];
      if (at < 0.0) return static_cast<int>(l);
    }
    return sampler_.levels() - 1;
  }

  void candidates_of(Index number, std::vector<Candidate>& into) const {
    Random random = random_.split(static_cast<std::uint64_t>(number) + 1);
    const int level = draw_level(random);
    const auto points = sampler_.draw(random, level);
    if (!points) return;
    Sample sample;
    for (std::size_t i = 0; i < 3; ++i) {
      sample.points[i] = field_.positions.col((*points)[i]).cast<double>();
      sample.normals[i] = field_.normals.col((*points)[i]).cast<double>();
    }
    for (const Kind kind : search_.kinds) {
      const auto shape = through(kind, sample);
      if (!shape || !admissible(*shape, search_) || !fits_sample(*shape, *points)) continue;
      Candidate candidate;
      candidate.shape = *shape;
      candidate.level = level;
      test(candidate, kFirstSubset);
      if (estimate(candidate, left()).high >= static_cast<double>(search_.min_size))
        into.push_back(candidate);
    }
  }

  // Draws a batch of samples and keeps the best candidates that come of it.
  void draw_batch() {
    std::vector<std::vector<Candidate>> made(static_cast<std::size_t>(kBatch));
    parallel_for(context_, kBatch, 16, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i)
        candidates_of(found_.samples + i, made[static_cast<std::size_t>(i)]);
    });
    found_.samples += kBatch;
    std::vector<Candidate> fresh;
    for (const auto& some : made)
      for (const Candidate& one : some) {
        gains_[static_cast<std::size_t>(one.level)] +=
            static_cast<double>(one.agreed) / static_cast<double>(kFirstSubset);
        fresh.push_back(one);
      }
    keep_best(fresh, kRefits);
    refit(fresh);
    pool_.insert(pool_.end(), fresh.begin(), fresh.end());
    keep_best(pool_, kPool);
  }

  void keep_best(std::vector<Candidate>& candidates, std::size_t most) const {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Candidate& a, const Candidate& b) {
                       return estimate(a, left()).mean > estimate(b, left()).mean;
                     });
    if (candidates.size() > most) candidates.resize(most);
  }

  // A shape through three noisy points is far from the best near it: fit it to a part of the
  // points.
  void refit(std::vector<Candidate>& candidates) {
    const std::vector<std::int32_t> part(shuffled_.begin(),
                                         shuffled_.begin() + std::min(left(), kRefitSubset));
    for (Candidate& candidate : candidates) {
      Candidate better;
      better.level = candidate.level;
      std::vector<std::int32_t> members;
      better.shape = polished(field_, candidate.shape, part, search_, members, context_);
      test(better, static_cast<Index>(part.size()));
      test(candidate, static_cast<Index>(part.size()));
      if (better.agreed > candidate.agreed) candidate = better;
    }
  }

  // The best of the pool, tested on ever more points until no other can be better.
  [[nodiscard]] std::optional<Candidate> best() {
    if (pool_.empty()) return std::nullopt;
    for (;;) {
      context_.check();
      keep_best(pool_, kPool);
      const Estimate first = estimate(pool_.front(), left());
      std::vector<Candidate*> open;
      for (Candidate& one : pool_)
        if (one.tested < left() && estimate(one, left()).high >= first.low) open.push_back(&one);
      const bool alone = open.size() <= 1 && pool_.front().tested >= std::min(left(), kRefitSubset);
      if (open.empty() || alone) return pool_.front();
      parallel_for(context_, static_cast<Index>(open.size()), 1, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          Candidate& one = *open[static_cast<std::size_t>(i)];
          test(one, 4 * one.tested);
        }
      });
    }
  }

  // Draws until a shape larger than the best can hardly have been missed, then takes the best.
  bool next_shape() {
    retest_pool();
    const auto smallest = static_cast<double>(search_.min_size);
    if (left() < search_.min_size || left() < 3) return false;
    for (Index drawn = 0; drawn < kMostSamples;) {
      context_.check();
      draw_batch();
      drawn += kBatch;
      const auto top = best();
      const double size = top ? std::max(estimate(*top, left()).mean, smallest) : smallest;
      if (missed(size, drawn) > search_.overlook) continue;
      if (missed(smallest, drawn) <= search_.overlook) return take_any();
      if (top && take(top->shape)) return true;
      if (top) pool_.erase(pool_.begin());  // not as many after all
    }
    return false;
  }

  // Nothing larger is to be expected: the first of the pool that is large enough, or nothing.
  bool take_any() {
    while (!pool_.empty()) {
      context_.check();
      const Candidate one = pool_.front();
      pool_.erase(pool_.begin());
      // A fit to all points gains some, but hardly doubles a count.
      if (estimate(one, left()).mean < 0.5 * static_cast<double>(search_.min_size)) return false;
      if (take(one.shape)) return true;
    }
    return false;
  }

  // After a shape was taken out its like must go too.
  void retest_pool() {
    for (Candidate& one : pool_) {
      one.tested = one.agreed = 0;
      test(one, kRefitSubset);
    }
    std::erase_if(pool_, [&](const Candidate& one) {
      return estimate(one, left()).high < static_cast<double>(search_.min_size);
    });
  }

  bool take(const Shape& candidate) {
    std::vector<std::int32_t> members;
    Shape shape = polished(field_, candidate, sampler_.points(), search_, members, context_);
    shape = simplest(field_, shape, sampler_.points(), search_, members, context_);
    if (search_.gap > 0.0) members = largest_part(field_.positions, members, search_.gap, context_);
    if (static_cast<Index>(members.size()) < search_.min_size) return false;
    const auto number = static_cast<int>(found_.shapes.size());
    for (const std::int32_t i : members) found_.labels[i] = number;
    const auto count = static_cast<Index>(members.size());
    found_.shapes.push_back({shape, count, count, rms(shape, field_.positions, members, context_)});
    sampler_.remove(found_.labels);
    std::erase_if(shuffled_, [&](std::int32_t p) { return found_.labels[p] >= 0; });
    return true;
  }

  Field field_;
  const Search& search_;
  Context& context_;
  Random random_;
  LocalSampler sampler_;
  std::vector<std::int32_t> shuffled_;  ///< the points left, in random order
  float cosine_;
  std::vector<double> gains_;  ///< of each level of the octree
  std::vector<Candidate> pool_;
  Detection found_;
};

}  // namespace

Detection find_shapes(const Cloud& cloud, const Search& search, Context& context) {
  Detection found = Ransac(cloud, search, context).run();
  assign_points(cloud, search, found, context);
  return found;
}

}  // namespace velum::shapes
