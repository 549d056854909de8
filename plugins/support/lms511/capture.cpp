// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <map>
#include <optional>

#include "lms511/import.hpp"
#include "lms511/packets.hpp"
#include "lms511/reader.hpp"
#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

// Bytes that wait for ones before them; more than that and those are given up as lost.
constexpr std::size_t kMostWaiting = std::size_t{4} << 20U;

// What a client says to a device is no part of a scan.
bool is_request(std::string_view payload) {
  return payload.size() >= 3 && payload[2] == 'N' && payload[1] != 'S';
}

// One direction of one connection.
class Stream {
 public:
  void add(const Segment& segment, std::int64_t begin, const RecordSink& sink) {
    time_ = segment.time - begin;
    if (segment.syn) restart(segment.sequence + 1);
    if (segment.bytes.empty()) return;
    if (!next_) next_ = segment.sequence;
    const auto ahead = static_cast<std::int32_t>(segment.sequence - *next_);
    if (ahead > 0) {
      waiting_bytes_ += segment.bytes.size();
      waiting_.emplace(segment.sequence, segment.bytes);
    } else {
      take(segment.sequence, segment.bytes, sink);
    }
    drain(sink);
    while (waiting_bytes_ > kMostWaiting) give_up(sink);
  }

  void finish(const RecordSink& sink) {
    while (!waiting_.empty()) give_up(sink);
  }

  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] std::uint64_t telegrams() const { return telegrams_; }
  [[nodiscard]] const Framer& framer() const { return framer_; }

 private:
  // Ordered by distance from the next byte, which wraps.
  struct Later {
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return static_cast<std::int32_t>(a - b) < 0;
    }
  };

  void restart(std::uint32_t sequence) {
    next_ = sequence;
    waiting_.clear();
    waiting_bytes_ = 0;
    framer_ = Framer();
    connected_ = false;
  }

  // Bytes that came before are passed over.
  void take(std::uint32_t sequence, std::string_view bytes, const RecordSink& sink) {
    const auto known = static_cast<std::size_t>(*next_ - sequence);
    if (known >= bytes.size()) return;
    bytes.remove_prefix(known);
    *next_ += static_cast<std::uint32_t>(bytes.size());
    framer_.feed(bytes);
    while (const auto telegram = framer_.next()) {
      if (is_request(telegram->payload)) continue;
      if (!connected_) sink({Event::connected, time_, "capture"});
      connected_ = true;
      ++telegrams_;
      sink(record_of(*telegram, time_));
    }
  }

  void drain(const RecordSink& sink) {
    while (!waiting_.empty() && static_cast<std::int32_t>(waiting_.begin()->first - *next_) <= 0) {
      const auto [sequence, bytes] = *waiting_.begin();
      waiting_.erase(waiting_.begin());
      waiting_bytes_ -= bytes.size();
      take(sequence, bytes, sink);
    }
  }

  void give_up(const RecordSink& sink) {
    lost_ += waiting_.begin()->first - *next_;
    next_ = waiting_.begin()->first;
    drain(sink);
  }

  std::optional<std::uint32_t> next_;
  std::multimap<std::uint32_t, std::string_view, Later> waiting_;
  std::size_t waiting_bytes_ = 0;
  Framer framer_;
  bool connected_ = false;
  std::int64_t time_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t telegrams_ = 0;
};

}  // namespace

bool is_capture(std::span<const std::byte> bytes) {
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()),  // NOLINT
                              std::min<std::size_t>(bytes.size(), 4));
  return head == "\x0a\x0d\x0d\x0a" || head == "\xd4\xc3\xb2\xa1" || head == "\xa1\xb2\xc3\xd4" ||
         head == "\x4d\x3c\xb2\xa1" || head == "\xa1\xb2\x3c\x4d";
}

ImportCounts read_capture(std::span<const std::byte> bytes, const std::string& name,
                          const RecordSink& sink) {
  std::map<std::string, Stream> streams;
  std::optional<std::int64_t> begin;
  ImportCounts counts;
  counts.format = read_segments(bytes, name, [&](const Segment& segment) {
    if (!begin) begin = segment.time;
    streams[segment.flow].add(segment, *begin, sink);
  });
  std::uint64_t telegrams = 0;
  for (auto& [flow, stream] : streams) {
    stream.finish(sink);
    telegrams += stream.telegrams();
    if (stream.telegrams() == 0) continue;
    counts.lost_bytes += stream.lost();
    counts.skipped_bytes += stream.framer().counts().skipped_bytes;
    counts.bad_checksums += stream.framer().counts().bad_checksums;
  }
  if (telegrams == 0)
    throw Error(Fault::input, "the capture holds no TCP stream with telegrams of an LMS 511")
        .at(name);
  return counts;
}

}  // namespace velum::lms511
