// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "graph/catalog.hpp"

/// Stages that can be described but not run, for tests of everything that happens before a run.
namespace fake {

using namespace velum;  // NOLINT: a test's header

struct ReadCloud {
  InputFile file;
  LengthUnit units;
  static auto about() {
    return About<ReadCloud>("Reads a cloud.")
        .out("cloud")
        .param(&ReadCloud::file, "file", "what to read")
        .required()
        .param(&ReadCloud::units, "units", "unit of the coordinates in the file");
  }
  Cloud operator()(Context& context) const;
};

struct WriteCloud {
  OutputFile file;
  std::vector<InputFile> extras;
  static auto about() {
    return About<WriteCloud>("Writes a cloud.")
        .in("cloud")
        .param(&WriteCloud::file, "file", "what to write")
        .required()
        .param(&WriteCloud::extras, "extras", "files to copy beside it");
  }
  void operator()(const Cloud& cloud, Context& context) const;
};

struct Simulator {
  Duration sweep{2.0};
  static auto about() {
    return About<Simulator>("A scanner that is computed.")
        .out("cloud")
        .adds("cloud", "label")
        .param(&Simulator::sweep, "sweep", "how long one takes", above(0.0));
  }
  Cloud operator()(Context& context) const;
};

struct Normals {
  int neighbours = 30;
  std::optional<Length> radius;
  static auto about() {
    return About<Normals>("Normals and curvature.")
        .in("cloud")
        .out("cloud")
        .adds("cloud", "normals")
        .adds("cloud", "curvature")
        .param(&Normals::neighbours, "neighbours", "points of a neighbourhood", at_least(3))
        .param(&Normals::radius, "radius", "size of a neighbourhood", above(0.0));
  }
  Cloud operator()(const Cloud& cloud, Context& context) const;
};

struct RegionGrowing {
  Angle smoothness{0.1};
  double curvature = 0.05;
  int min_size = 100;
  static auto about() {
    return About<RegionGrowing>("Smooth regions.")
        .in("cloud")
        .out("clusters")
        .needs("cloud", "normals")
        .param(&RegionGrowing::smoothness, "smoothness", "largest angle between neighbours",
               between(0.0, 1.5707963267948966))
        .param(&RegionGrowing::curvature, "curvature", "largest curvature", between(0.0, 1.0))
        .param(&RegionGrowing::min_size, "min_size", "points of the smallest region", at_least(1));
  }
  Clusters operator()(const Cloud& cloud, Context& context) const;
};

struct SelectCluster {
  enum class Which { largest, index, containing };
  Which which = Which::largest;
  std::int64_t index = 0;
  std::optional<Place> point;
  static auto about() {
    return About<SelectCluster>("One cluster as a cloud.")
        .in("clusters")
        .out("cloud")
        .choice(&SelectCluster::which, "which", "how it is chosen",
                {{"largest", Which::largest, "the one with most points"},
                 {"index", Which::index, "by number"},
                 {"containing", Which::containing, "that nearest to a point"}})
        .param(&SelectCluster::index, "index", "its number", at_least(0))
        .param(&SelectCluster::point, "point", "a place in it");
  }
  Cloud operator()(const std::variant<Clusters, Cloud>& clusters, Context& context) const;
};

struct VoxelGrid {
  Length size;
  static auto about() {
    return About<VoxelGrid>("One point per voxel.")
        .in("cloud")
        .out("cloud")
        .param(&VoxelGrid::size, "size", "edge length of a voxel", above(0.0))
        .required()
        .was("leaf");
  }
  Cloud operator()(const Cloud& cloud, Context& context) const;
};

struct Merge {
  static auto about() { return About<Merge>("All points together.").in("clouds").out("cloud"); }
  Cloud operator()(const std::vector<Cloud>& clouds, Context& context) const;
};

struct Icp {
  enum class Metric { point_to_point, point_to_plane };
  Metric metric = Metric::point_to_point;
  bool trimmed = false;
  double overlap = 0.9;
  static auto about() {
    return About<Icp>("Iterative closest points.")
        .in("source")
        .in("target")
        .out("cloud")
        .out("transform")
        .out("table")
        .needs_when("metric", "point_to_plane", "target", "normals")
        .choice(&Icp::metric, "metric", "what is made small",
                {{"point_to_point", Metric::point_to_point, "distances of points"},
                 {"point_to_plane", Metric::point_to_plane, "distances to planes"}})
        .param(&Icp::trimmed, "trimmed", "leave the worst pairs out")
        .param(&Icp::overlap, "overlap", "share of pairs that is kept", between(0.0, 1.0));
  }
  std::tuple<Cloud, Transform, Table> operator()(const Cloud& source, const Cloud& target,
                                                 Context& context) const;
};

struct Pair {
  Place source;
  Place target;
  double weight = 1.0;
};

struct Svd {
  std::vector<Pair> pairs;
  Eigen::Vector3d up{0, 0, 1};
  std::vector<double> weights;
  std::string note;
  static auto about() {
    return About<Svd>("From picked pairs.")
        .in("source")
        .in("target")
        .out("cloud")
        .out("transform")
        .rows(&Svd::pairs, "pairs", "picked points",
              Row<Pair>()
                  .field(&Pair::source, "source", "in the source")
                  .field(&Pair::target, "target", "in the target")
                  .field(&Pair::weight, "weight", "how much it counts", above(0.0)))
        .param(&Svd::up, "up", "the direction that is up")
        .param(&Svd::weights, "weights", "of the coordinates", at_least(0.0))
        .param(&Svd::note, "note", "for the record");
  }
  std::tuple<Cloud, Transform> operator()(const Cloud& source, const Cloud& target,
                                          Context& context) const;
};

struct TransformCloud {
  static auto about() {
    return About<TransformCloud>("Moves a cloud.").in("cloud").in("transform").out("cloud");
  }
  Cloud operator()(const Cloud& cloud, const std::optional<Transform>& transform,
                   Context& context) const;
};

struct Delaunay {
  Length max_edge = spacings(5);
  static auto about() {
    return About<Delaunay>("A projected triangulation.")
        .in("cloud")
        .out("mesh")
        .param(&Delaunay::max_edge, "max_edge", "longest edge that is kept", above(0.0));
  }
  Mesh operator()(const Cloud& cloud, Context& context) const;
};

struct MeshToReference {
  static auto about() {
    return About<MeshToReference>("Deviations.").in("mesh").in("reference").out("table");
  }
  Table operator()(const Mesh& mesh, const std::variant<Mesh, Surface>& reference,
                   Context& context) const;
};

/// Holds the stages above; `features.broken` is a plugin that does not load.
class Catalog : public graph::Catalog {
 public:
  Catalog() {
    add<ReadCloud>("io.read_cloud");
    add<WriteCloud>("io.write_cloud");
    add<Simulator>("devices.simulator");
    add<Normals>("features.normals");
    add<RegionGrowing>("segmentation.region_growing");
    add<SelectCluster>("filtering.select_cluster");
    add<Merge>("filtering.merge");
    add<TransformCloud>("filtering.transform");
    add<VoxelGrid>("resampling.voxel_grid");
    add<Icp>("registration.icp");
    add<Svd>("registration.svd");
    add<Delaunay>("meshing.delaunay_projected");
    add<MeshToReference>("analysis.mesh_to_reference");
    stages_.at("features.normals").check = [](const std::vector<Setting>& settings) {
      if (std::get<std::int64_t>(settings.at(0).value) != 30 && settings.at(1).is_set())
        throw Error(Fault::graph, "'neighbours' and 'radius' are both given")
            .at("radius")
            .hint("keep one of them");
    };
  }
  const StageInfo* find(std::string_view id) override {
    const auto found = stages_.find(id);
    return found == stages_.end() ? nullptr : &found->second;
  }
  std::string why_not(std::string_view id) override {
    return id == "features.broken" ? "its Eigen version is 30300, that of velum 30400" : "";
  }
  std::vector<std::string> ids() override {
    std::vector<std::string> all = {"features.broken"};
    for (const auto& [id, info] : stages_) all.push_back(id);
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  template <class Stage>
  void add(const std::string& id) {
    StageInfo info = Stage::about().info();
    info.id = id;
    stages_.emplace(id, std::move(info));
  }
  std::map<std::string, StageInfo, std::less<>> stages_;
};

}  // namespace fake
