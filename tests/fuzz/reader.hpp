// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>

#include "formats/cloud_io.hpp"
#include "formats/mesh_io.hpp"
#include "velum/context.hpp"

/// What the fuzz targets of readers share: any bytes are either read into a sound value or refused
/// as bad input with a place.
namespace fuzz {

/// One thread, and what is said is forgotten.
class Context : public velum::Context {
 public:
  [[nodiscard]] int threads() const override { return 1; }
  [[nodiscard]] velum::Random random() const override { return velum::Random(1); }
  void progress(double) override {}
  [[nodiscard]] bool cancelled() const noexcept override { return false; }
  void warn(const std::string&) override {}
  void info(const std::string&) override {}
  void measure(const std::string&, double, const std::string&, velum::Better) override {}
  void run_chunks(velum::Index chunks, const std::function<void(velum::Index)>& body) override {
    for (velum::Index i = 0; i < chunks; ++i) body(i);
  }
};

inline void require(bool good) {
  if (!good) std::abort();
}

template <class Read>
void try_read(const Read& read) {
  try {
    read();
  } catch (const velum::Error& error) {
    require(error.fault() == velum::Fault::input);
    require(!error.where().empty() && *error.what() != '\0');
  }
}

inline void as_cloud(velum::formats::Source source,
                     const velum::formats::ReadOptions& options = {}) {
  Context context;
  try_read([&] {
    const velum::Cloud cloud = velum::formats::read_cloud(source, options, context);
    for (const auto& [name, column] : cloud.columns()) require(column.count() == cloud.size());
  });
}

inline void as_mesh(velum::formats::Source source) {
  Context context;
  try_read([&] {
    const velum::Mesh mesh = velum::formats::read_mesh(source, {}, context);
    require(mesh.size() > 0 || mesh.vertices().empty());
  });
}

/// The bytes as a file of that name; nothing where there are none.
inline bool run(const std::uint8_t* data, std::size_t size, const char* name, bool mesh) {
  if (size == 0) return false;
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);  // NOLINT
  as_cloud(velum::formats::Source(name, bytes));
  if (mesh) as_mesh(velum::formats::Source(name, bytes));
  return true;
}

}  // namespace fuzz
