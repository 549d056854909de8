// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "velum/about.hpp"

namespace velum {

/// What kernel and plugin must agree on to exchange values. Plain numbers, so that it can be read
/// from a file that is never opened.
struct Fingerprint {
  std::uint32_t sdk_major = kSdkMajor;
  std::uint32_t sdk_minor = kSdkMinor;
#if defined(__clang__)
  std::uint32_t compiler = 2;  // 1 GCC, 2 clang
  std::uint32_t compiler_major = __clang_major__;
#else
  std::uint32_t compiler = 1;
  std::uint32_t compiler_major = __GNUC__;
#endif
  std::uint32_t cplusplus = static_cast<std::uint32_t>(__cplusplus);
  std::uint32_t cxx11_abi = _GLIBCXX_USE_CXX11_ABI;
#if defined(_GLIBCXX_DEBUG)
  std::uint32_t debug_containers = 1;
#else
  std::uint32_t debug_containers = 0;
#endif
  std::uint32_t eigen_version =
      EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION;
  std::uint32_t eigen_alignment = EIGEN_MAX_ALIGN_BYTES;
  std::uint32_t size_of_cloud = sizeof(Cloud);
  std::uint32_t size_of_mesh = sizeof(Mesh);
  std::uint32_t size_of_surface = sizeof(Surface);
  std::uint32_t size_of_transform = sizeof(Transform);
  std::uint32_t size_of_clusters = sizeof(Clusters);
  std::uint32_t size_of_table = sizeof(Table);
  std::uint32_t size_of_stage_info = sizeof(StageInfo);
};

/// The content of a plugin's ELF section `.velum`, read before the file is opened.
struct PluginEntry {
  char magic[8] = {'V', 'E', 'L', 'U', 'M', 'P', 'L', '1'};
  std::uint32_t size = sizeof(PluginEntry);
  char id[84] = {};
  Fingerprint fingerprint;
};

}  // namespace velum
