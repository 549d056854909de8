// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "lms511/record.hpp"
#include "velum/context.hpp"

namespace velum::lms511 {

/// What reading a recording or capture found besides its telegrams.
struct ImportCounts {
  std::string format{};             ///< "vrec", "pcapng", "pcap", "telegrams"
  std::uint64_t skipped_bytes = 0;  ///< that belong to no telegram
  std::uint64_t bad_checksums = 0;
  std::uint64_t lost_bytes = 0;     ///< TCP segments that the capture does not have
  std::uint64_t damaged_bytes = 0;  ///< of a recording
  std::uint64_t missing_blocks = 0;
  bool ended = true;  ///< a recording was closed in order
};

/// Reads all records of a .vrec file with its parts, of a pcap or pcapng capture of the scanner's
/// TCP stream, or of telegrams back to back in either dialect (a dump of bytes, or a telegram a
/// line). The content decides. Throws Error (Fault::input) where nothing of that kind is found.
[[nodiscard]] ImportCounts read_records(const std::filesystem::path& path, const RecordSink& sink,
                                        const Context& context);

/// The same for bytes at hand; `name` is what messages call them.
[[nodiscard]] ImportCounts read_telegrams(std::span<const std::byte> bytes, const std::string& name,
                                          const RecordSink& sink);
[[nodiscard]] ImportCounts read_vrec(std::span<const std::byte> bytes, const std::string& name,
                                     const RecordSink& sink);
/// Puts the TCP streams of a capture together, in the order of their sequence numbers, whatever the
/// order of the packets; repeated bytes count once. Only streams that hold telegrams give any.
[[nodiscard]] ImportCounts read_capture(std::span<const std::byte> bytes, const std::string& name,
                                        const RecordSink& sink);
[[nodiscard]] bool is_capture(std::span<const std::byte> bytes);

}  // namespace velum::lms511
