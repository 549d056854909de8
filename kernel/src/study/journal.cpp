// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/journal.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <span>
#include <system_error>

#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargest = std::uint64_t{1} << 34U;

std::string checked_line(const run::Json& json) {
  const std::string text = run::dump(json);
  return hash_of(std::as_bytes(std::span(text))) + " " + text + "\n";
}

/// The JSON of a line without its end; nothing when its checksum does not fit.
std::optional<run::Json> parse_line(std::string_view line) {
  const auto blank = line.find(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  const std::string_view text = line.substr(blank + 1);
  if (hash_of(std::as_bytes(std::span(text))) != line.substr(0, blank)) return std::nullopt;
  run::Json json = run::Json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  return json;
}

/// Calls `take(json)` for each line that is not damaged and returns where the last one that has an
/// end ends.
template <class Take>
std::size_t read_lines(std::string_view text, const Take& take) {
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos;
       end = text.find('\n', begin)) {
    if (const auto json = parse_line(text.substr(begin, end - begin))) take(*json);
    begin = end + 1;
  }
  return begin;
}

}  // namespace

std::optional<Journal::Heading> Journal::heading_of(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  const FileContent content(file, kLargest);
  const auto json = parse_line(content.text().substr(0, content.text().find('\n')));
  if (!json || !json->contains("study")) return std::nullopt;
  return Heading{json->at("graph").get<std::string>(), json->at("study").get<std::string>()};
}

std::size_t Journal::read(const fs::path& file, std::size_t from,
                          const std::function<void(const Cell&, Outcome)>& take) {
  std::error_code failed;
  if (fs::file_size(file, failed) <= from || failed) return from;
  const FileContent content(file, kLargest);
  if (content.size() <= from) return from;
  return from + read_lines(content.text().substr(from), [&](const run::Json& json) {
           if (json.contains("cell"))
             take({json.at("cell").at(0).get<std::size_t>(),
                   json.at("cell").at(1).get<std::size_t>()},
                  outcome_from_json(json.at("outcome")));
         });
}

Journal::Journal(const fs::path& file, const Heading& heading) : path_(file) {
  const bool there = heading_of(file).has_value();
  const std::size_t whole =
      there ? read(file, 0,
                   [&](const Cell& cell, Outcome outcome) {
                     outcomes_[{cell.variant, cell.repeat}] = std::move(outcome);
                   })
            : 0;
  file_ = files::Descriptor(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (!file_ || ::ftruncate(file_.get(), static_cast<off_t>(whole)) != 0)
    throw Error(Fault::output, "cannot be written: " + files::reason(errno)).at(file.string());
  if (there) return;
  append({{"study", heading.key}, {"graph", heading.graph}});
  sync();
}

void Journal::add(const Cell& cell, const Outcome& outcome) {
  append({{"cell", {cell.variant, cell.repeat}}, {"outcome", to_json(outcome)}});
  outcomes_[{cell.variant, cell.repeat}] = outcome;
}

void Journal::append(const run::Json& json) {
  const std::string line = checked_line(json);
  try {
    files::write_fully(file_.get(), std::as_bytes(std::span(line)));
  } catch (const std::system_error& error) {
    refuse(error.code().value());
  }
}

void Journal::sync() {
  if (::fdatasync(file_.get()) != 0) refuse(errno);
}

void Journal::refuse(int error) const {
  throw Error(Fault::output, "cannot be written: " + files::reason(error))
      .at(path_.string())
      .hint("make room on the disk; --resume goes on from here");
}

}  // namespace velum::study
