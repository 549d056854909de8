// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <velum/testing.hpp>

namespace velum::test {

/// The scene graphs/scenes/shapes.toml as its four scanners see it, in one cloud with labels and
/// normals. About 17,000 points at steps of 0.5 degrees.
inline Cloud shapes_scene(const std::string& noise, const std::string& step = "0.5 deg") {
  const std::string scene = std::string("\"") + VELUM_SOURCE_DIR + "/graphs/scenes/shapes.toml\"";
  std::vector<Cloud> parts;
  for (const std::string name : {"south_west", "south_east", "north_east", "north_west"}) {
    const std::string scanner = "\"" + name + "\"";
    const Cloud scan = Stage("devices.simulator")
                           .set("scene", scene)
                           .set("scanner", scanner)
                           .set("beam_step", step)
                           .set("tilt_step", step)
                           .set("noise", noise)
                           .seed(std::hash<std::string>{}(name))
                           .run()
                           .cloud();
    const auto pose =
        Stage("devices.truth").set("scene", scene).set("scanner", scanner).run().get<Transform>();
    parts.push_back(scan.transformed(pose.matrix));
  }
  return Stage("features.normals").run(merge(parts)).cloud();
}

/// How a set of clusters meets one true label: of the cluster with the best IoU.
struct Score {
  int cluster = -1;
  Index points = 0;
  Index correct = 0;
  Index truth = 0;
  [[nodiscard]] double recall() const { return share(correct, truth); }
  [[nodiscard]] double precision() const { return share(correct, points); }
  [[nodiscard]] double iou() const { return share(correct, points + truth - correct); }
  /// As the thesis counts (tables 3.24, 3.26): 1 - |found - true| / true.
  [[nodiscard]] double counted() const { return 1.0 - share(std::abs(points - truth), truth); }

 private:
  static double share(Index part, Index whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  }
};

inline Score score(const Clusters& clusters, int label) {
  const auto found = clusters.label();
  const auto truth = clusters.cloud.labels();
  std::vector<Score> scores(clusters.kinds.size());
  Index all = 0;
  for (Index i = 0; i < found.size(); ++i) {
    all += truth[i] == label;
    if (found[i] < 0) continue;
    Score& one = scores[static_cast<std::size_t>(found[i])];
    ++one.points;
    one.correct += truth[i] == label;
  }
  Score best;
  for (std::size_t c = 0; c < scores.size(); ++c) {
    scores[c].cluster = static_cast<int>(c);
    scores[c].truth = all;
    if (best.cluster < 0 || scores[c].iou() > best.iou()) best = scores[c];
  }
  best.truth = all;
  return best;
}

}  // namespace velum::test
