// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/files.hpp"

#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

namespace fs = std::filesystem;
using namespace velum;

namespace {

/// A folder of its own for a test, removed at its end.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "velum_files_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

void scribble(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string content_of(const fs::path& path) {
  return std::string(FileContent(path).text());
}

/// Runs `body` in a child process; its result is the exit status, 99 for any exception.
template <class Body>
int in_child(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    int status = 99;
    try {
      status = body();
    } catch (...) {
    }
    ::_exit(status);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

/// What an attempt to write `size` bytes to `target` ends with: 0 success, 6 Fault::output.
int attempt(const fs::path& target, std::size_t size) {
  try {
    write_file(target, std::string(size, 'x'));
    return 0;
  } catch (const Error& error) {
    return error.where() == target.string() ? static_cast<int>(error.fault()) : 98;
  }
}

Fault fault_of_reading(const fs::path& path, std::uint64_t limit = 1000) {
  try {
    const FileContent content(path, limit);
  } catch (const Error& error) {
    CHECK(error.where() == path.string());
    CHECK(std::string(error.what()).find("cannot be read") == 0);
    return error.fault();
  }
  return Fault::stage;
}

}  // namespace

TEST_CASE("files: content is read whole, up to a limit") {
  const Folder folder;
  const fs::path path = folder.path / "a.txt";
  for (const std::size_t size : {0U, 1U, 1000U, 5000000U}) {
    const std::string text(size, 'q');
    scribble(path, text);
    const FileContent content(path);
    CHECK(content.size() == size);
    CHECK(content.text() == text);
    CHECK(content.bytes().size() == size);
  }
  scribble(path, std::string(1000, 'q'));
  CHECK_NOTHROW(FileContent(path, 1000));
  CHECK(fault_of_reading(path, 999) == Fault::input);
}

TEST_CASE("files: what is not a file is refused, and does not block") {
  const Folder folder;
  CHECK(fault_of_reading(folder.path / "absent") == Fault::input);
  CHECK(fault_of_reading(folder.path) == Fault::input);
  const fs::path pipe = folder.path / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(fault_of_reading(pipe) == Fault::input);
  CHECK(fault_of_reading("/dev/zero") == Fault::input);
}

TEST_CASE("files: hash_of is XXH3-128") {
  CHECK(hash_of(std::span<const std::byte>()) == "99aa06d3014798d86001c324468d497f");
  const std::string text = "velum";
  CHECK(hash_of(std::as_bytes(std::span(text))).size() == 32);
}

TEST_CASE("files: a target holds the old or the new content") {
  const Folder folder;
  const fs::path path = folder.path / "out.txt";
  write_file(path, "old");
  CHECK(content_of(path) == "old");
  {
    AtomicFile file(path);
    file.write("new and ");
    file.write(std::string(3000000, 'y'));
    CHECK(content_of(path) == "old");
    CHECK(folder.entries() == 2);
    file.write(" end");
    file.commit();
    CHECK_THROWS_AS(file.commit(), Error);
  }
  CHECK(content_of(path) == "new and " + std::string(3000000, 'y') + " end");
  CHECK(folder.entries() == 1);
}

TEST_CASE("files: what was not committed is removed") {
  const Folder folder;
  {
    AtomicFile file(folder.path / "out.txt");
    file.write("something");
    CHECK(folder.entries() == 1);
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("files: two writers of one name in one process") {
  const Folder folder;
  const fs::path path = folder.path / "out.txt";
  AtomicFile first(path);
  AtomicFile second(path);
  first.write("first");
  second.write("second");
  second.commit();
  first.commit();
  CHECK(content_of(path) == "first");
  CHECK(folder.entries() == 1);
}

TEST_CASE("files: relative names, links and long names") {
  const Folder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path);
  write_file("plain.txt", "plain");
  fs::current_path(before);
  CHECK(content_of(folder.path / "plain.txt") == "plain");

  fs::create_symlink("plain.txt", folder.path / "link.txt");
  write_file(folder.path / "link.txt", "through the link");
  CHECK(fs::is_symlink(folder.path / "link.txt"));
  CHECK(content_of(folder.path / "plain.txt") == "through the link");

  const fs::path longest = folder.path / (std::string(250, 'n') + ".txt");
  write_file(longest, "long");
  CHECK(content_of(longest) == "long");
}

TEST_CASE("files: targets that are no regular files are refused") {
  const Folder folder;
  fs::create_directory(folder.path / "folder");
  fs::create_symlink("nowhere", folder.path / "dangling");
  CHECK(attempt(folder.path / "folder", 1) == 6);
  CHECK(attempt(folder.path / "dangling", 1) == 6);
  CHECK(attempt(folder.path / "absent" / "out.txt", 1) == 6);
  CHECK(attempt("/dev/full", 1) == 6);
  CHECK(attempt("/dev/null", 1) == 6);
  CHECK(attempt("", 1) == 6);
  CHECK(attempt(folder.path / "", 1) == 6);
  CHECK(folder.entries() == 2);
  try {
    write_file("/dev/full", "x");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find("not a regular file") != std::string::npos);
  }
}

TEST_CASE("files: a limit of file sizes is met as a full disk is") {
  const Folder folder;
  const fs::path path = folder.path / "out.bin";
  write_file(path, "old");
  const int status = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    if (attempt(path, 50000) != 0) return 1;
    for (const std::size_t size : {100001U, 5000000U})
      if (attempt(path, size) != 6) return 2;
    return 0;
  });
  CHECK(status == 0);
  CHECK(content_of(path) == std::string(50000, 'x'));
  CHECK(folder.entries() == 1);
}

TEST_CASE("files: a full disk") {
  const Folder folder;
  const int status = in_child([&] {
    // In a name space of its own, so that the mount goes with the process.
    if (::unshare(CLONE_NEWNS) != 0 ||
        ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("velum", folder.path.c_str(), "tmpfs", 0, "size=1m") != 0)
      return 77;
    const fs::path path = folder.path / "out.bin";
    int result = attempt(path, 1000) == 0 ? 0 : 1;
    if (attempt(path, 3000000) != 6) result = 2;
    if (result == 0 && (fs::file_size(path) != 1000 || folder.entries() != 1)) result = 3;
    // A library that does not notice: it leaves a file that is cut short.
    try {
      AtomicFile file(path);
      std::ofstream(file.aside(), std::ios::binary) << std::string(3000000, 'z');
      file.adopt();
      result = 4;
    } catch (const Error& error) {
      if (error.fault() != Fault::output) result = 5;
    }
    return result;
  });
  if (status == 77) {
    WARN("skipped: no file system can be mounted here");
    return;
  }
  CHECK(status == 0);
}

TEST_CASE("files: a folder that cannot be written to") {
  CHECK(attempt("/proc/velum_test.txt", 1) == 6);
  const Folder folder;
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  if (::geteuid() == 0) {
    WARN("skipped: folder modes do not bind the superuser");
  } else {
    CHECK(attempt(folder.path / "out.txt", 1) == 6);
  }
  fs::permissions(folder.path, fs::perms::owner_all);
}

TEST_CASE("files: a killed writer leaves the old content, and its rest goes with the next write") {
  const Folder folder;
  const fs::path path = folder.path / "out.txt";
  write_file(path, "old");
  const int status = in_child([&] {
    AtomicFile file(path);
    file.write(std::string(3000000, 'k'));
    ::raise(SIGKILL);
    return 0;
  });
  CHECK(status == 1000 + SIGKILL);
  CHECK(content_of(path) == "old");
  CHECK(folder.entries() == 2);
  scribble(folder.path / ".other.txt.partial.1", "of another name");
  scribble(folder.path / ".out.txt.partial.mine", "of no process");
  AtomicFile alive(path);
  write_file(path, "new");
  CHECK(content_of(path) == "new");
  CHECK(folder.entries() == 4);
  CHECK(fs::exists(alive.aside()));
}

TEST_CASE("files: libraries write aside themselves") {
  const Folder folder;
  const fs::path path = folder.path / "out.ply";
  AtomicFile file(path);
  CHECK(file.aside().extension() == ".ply");
  CHECK(file.aside().parent_path() == fs::canonical(folder.path));
  SECTION("into the file") {
    std::ofstream(file.aside()) << "ply";
    file.adopt();
    CHECK(content_of(file.aside()) == "ply");
    file.commit();
    CHECK(content_of(path) == "ply");
  }
  SECTION("as a new file") {
    fs::remove(file.aside());
    scribble(file.aside(), "new");
    file.adopt();
    file.commit();
    CHECK(content_of(path) == "new");
  }
  SECTION("not at all") {
    fs::remove(file.aside());
    CHECK_THROWS_AS(file.adopt(), Error);
    CHECK_FALSE(fs::exists(path));
  }
  SECTION("and somebody cuts the file short before the end") {
    std::ofstream(file.aside()) << "something";
    file.adopt();
    fs::resize_file(file.aside(), 3);
    CHECK_THROWS_AS(file.commit(), Error);
    CHECK_FALSE(fs::exists(path));
  }
}

TEST_CASE("files: what the disk gives back is compared with what was written") {
  const Folder folder;
  const fs::path path = folder.path / "out.txt";
  AtomicFile file(path);
  file.write(std::string(2000000, 'a'));  // beyond the buffer, so that it is on the disk already
  {
    std::fstream disk(file.aside(), std::ios::in | std::ios::out | std::ios::binary);
    disk.seekp(1000);
    disk.put('b');
  }
  CHECK_THROWS_AS(file.commit(), Error);
  CHECK_FALSE(fs::exists(path));
}
