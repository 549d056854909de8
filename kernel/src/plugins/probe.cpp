// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/probe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "plugins/search.hpp"
#include "velum/error.hpp"

namespace velum::plugins {
namespace {

using Clock = std::chrono::steady_clock;
/// Where the child writes its answer; its standard output belongs to whatever the plugin prints.
constexpr int kAnswer = 3;
/// How many times its limit a child is given that the machine does not serve.
constexpr int kPatience = 12;

struct Pipe {
  int read = -1;
  int write = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw Error(Fault::plugin,
                  std::string("no pipe for the plugin probe: ") + std::strerror(errno));
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    ::close(read);
    close_write();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_write() {
    if (write >= 0) ::close(write);
    write = -1;
  }
};

/// Starts velum-probe in a process group of its own, so that all that it starts can be ended.
pid_t start_child(const std::filesystem::path& file, int answer) {
  const std::string program = (library_folder() / "velum" / "velum-probe").string();
  const std::string name = file.string();
  std::array<char*, 3> arguments = {const_cast<char*>(program.c_str()),         // NOLINT
                                    const_cast<char*>(name.c_str()), nullptr};  // NOLINT
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, answer, kAnswer);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t child = -1;
  const int failed =
      ::posix_spawn(&child, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    throw Error(Fault::plugin,
                fmt::format("the plugin probe cannot be started: {}", std::strerror(failed)))
        .at(program)
        .hint("install Velum again, or build all of it");
  }
  return child;
}

/// The line that comes until the other end is closed or the time is up (then false).
bool read_answer(int from, Clock::time_point deadline, std::string& answer) {
  std::array<char, 4096> buffer{};
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready = {from, POLLIN, 0};
    const int events = ::poll(&ready, 1, static_cast<int>(left));
    if (events < 0 && errno != EINTR) return false;
    if (events <= 0) continue;
    const ssize_t got = ::read(from, buffer.data(), buffer.size());
    if (got == 0) return true;
    if (got > 0) answer.append(buffer.data(), static_cast<std::size_t>(got));
    if (got > 0 && answer.back() == '\n') return true;
    if (got < 0 && errno != EINTR) return false;
  }
}

/// Has the child waited for something, or computed, for as long as it may take? One that is ready
/// to run, stopped or waiting for a disk was only not served.
bool is_hung(pid_t child, std::chrono::milliseconds limit) {
  std::ifstream file(fmt::format("/proc/{}/stat", child));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return true;
  std::istringstream fields(text.substr(name_end + 1));
  char state = '?';
  fields >> state;
  long long field = 0;
  for (int skipped = 0; skipped < 10; ++skipped) fields >> field;  // up to the times, 14 and 15
  long long user = 0;
  long long system = 0;
  fields >> user >> system;
  const long long ticks = ::sysconf(_SC_CLK_TCK);
  return state == 'S' || (user + system) * 1000 / ticks >= limit.count();
}

int end_child(pid_t child, bool finished) {
  // A child that has answered and closed its end leaves at once; any other is made to.
  if (!finished) ::kill(-child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ::kill(-child, SIGKILL);
  return status;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    const char* name = ::sigabbrev_np(signal);
    const char* meaning = ::sigdescr_np(signal);
    return fmt::format("crashes when it is opened: SIG{} ({})", name == nullptr ? "?" : name,
                       meaning == nullptr ? "unknown signal" : meaning);
  }
  return fmt::format("ends the process when it is opened, with status {}", WEXITSTATUS(status));
}

}  // namespace

Probed probe_afresh(const std::filesystem::path& file, std::chrono::milliseconds limit) {
  Pipe pipe;
  const pid_t child = start_child(file, pipe.write);
  pipe.close_write();
  std::string text;
  bool finished = false;
  bool hung = false;
  std::chrono::milliseconds waited{0};
  while (!finished && !hung && waited < kPatience * limit) {
    finished = read_answer(pipe.read, Clock::now() + limit, text);
    waited += limit;
    hung = !finished && is_hung(child, limit);
  }
  const int status = end_child(child, finished);

  Probed probed;
  const auto answer = nlohmann::json::parse(text, nullptr, false);
  if (!finished) {
    probed.quarantined = fmt::format("hangs when it is opened: no answer within {} s",
                                     std::chrono::duration<double>(waited).count());
    probed.uncertain = !hung;
  } else if (!answer.is_object()) {
    probed.quarantined = how_it_ended(status);
  } else if (answer.contains("thrown")) {
    probed.quarantined = "throws in a static constructor: " + answer.value("thrown", "");
  } else {
    probed.refused = answer.value("refused", "");
    probed.summary = answer.value("summary", "");
  }
  return probed;
}

}  // namespace velum::plugins
