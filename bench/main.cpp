// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// velum_bench [SIZE...] [--only TEXT]: our stages beside the peers, a table for each kind of stage.
// A row is an operation: our time with 2 threads at each size, then every contender's time divided
// by ours (above 1: slower than we are). Rows are shown on the error stream while they are made.
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <velum/testing.hpp>

#include "clouds.hpp"
#include "table.hpp"
#include "timing.hpp"

namespace {

using velum::test::Stage;

velum::Cloud with_normals(const velum::Cloud& cloud) {
  return Stage("features.normals").set("neighbours", "50").run(cloud).cloud();
}

void write_files(const bench::Input& input) {
  const auto save = [&](const std::string& file, const std::string& format) {
    Stage("io.write_cloud")
        .set("file", input.folder + "/" + file)
        .set("format", format)
        .run(input.cloud);
  };
  save("cloud.pcd", "pcd");
  save("cloud_ascii.pcd", "pcd_ascii");
  save("cloud.ply", "ply");
  save("cloud.xyz", "xyz");
  save("cloud.csv", "csv");
  bench::write_las(input.folder + "/cloud.las", input.cloud);
  bench::write_lines(input.folder, input.cloud.size());
}

bench::Input make_input(velum::Index count) {
  bench::Input input;
  input.cloud = bench::sail(count);
  input.moved = with_normals(bench::sail_moved(count));
  input.normals = with_normals(input.cloud);
  constexpr double kArea = 11.5;  // of the sail [m²]
  input.radius = std::sqrt(50.0 * kArea / (M_PI * static_cast<double>(count)));
  input.smooth = Stage("resampling.mls")
                     .set("radius", fmt::format("{} m", 2.0 * input.radius))
                     .run(input.normals)
                     .cloud();
  input.scene = with_normals(bench::scanner("gennaker", count).run().cloud());
  input.other = bench::scanner("mainsail", count).run().cloud();
  constexpr double kGapAt100k = 0.1;  // about three steps of the scan at the far wall [m]
  input.gap = kGapAt100k * std::sqrt(1e5 / static_cast<double>(count));
  std::string folder = (std::filesystem::temp_directory_path() / "velum-bench-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  input.folder = folder;
  write_files(input);
  return input;
}

struct Kind {
  std::string name;
  bench::Contenders own;
};

std::vector<Kind> kinds() {
  return {{"Features", bench::own_features()},         {"Filtering", bench::own_filtering()},
          {"Registration", bench::own_registration()}, {"Segmentation", bench::own_segmentation()},
          {"Resampling", bench::own_resampling()},     {"Meshing", bench::own_meshing()},
          {"Analysis", bench::own_analysis()},         {"Files", bench::own_files()}};
}

bench::Contenders peers() {
  bench::Contenders all;
  for (const auto& peer :
       {bench::pcl_features(), bench::pcl_filtering(), bench::pcl_icp(), bench::pcl_registration(),
        bench::pcl_segmentation(), bench::pcl_resampling(), bench::pcl_meshing(),
        bench::pcl_analysis(), bench::pcl_files(), bench::open3d_points(), bench::open3d_surfaces(),
        bench::cgal_points(), bench::cgal_surfaces()})
    all.insert(all.end(), peer.begin(), peer.end());
  return all;
}

/// All ways to do `operation`, ours first.
bench::Contenders contenders_of(const std::string& operation, const bench::Contenders& own,
                                const bench::Contenders& peers) {
  bench::Contenders found;
  for (const auto* list : {&own, &peers})
    for (const auto& contender : *list)
      if (contender.operation == operation) found.push_back(contender);
  return found;
}

void measure_all(const bench::Input& input, const std::string& only, bench::Tables& tables) {
  const bench::Contenders others = peers();
  for (const Kind& kind : kinds()) {
    std::vector<std::string> done;
    for (const auto& first : kind.own) {
      if (std::find(done.begin(), done.end(), first.operation) != done.end()) continue;
      done.push_back(first.operation);
      if ((kind.name + ": " + first.operation).find(only) == std::string::npos) continue;
      bench::Contenders all = contenders_of(first.operation, kind.own, others);
      std::erase_if(all, [&](const bench::Contender& one) {
        return one.max_points > 0 && input.cloud.size() > one.max_points;
      });
      if (all.empty() || all.front().name != first.name) continue;
      tables.add(kind.name, input, all, bench::measure(all, input));
    }
  }
}

std::vector<velum::Index> sizes_of(int argc, char** argv, std::string& only) {
  std::vector<velum::Index> sizes;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) {
      only = argv[++i];
      continue;
    }
    velum::Index size = 0;
    std::from_chars(argv[i], argv[i] + std::strlen(argv[i]), size);
    if (size < 1000) throw std::runtime_error("usage: velum_bench [SIZE >= 1000]... [--only TEXT]");
    sizes.push_back(size);
  }
  if (sizes.empty()) sizes = {20'000, 100'000, 1'000'000};
  return sizes;
}

}  // namespace

int main(int argc, char** argv) try {
  std::string only;
  const std::vector<velum::Index> sizes = sizes_of(argc, argv, only);
  bench::Tables tables(sizes);
  for (const velum::Index size : sizes) {
    const bench::Input input = make_input(size);
    measure_all(input, only, tables);
    std::filesystem::remove_all(input.folder);
  }
  fmt::print("{}", tables.text());
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "velum_bench: {}\n", error.what());
  return 1;
}
