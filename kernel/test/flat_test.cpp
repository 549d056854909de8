// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "values/flat.hpp"

#include <unistd.h>
#include <xxhash.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "values/flat_layout.hpp"
#include "velum/random.hpp"

namespace fs = std::filesystem;
using namespace velum;

namespace {

/// A folder of its own for a test, removed at its end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("velum_flat_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

Pose some_pose() {
  Pose pose = Pose::Identity();
  pose.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  pose.pretranslate(Eigen::Vector3d(5e6, 4e5, 12.25));
  return pose;
}

Cloud some_cloud(Index points) {
  Random random(7);
  Points positions(3, points);
  for (Index i = 0; i < points; ++i)
    for (Index axis = 0; axis < 3; ++axis)
      positions(axis, i) = static_cast<float>(random.uniform(-1, 1));
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(points, 0, 1);
  const VectorXu8 sensor = VectorXu8::Constant(points, 1);
  const Eigen::MatrixXf histogram = Eigen::MatrixXf::Constant(5, points, 0.5F);
  return Cloud(std::move(positions), {5e6, 4e5, 12})
      .with(column::kTime, Column(time))
      .with(column::kSensor, Column(sensor))
      .with(column::kLabel, Column(Eigen::VectorXi(Eigen::VectorXi::LinSpaced(points, 0, 9))))
      .with("histogram", Column(histogram))
      .with_sensors({{"left", some_pose()}, {"right", Pose::Identity()}});
}

Table some_table() {
  Table table({{"height", "m"}, {"number", ""}, {"name", ""}});
  table.add({1.5, std::int64_t{-3}, "head, or \"top\""});
  table.add({std::numeric_limits<double>::quiet_NaN(), std::int64_t{1} << 62, ""});
  return table;
}

Surface some_surface() {
  Surface surface;
  surface.degree_u = 2;
  surface.knots_u = Eigen::VectorXd::LinSpaced(6, 0, 1);
  surface.knots_v = Eigen::VectorXd::LinSpaced(8, 0, 2);
  surface.control = Eigen::Matrix3Xd::Constant(3, 12, 0.1);
  surface.trimming = {Eigen::Matrix2Xd::Constant(2, 4, 0.25), Eigen::Matrix2Xd(2, 0)};
  surface.origin = {1, 2, 3};
  surface.sensors = {{"left", some_pose()}};
  return surface;
}

Results one_of_each(Index points) {
  const Cloud cloud = some_cloud(points);
  Triangles triangles(3, 2);
  triangles << 0, 1, 1, 2, 2, 0;
  Clusters clusters{cloud, cloud.column(column::kLabel), some_table()};
  Correspondences pairs{Column(Eigen::VectorXi::Constant(2, 1).eval()),
                        Column(Eigen::VectorXi::Constant(2, 4).eval()),
                        Column(Eigen::VectorXf::Constant(2, 0.5F).eval())};
  return {cloud,
          std::nullopt,
          Mesh(cloud, triangles),
          some_surface(),
          Transform{some_pose(), "a", "b", 1e-7, some_table()},
          clusters,
          pairs,
          some_table()};
}

fs::path written(const Folder& folder, const Results& results, const char* name = "results") {
  const fs::path path = folder.path / name;
  AtomicFile file(path);
  write_flat(file, results);
  file.commit();
  return path;
}

/// Without a flush, which would make thousands of files take minutes: neither that of write_file
/// nor that of file systems which flush what is written over.
void scribble(const fs::path& path, std::string_view bytes) {
  fs::remove(path);
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string content_of(const fs::path& path) {
  return std::string(FileContent(path).text());
}

/// True when reading throws what it should; any other exception or a crash fails the test.
bool is_refused(const fs::path& path) {
  try {
    (void)read_flat(path);
    return false;
  } catch (const Error& error) {
    return error.fault() == Fault::input && error.where() == path.string();
  }
}

}  // namespace

TEST_CASE("flat: every type comes back as it was") {
  const Folder folder;
  const Results results = one_of_each(100);
  const Results again = read_flat(written(folder, results));
  REQUIRE(again.size() == results.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    CAPTURE(i);
    REQUIRE(again[i].has_value() == results[i].has_value());
    if (!results[i]) continue;
    CHECK(type_of(*again[i]) == type_of(*results[i]));
    CHECK(hash_of(*again[i]) == hash_of(*results[i]));
  }
  const auto& transform = std::get<Transform>(*again[4]);
  CHECK(transform.matrix.matrix() == some_pose().matrix());
  CHECK(transform.history.headings() == some_table().headings());
  CHECK(std::get<Cloud>(*again[0]).sensors()[0].name == "left");
  CHECK(std::get<Cloud>(*again[0]).column("histogram").width() == 5);
  CHECK(std::get<Surface>(*again[3]).trimming.size() == 2);
}

TEST_CASE("flat: columns are aligned views of one buffer, and shared memory is written once") {
  const Folder folder;
  const Cloud cloud = some_cloud(1000);
  const Results results = {cloud, cloud.without("histogram")};
  const fs::path path = written(folder, results);
  CHECK(fs::file_size(path) < 1000 * (12 + 8 + 1 + 4 + 20) + 2000);
  const Results again = read_flat(path);
  const auto& first = std::get<Cloud>(*again[0]);
  const auto& second = std::get<Cloud>(*again[1]);
  CHECK(first.position_column().same_storage(second.position_column()));
  for (const auto& [name, column] : first.columns())
    CHECK(reinterpret_cast<std::uintptr_t>(column.bytes().data()) % 16 == 0);
}

TEST_CASE("flat: empty values and no values") {
  const Folder folder;
  CHECK(read_flat(written(folder, {})).empty());
  const Results results = {Cloud(),           Mesh(),  Surface(),   Transform(), Clusters(),
                           Correspondences(), Table(), std::nullopt};
  const Results again = read_flat(written(folder, results));
  REQUIRE(again.size() == 8);
  for (std::size_t i = 0; i < 7; ++i) CHECK(hash_of(*again[i]) == hash_of(*results[i]));
  CHECK_FALSE(again[7]);
}

TEST_CASE("flat: what is read outlives the file") {
  const Folder folder;
  const fs::path path = written(folder, {some_cloud(50)});
  const Results again = read_flat(path);
  fs::remove(path);
  CHECK(hash_of(*again[0]) == hash_of(some_cloud(50)));
}

TEST_CASE("flat: a changed byte anywhere is found") {
  const Folder folder;
  const std::string good = content_of(written(folder, one_of_each(3)));
  const fs::path path = folder.path / "bad";
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    scribble(path, bad);
    if (!is_refused(path)) FAIL_CHECK("byte " << i << " of " << good.size());
  }
}

TEST_CASE("flat: a file cut short or continued is refused") {
  const Folder folder;
  const std::string good = content_of(written(folder, one_of_each(3)));
  const fs::path path = folder.path / "bad";
  for (std::size_t size = 0; size < good.size(); ++size) {
    scribble(path, std::string_view(good).substr(0, size));
    if (!is_refused(path)) FAIL_CHECK("cut to " << size);
  }
  scribble(path, good + '\0');
  CHECK(is_refused(path));
  fs::remove(path);
  CHECK(is_refused(path));
  CHECK(is_refused(folder.path));
}

namespace {

/// Makes the checksums right again for a file whose header or index was changed.
std::string sealed(std::string bytes) {
  flat::Header header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  const std::size_t size = std::min<std::size_t>(header.index_size, bytes.size() - sizeof(header));
  const XXH128_hash_t hash = XXH3_128bits(bytes.data() + sizeof(header), size);
  header.index_low = hash.low64;
  header.index_high = hash.high64;
  header.check = XXH3_64bits(&header, offsetof(flat::Header, check));
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

}  // namespace

TEST_CASE("flat: lies under right checksums neither crash nor ask for much memory") {
  const Folder folder;
  const std::string good = content_of(written(folder, one_of_each(3)));
  flat::Header header;
  std::memcpy(&header, good.data(), sizeof(header));
  const fs::path path = folder.path / "bad";
  const std::size_t end = sizeof(header) + header.index_size;
  int refused = 0;
  for (std::size_t i = 12; i < end; ++i) {
    for (const int lie : {0x00, 0x01, 0x7f, 0xff}) {
      std::string bad = good;
      bad[i] = static_cast<char>(lie);
      scribble(path, sealed(bad));
      try {
        (void)read_flat(path);  // some lies are other values, rightly read
      } catch (const Error& error) {
        if (error.fault() != Fault::input) FAIL_CHECK("byte " << i << ": " << error.what());
        ++refused;
      }
    }
  }
  CHECK(refused > 500);
}

TEST_CASE("flat: random bytes behind a right header are refused") {
  const Folder folder;
  Random random(3);
  const fs::path path = folder.path / "bad";
  for (int trial = 0; trial < 500; ++trial) {
    std::string bytes(sizeof(flat::Header) + static_cast<std::size_t>(random.below(400)), '\0');
    for (char& c : bytes) c = static_cast<char>(random.below(trial % 2 == 0 ? 256 : 3));
    flat::Header header;
    header.file_size = bytes.size();
    header.index_size = bytes.size() - sizeof(header);
    std::memcpy(bytes.data(), &header, sizeof(header));
    scribble(path, sealed(bytes));
    try {
      (void)read_flat(path);  // an index of zeros describes no results
    } catch (const Error& error) {
      if (error.fault() != Fault::input) FAIL_CHECK(error.what());
    }
  }
}
