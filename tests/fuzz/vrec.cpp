// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Any bytes as a recording, a capture or a dump: read as far as they go, or refused as bad input.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "lms511/import.hpp"
#include "lms511/lines.hpp"
#include "lms511/vrec.hpp"
#include "velum/error.hpp"

namespace {

namespace lms = velum::lms511;

void require(bool good) {
  if (!good) std::abort();
}

template <class Read>
void attempt(const Read& read) {
  lms::LineGatherer lines;
  try {
    static_cast<void>(read([&](const lms::Record& record) { lines.add(record); }));
  } catch (const velum::Error& error) {
    require(error.fault() == velum::Fault::input && error.where() == "fuzz");
  }
  require(lines.lines().size() == lines.counts().lines);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  attempt([&](const lms::RecordSink& sink) { return lms::read_vrec(bytes, "fuzz", sink); });
  attempt([&](const lms::RecordSink& sink) { return lms::read_capture(bytes, "fuzz", sink); });
  attempt([&](const lms::RecordSink& sink) { return lms::read_telegrams(bytes, "fuzz", sink); });
  return 0;
}
