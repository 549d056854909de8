// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Any bytes as a text file: a cloud (plain, by names of columns, or legacy VTK by its content), a
// mesh (OBJ, OFF, STL, VTK), or a rigid motion.
#include "formats/transform_io.hpp"
#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (!fuzz::run(data, size, "fuzz.txt", true)) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data), size);  // NOLINT
  fuzz::try_read([&] {
    const auto motion =
        velum::formats::read_transform(velum::formats::Source("fuzz.txt", text), {});
    fuzz::require(motion.matrix.matrix().allFinite());
  });
  return 0;
}
