// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <span>
#include <utility>
#include <vector>

#include "run/usage.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

/// The process and what descends from it.
std::vector<pid_t> family(pid_t process) {
  std::vector<pid_t> all = {process};
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::error_code gone;
    const fs::path tasks = fmt::format("/proc/{}/task", all[i]);
    for (auto task = fs::directory_iterator(tasks, gone); task != fs::directory_iterator();
         task.increment(gone)) {
      std::ifstream children(task->path() / "children");
      for (pid_t child = 0; children >> child;) all.push_back(child);
      if (gone) break;
    }
  }
  return all;
}

[[noreturn]] void work_as_child(const std::function<Outcome()>& work, pid_t parent, int answer,
                                int log) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  // A group of its own: Ctrl-C at the terminal goes to the parent, which decides.
  ::setpgid(0, 0);
  const rlimit none = {0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  try {
    const std::string text = run::dump(to_json(work()));
    files::write_fully(answer, std::as_bytes(std::span(text)));
  } catch (...) {  // interrupted, or out of memory: no answer is one too
    ::_exit(1);
  }
  // Neither destructors of libraries nor leak checks.
  ::_exit(0);
}

[[noreturn]] void refuse(const std::string& what, const fs::path& where) {
  throw Error(Fault::output, what + ": " + files::reason(errno)).at(where.string());
}

}  // namespace

Process::Process(const std::function<Outcome()>& work, const fs::path& log) {
  std::error_code failed;
  fs::create_directories(log.parent_path(), failed);
  const files::Descriptor out(
      ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666));
  if (!out) refuse("cannot be written", log);
  answer_ = files::Descriptor(::memfd_create("velum-cell", MFD_CLOEXEC));
  if (!answer_) refuse("no memory for a cell's answer", log);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) refuse("a cell's process cannot be started", log);
  if (pid_ == 0) work_as_child(work, parent, answer_.get(), out.get());
  // Debian 12's <sys/pidfd.h> is for C only.
  ended_ = files::Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
  if (!ended_) {
    kill();
    refuse("a cell's process cannot be followed", log);
  }
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      answer_(std::move(other.answer_)),
      ended_(std::move(other.ended_)),
      started_(other.started_) {}

Process::~Process() {
  if (pid_ < 0) return;
  kill();
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
}

Outcome Process::outcome() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  std::string text(static_cast<std::size_t>(::lseek(answer_.get(), 0, SEEK_END)), '\0');
  const ssize_t got = ::pread(answer_.get(), text.data(), text.size(), 0);
  if (WIFEXITED(status) && got == static_cast<ssize_t>(text.size()) && !text.empty()) {
    try {
      return outcome_from_json(run::Json::parse(text));
    } catch (const std::exception&) {  // half an answer: below
    }
  }
  Outcome outcome;
  outcome.status = Status::crashed;
  outcome.seconds = seconds();
  if (WIFSIGNALED(status)) {
    const char* name = ::sigabbrev_np(WTERMSIG(status));
    outcome.message = fmt::format("the process died of SIG{}", name == nullptr ? "?" : name);
  } else {
    outcome.message = fmt::format("the process left with status {}", WEXITSTATUS(status));
  }
  return outcome;
}

void Process::interrupt() const {
  ::kill(pid_, SIGTERM);
}

void Process::kill() const {
  for (const pid_t process : family(pid_)) ::kill(process, SIGKILL);
}

double Process::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

std::uint64_t Process::resident() const {
  std::uint64_t bytes = 0;
  for (const pid_t process : family(pid_)) bytes += run::resident_bytes(process);
  return bytes;
}

}  // namespace velum::study
