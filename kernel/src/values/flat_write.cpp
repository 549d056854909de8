// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <xxhash.h>

#include <algorithm>
#include <vector>

#include "values/flat.hpp"
#include "values/flat_layout.hpp"

namespace velum {
namespace {

using Bytes = std::span<const std::byte>;

/// Collects what describes the results, and the memory that they point to.
class Description {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void put(T value) {
    put_raw(std::as_bytes(std::span(&value, 1)));
  }
  void put(std::string_view text) {
    put(std::uint64_t{text.size()});
    put_raw(std::as_bytes(std::span(text)));
  }
  template <class Derived>
  void put(const Eigen::MatrixBase<Derived>& matrix) {
    const Eigen::MatrixXd copy = matrix;
    put(std::int64_t{copy.rows()});
    put(std::int64_t{copy.cols()});
    put_raw(std::as_bytes(std::span(copy.data(), static_cast<std::size_t>(copy.size()))));
  }
  void put(const Column& column) {
    put(column.scalar());
    put(std::int64_t{column.width()});
    put(std::int64_t{column.count()});
    put(number_of(column.bytes()));
  }
  void put(const std::vector<Sensor>& sensors) {
    put(std::uint64_t{sensors.size()});
    for (const Sensor& sensor : sensors) {
      put(std::string_view(sensor.name));
      put(sensor.pose.matrix());
    }
  }
  void put(const Cloud& cloud) {
    put(cloud.position_column());
    put(cloud.origin());
    put(cloud.sensors());
    put(std::uint64_t{cloud.columns().size()});
    for (const auto& [name, column] : cloud.columns()) {
      put(std::string_view(name));
      put(column);
    }
  }
  void put(const Mesh& mesh) {
    put(mesh.vertices());
    put(mesh.triangle_column());
  }
  void put(const Surface& surface) {
    put(std::int32_t{surface.degree_u});
    put(std::int32_t{surface.degree_v});
    put(surface.knots_u);
    put(surface.knots_v);
    put(surface.control);
    put(surface.weights);
    put(std::uint64_t{surface.trimming.size()});
    for (const auto& loop : surface.trimming) put(loop);
    put(surface.origin);
    put(surface.sensors);
  }
  void put(const Table& table) {
    put(std::uint64_t{table.headings().size()});
    for (const auto& heading : table.headings()) {
      put(std::string_view(heading.name));
      put(std::string_view(heading.unit));
    }
    put(std::uint64_t{table.size()});
    for (const auto& row : table.rows())
      for (const Cell& cell : row) put(cell);
  }
  void put(const Cell& cell) {
    put(static_cast<std::uint8_t>(cell.index()));
    if (const auto* real = std::get_if<double>(&cell)) put(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) put(*whole);
    if (const auto* text = std::get_if<std::string>(&cell)) put(std::string_view(*text));
  }
  void put(const Transform& transform) {
    put(transform.matrix.matrix());
    put(std::string_view(transform.source));
    put(std::string_view(transform.target));
    put(transform.fitness);
    put(transform.history);
  }
  void put(const Clusters& clusters) {
    put(clusters.cloud);
    put(clusters.labels);
    put(clusters.kinds);
  }
  void put(const Correspondences& pairs) {
    put(pairs.source);
    put(pairs.target);
    put(pairs.distance);
  }

  [[nodiscard]] Bytes bytes() const { return bytes_; }
  [[nodiscard]] const std::vector<Bytes>& blobs() const { return blobs_; }

 private:
  void put_raw(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  std::uint64_t number_of(Bytes blob) {
    const auto found = std::find_if(blobs_.begin(), blobs_.end(), [&](Bytes other) {
      return other.data() == blob.data() && other.size() == blob.size();
    });
    if (found == blobs_.end()) {
      blobs_.push_back(blob);
      return blobs_.size() - 1;
    }
    return static_cast<std::uint64_t>(found - blobs_.begin());
  }

  std::vector<std::byte> bytes_;
  std::vector<Bytes> blobs_;
};

/// Writes while counting, so that blobs can be aligned.
class Output {
 public:
  explicit Output(AtomicFile& file) : file_(file) {}
  void write(Bytes bytes) {
    file_.write(bytes);
    offset_ += bytes.size();
  }
  void align() {
    static constexpr std::array<std::byte, flat::kAlignment> kZeros = {};
    write(Bytes(kZeros).first(flat::aligned(offset_) - offset_));
  }

 private:
  AtomicFile& file_;
  std::uint64_t offset_ = 0;
};

std::vector<flat::Blob> table_of(const std::vector<Bytes>& blobs) {
  std::vector<flat::Blob> table;
  for (const Bytes blob : blobs) {
    const XXH128_hash_t hash = XXH3_128bits(blob.data(), blob.size());
    table.push_back({blob.size(), hash.low64, hash.high64});
  }
  return table;
}

}  // namespace

void write_flat(AtomicFile& file, const Results& results) {
  Description index;
  index.put(std::uint64_t{results.size()});
  for (const auto& result : results) {
    index.put(static_cast<std::uint8_t>(result ? 1 : 0));
    if (!result) continue;
    index.put(type_of(*result));
    std::visit([&](const auto& value) { index.put(value); }, *result);
  }
  const auto table = table_of(index.blobs());
  const Bytes table_bytes = std::as_bytes(std::span(table));
  std::vector<std::byte> described(table_bytes.begin(), table_bytes.end());
  described.insert(described.end(), index.bytes().begin(), index.bytes().end());

  flat::Header header;
  header.index_size = described.size();
  header.blobs = table.size();
  header.file_size = sizeof(header) + described.size();
  for (const flat::Blob& blob : table)
    header.file_size = flat::aligned(header.file_size) + blob.size;
  const XXH128_hash_t hash = XXH3_128bits(described.data(), described.size());
  header.index_low = hash.low64;
  header.index_high = hash.high64;
  header.check = XXH3_64bits(&header, offsetof(flat::Header, check));

  Output output(file);
  output.write(std::as_bytes(std::span(&header, 1)));
  output.write(described);
  for (const Bytes blob : index.blobs()) {
    output.align();
    output.write(blob);
  }
}

}  // namespace velum
