// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The parent's side of a stage in a process of its own.
#include "run/isolate.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>

#include "files/descriptor.hpp"
#include "plugins/search.hpp"
#include "run/isolate_protocol.hpp"
#include "run/node_error.hpp"
#include "run/record.hpp"
#include "run/setting_json.hpp"
#include "run/usage.hpp"
#include "values/flat.hpp"

namespace velum::run {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// How often time, memory and interruption are looked at.
constexpr int kLookMs = 20;
/// What an interrupted child may take before it is killed; less than Executor's patience.
constexpr std::chrono::milliseconds kChildPatience{1000};

struct Ended {
  int status = 0;
  struct rusage usage = {};
};

/// The child process, which never outlives this object.
class Child {
 public:
  explicit Child(const fs::path& scratch) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse(errno);
    messages_ = files::Descriptor(ends[0]);
    const files::Descriptor write(ends[1]);
    start(scratch, write.get());
  }
  ~Child() {
    if (pid_ < 0) return;
    kill(SIGKILL);
    wait(0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// All of the child's process group, in case it has started others.
  void kill(int signal) const { ::kill(-pid_, signal); }
  [[nodiscard]] int messages() const { return messages_.get(); }
  [[nodiscard]] pid_t pid() const { return pid_; }

  std::optional<Ended> wait(int options) {
    Ended ended;
    pid_t got = 0;
    do {
      got = ::wait4(pid_, &ended.status, options, &ended.usage);
    } while (got < 0 && errno == EINTR);
    if (got == 0) return std::nullopt;
    ::kill(-pid_, SIGKILL);
    pid_ = -1;
    return ended;
  }

 private:
  [[noreturn]] static void refuse(int error) {
    throw Error(Fault::stage,
                "the process of the isolated stage cannot be started: " + files::reason(error))
        .at((plugins::library_folder() / "velum" / "velum-node").string());
  }

  void start(const fs::path& scratch, int messages) {
    const std::string program = (plugins::library_folder() / "velum" / "velum-node").string();
    const std::string folder = scratch.string();
    std::array<char*, 3> arguments = {const_cast<char*>(program.c_str()),           // NOLINT
                                      const_cast<char*>(folder.c_str()), nullptr};  // NOLINT
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages, kMessages);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // A group of its own: Ctrl-C at the terminal goes to the parent, which decides.
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int failed =
        ::posix_spawn(&pid_, program.c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
      pid_ = -1;
      refuse(failed);
    }
  }

  files::Descriptor messages_;
  pid_t pid_ = -1;
};

/// Passes on what the child says, line by line.
class Listener {
 public:
  Listener(int from, LocalContext& context) : from_(from), context_(context) {}

  void listen(int milliseconds) {
    pollfd ready = {from_, POLLIN, 0};
    if (::poll(&ready, 1, closed_ ? 0 : milliseconds) <= 0) return;
    std::array<char, 4096> buffer{};
    const ssize_t got = ::read(from_, buffer.data(), buffer.size());
    closed_ = got == 0;
    if (got <= 0) return;
    text_.append(buffer.data(), static_cast<std::size_t>(got));
    for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      take(text_.substr(0, end));
      text_.erase(0, end + 1);
    }
  }
  void listen_to_the_end() {
    // Processes that the child left behind may hold the other end: what is there now is enough.
    for (std::size_t before = 0; !closed_;) {
      before = lines_;
      listen(0);
      if (lines_ == before) return;
    }
  }
  [[nodiscard]] const std::string& last() const { return last_; }

 private:
  void take(const std::string& line) {
    ++lines_;
    const Json json = Json::parse(line, nullptr, false);
    if (json.contains("progress")) return context_.progress(json["progress"].get<double>());
    const bool warning = json.contains("warning");
    if (!warning && !json.contains("info")) return;
    last_ = json[warning ? "warning" : "info"].get<std::string>();
    warning ? context_.warn(last_) : context_.info(last_);
  }

  int from_;
  LocalContext& context_;
  std::string text_;
  std::string last_;
  std::size_t lines_ = 0;
  bool closed_ = false;
};

/// Waits for the child, within its limits.
class Watch {
 public:
  Watch(Child& child, const IsolatedStage& stage, LocalContext& context)
      : child_(child), stage_(stage), context_(context), listener_(child.messages(), context) {}

  Ended run() {
    while (true) {
      listener_.listen(kLookMs);
      peak_ = std::max(peak_, resident_bytes(child_.pid()));
      if (auto ended = child_.wait(WNOHANG)) {
        listener_.listen_to_the_end();
        return *ended;
      }
      check_limits();
      check_interruption();
    }
  }
  [[nodiscard]] std::uint64_t peak() const { return peak_; }
  [[nodiscard]] std::string last_words() const {
    return listener_.last().empty() ? "" : fmt::format("; it last said: {}", listener_.last());
  }

 private:
  void check_limits() const {
    const double seconds = std::chrono::duration<double>(Clock::now() - started_).count();
    if (stage_.limits.seconds && seconds > *stage_.limits.seconds)
      throw CodedError(Fault::stage, kTooLong,
                       fmt::format("the stage took more than its limit of {} s{}",
                                   *stage_.limits.seconds, last_words()),
                       "raise `limits.time` of the node");
    if (stage_.limits.bytes && peak_ > *stage_.limits.bytes)
      throw CodedError(Fault::stage, kTooMuchMemory,
                       fmt::format("the stage took more than its limit of {} MB of memory{}",
                                   *stage_.limits.bytes / 1'000'000, last_words()),
                       "raise `limits.memory` of the node");
  }
  void check_interruption() {
    if (!context_.cancelled()) return;
    if (!interrupted_) {
      interrupted_ = Clock::now();
      child_.kill(SIGTERM);
    }
    if (Clock::now() - *interrupted_ > kChildPatience) throw Cancelled();
  }

  Child& child_;
  const IsolatedStage& stage_;
  LocalContext& context_;
  Listener listener_;
  Clock::time_point started_ = Clock::now();
  std::optional<Clock::time_point> interrupted_;
  std::uint64_t peak_ = 0;
};

void write_call(const IsolatedStage& stage, const plugins::Call& call, LocalContext& context) {
  Results values;
  Json counts = Json::array();
  for (const Wired& wired : call.inputs) {
    counts.push_back(wired.size());
    for (const Value& value : wired) values.emplace_back(value);
  }
  AtomicFile file(stage.scratch / kInputs);
  write_flat(file, values);
  file.commit();
  const Json json = {{"stage", stage.id},
                     {"plugin", stage.plugin.string()},
                     {"threads", context.threads()},
                     {"seed", stage.seed},
                     {"inputs", std::move(counts)},
                     {"settings", to_json(stage.info->parameters, call.settings)}};
  write_file(stage.scratch / kCall, dump(json));
}

[[noreturn]] void crashed(const Ended& ended, const IsolatedStage& stage,
                          const std::string& last_words) {
  std::string how = fmt::format("ended its process with status {}", WEXITSTATUS(ended.status));
  if (WIFSIGNALED(ended.status)) {
    const int signal = WTERMSIG(ended.status);
    const char* name = ::sigabbrev_np(signal);
    const char* meaning = ::sigdescr_np(signal);
    how = fmt::format("crashed with SIG{} ({})", name == nullptr ? "?" : name,
                      meaning == nullptr ? "unknown signal" : meaning);
  }
  throw CodedError(Fault::stage, kCrashed,
                   fmt::format("the stage {}; seed {}{}", how, stage.seed, last_words));
}

Results read_answer(const IsolatedStage& stage, const Json& answer, LocalContext& context) {
  for (const auto& [name, measure] : measures_from_json(answer.at("measures")))
    context.measure(name, measure.value, measure.unit, measure.better);
  if (answer.value("cancelled", false)) throw Cancelled();
  const auto error = answer.find("error");
  if (error == answer.end()) return read_flat(stage.scratch / kOutputs);
  throw Error(static_cast<Fault>(error->at("fault").get<int>()),
              error->at("message").get<std::string>())
      .at(error->at("where").get<std::string>())
      .hint(error->at("hint").get<std::string>());
}

}  // namespace

IsolatedResults run_isolated(const IsolatedStage& stage, const plugins::Call& call,
                             LocalContext& context) {
  write_call(stage, call, context);
  Child child(stage.scratch);
  Watch watch(child, stage, context);
  const Ended ended = watch.run();
  // A child that was interrupted before it could listen for signals ends by the signal.
  if (context.cancelled() && (!WIFEXITED(ended.status) || WEXITSTATUS(ended.status) != 0))
    throw Cancelled();
  if (!WIFEXITED(ended.status) || WEXITSTATUS(ended.status) != 0)
    crashed(ended, stage, watch.last_words());
  IsolatedResults isolated;
  try {
    const Json answer = Json::parse(FileContent(stage.scratch / kAnswer).text());
    isolated.peak_bytes = answer.at("peak_bytes").get<std::uint64_t>();
    isolated.results = read_answer(stage, answer, context);
  } catch (const Json::exception& error) {
    throw Error(Fault::stage,
                fmt::format("the answer of the isolated stage is damaged: {}", error.what()));
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  isolated.cpu_seconds = seconds(ended.usage.ru_utime) + seconds(ended.usage.ru_stime);
  return isolated;
}

}  // namespace velum::run
