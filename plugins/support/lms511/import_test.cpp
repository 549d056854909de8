// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/import.hpp"

#include <catch2/catch.hpp>

#include "lms511/test_room.hpp"

using namespace velum::lms511;  // NOLINT

namespace {

void put(std::string& to, std::uint64_t value, int size, bool big) {
  for (int i = 0; i < size; ++i) {
    const int shift = 8 * (big ? size - 1 - i : i);
    to += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xffU);
  }
}

// An Ethernet packet with a TCP segment from the device.
std::string packet(std::uint32_t sequence, std::string_view bytes, bool six = false,
                   bool syn = false) {
  std::string p(12, '\0');
  put(p, six ? 0x86dd : 0x0800, 2, true);
  if (six) {
    p += '\x60';
    p.append(3, '\0');
    put(p, 20 + bytes.size(), 2, true);
    p += "\x06\x40";
    p.append(32, '\x01');
  } else {
    p += "\x45";
    p += '\0';
    put(p, 40 + bytes.size(), 2, true);
    p.append(5, '\0');
    p += "\x06";
    p.append(2, '\0');
    p.append(8, '\x0a');
  }
  put(p, 2112, 2, true);
  put(p, 50000, 2, true);
  put(p, sequence, 4, true);
  put(p, 0, 4, true);
  p += "\x50";
  p += syn ? '\x02' : '\x18';
  p.append(6, '\0');
  return p += bytes;
}

std::string pcap(const std::vector<std::string>& packets, bool big) {
  std::string file;
  put(file, 0xa1b2c3d4, 4, big);
  put(file, 2, 2, big);
  put(file, 4, 2, big);
  put(file, 0, 8, big);
  put(file, 65535, 4, big);
  put(file, 1, 4, big);
  std::uint64_t time = 0;
  for (const std::string& one : packets) {
    put(file, 100, 4, big);
    put(file, 1000 * time++, 4, big);
    put(file, one.size(), 4, big);
    put(file, one.size(), 4, big);
    file += one;
  }
  return file;
}

std::string block(std::uint32_t type, std::string body) {
  body.resize((body.size() + 3) / 4 * 4);
  std::string whole;
  put(whole, type, 4, false);
  put(whole, body.size() + 12, 4, false);
  whole += body;
  put(whole, body.size() + 12, 4, false);
  return whole;
}

std::string pcapng(const std::vector<std::string>& packets) {
  std::string head;
  put(head, 0x1a2b3c4d, 4, false);
  put(head, 1, 4, false);
  put(head, ~std::uint64_t{0}, 8, false);
  std::string interface;
  put(interface, 1, 4, false);
  put(interface, 0, 4, false);
  put(interface, 9 | 1U << 16U, 4, false);  // option: resolution, of one byte
  put(interface, 9, 4, false);              // 1 ns
  std::string file = block(0x0a0d0d0a, head) + block(1, interface);
  std::uint64_t time = 0;
  for (const std::string& one : packets) {
    std::string body;
    put(body, 0, 4, false);
    put(body, 0, 4, false);
    put(body, 1'000'000 * time++, 4, false);
    put(body, one.size(), 4, false);
    put(body, one.size(), 4, false);
    file += block(6, body + one);
  }
  return file;
}

struct Seen {
  LineGatherer lines;
  ImportCounts counts;
  std::vector<std::int64_t> times;
};

Seen imported(const std::string& content) {
  Seen seen;
  const auto bytes = std::as_bytes(std::span(content));
  const RecordSink sink = [&](const Record& record) {
    seen.lines.add(record);
    if (is_telegram(record)) seen.times.push_back(record.time);
  };
  seen.counts =
      is_capture(bytes) ? read_capture(bytes, "test", sink) : read_telegrams(bytes, "test", sink);
  return seen;
}

std::string stream(int scans) {
  lms::RoomScan room;
  std::string bytes;
  for (int i = 0; i < scans; ++i)
    bytes += framed(Dialect::binary, encode_scan(room.line(i), Dialect::binary));
  return bytes;
}

// The stream in pieces of 500 bytes; sequence numbers wrap on the way.
std::vector<std::string> packets(const std::string& bytes, bool six = false) {
  std::vector<std::string> all = {packet(0xfffffe00U - 1, "", six, true)};
  for (std::size_t at = 0; at < bytes.size(); at += 500)
    all.push_back(packet(0xfffffe00U + static_cast<std::uint32_t>(at),
                         std::string_view(bytes).substr(at, 500), six));
  return all;
}

}  // namespace

TEST_CASE("a capture's TCP stream is put together") {
  const std::string bytes = stream(10);
  for (const bool six : {false, true})
    for (const std::string& file : {pcap(packets(bytes, six), false),
                                    pcap(packets(bytes, six), true), pcapng(packets(bytes, six))}) {
      const Seen seen = imported(file);
      CHECK(seen.lines.counts().lines == 10);
      CHECK(seen.lines.counts().connections == 1);
      CHECK(seen.counts.skipped_bytes == 0);
      CHECK(seen.counts.lost_bytes == 0);
      // A packet a millisecond; a scan of 689 bytes is whole with its second packet.
      REQUIRE(seen.times.size() == 10);
      CHECK(seen.times.front() == 2'000'000);
    }
}

TEST_CASE("packets out of order and sent twice change nothing") {
  auto all = packets(stream(10));
  std::swap(all[2], all[5]);
  std::swap(all[7], all[8]);
  all.insert(all.begin() + 9, all[4]);
  all.push_back(all[6]);
  const Seen seen = imported(pcap(all, false));
  CHECK(seen.lines.counts().lines == 10);
  CHECK(seen.lines.counts().lost == 0);
  CHECK(seen.counts.lost_bytes == 0);
}

TEST_CASE("a packet that the capture lacks costs its scans only") {
  auto all = packets(stream(10));
  all.erase(all.begin() + 4);
  const Seen seen = imported(pcap(all, false));
  CHECK(seen.counts.lost_bytes == 500);
  CHECK(seen.lines.counts().lines >= 8);
  CHECK(seen.lines.counts().lines + seen.lines.counts().lost == 10);
}

TEST_CASE("a capture cut anywhere or changed anywhere is read as far as it goes") {
  const std::string file = pcapng(packets(stream(3)));
  const auto attempt = [](const std::string& content) {
    try {
      static_cast<void>(imported(content));
    } catch (const velum::Error& error) {
      REQUIRE(error.fault() == velum::Fault::input);
    }
  };
  for (std::size_t cut = 0; cut < file.size(); cut += 7) attempt(file.substr(0, cut));
  for (std::size_t at = 0; at < file.size(); ++at) {
    std::string changed = file;
    changed[at] = static_cast<char>(~changed[at]);
    attempt(changed);
  }
}

TEST_CASE("telegrams back to back or a line each, with whatever is between them") {
  lms::RoomScan room;
  std::string text;
  for (int i = 0; i < 5; ++i)
    text += framed(Dialect::ascii, encode_scan(room.line(i), Dialect::ascii)) + "\r\n";
  const Seen seen = imported(text);
  CHECK(seen.lines.counts().lines == 5);
  CHECK(seen.counts.skipped_bytes == 10);
  CHECK(imported("rubbish" + stream(4)).lines.counts().lines == 4);
  CHECK_THROWS_AS(imported("no telegram at all"), velum::Error);
  CHECK_THROWS_AS(imported(""), velum::Error);
}

TEST_CASE("a real capture of another scanner, with real TCP segments") {
  const auto path = lms::capture("related_tim.pcapng");
  if (!path) {
    WARN("no captures at hand, skipped");
    return;
  }
  const Seen seen = imported(lms::content(*path));
  CHECK(seen.counts.format == "pcapng");
  REQUIRE(seen.lines.counts().lines == 16);
  const Line& line = seen.lines.lines().front();
  CHECK(line.frequency == Approx(15.0));
  CHECK(line.ranges.front().values.size() == 811);
  CHECK(line.ranges.front().start == -450000);
  CHECK(line.ranges.front().step == 3333);
  CHECK(line.remission.front().name == "RSSI1");
  CHECK(seen.lines.counts().returns.implausible > 0);
}
