// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "velum/error.hpp"
#include "velum/random.hpp"

namespace velum::study {
namespace {

/// Counts through all combinations; the last axis runs fastest. Axes that are zipped share a wheel.
class Wheels {
 public:
  explicit Wheels(const std::vector<graph::Axis>& axes) {
    std::map<std::string, std::size_t> zips;
    for (const graph::Axis& axis : axes) {
      const auto [zip, fresh] = zips.try_emplace(axis.zip, sizes_.size());
      if (axis.zip.empty() || fresh) {
        wheel_of_.push_back(sizes_.size());
        sizes_.push_back(axis.choices.size());
      } else {
        wheel_of_.push_back(zip->second);
      }
    }
  }

  /// Throws when there are too many to count one by one.
  [[nodiscard]] std::size_t count() const {
    std::size_t product = 1;
    for (const std::size_t size : sizes_) {
      if (size > 0 && product > kMostCombinations / size)
        throw Error(Fault::graph,
                    fmt::format("the study has more than {} combinations", kMostCombinations));
      product *= size;
    }
    return product;
  }

  [[nodiscard]] std::vector<std::size_t> at(std::size_t number) const {
    std::vector<std::size_t> turned(sizes_.size());
    for (std::size_t w = sizes_.size(); w-- > 0; number /= sizes_[w])
      turned[w] = number % sizes_[w];
    std::vector<std::size_t> choices;
    for (const std::size_t wheel : wheel_of_) choices.push_back(turned[wheel]);
    return choices;
  }

 private:
  static constexpr std::size_t kMostCombinations = 100'000'000;
  std::vector<std::size_t> sizes_;
  std::vector<std::size_t> wheel_of_;
};

bool matches(const graph::Study& study, const std::vector<std::size_t>& choices,
             const graph::Labels& labels) {
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const auto wanted = labels.find(study.axes[a].name);
    if (wanted != labels.end() && wanted->second != study.axes[a].choices[choices[a]].label)
      return false;
  }
  return true;
}

/// `size` of the numbers, ascending; the same each time.
std::vector<std::size_t> drawn(std::vector<std::size_t> numbers, std::size_t size) {
  Random random(1);
  for (std::size_t i = 0; i < size; ++i)
    std::swap(numbers[i], numbers[i + static_cast<std::size_t>(random.below(
                                          static_cast<std::int64_t>(numbers.size() - i)))]);
  numbers.resize(size);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

graph::Variation Plan::variation(const Variant& variant) const {
  graph::Variation all;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const graph::Variation& one = study.axes[a].choices[variant.choices[a]].variation;
    all.alternatives.insert(all.alternatives.end(), one.alternatives.begin(),
                            one.alternatives.end());
    all.values.insert(all.values.end(), one.values.begin(), one.values.end());
  }
  return all;
}

std::vector<std::size_t> Plan::references() const {
  std::vector<std::size_t> found(variants.size(), variants.size());
  if (!study.reference) return found;
  // Named itself, or along with an axis that is.
  const auto is_named = [&](const graph::Axis& axis) {
    return std::ranges::any_of(study.axes, [&](const graph::Axis& other) {
      return study.reference->contains(other.name) &&
             (other.name == axis.name || (!axis.zip.empty() && other.zip == axis.zip));
    });
  };
  std::vector<std::size_t> free;  // axes
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (!is_named(study.axes[a])) free.push_back(a);
  const auto others_of = [&](const Variant& variant) {
    std::vector<std::size_t> choices;
    for (const std::size_t a : free) choices.push_back(variant.choices[a]);
    return choices;
  };
  std::map<std::vector<std::size_t>, std::size_t> reference;
  for (std::size_t v = 0; v < variants.size(); ++v)
    if (matches(study, variants[v].choices, *study.reference))
      reference.try_emplace(others_of(variants[v]), v);
  for (std::size_t v = 0; v < variants.size(); ++v)
    if (const auto one = reference.find(others_of(variants[v])); one != reference.end())
      found[v] = one->second;
  return found;
}

Plan make_plan(graph::Study study) {
  const Wheels wheels(study.axes);
  const std::size_t count = wheels.count();
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < count; ++n) {
    const auto choices = wheels.at(n);
    const auto excludes = [&](const graph::Labels& labels) {
      return matches(study, choices, labels);
    };
    if (std::ranges::none_of(study.exclude, excludes)) numbers.push_back(n);
  }
  if (study.sample && *study.sample < numbers.size())
    numbers = drawn(std::move(numbers), *study.sample);
  if (numbers.empty())
    throw Error(Fault::graph, "the study excludes every variant")
        .hint("take some of 'exclude' away");
  if (numbers.size() > kMostVariants)
    throw Error(Fault::graph, fmt::format("the study has {} variants, more than {}", numbers.size(),
                                          kMostVariants))
        .hint("`sample = 1000` takes some of them at random");
  Plan plan;
  const std::size_t width = fmt::format("{}", numbers.size()).size();
  for (const std::size_t n : numbers)
    plan.variants.push_back(
        {fmt::format("v{:0{}}", plan.variants.size() + 1, width), wheels.at(n)});
  plan.study = std::move(study);
  const auto is_reference = [&](const Variant& variant) {
    return matches(plan.study, variant.choices, *plan.study.reference);
  };
  if (plan.study.reference && std::ranges::none_of(plan.variants, is_reference))
    throw Error(Fault::graph, "no variant has the labels of 'reference'")
        .hint("it may be one that 'exclude' or 'sample' leaves out");
  return plan;
}

}  // namespace velum::study
