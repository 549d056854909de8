// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <velum/stage.hpp>

namespace {

// How far a set of points and the points of the true object agree.
struct Score {
  std::int64_t cluster = 0;
  std::int64_t points = 0;
  std::int64_t correct = 0;
  std::int64_t truth = 0;

  [[nodiscard]] double precision() const { return share(correct, points); }
  [[nodiscard]] double recall() const { return share(correct, truth); }
  [[nodiscard]] double iou() const { return share(correct, points + truth - correct); }
  /// As the thesis counts (tables 3.24, 3.26 and 3.27): 1 - |found - true| / true, right or wrong.
  [[nodiscard]] double counted() const {
    return truth > 0 ? 1.0 - share(std::abs(points - truth), truth) : 0.0;
  }

 private:
  static double share(std::int64_t part, std::int64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  }
};

struct SegmentationScore {
  std::vector<int> label;
  std::optional<int> cluster;

  static auto about() {
    return velum::About<SegmentationScore>("Compares found points with their true labels.")
        .in("clusters", "clusters over labelled points, or a selection of labelled points")
        .in("reference", "the whole scene before the selection: where the true points are counted")
        .out("table", "one row for each cluster that holds a true point")
        .param(&SegmentationScore::label, "label",
               "values of the column label that the true object has")
        .required()
        .param(&SegmentationScore::cluster, "cluster",
               "number of the cluster to be judged; unset: the one with the best IoU",
               velum::at_least(0))
        .deterministic()
        .reference("thesis 3.3.2.5 and 3.3.3.2: tables 3.24, 3.26 and 3.27");
  }

  void check() const {
    if (label.empty())
      throw velum::Error(velum::Fault::graph, "'label' is an empty list: name at least one label")
          .at("label");
  }

  velum::Table operator()(const std::variant<velum::Clusters, velum::Cloud>& found,
                          const std::optional<velum::Cloud>& reference,
                          velum::Context& context) const {
    context.check();
    if (const auto* clusters = std::get_if<velum::Clusters>(&found))
      return of_clusters(*clusters, reference, context);
    return of_cloud(std::get<velum::Cloud>(found), reference, context);
  }

 private:
  [[nodiscard]] bool is_true(int value) const {
    return std::find(label.begin(), label.end(), value) != label.end();
  }
  [[nodiscard]] std::int64_t count_true(const velum::Cloud& cloud) const {
    if (cloud.empty()) return 0;
    const auto labels = cloud.labels();
    return std::count_if(labels.begin(), labels.end(), [&](int value) { return is_true(value); });
  }

  velum::Table of_cloud(const velum::Cloud& cloud, const std::optional<velum::Cloud>& reference,
                        velum::Context& context) const {
    Score score{.points = cloud.size(), .correct = count_true(cloud)};
    if (reference) {
      score.truth = count_true(*reference);
      warn_of_missing_truth(score.truth, context);
    }
    report(score, reference.has_value(), context);
    velum::Table table = empty_table();
    add(table, score, reference.has_value());
    return table;
  }

  velum::Table of_clusters(const velum::Clusters& clusters,
                           const std::optional<velum::Cloud>& reference,
                           velum::Context& context) const {
    std::vector<Score> scores = tally(clusters);
    const std::int64_t truth = count_true(reference ? *reference : clusters.cloud);
    warn_of_missing_truth(truth, context);
    for (Score& score : scores) score.truth = truth;
    velum::Table table = empty_table();
    for (const Score& score : scores)
      if (score.correct > 0) add(table, score, true);
    report(choose(scores), true, context);
    return table;
  }

  [[nodiscard]] std::vector<Score> tally(const velum::Clusters& clusters) const {
    const auto numbers = clusters.label();
    if (numbers.size() == 0) return {};
    const auto labels = clusters.cloud.labels();
    std::vector<Score> scores(static_cast<std::size_t>(numbers.maxCoeff() + 1));
    for (velum::Index i = 0; i < numbers.size(); ++i) {
      if (numbers[i] < 0) continue;
      Score& score = scores[static_cast<std::size_t>(numbers[i])];
      score.cluster = numbers[i];
      ++score.points;
      if (is_true(labels[i])) ++score.correct;
    }
    return scores;
  }

  [[nodiscard]] Score choose(const std::vector<Score>& scores) const {
    if (cluster) {
      if (*cluster >= static_cast<int>(scores.size()))
        throw velum::Error(velum::Fault::stage,
                           fmt::format("cluster {} was to be judged, but there are {} (from 0)",
                                       *cluster, scores.size()));
      return scores[static_cast<std::size_t>(*cluster)];
    }
    const auto best =
        std::max_element(scores.begin(), scores.end(),
                         [](const Score& a, const Score& b) { return a.iou() < b.iou(); });
    return best == scores.end() ? Score{.cluster = -1} : *best;
  }

  void warn_of_missing_truth(std::int64_t truth, velum::Context& context) const {
    if (truth == 0)
      context.warn(
          fmt::format("no point has the label {}: recall and IoU are 0", fmt::join(label, " or ")));
  }

  static void report(const Score& score, bool truth_known, velum::Context& context) {
    using velum::Better;
    context.measure("cluster", static_cast<double>(score.cluster), "");
    context.measure("points", static_cast<double>(score.points), "");
    context.measure("precision", score.precision(), "", Better::higher);
    if (!truth_known) {
      context.warn("recall and IoU need the whole scene: wire it to the input 'reference'");
      return;
    }
    context.measure("recall", score.recall(), "", Better::higher);
    context.measure("iou", score.iou(), "", Better::higher);
    context.measure("counted", score.counted(), "", Better::higher);
  }

  static velum::Table empty_table() {
    return velum::Table({{"cluster", ""},
                         {"points", ""},
                         {"correct", ""},
                         {"truth", ""},
                         {"precision", ""},
                         {"recall", ""},
                         {"iou", ""}});
  }
  static void add(velum::Table& table, const Score& score, bool truth_known) {
    std::vector<velum::Cell> row;
    for (const std::int64_t count : {score.cluster, score.points, score.correct, score.truth})
      row.emplace_back(count);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    row.emplace_back(score.precision());
    row.emplace_back(truth_known ? score.recall() : unknown);
    row.emplace_back(truth_known ? score.iou() : unknown);
    table.add(std::move(row));
  }
};

}  // namespace
VELUM_STAGE(SegmentationScore)
