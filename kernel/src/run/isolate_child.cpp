// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The child's side of a stage in a process of its own.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <mutex>
#include <system_error>

#include "files/descriptor.hpp"
#include "plugins/call.hpp"
#include "plugins/library.hpp"
#include "run/isolate.hpp"
#include "run/isolate_protocol.hpp"
#include "run/record.hpp"
#include "run/setting_json.hpp"
#include "run/signals.hpp"
#include "run/threads.hpp"
#include "run/usage.hpp"
#include "values/flat.hpp"

namespace velum::run {
namespace {

namespace fs = std::filesystem;

void say(const Json& json) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const std::string line = dump(json) + "\n";
  try {
    files::write_fully(kMessages, std::as_bytes(std::span(line)));
  } catch (const std::system_error&) {  // the parent is gone; so will this process be
  }
}

/// Tells the parent how far the stage is, in steps of a percent.
class ChildContext final : public LocalContext {
 public:
  using LocalContext::LocalContext;
  void progress(double done) override {
    const int before = static_cast<int>(fraction() * 100);
    LocalContext::progress(done);
    if (static_cast<int>(fraction() * 100) > before) say({{"progress", fraction()}});
  }
};

std::vector<Wired> read_inputs(const fs::path& scratch, const Json& counts) {
  Results values = read_flat(scratch / kInputs);
  std::vector<Wired> inputs;
  std::size_t next = 0;
  for (const Json& count : counts) {
    Wired& wired = inputs.emplace_back();
    for (std::size_t i = 0; i < count.get<std::size_t>(); ++i)
      wired.push_back(std::move(values.at(next++)).value());
  }
  return inputs;
}

Results run_stage(const fs::path& scratch, const Json& json, Context& context) {
  const StageType& stage = plugins::open_stage(json.at("plugin").get<std::string>());
  find_openmp();
  limit_openmp(context.threads());
  const plugins::Call call{from_json(stage.info().parameters, json.at("settings")),
                           read_inputs(scratch, json.at("inputs"))};
  return plugins::invoke(stage, call, context);
}

// No core file, and no end later than that of the parent.
void make_plain() {
  const rlimit none = {0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

Json answer_to(const fs::path& scratch, const Json& call, ChildContext& context) {
  Json answer = Json::object();
  try {
    const Results results = run_stage(scratch, call, context);
    AtomicFile file(scratch / kOutputs);
    write_flat(file, results);
    file.commit();
  } catch (const Cancelled&) {
    answer["cancelled"] = true;
  } catch (const Error& error) {
    answer["error"] = {{"fault", static_cast<int>(error.fault())},
                       {"message", error.what()},
                       {"where", error.where()},
                       {"hint", error.hint()}};
  }
  answer["measures"] = to_json(context.measures());
  answer["peak_bytes"] = PeakMeter().whole();
  return answer;
}

}  // namespace

int isolated_main(const fs::path& scratch) {
  make_plain();
  catch_signals();
  ::fcntl(kMessages, F_SETFD, FD_CLOEXEC);
  const Json call = Json::parse(FileContent(scratch / kCall).text());
  const int threads = call.at("threads").get<int>();
  limit_threads(threads);
  ChildContext context(
      {.threads = threads,
       .arena = threads,
       .seed = call.at("seed").get<std::uint64_t>(),
       .cancel = &stop_requested(),
       .log = [](LocalContext::Level level, const std::string& message) {
         say({{level == LocalContext::Level::warning ? "warning" : "info", message}});
       }});
  write_file(scratch / kAnswer, dump(answer_to(scratch, call, context)));
  // What the stage or its libraries do when they are taken down is of no more interest.
  ::_exit(0);
}

}  // namespace velum::run
