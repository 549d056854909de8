// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "graph/settings.hpp"
#include "plugins/call.hpp"
#include "run/local_context.hpp"
#include "testing/bench.hpp"
#include "testing/sound.hpp"
#include "testing/specimens.hpp"
#include "velum/testing.hpp"

namespace velum::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

#if defined(VELUM_SANITIZED)
constexpr double kSlowness = 10.0;
#else
constexpr double kSlowness = 1.0;
#endif
/// A stage that is done with a few hundred points takes no longer.
constexpr double kLongestSeconds = 30.0 * kSlowness;
/// An interrupted stage leaves within this time.
constexpr double kLongestCancelSeconds = 2.0 * kSlowness;

/// How one run ended: with results, in order, with an error of the kernel's own type, or cancelled.
/// Anything else is a fault.
struct Ending {
  std::string fault;
  Results results;
  std::string error;
  bool cancelled = false;
  double seconds = 0.0;
};

struct Manner {
  int threads = 2;
  bool cancel = false;
  /// Files of runs that take place at once must not meet.
  std::string folder = "0";
};

/// The same results, or the same error?
std::string signature(const Ending& ending) {
  if (!ending.error.empty()) return "error: " + ending.error;
  std::string all;
  for (const auto& result : ending.results) all += (result ? hash_of(*result) : "-") + " ";
  return all;
}

class Suite {
 public:
  Suite(const std::string& id, const std::map<std::string, std::string>& settings)
      : stage_(registry().stage(id)), info_(stage_.info()) {
    for (const auto& [name, text] : settings) {
      const auto at = std::find_if(info_.parameters.begin(), info_.parameters.end(),
                                   [&, &key = name](const Parameter& p) { return p.name == key; });
      if (at == info_.parameters.end())
        throw Error(Fault::graph, fmt::format("{} has no parameter '{}'", id, name));
      settings_[name] = graph::parse_setting_text(*at, text);
    }
    (void)settings_of(info_, settings_, scratch_folder());  // all that are required are there
  }

  std::vector<std::string> run() {
    const std::vector<Wired> usual = inputs(sheet(), sheet(), 0, false);
    const Ending first = attempt("on a curved sheet", usual);
    attempt("on a curved sheet with no more columns than needed",
            inputs(sheet(), sheet(), 0, true));
    if (!info_.inputs.empty()) degenerate();
    cancelled(usual);
    repeated(usual, first);
    return std::move(faults_);
  }

 private:
  /// One value a required input (two for `many`): of `odd` at input `place`, of `even` elsewhere.
  /// Optional inputs stay unwired.
  std::vector<Wired> inputs(const Specimen& odd, const Specimen& even, std::size_t place,
                            bool spare) {
    std::vector<Wired> wired;
    for (std::size_t i = 0; i < info_.inputs.size(); ++i) {
      const Port& port = info_.inputs[i];
      wired.emplace_back();
      if (!port.required) continue;
      const Specimen& specimen = i == place ? odd : even;
      const Value value = fit_to(port, make_value(port.types.front(), specimen), spare);
      wired.back().assign(port.many ? 2 : 1, value);
    }
    return wired;
  }

  /// Every input in turn is the odd one, and then all are.
  void degenerate() {
    const Specimen usual = sheet();
    const auto required = static_cast<std::size_t>(std::count_if(
        info_.inputs.begin(), info_.inputs.end(), [](const Port& p) { return p.required; }));
    for (const Specimen& odd : degenerate_specimens()) {
      for (std::size_t i = 0; i < info_.inputs.size() && required > 1; ++i)
        if (info_.inputs[i].required)
          attempt(fmt::format("with {} at input '{}'", odd.name, info_.inputs[i].name),
                  inputs(odd, usual, i, false));
      attempt("with " + odd.name, inputs(odd, odd, 0, false));
    }
    other_types(usual);
  }

  /// Inputs that take several types: each of them once.
  void other_types(const Specimen& usual) {
    for (std::size_t i = 0; i < info_.inputs.size(); ++i) {
      const Port& port = info_.inputs[i];
      for (const ValueType type : port.types) {
        if (port.required && type == port.types.front()) continue;
        auto wired = inputs(usual, usual, 0, false);
        wired[i] = {fit_to(port, make_value(type, usual), false)};
        attempt(fmt::format("with a {} at input '{}'", name_of(type), port.name), wired);
      }
    }
  }

  void cancelled(const std::vector<Wired>& usual) {
    Manner manner;
    manner.cancel = true;
    const Ending ending = attempt("cancelled at once", usual, manner);
    if (ending.seconds > kLongestCancelSeconds)
      fault("cancelled at once", fmt::format("went on for {:.1f} s", ending.seconds));
  }

  void repeated(const std::vector<Wired>& usual, const Ending& first) {
    compare("run a second time", first, attempt("run a second time", usual));
    Manner manner;
    manner.threads = 1;
    compare("with 1 thread instead of 2", first, attempt("with 1 thread", usual, manner));

    std::vector<Ending> both(2);
    std::thread other(
        [&] { both[1] = run_once(usual, {.threads = 1, .cancel = false, .folder = "1"}); });
    both[0] = run_once(usual, {.threads = 1, .cancel = false, .folder = "0"});
    other.join();
    for (const Ending& ending : both) {
      if (!ending.fault.empty()) fault("with two instances at once", ending.fault);
      compare("with two instances at once", first, ending);
    }
  }

  void compare(const std::string& when, const Ending& first, const Ending& second) {
    const bool promised =
        info_.determinism == Determinism::bitwise || info_.determinism == Determinism::seeded;
    if (promised && first.fault.empty() && second.fault.empty() && !second.cancelled &&
        signature(first) != signature(second))
      fault(when, "the results are not the same: " + signature(first) + "and " + signature(second));
  }

  Ending attempt(const std::string& when, const std::vector<Wired>& wired,
                 const Manner& manner = {}) {
    Ending ending = run_once(wired, manner);
    if (!ending.fault.empty()) fault(when, ending.fault);
    if (ending.cancelled && !manner.cancel) fault(when, "says that it was cancelled, it was not");
    if (ending.seconds > kLongestSeconds)
      fault(when, fmt::format("takes {:.1f} s for a few hundred points", ending.seconds));
    return ending;
  }

  Ending run_once(const std::vector<Wired>& wired, const Manner& manner) {
    Ending ending;
    const auto begin = Clock::now();
    try {
      const fs::path folder = scratch_folder() / "conformance" / manner.folder;
      fs::create_directories(folder);
      const auto call = plugins::prepare(info_, settings_of(info_, settings_, folder), wired);
      run::LocalContext context(manner.threads, run::node_seed(1, info_.id, "conformance"));
      if (manner.cancel) context.cancel();
      ending.results = stage_.run(call.settings, call.inputs, context);
      ending.fault = unsound_outcome(ending.results, call, context);
    } catch (const Error& error) {
      ending.error = error.what();
      if (error.fault() == Fault::plugin)
        ending.fault = "an Error of Fault::plugin: " + ending.error;
      if (ending.error.empty()) ending.fault = "an Error without a message";
    } catch (const Cancelled&) {
      ending.cancelled = true;
    } catch (const std::exception& error) {
      ending.fault = std::string("throws what is not a velum::Error: ") + error.what();
    } catch (...) {
      ending.fault = "throws what is not a velum::Error";
    }
    ending.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return ending;
  }

  std::string unsound_outcome(const Results& results, const plugins::Call& call,
                              const run::LocalContext& context) {
    for (std::size_t i = 0; i < results.size() && i < info_.outputs.size(); ++i) {
      if (!results[i]) continue;
      const std::string name = info_.outputs[i].name;
      const std::string what = unsound(*results[i]);
      if (!what.empty() && !inherited(call)) return fmt::format("output '{}' has {}", name, what);
      const std::string column = missing_column(info_.outputs[i], *results[i], call);
      if (!column.empty()) return fmt::format("output '{}' lacks the column '{}'", name, column);
    }
    for (const auto& [name, measure] : context.measures())
      if (!std::isfinite(measure.value)) return fmt::format("measure '{}' is not finite", name);
    return plugins::mismatch(info_, results);
  }

  /// Columns that were not sound when they came in may leave as they came.
  static bool inherited(const plugins::Call& call) {
    return std::any_of(call.inputs.begin(), call.inputs.end(), [](const Wired& wired) {
      return std::any_of(wired.begin(), wired.end(),
                         [](const Value& value) { return !unsound(value).empty(); });
    });
  }

  std::string missing_column(const Port& port, const Value& value, const plugins::Call& call) {
    const Cloud* points = plugins::points_of(value);
    if (points == nullptr || points->empty()) return "";
    for (const ColumnRule& rule : port.columns)
      if (plugins::applies(rule, info_, call.settings) && !points->has(rule.column))
        return rule.column;
    return "";
  }

  void fault(const std::string& when, const std::string& what) {
    faults_.push_back(fmt::format("{} {}: {}", info_.id, when, what));
  }

  const StageType& stage_;
  const StageInfo& info_;
  std::map<std::string, Setting> settings_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> conformance(const std::string& id,
                                     const std::map<std::string, std::string>& settings) {
  try {
    return Suite(id, settings).run();
  } catch (const Error& error) {
    return {plugins::one_line(error)};
  }
}

}  // namespace velum::test
