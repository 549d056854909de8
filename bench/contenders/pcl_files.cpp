// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

std::function<void()> write_pcd(const Input& input) {
  return [cloud = plain(input.cloud), file = input.folder + "/pcl.pcd"] {
    pcl::io::savePCDFileBinary(file, *cloud);
  };
}

std::function<void()> write_ply(const Input& input) {
  return [cloud = plain(input.cloud), file = input.folder + "/pcl.ply"] {
    pcl::io::savePLYFileBinary(file, *cloud);
  };
}

template <int (*Load)(const std::string&, Plain&)>
Prepare reader(const std::string& name) {
  return [=](const Input& input) {
    return [file = input.folder + "/" + name] {
      Plain out;
      if (Load(file, out) < 0) throw std::runtime_error("PCL cannot read " + file);
    };
  };
}

}  // namespace

Contenders pcl_files() {
  using pcl::io::loadPCDFile;
  using pcl::io::loadPLYFile;
  return {{"write PCD, binary", "PCL", write_pcd},
          {"write PLY, binary", "PCL", write_ply},
          {"read PCD, binary", "PCL", reader<loadPCDFile>("cloud.pcd")},
          {"read PCD, text", "PCL", reader<loadPCDFile>("cloud_ascii.pcd")},
          {"read PLY, binary", "PCL", reader<loadPLYFile>("cloud.ply")}};
}

}  // namespace bench
