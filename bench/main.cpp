// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// velum_bench [SIZE...] [--only TEXT]: our stages beside the peers, one table. Each row: our time
// with 2 threads, then every contender's time divided by ours (above 1: slower than we are).
#include <fmt/format.h>
#include <stdlib.h>

#include <charconv>
#include <cstring>
#include <filesystem>
#include <velum/testing.hpp>

#include "clouds.hpp"
#include "timing.hpp"

namespace {

bench::Input make_input(velum::Index count) {
  using velum::test::Stage;
  bench::Input input;
  input.cloud = bench::sail(count);
  input.moved =
      Stage("features.normals").set("neighbours", "50").run(bench::sail_moved(count)).cloud();
  input.normals = Stage("features.normals").set("neighbours", "50").run(input.cloud).cloud();
  constexpr double kArea = 11.5;  // of the sail [m²]
  input.radius = std::sqrt(50.0 * kArea / (M_PI * static_cast<double>(count)));
  input.smooth = Stage("resampling.mls")
                     .set("radius", fmt::format("{} m", 2.0 * input.radius))
                     .run(input.normals)
                     .cloud();
  std::string folder = (std::filesystem::temp_directory_path() / "velum-bench-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  input.folder = folder;
  const auto save = [&](const char* file, const char* format) {
    Stage("io.write_cloud").set("file", folder + "/" + file).set("format", format).run(input.cloud);
  };
  save("cloud.pcd", "pcd");
  save("cloud_ascii.pcd", "pcd_ascii");
  save("cloud.ply", "ply");
  return input;
}

void print_operation(const std::string& operation, velum::Index count,
                     const std::vector<bench::Contender>& all, const bench::Input& input) {
  std::vector<bench::Contender> contenders;
  for (const auto& contender : all)
    if (contender.operation == operation) contenders.push_back(contender);
  const std::vector<double> seconds = bench::measure(contenders, input);
  std::string ratios;
  for (std::size_t i = 1; i < contenders.size(); ++i)
    ratios +=
        fmt::format("{}{} {:.2f}", i > 1 ? ", " : "", contenders[i].name, seconds[i] / seconds[0]);
  fmt::print("| {} | {} | {:.2f} ms | {} |\n", operation, count, 1e3 * seconds[0], ratios);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<velum::Index> sizes;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) {
      only = argv[++i];
    } else {
      velum::Index size = 0;
      std::from_chars(argv[i], argv[i] + std::strlen(argv[i]), size);
      if (size < 1000)
        throw std::runtime_error("usage: velum_bench [SIZE >= 1000]... [--only TEXT]");
      sizes.push_back(size);
    }
  }
  if (sizes.empty()) sizes = {20'000, 100'000, 1'000'000};

  std::vector<bench::Contender> all = bench::ours();
  for (const auto& peer : {bench::our_small_ones(), bench::pcl_contenders(),
                           bench::open3d_contenders(), bench::cgal_contenders()})
    all.insert(all.end(), peer.begin(), peer.end());

  fmt::print(
      "| operation | points | Velum, 2 threads | the others' time / ours |\n|---|--:|--:|---|\n");
  for (const velum::Index size : sizes) {
    const bench::Input input = make_input(size);
    std::vector<std::string> done;
    for (const auto& contender : all) {
      if (std::find(done.begin(), done.end(), contender.operation) != done.end()) continue;
      done.push_back(contender.operation);
      if (contender.operation.find(only) != std::string::npos)
        print_operation(contender.operation, size, all, input);
    }
    std::filesystem::remove_all(input.folder);
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "velum_bench: {}\n", error.what());
  return 1;
}
