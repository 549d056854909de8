// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Any bytes as a PLY file, as a cloud and as a mesh; what begins otherwise may be any mesh format.
#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::run(data, size, "fuzz.ply", true);
  return 0;
}
