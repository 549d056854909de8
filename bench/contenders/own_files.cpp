// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fstream>

#include "own.hpp"

namespace bench {
namespace {

/// What no reader can beat: the file's bytes into memory.
void read_bytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::size_t>(in.tellg());
  const auto bytes = std::make_unique_for_overwrite<char[]>(size);
  in.seekg(0).read(bytes.get(), static_cast<std::streamsize>(size));
}

void add_reader(Contenders& all, const std::string& operation, const std::string& file,
                const std::string& stage_id = "io.read_cloud") {
  Contender reader = own(operation, [=](const Input& input) {
    return
        [stage = Stage(stage_id).set("file", input.folder + "/" + file)]() mutable { stage.run(); };
  });
  reader.file = file;
  all.push_back(reader);
  all.push_back({operation, "bytes into memory", [=](const Input& input) {
                   return [path = input.folder + "/" + file] { read_bytes(path); };
                 }});
}

Contender writer(const std::string& operation, const std::string& file) {
  return on_cloud(operation, &Input::cloud, [=](const Input& input) {
    return Stage("io.write_cloud").set("file", input.folder + "/out_" + file);
  });
}

}  // namespace

Contenders own_files() {
  Contenders all;
  add_reader(all, "read PCD, binary", "cloud.pcd");
  add_reader(all, "read PLY, binary", "cloud.ply");
  add_reader(all, "read LAS", "cloud.las");
  add_reader(all, "read PCD, text", "cloud_ascii.pcd");
  add_reader(all, "read XYZ, text", "cloud.xyz");
  add_reader(all, "read CSV, text", "cloud.csv");
  add_reader(all, "scanner's telegrams, CoLa A", "lines_a.bin", "devices.replay");
  add_reader(all, "scanner's telegrams, CoLa B", "lines_b.bin", "devices.replay");
  add_reader(all, "scanner's recording", "lines.vrec", "devices.replay");
  all.push_back(writer("write PCD, binary", "cloud.pcd"));
  all.push_back(writer("write PLY, binary", "cloud.ply"));
  all.push_back(writer("write XYZ, text", "cloud.xyz"));
  all.push_back(own("simulate a scan", [](const Input& input) {
    return [stage = scanner("gennaker", input.cloud.size())]() mutable { stage.run(); };
  }));
  return all;
}

}  // namespace bench
