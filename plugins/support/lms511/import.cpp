// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/import.hpp"

#include "lms511/vrec.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::lms511 {
namespace {

constexpr std::size_t kPiece = 65536;

void add(ImportCounts& to, const ImportCounts& more) {
  to.format = more.format;
  to.skipped_bytes += more.skipped_bytes;
  to.bad_checksums += more.bad_checksums;
  to.lost_bytes += more.lost_bytes;
  to.damaged_bytes += more.damaged_bytes;
  to.missing_blocks += more.missing_blocks;
  to.ended = more.ended;
}

// The recording's start, which all its parts repeat; empty where there is none.
std::string start_of(std::span<const std::byte> bytes, const std::string& name) {
  VrecReader reader(bytes, name);
  Record record;
  const bool found = reader.next(record) && record.event == Event::start;
  return found ? std::string(record.bytes) : "";
}

}  // namespace

ImportCounts read_telegrams(std::span<const std::byte> bytes, const std::string& name,
                            const RecordSink& sink) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());  // NOLINT
  Framer framer;
  while (!rest.empty()) {
    framer.feed(rest.substr(0, kPiece));
    rest.remove_prefix(std::min(rest.size(), kPiece));
    while (const auto telegram = framer.next()) sink(record_of(*telegram, kNoTime));
  }
  if (framer.counts().telegrams == 0)
    throw Error(Fault::input, "the file holds no telegram of an LMS 511")
        .at(name)
        .hint("read are .vrec, pcap and pcapng, and telegrams with their marks, back to back");
  return {.format = "telegrams",
          .skipped_bytes = framer.counts().skipped_bytes + framer.pending(),
          .bad_checksums = framer.counts().bad_checksums};
}

ImportCounts read_vrec(std::span<const std::byte> bytes, const std::string& name,
                       const RecordSink& sink) {
  VrecReader reader(bytes, name);
  ImportCounts counts;
  counts.format = "vrec";
  counts.ended = false;
  Record record;
  while (reader.next(record)) {
    if (record.event == Event::end) counts.ended = true;
    sink(record);
  }
  counts.damaged_bytes = reader.damaged_bytes();
  counts.missing_blocks = reader.missing_blocks();
  return counts;
}

ImportCounts read_records(const std::filesystem::path& path, const RecordSink& sink,
                          const Context& context) {
  const RecordSink checked = [&, n = 0](const Record& record) mutable {
    if (++n % 256 == 0) context.check();
    sink(record);
  };
  const FileContent content(path);
  if (is_capture(content.bytes())) return read_capture(content.bytes(), path.string(), checked);
  if (!is_vrec(content.bytes())) return read_telegrams(content.bytes(), path.string(), checked);
  ImportCounts counts = read_vrec(content.bytes(), path.string(), checked);
  const std::string start = start_of(content.bytes(), path.string());
  const auto parts = parts_of(path);
  for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
    const FileContent more(*part);
    // A part with another start was left by a longer recording of the same name.
    if (!is_vrec(more.bytes()) || start_of(more.bytes(), part->string()) != start) break;
    bool repeated = true;
    add(counts, read_vrec(more.bytes(), part->string(), [&](const Record& record) {
          if (!repeated) checked(record);
          if (record.event == Event::part) repeated = false;
        }));
  }
  return counts;
}

}  // namespace velum::lms511
