// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <map>

#include "console.hpp"
#include "graph/place.hpp"
#include "reporters.hpp"

namespace velum::app {
namespace {

using run::Json;

class JsonReporter final : public Reporter {
 public:
  void refused(const graph::Diagnostics& diagnostics) override {
    for (const graph::Diagnostic& each : diagnostics)
      emit("error", {{"code", each.code},
                     {"message", each.message},
                     {"where", graph::place_of(each)},
                     {"hint", each.hint}});
    emit("end", {{"status", "failed"}, {"exit", graph::exit_status(diagnostics)}});
    complain(graph::format(diagnostics));
  }
  void refused(const Error& error) override {
    emit("error", {{"message", error.what()}, {"where", error.where()}, {"hint", error.hint()}});
    emit("end", {{"status", "failed"}, {"exit", static_cast<int>(error.fault())}});
    complain(format(error));
  }
  void run_started(const run::RunRecord& record, const std::filesystem::path& out) override {
    Json nodes = Json::array();
    for (const auto& node : record.nodes) nodes.push_back({{"name", node.name}, {"use", node.use}});
    emit("start", {{"graph", record.graph_path},
                   {"title", record.graph_title},
                   {"out", out.string()},
                   {"threads", record.threads},
                   {"seed", record.seed},
                   {"nodes", std::move(nodes)}});
  }
  void node_started(const std::string& node, const std::string& stage) override {
    emit("node_start", {{"node", node}, {"use", stage}});
  }
  void said(const std::string& node, run::LocalContext::Level level,
            const std::string& message) override {
    const bool warning = level == run::LocalContext::Level::warning;
    emit(warning ? "warn" : "info", {{"node", node}, {"message", message}});
  }
  void tick(const std::vector<run::Running>& running) override {
    for (const run::Running& each : running) {
      double& last = told_[each.node];
      if (each.fraction <= last) continue;
      last = each.fraction;
      emit("progress",
           {{"node", each.node}, {"fraction", each.fraction}, {"seconds", each.seconds}});
    }
  }
  void node_ended(const run::NodeRecord& node) override {
    emit("node_end", {{"node", node.name},
                      {"status", run::name_of(node.status)},
                      {"seconds", node.seconds},
                      {"out", node.out},
                      {"measures", run::to_json(node.measures)}});
    if (!node.failure) return;
    emit("error", run::to_json(*node.failure));
    complain(run::format(*node.failure));
  }
  void file_written(const run::FileRecord& file) override { emit("file", run::to_json(file)); }
  void report_written(const std::filesystem::path& file) override {
    emit("report", {{"path", file.string()}});
  }
  void run_ended(const run::RunResult& result) override {
    emit("end", {{"status", run::name_of(result.record.status)},
                 {"exit", run::exit_status(result.record)},
                 {"seconds", result.record.seconds},
                 {"record", result.record_file.string()}});
  }

 private:
  static void emit(const char* event, const Json& content) {
    Json line = {{"event", event}};
    line.update(content);
    print(run::dump(line) + "\n");
  }

  std::map<std::string, double> told_;
};

}  // namespace

std::unique_ptr<Reporter> make_json_reporter() {
  return std::make_unique<JsonReporter>();
}

}  // namespace velum::app
