// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

/// Network captures: packets out of pcap and pcapng files, TCP segments out of packets.
namespace velum::lms511 {

/// A TCP segment as it was captured.
struct Segment {
  std::string flow;  ///< addresses and ports, from and to
  std::uint32_t sequence = 0;
  bool syn = false;
  std::int64_t time = 0;   ///< [ns] since 1970, or what the capture counts from
  std::string_view bytes;  ///< of the capture
};

using SegmentSink = std::function<void(const Segment&)>;

/// The TCP segments of a capture in its order; other packets, fragments and what is cut short are
/// passed over. Returns "pcap" or "pcapng". Throws Error (Fault::input) at `name` when the capture
/// is neither.
std::string read_segments(std::span<const std::byte> bytes, const std::string& name,
                          const SegmentSink& sink);

/// The TCP segment in a packet of that link type, or false.
bool parse_packet(std::string_view packet, std::uint32_t link_type, Segment& segment);

}  // namespace velum::lms511
