// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/comparison.hpp"

#include <algorithm>
#include <cmath>

namespace velum::study {
namespace {

class Comparer {
 public:
  Comparer(const Plan& plan, const Outcomes& outcomes)
      : plan_(plan), outcomes_(outcomes), references_(plan.references()) {}

  Comparison compare() {
    comparison_.variants.resize(plan_.variants.size());
    for (std::size_t v = 0; v < plan_.variants.size(); ++v) summarise_variant(v);
    group();
    for (const auto& name : plan_.study.measures) {
      if (comparison_.measures.try_emplace(name.full()).second)
        comparison_.missing.push_back(name.full());
      rank(name.full());
      differ(name.full());
    }
    return std::move(comparison_);
  }

 private:
  [[nodiscard]] const Outcome& outcome(std::size_t variant, std::size_t repeat) const {
    return outcomes_.at({variant, repeat});
  }
  [[nodiscard]] std::size_t repeats() const { return plan_.study.seeds.size(); }

  /// The measure of a cell that is ok and has it.
  [[nodiscard]] std::optional<double> value(std::size_t variant, std::size_t repeat,
                                            const std::string& measure) const {
    const Outcome& cell = outcome(variant, repeat);
    const auto found = cell.figures.find(measure);
    if (cell.status != Status::ok || found == cell.figures.end() ||
        !std::isfinite(found->second.value))
      return std::nullopt;
    return found->second.value;
  }

  void summarise_variant(std::size_t v) {
    VariantSummary& summary = comparison_.variants[v];
    std::size_t ok = 0;
    for (std::size_t r = 0; r < repeats(); ++r) {
      const Outcome& cell = outcome(v, r);
      for (const auto& [name, figure] : cell.figures)
        comparison_.measures.try_emplace(name, figure);
      if (cell.status == Status::ok) {
        ++ok;
      } else if (summary.status == Status::ok) {
        summary.status = cell.status;
        summary.message = cell.message;
      }
    }
    summary.success = static_cast<double>(ok) / static_cast<double>(repeats());
    for (const auto& name : plan_.study.measures) {
      std::vector<double> sample;
      for (std::size_t r = 0; r < repeats(); ++r)
        if (const auto x = value(v, r, name.full())) sample.push_back(*x);
      if (sample.empty()) continue;
      MeasureSummary& measure = summary.measures[name.full()];
      measure.count = sample.size();
      measure.summary = summarise(std::move(sample));
    }
  }

  /// Variants go together unless they had other sources in some repeat. One that is never ok had
  /// none that are known.
  void group() {
    using Sources = std::map<std::size_t, std::string>;  // by repeat
    std::vector<Sources> groups;
    std::map<Sources, std::size_t> known;  // which most variants agree with
    for (std::size_t v = 0; v < plan_.variants.size(); ++v) {
      Sources own;
      for (std::size_t r = 0; r < repeats(); ++r)
        if (outcome(v, r).status == Status::ok) own[r] = outcome(v, r).source;
      if (own.empty()) continue;
      const auto [same, fresh] = known.try_emplace(own, 0);
      if (fresh) {
        std::size_t g = 0;
        while (g < groups.size() && !agree(own, groups[g])) ++g;
        if (g == groups.size()) groups.emplace_back();
        groups[g].insert(own.begin(), own.end());
        same->second = g;
      }
      comparison_.variants[v].group = same->second;
    }
    comparison_.groups = std::max<std::size_t>(1, groups.size());
  }

  static bool agree(const std::map<std::size_t, std::string>& own,
                    const std::map<std::size_t, std::string>& group) {
    return std::ranges::all_of(own, [&](const auto& entry) {
      const auto other = group.find(entry.first);
      return other == group.end() || other->second == entry.second;
    });
  }

  void rank(const std::string& measure) {
    const Better better = comparison_.measures.at(measure).better;
    if (better == Better::neither) return;
    std::vector<std::vector<MeasureSummary*>> ranked(comparison_.groups);
    for (VariantSummary& variant : comparison_.variants) {
      const auto found = variant.measures.find(measure);
      if (found != variant.measures.end() && found->second.count == repeats())
        ranked[variant.group].push_back(&found->second);
    }
    for (const auto& group : ranked) {
      std::vector<double> means;
      for (const MeasureSummary* one : group) means.push_back(one->summary.mean);
      const std::vector<int> places = ranks(means, better == Better::lower);
      for (std::size_t i = 0; i < group.size(); ++i) group[i]->rank = places[i];
    }
  }

  void differ(const std::string& measure) {
    std::vector<Difference*> tested;
    std::vector<double> p;
    for (std::size_t v = 0; v < plan_.variants.size(); ++v) {
      const std::size_t reference = references_[v];
      const auto found = comparison_.variants[v].measures.find(measure);
      if (reference == plan_.variants.size() || reference == v ||
          found == comparison_.variants[v].measures.end() ||
          comparison_.variants[reference].group != comparison_.variants[v].group)
        continue;
      std::vector<double> differences;
      for (std::size_t r = 0; r < repeats(); ++r) {
        const auto own = value(v, r, measure);
        const auto other = value(reference, r, measure);
        if (own && other) differences.push_back(*own - *other);
      }
      if (differences.empty()) continue;
      Difference& difference = found->second.difference.emplace();
      difference.reference = reference;
      difference.pairs = differences.size();
      difference.mean = summarise(differences).mean;
      if (differences.size() < kFewestForAClaim) continue;
      tested.push_back(&difference);
      p.push_back(signed_rank_p(differences));
    }
    const std::vector<double> adjusted = holm(p);
    for (std::size_t i = 0; i < tested.size(); ++i) tested[i]->p = adjusted[i];
  }

  const Plan& plan_;
  const Outcomes& outcomes_;
  const std::vector<std::size_t> references_;
  Comparison comparison_;
};

}  // namespace

Comparison compare(const Plan& plan, const Outcomes& outcomes) {
  return Comparer(plan, outcomes).compare();
}

}  // namespace velum::study
