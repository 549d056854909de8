// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/vrec.hpp"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "lms511/import.hpp"
#include "lms511/test_room.hpp"
#include "velum/files.hpp"

using namespace velum::lms511;  // NOLINT
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("velum_vrec_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

std::span<const std::byte> as_bytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::vector<std::string> read(const std::string& content) {
  std::vector<std::string> all;
  static_cast<void>(read_vrec(as_bytes(content), "test.vrec", [&](const Record& record) {
    all.push_back(std::to_string(record.time) + " " + std::string(record.bytes));
  }));
  return all;
}

// A recording of 200 numbered records in blocks of ten.
std::string recording(const fs::path& path) {
  VrecWriter writer(path, {.block_size = 10 * (16 + 3)});
  for (int i = 0; i < 200; ++i)
    writer.add({Event::ascii_telegram, i, std::to_string(1000 + i).substr(1)});
  writer.close();
  return lms::content(path);
}

}  // namespace

TEST_CASE("what is recorded is read again, byte for byte") {
  const Folder folder;
  const lms::RoomScan scan;
  std::vector<std::string> written;
  VrecWriter writer(folder.path / "room.vrec", {});
  scan.play([&](const Record& record) {
    writer.add(record);
    written.push_back(std::to_string(record.time) + " " + std::string(record.bytes));
  });
  writer.close();
  CHECK(writer.records() == 104);
  const std::string content = lms::content(folder.path / "room.vrec");
  CHECK(content.size() == writer.written());
  CHECK(read(content) == written);
  CHECK(content.size() < 101 * 400);  // ranges and remission compress
}

TEST_CASE("a recording cut anywhere is read up to its last whole block") {
  const Folder folder;
  const std::string whole = recording(folder.path / "a.vrec");
  REQUIRE(read(whole).size() == 200);
  std::size_t last = 0;
  for (std::size_t cut = 16; cut <= whole.size(); ++cut) {
    const auto records = read(whole.substr(0, cut));
    REQUIRE(records.size() % 10 == 0);
    REQUIRE(records.size() >= last);
    last = records.size();
  }
  CHECK(last == 200);
}

TEST_CASE("a byte that changed costs its block and no other, and is reported") {
  const Folder folder;
  const std::string whole = recording(folder.path / "a.vrec");
  for (std::size_t at = 16; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x41);
    std::size_t records = 0;
    const ImportCounts counts =
        read_vrec(as_bytes(changed), "test.vrec", [&](const Record&) { ++records; });
    REQUIRE(records == 190);
    REQUIRE(counts.damaged_bytes > 0);
  }
}

TEST_CASE("what is no recording, or one of the future, is refused") {
  const Folder folder;
  std::string content = recording(folder.path / "a.vrec");
  CHECK_THROWS_AS(read("not a recording at all"), velum::Error);
  CHECK_THROWS_AS(read(content.substr(0, 12)), velum::Error);
  content[8] = 9;
  try {
    read(content);
    FAIL("read version 9");
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::input);
    CHECK(std::string(error.what()).find("version 9") != std::string::npos);
  }
}

TEST_CASE("parts of a given size make one recording, and each can be read alone") {
  const Folder folder;
  const fs::path path = folder.path / "long.vrec";
  lms::RoomScan scan;
  LineGatherer lines;
  VrecWriter writer(path, {.rotate = 8192, .block_size = 4096});
  scan.play([&](const Record& record) {
    lines.add(record);
    writer.add(record);
  });
  writer.close();
  REQUIRE(writer.parts().size() > 2);
  CHECK(writer.parts() == parts_of(path));
  CHECK(writer.parts()[1].filename() == "long.0001.vrec");
  lms::QuietContext context;
  LineGatherer again;
  const ImportCounts counts = read_records(
      path, [&](const Record& record) { again.add(record); }, context);
  CHECK(counts.ended);
  CHECK(again.counts().lines == 101);
  CHECK(again.counts().connections == 1);
  CHECK(again.counts().lost == 0);
  LineGatherer second;
  static_cast<void>(read_records(
      writer.parts()[1], [&](const Record& record) { second.add(record); }, context));
  CHECK(second.counts().connections == 1);
  CHECK(second.counts().lines > 0);
}

TEST_CASE("parts that an earlier recording of the same name left do not count") {
  const Folder folder;
  const fs::path path = folder.path / "again.vrec";
  {
    VrecWriter writer(path, {.rotate = 8192, .block_size = 4096});
    lms::RoomScan().play([&](const Record& record) { writer.add(record); });
    REQUIRE(writer.parts().size() > 1);
  }
  {
    VrecWriter writer(path, {});
    writer.add({Event::start, 0, "2026-01-02T00:00:00Z"});
    writer.add({Event::ascii_telegram, 5, "sAN Run 1"});
    writer.add({Event::end, 6, "done"});
    writer.close();
  }
  REQUIRE(fs::exists(folder.path / "again.0001.vrec"));
  lms::QuietContext context;
  std::size_t records = 0;
  const ImportCounts counts = read_records(
      path, [&](const Record&) { ++records; }, context);
  CHECK(records == 3);
  CHECK(counts.ended);
}

TEST_CASE("a disk that is full is reported, and what was written stays") {
  const Folder folder;
  const fs::path path = folder.path / "full.vrec";
  // The system's limit on file sizes stands in for a full disk.
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit little{20000, limit.rlim_max};
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &little);
  bool failed = false;
  try {
    VrecWriter writer(path, {.block_size = 3000});
    lms::RoomScan().play([&](const Record& record) { writer.add(record); });
    writer.close();
  } catch (const velum::Error& error) {
    failed = error.fault() == velum::Fault::output && error.where() == path.string();
  }
  ::setrlimit(RLIMIT_FSIZE, &limit);
  static_cast<void>(std::signal(SIGXFSZ, old));
  CHECK(failed);
  CHECK(read(lms::content(path)).size() > 10);
}
