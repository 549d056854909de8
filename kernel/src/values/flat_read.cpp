// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>

#include "values/flat.hpp"
#include "values/flat_layout.hpp"

namespace velum {
namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void damaged(const std::string& what) {
  throw Error(Fault::input, what);
}

bool matches(Bytes bytes, std::uint64_t low, std::uint64_t high) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return hash.low64 == low && hash.high64 == high;
}

/// Takes the results out of the index. Every count is compared with the bytes that are left before
/// memory is asked for, since a checksum does not protect from a file that was made wrong.
class Reader {
 public:
  Reader(Bytes index, std::vector<Bytes> blobs, std::shared_ptr<const FileContent> owner)
      : left_(index), blobs_(std::move(blobs)), owner_(std::move(owner)) {}

  Results results() {
    Results all(count(1));
    for (auto& result : all)
      if (get<std::uint8_t>() != 0) result = value();
    if (!left_.empty()) damaged("more in the index than it describes");
    return all;
  }

 private:
  Bytes take(std::uint64_t size) {
    if (size > left_.size()) damaged("the index ends too early");
    const Bytes taken = left_.first(size);
    left_ = left_.subspan(size);
    return taken;
  }
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  /// A number of things that take at least `least` bytes of the index each.
  std::size_t count(std::size_t least) {
    const auto number = get<std::uint64_t>();
    if (number > left_.size() / least) damaged("a count larger than the index");
    return number;
  }
  std::string text() {
    const Bytes bytes = take(get<std::uint64_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT
  }
  template <int Fixed>
  static bool allows(std::uint64_t size) {
    return Fixed == Eigen::Dynamic || size == static_cast<std::uint64_t>(Fixed);
  }
  template <class Matrix>
  Matrix matrix() {
    const auto rows = get<std::uint64_t>();
    const auto cols = get<std::uint64_t>();
    const std::uint64_t most = left_.size() / sizeof(double);
    if (!allows<Matrix::RowsAtCompileTime>(rows) || !allows<Matrix::ColsAtCompileTime>(cols) ||
        rows > most || cols > most || (rows > 0 && cols > most / rows))
      damaged("a matrix of impossible size");
    Matrix result(static_cast<Index>(rows), static_cast<Index>(cols));
    const Bytes bytes = take(rows * cols * sizeof(double));
    if (!bytes.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
  }
  Pose pose() {
    Pose result;
    result.matrix() = matrix<Eigen::Matrix4d>();
    return result;
  }
  Column column() {
    const auto scalar = get<Scalar>();
    if (scalar > Scalar::f64) damaged("a column of unknown type");
    const auto width = get<std::uint64_t>();
    const auto number = get<std::uint64_t>();
    const auto blob = get<std::uint64_t>();
    if (blob >= blobs_.size()) damaged("a column without memory");
    const Bytes bytes = blobs_[blob];
    const std::uint64_t element = size_of(scalar);
    // An empty column may be of any width, so products are formed only of what fits the blob.
    const bool fits = width == 0 || number == 0 || bytes.empty()
                          ? bytes.empty() && (width == 0 || number == 0) && width <= kMostWide &&
                                number <= kMostWide
                          : width <= bytes.size() && number <= bytes.size() / width &&
                                width * number * element == bytes.size();
    if (!fits) damaged("a column whose memory has another size");
    return {scalar, static_cast<Index>(width), static_cast<Index>(number), bytes.data(), owner_};
  }
  Column column(Scalar scalar, Index width) {
    Column result = column();
    if (result.scalar() != scalar || result.width() != width) damaged("a column of a wrong type");
    return result;
  }
  std::vector<Sensor> sensors() {
    std::vector<Sensor> result(count(16));
    for (Sensor& sensor : result) {
      sensor.name = text();
      sensor.pose = pose();
    }
    return result;
  }
  Cloud cloud() {
    Column positions = column();
    const auto origin = matrix<Eigen::Vector3d>();
    Cloud result = Cloud(std::move(positions), origin).with_sensors(sensors());
    const std::size_t columns = count(8);
    for (std::size_t i = 0; i < columns; ++i) {
      std::string name = text();
      result = result.with(std::move(name), column());
    }
    return result;
  }
  Mesh mesh() {
    Cloud vertices = cloud();
    const Column triangles = column(Scalar::i32, 3);
    return {std::move(vertices), Triangles(triangles.as<std::int32_t>())};
  }
  Surface surface() {
    Surface result;
    result.degree_u = get<std::int32_t>();
    result.degree_v = get<std::int32_t>();
    result.knots_u = matrix<Eigen::VectorXd>();
    result.knots_v = matrix<Eigen::VectorXd>();
    result.control = matrix<Eigen::Matrix3Xd>();
    result.weights = matrix<Eigen::VectorXd>();
    result.trimming.resize(count(16));
    for (auto& loop : result.trimming) loop = matrix<Eigen::Matrix2Xd>();
    result.origin = matrix<Eigen::Vector3d>();
    result.sensors = sensors();
    return result;
  }
  Cell cell() {
    switch (get<std::uint8_t>()) {
      case 0:
        return get<double>();
      case 1:
        return get<std::int64_t>();
      case 2:
        return text();
      default:
        damaged("a table's cell of unknown type");
    }
  }
  Table table() {
    std::vector<Table::Heading> headings(count(16));
    for (auto& heading : headings) {
      heading.name = text();
      heading.unit = text();
    }
    const std::size_t width = headings.size();
    Table result(std::move(headings));
    const std::size_t rows = count(std::max<std::size_t>(width, 1));
    for (std::size_t i = 0; i < rows; ++i) {
      std::vector<Cell> row(width);
      for (Cell& entry : row) entry = cell();
      result.add(std::move(row));
    }
    return result;
  }
  Transform transform() {
    Transform result;
    result.matrix = pose();
    result.source = text();
    result.target = text();
    result.fitness = get<double>();
    result.history = table();
    return result;
  }
  Clusters clusters() {
    Clusters result;
    result.cloud = cloud();
    result.labels = column(Scalar::i32, 1);
    if (result.labels.count() != result.cloud.size()) damaged("labels of another cloud");
    result.kinds = table();
    return result;
  }
  Correspondences correspondences() {
    Correspondences result;
    result.source = column(Scalar::i32, 1);
    result.target = column(Scalar::i32, 1);
    result.distance = column(Scalar::f32, 1);
    if (result.target.count() != result.source.count() ||
        result.distance.count() != result.source.count())
      damaged("pairs of unequal number");
    return result;
  }
  Value value() {
    switch (get<ValueType>()) {
      case ValueType::cloud:
        return cloud();
      case ValueType::mesh:
        return mesh();
      case ValueType::surface:
        return surface();
      case ValueType::transform:
        return transform();
      case ValueType::clusters:
        return clusters();
      case ValueType::correspondences:
        return correspondences();
      case ValueType::table:
        return table();
    }
    damaged("a value of unknown type");
  }

  static constexpr std::uint64_t kMostWide = std::uint64_t{1} << 31U;
  Bytes left_;
  std::vector<Bytes> blobs_;
  std::shared_ptr<const FileContent> owner_;
};

flat::Header header_of(Bytes file) {
  flat::Header header;
  if (file.size() < sizeof(header))
    damaged(fmt::format("{} bytes, a header has {}", file.size(), sizeof(header)));
  const flat::Header expected;
  std::memcpy(&header, file.data(), sizeof(header));
  if (header.magic != expected.magic) damaged("not a file of kept results");
  if (header.check != XXH3_64bits(&header, offsetof(flat::Header, check)))
    damaged("the header's checksum is wrong");
  if (header.version != expected.version || header.byte_order != expected.byte_order)
    damaged("results of another version of Velum or kind of machine");
  if (header.file_size != file.size())
    damaged(fmt::format("{} bytes, the header says {}", file.size(), header.file_size));
  if (header.index_size > file.size() - sizeof(header) ||
      header.blobs > header.index_size / sizeof(flat::Blob))
    damaged("the header describes more than the file holds");
  return header;
}

/// The blobs behind the index that ends at `offset`, each compared with its checksum.
std::vector<Bytes> blobs_of(Bytes file, Bytes table, std::uint64_t offset) {
  std::vector<Bytes> blobs;
  for (; !table.empty(); table = table.subspan(sizeof(flat::Blob))) {
    flat::Blob blob{};
    std::memcpy(&blob, table.data(), sizeof(blob));
    const std::uint64_t begin = flat::aligned(offset);
    if (begin > file.size() || blob.size > file.size() - begin) damaged("a blob behind the end");
    const Bytes padding = file.subspan(offset, begin - offset);
    const Bytes bytes = file.subspan(begin, blob.size);
    if (std::any_of(padding.begin(), padding.end(), [](std::byte b) { return b != std::byte{}; }) ||
        !matches(bytes, blob.low, blob.high))
      damaged(fmt::format("the checksum of {} bytes at {} is wrong", blob.size, begin));
    blobs.push_back(bytes);
    offset = begin + blob.size;
  }
  if (offset != file.size()) damaged("bytes behind the end");
  return blobs;
}

Results read(std::shared_ptr<const FileContent> content) {
  const Bytes file = content->bytes();
  const flat::Header header = header_of(file);
  const Bytes index = file.subspan(sizeof(header), header.index_size);
  if (!matches(index, header.index_low, header.index_high))
    damaged("the index's checksum is wrong");
  const std::size_t table_size = header.blobs * sizeof(flat::Blob);
  auto blobs = blobs_of(file, index.first(table_size), sizeof(header) + header.index_size);
  return Reader(index.subspan(table_size), std::move(blobs), std::move(content)).results();
}

}  // namespace

Results read_flat(const std::filesystem::path& path) {
  auto content = std::make_shared<const FileContent>(path);
  try {
    return read(std::move(content));
  } catch (const Error& error) {
    // What values refuse to be made of is here the fault of the file.
    throw Error(Fault::input, std::string("damaged results: ") + error.what()).at(path.string());
  }
}

}  // namespace velum
