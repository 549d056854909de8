// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "console.hpp"
#include "reporters.hpp"
#include "run/summary.hpp"

namespace velum::app {
namespace {

constexpr int kBar = 24;
constexpr std::size_t kWide = 72;

std::string plural(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string in_words(const run::NodeRecord& node) {
  std::string text;
  for (const auto& [name, summary] : node.out.items()) {
    if (summary.is_null()) continue;
    text += (text.empty() ? "" : "; ") + run::in_words(summary);
  }
  return text;
}

std::string number(double value) {
  constexpr double kExact = 1e15;
  const bool whole = std::abs(value) < kExact && value == std::floor(value);
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

// Lines of at most kWide characters.
std::vector<std::string> in_words(const run::Measures& measures) {
  std::vector<std::string> lines;
  for (const auto& [name, measure] : measures) {
    const std::string word = fmt::format("{} {}{}{}", name, number(measure.value),
                                         measure.unit.empty() ? "" : " ", measure.unit);
    if (lines.empty() || lines.back().size() + word.size() > kWide)
      lines.push_back(word);
    else
      lines.back() += ", " + word;
  }
  return lines;
}

class TextReporter final : public Reporter {
 public:
  TextReporter(bool on_terminal, bool cached) : on_terminal_(on_terminal), cached_(cached) {}

  void refused(const graph::Diagnostics& diagnostics) override {
    complain(graph::format(diagnostics));
  }
  void refused(const Error& error) override { complain(format(error)); }

  void run_started(const run::RunRecord& record, const std::filesystem::path& out) override {
    out_ = out.string();
    for (const auto& node : record.nodes) width_ = std::max(width_, node.name.size());
    const std::string& title = record.graph_title.empty() ? record.graph_path : record.graph_title;
    line(fmt::format("{}: {}, {}, seed {}", title, plural(record.nodes.size(), "node"),
                     plural(static_cast<std::size_t>(record.threads), "thread"), record.seed));
  }
  void said(const std::string& node, run::LocalContext::Level level,
            const std::string& message) override {
    const bool warning = level == run::LocalContext::Level::warning;
    line(fmt::format("  {:<7} {:<{}}  {}", warning ? "warning" : "info", node, width_, message));
  }
  void node_ended(const run::NodeRecord& node) override {
    const std::string words = in_words(node);
    line(fmt::format("  {:<7} {:<{}} {:9.3f} s{}{}", run::name_of(node.status), node.name, width_,
                     node.seconds, words.empty() ? "" : "  ", words));
    for (const std::string& measures : in_words(node.measures))
      line(fmt::format("  {:<7} {:<{}}  {}", "", "", width_, measures));
    if (!node.failure) return;
    erase_bars();
    complain(run::format(*node.failure));
  }
  void tick(const std::vector<run::Running>& running) override {
    if (!on_terminal_) return;
    std::string bars;
    for (const run::Running& each : running) bars += bar(each);
    erase_bars();
    print(bars);
    bars_ = running.size();
  }
  void report_written(const std::filesystem::path& file) override {
    line("report: " + file.string());
  }
  void run_ended(const run::RunResult& result) override {
    const run::RunRecord& record = result.record;
    const std::string kept = plural(record.files.size(), "file");
    if (record.status == run::Status::interrupted) {
      line(fmt::format("interrupted after {:.2f} s; kept: {} and the record in {}{}",
                       record.seconds, kept, out_,
                       cached_ ? "; results of finished nodes are in the cache, a new run goes on "
                                 "from them"
                               : ""));
    } else if (record.status == run::Status::failed) {
      line(fmt::format("failed after {:.2f} s; kept: {} and the record in {}", record.seconds, kept,
                       out_));
    } else {
      line(fmt::format("done in {:.2f} s; {} and the record in {}", record.seconds, kept, out_));
    }
  }

 private:
  // The bars stand below the lines, and are drawn anew after each.
  void line(const std::string& text) {
    erase_bars();
    print(text + "\n");
  }
  void erase_bars() {
    if (bars_ > 0) print(fmt::format("\x1b[{}A\x1b[J", bars_));
    bars_ = 0;
  }
  [[nodiscard]] std::string bar(const run::Running& running) const {
    const int full = static_cast<int>(std::lround(running.fraction * kBar));
    const std::string done =
        running.fraction > 0.0 ? fmt::format("{:3.0f} %", 100.0 * running.fraction) : "     ";
    return fmt::format("  running {:<{}} {:9.1f} s  [{:#<{}}{:.<{}}] {}\n", running.node, width_,
                       running.seconds, "", full, "", kBar - full, done);
  }

  bool on_terminal_;
  bool cached_;
  std::string out_;
  std::size_t width_ = 0;
  std::size_t bars_ = 0;
};

}  // namespace

std::unique_ptr<Reporter> make_text_reporter(bool on_terminal, bool cached) {
  return std::make_unique<TextReporter>(on_terminal, cached);
}

}  // namespace velum::app
