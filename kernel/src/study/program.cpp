// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <span>

#include "files/descriptor.hpp"
#include "velum/error.hpp"

namespace velum::study {
namespace {

/// Memory that takes what a program prints: unlike a pipe it is never full.
files::Descriptor catcher() {
  files::Descriptor file(::memfd_create("velum-said", MFD_CLOEXEC));
  if (!file)
    throw Error(Fault::output, "no memory for what a program says: " + files::reason(errno));
  return file;
}

std::string caught(const files::Descriptor& file) {
  std::string text(static_cast<std::size_t>(::lseek(file.get(), 0, SEEK_END)), '\0');
  ::lseek(file.get(), 0, SEEK_SET);
  text.resize(files::read_fully(file.get(), std::as_writable_bytes(std::span(text))));
  return text;
}

pid_t start(const std::vector<std::string>& words, int out, int error) {
  std::vector<char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));  // NOLINT: execve's interface
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t process = -1;
  const int failed =
      ::posix_spawnp(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw Error(Fault::graph,
                fmt::format("'{}' cannot be started: {}", words.front(), files::reason(failed)));
  return process;
}

}  // namespace

Said run_program(const std::vector<std::string>& words) {
  const files::Descriptor out = catcher();
  const files::Descriptor error = catcher();
  const pid_t process = start(words, out.get(), error.get());
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), caught(out),
          caught(error)};
}

}  // namespace velum::study
