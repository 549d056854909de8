// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <velum/stage.hpp>

namespace {

enum class Which { largest, index, containing };

struct SelectCluster {
  Which which = Which::largest;
  std::optional<int> index;
  std::optional<velum::Place> point;

  static auto about() {
    return velum::About<SelectCluster>("One cluster as a cloud.")
        .in("clusters")
        .out("cloud", "its points in their order, with all their columns")
        .choice(&SelectCluster::which, "which", "how the cluster is named",
                {{"largest", Which::largest, "the one with the most points"},
                 {"index", Which::index, "the one numbered `index`"},
                 {"containing", Which::containing,
                  "the one of the clustered point nearest to `point`"}})
        .param(&SelectCluster::index, "index", "number of the cluster, from 0", velum::at_least(0))
        .param(&SelectCluster::point, "point", "a place on the cluster, in absolute coordinates")
        .deterministic();
  }

  void check() const {
    if (which == Which::index && !index)
      throw velum::Error(velum::Fault::graph, "which = \"index\" needs the parameter 'index'")
          .at("which");
    if (which == Which::containing && !point)
      throw velum::Error(velum::Fault::graph, "which = \"containing\" needs the parameter 'point'")
          .at("which");
  }

  velum::Cloud operator()(const velum::Clusters& clusters, velum::Context& context) const {
    context.check();
    const auto labels = clusters.label();
    const int count = labels.size() == 0 ? 0 : labels.maxCoeff() + 1;
    const int chosen = choose(clusters, count);
    std::vector<std::int32_t> members;
    for (velum::Index i = 0; i < labels.size(); ++i)
      if (chosen >= 0 && labels[i] == chosen) members.push_back(static_cast<std::int32_t>(i));
    context.measure("cluster", chosen, "");
    context.measure("points", static_cast<double>(members.size()), "");
    return clusters.cloud.select(members);
  }

 private:
  // Number of the cluster; -1 where there are none and any would do.
  [[nodiscard]] int choose(const velum::Clusters& clusters, int count) const {
    switch (which) {
      case Which::index:
        return by_index(count);
      case Which::containing:
        return containing(clusters);
      case Which::largest:
        break;
    }
    return largest(clusters, count);
  }

  [[nodiscard]] int by_index(int count) const {
    if (*index >= count)
      throw velum::Error(
          velum::Fault::stage,
          fmt::format("cluster {} was asked for, but there are {} (from 0)", *index, count));
    return *index;
  }

  [[nodiscard]] int containing(const velum::Clusters& clusters) const {
    const auto positions = clusters.cloud.positions();
    const Eigen::Vector3d place = point->metres - clusters.cloud.origin();
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (velum::Index i = 0; i < positions.cols(); ++i) {
      if (clusters.label()[i] < 0) continue;
      const double distance = (positions.col(i).cast<double>() - place).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = clusters.label()[i];
      }
    }
    return nearest;
  }

  [[nodiscard]] static int largest(const velum::Clusters& clusters, int count) {
    std::vector<velum::Index> sizes(static_cast<std::size_t>(count), 0);
    for (const int label : clusters.label())
      if (label >= 0) ++sizes[static_cast<std::size_t>(label)];
    const auto most = std::max_element(sizes.begin(), sizes.end());
    return most == sizes.end() ? -1 : static_cast<int>(most - sizes.begin());
  }
};

}  // namespace
VELUM_STAGE(SelectCluster)
