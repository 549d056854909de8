// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <functional>
#include <thread>
#include <vector>

#include "formats/test_tools.hpp"
#include "velum/files.hpp"

/// What goes wrong with disks, for tests of stages that write.
namespace velum::formats::test {

using Writer = std::function<void(const std::filesystem::path&)>;

/// How a child process that calls `body` ended: its exit status, or minus the signal that ended it.
/// The body exits with 0 when it returns, 6 (Fault::output) or another Fault, 99 for anything else.
inline int status_of_child(const std::function<void()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      body();
    } catch (const Error& error) {
      ::_exit(static_cast<int>(error.fault()));
    } catch (...) {
      ::_exit(99);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

inline std::size_t files_in(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

/// A disk that is full, played by a limit on the size of files.
inline void full_disk(const Writer& write, std::vector<std::string>& faults) {
  const Folder folder;
  const int status = status_of_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    write(folder / "out.dat");
  });
  if (status != static_cast<int>(Fault::output))
    faults.push_back("full disk: ended with " + std::to_string(status) + ", expected 6");
  if (files_in(folder / "") != 0) faults.push_back("full disk: a file was left behind");
}

/// A folder that nobody may write to; root may everywhere, so it becomes another user.
inline void read_only(const Writer& write, std::vector<std::string>& faults) {
  const Folder folder;
  std::filesystem::permissions(folder / "", std::filesystem::perms(0555));
  const int status = status_of_child([&] {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) ::_exit(98);
    write(folder / "out.dat");
  });
  std::filesystem::permissions(folder / "", std::filesystem::perms(0755));
  if (status != static_cast<int>(Fault::output))
    faults.push_back("read-only folder: ended with " + std::to_string(status) + ", expected 6");
}

/// Writers that are killed at several moments leave the earlier file as it was, or the new one.
inline void killed(const Writer& write, std::vector<std::string>& faults) {
  const Folder folder;
  write(folder / "out.dat");
  const std::string whole(FileContent(folder / "out.dat").text());
  write_file(folder / "out.dat", "earlier");
  for (int moment = 0; moment < 8; ++moment) {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        write(folder / "out.dat");
      } catch (...) {
      }
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(moment * 2));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const FileContent now(folder / "out.dat");
    if (now.text() != whole && now.text() != "earlier")
      faults.push_back("killed: " + std::to_string(now.size()) + " bytes were left");
  }
}

/// Lets `write` fail in every way; returns what was broken. Writers must run on one thread in a
/// child process, which has no others.
inline std::vector<std::string> writer_faults(const Writer& write) {
  std::vector<std::string> faults;
  full_disk(write, faults);
  read_only(write, faults);
  killed(write, faults);
  return faults;
}

}  // namespace velum::formats::test
