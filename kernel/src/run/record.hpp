// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/json.hpp"
#include "run/local_context.hpp"
#include "velum/error.hpp"

/// What is known of a run, and its form on disk: run.json (docs/record.md).
namespace velum::run {

enum class Status : std::uint8_t { ok, cached, failed, skipped, interrupted };
std::string_view name_of(Status status);
std::string_view name_of(Better better);

/// Why a node failed.
struct Failure {
  Fault fault = Fault::stage;
  std::string code;  ///< "E1001"; docs/errors.md explains each
  std::string node;
  std::string stage;
  std::string message;
  std::string where;
  std::string hint;
};
/// An error as that of a node; the code follows from the fault.
Failure failure_of(const Error& error, const std::string& node, const std::string& stage);
/// In the form in which the command shows it, with a line break at its end.
std::string format(const Failure& failure);

struct NodeRecord {
  std::string name;
  std::string use;
  std::string version;
  std::string plugin_hash;
  Status status = Status::skipped;
  double seconds = 0.0;
  /// Unknown where nodes overlapped in one process.
  std::optional<double> cpu_seconds;
  std::optional<std::uint64_t> peak_bytes;
  Json parameters = Json::object();
  Json in = Json::object();
  Json out = Json::object();
  Measures measures;
  std::vector<std::string> warnings;
  std::optional<Failure> failure;
};

struct FileRecord {
  std::string path;  ///< relative to the output folder where it lies in it
  std::string node;  ///< empty for inputs
  std::uint64_t bytes = 0;
  std::string hash;
};
/// Reads the file once. Throws Error (Fault::input) when it cannot be read.
FileRecord describe_file(const std::filesystem::path& path);

struct RunRecord {
  std::string graph_path;
  std::string graph_title;
  std::string graph_resolved;
  Status status = Status::ok;  ///< ok, failed or interrupted
  std::string started;         ///< UTC, ISO 8601
  double seconds = 0.0;
  double cpu_seconds = 0.0;
  std::uint64_t peak_bytes = 0;
  int threads = 1;
  std::uint64_t seed = 1;
  std::vector<NodeRecord> nodes;
  std::vector<FileRecord> files;
  std::vector<FileRecord> inputs;
  std::optional<Failure> failure;  ///< the first one
};

Json to_json(const Failure& failure);
Json to_json(const Measures& measures);
Measures measures_from_json(const Json& json);
Json to_json(const NodeRecord& node);
Json to_json(const FileRecord& file);
Json to_json(const RunRecord& record);

}  // namespace velum::run
