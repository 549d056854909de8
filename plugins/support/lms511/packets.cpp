// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/packets.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t size, bool big) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8U | static_cast<std::uint8_t>(bytes[at + (big ? i : size - 1 - i)]);
  return value;
}

constexpr std::uint32_t kPcapMicro = 0xa1b2c3d4;
constexpr std::uint32_t kPcapNano = 0xa1b23c4d;
constexpr std::uint32_t kSection = 0x0a0d0d0a;
constexpr std::uint32_t kByteOrder = 0x1a2b3c4d;

void read_pcap(std::string_view bytes, bool big, bool nano, const SegmentSink& sink) {
  constexpr std::size_t kHead = 24;
  constexpr std::size_t kPacketHead = 16;
  const std::uint32_t link = number(bytes, 20, 4, big) & 0xffffU;
  std::string_view rest = bytes.substr(kHead);
  while (rest.size() >= kPacketHead) {
    const std::int64_t seconds = number(rest, 0, 4, big);
    const std::int64_t fraction = number(rest, 4, 4, big);
    const std::size_t size = number(rest, 8, 4, big);
    if (size > rest.size() - kPacketHead) return;
    Segment segment;
    segment.time = seconds * 1'000'000'000 + fraction * (nano ? 1 : 1000);
    if (parse_packet(rest.substr(kPacketHead, size), link, segment)) sink(segment);
    rest.remove_prefix(kPacketHead + size);
  }
}

// One interface of a pcapng section.
struct Interface {
  std::uint32_t link = 1;
  double tick = 1e-6;  ///< [s]
};

class Pcapng {
 public:
  explicit Pcapng(const SegmentSink& sink) : sink_(sink) {}

  void read(std::string_view rest) {
    constexpr std::size_t kFrame = 12;  // type, length, and the length again
    while (rest.size() >= kFrame) {
      if (number(rest, 0, 4, true) == kSection) {
        big_ = number(rest, 8, 4, true) == kByteOrder;
        interfaces_.clear();
      }
      const std::size_t length = number(rest, 4, 4, big_);
      if (length < kFrame || length > rest.size()) return;
      block(number(rest, 0, 4, big_), rest.substr(8, length - kFrame));
      rest.remove_prefix(std::min(rest.size(), (length + 3) / 4 * 4));
    }
  }

 private:
  void block(std::uint32_t type, std::string_view body) {
    constexpr std::uint32_t kInterface = 1;
    constexpr std::uint32_t kSimple = 3;
    constexpr std::uint32_t kEnhanced = 6;
    if (type == kInterface && body.size() >= 8) interfaces_.push_back(interface_of(body));
    if (type == kSimple && body.size() >= 4) packet(0, 0, body.substr(4));
    if (type == kEnhanced && body.size() >= 20) {
      const std::uint64_t ticks =
          std::uint64_t{number(body, 4, 4, big_)} << 32U | number(body, 8, 4, big_);
      const std::size_t size = number(body, 12, 4, big_);
      packet(number(body, 0, 4, big_), ticks, body.substr(20, size));
    }
  }

  [[nodiscard]] Interface interface_of(std::string_view body) const {
    constexpr std::uint32_t kResolution = 9;
    Interface one;
    one.link = number(body, 0, 2, big_);
    std::string_view options = body.substr(8);
    while (options.size() >= 5) {
      const std::uint32_t code = number(options, 0, 2, big_);
      const std::size_t size = number(options, 2, 2, big_);
      if (code == 0) break;
      if (code == kResolution && size >= 1) {
        const auto value = static_cast<std::uint8_t>(options[4]);
        one.tick = 1.0;
        for (int i = value & 0x7f; i > 0; --i) one.tick /= (value & 0x80) != 0 ? 2.0 : 10.0;
      }
      options.remove_prefix(std::min(options.size(), 4 + (size + 3) / 4 * 4));
    }
    return one;
  }

  void packet(std::uint32_t interface, std::uint64_t ticks, std::string_view bytes) {
    if (interface >= interfaces_.size()) return;
    const Interface& from = interfaces_[interface];
    Segment segment;
    constexpr double kLatest = 4e18;  // [ns], so that differences stay representable
    segment.time = static_cast<std::int64_t>(
        std::min(static_cast<long double>(ticks) * static_cast<long double>(from.tick) * 1e9L,
                 static_cast<long double>(kLatest)));
    if (parse_packet(bytes, from.link, segment)) sink_(segment);
  }

  const SegmentSink& sink_;
  std::vector<Interface> interfaces_;
  bool big_ = false;
};

// Where the IP packet begins, by the kind of link; nothing when it holds none.
std::optional<std::size_t> ip_offset(std::string_view packet, std::uint32_t link) {
  constexpr std::uint32_t kVlan = 0x8100;
  std::size_t type = 0;
  switch (link) {
    case 0:  // loopback of BSD: an address family
      return 4;
    case 12:
    case 14:
    case 101:  // the IP packet itself
      return 0;
    case 1:  // Ethernet
      type = 12;
      break;
    case 113:  // "any" of Linux
      type = 14;
      break;
    case 276:  // the same, version 2
      return packet.size() > 20 ? std::optional<std::size_t>(20) : std::nullopt;
    default:
      return std::nullopt;
  }
  while (packet.size() >= type + 2 && number(packet, type, 2, true) == kVlan) type += 4;
  if (packet.size() < type + 2) return std::nullopt;
  const std::uint32_t kind = number(packet, type, 2, true);
  return kind == 0x0800 || kind == 0x86dd ? std::optional(type + 2) : std::nullopt;
}

constexpr std::uint8_t kTcp = 6;

bool parse_tcp(std::string_view tcp, std::string addresses, Segment& segment) {
  if (tcp.size() < 20) return false;
  const std::size_t head = static_cast<std::size_t>(static_cast<std::uint8_t>(tcp[12]) >> 4U) * 4;
  if (head < 20 || head > tcp.size()) return false;
  segment.flow = std::move(addresses);
  segment.flow += tcp.substr(0, 4);
  segment.sequence = number(tcp, 4, 4, true);
  segment.syn = (static_cast<std::uint8_t>(tcp[13]) & 2U) != 0;
  segment.bytes = tcp.substr(head);
  return true;
}

}  // namespace

bool parse_packet(std::string_view packet, std::uint32_t link_type, Segment& segment) {
  const auto offset = ip_offset(packet, link_type);
  if (!offset || packet.size() < *offset + 20) return false;
  std::string_view ip = packet.substr(*offset);
  const unsigned version = static_cast<std::uint8_t>(ip.front()) >> 4U;
  if (version == 4) {
    const std::size_t head = (static_cast<std::uint8_t>(ip.front()) & 0xfU) * std::size_t{4};
    const std::size_t total = number(ip, 2, 2, true);
    const bool fragment = (number(ip, 6, 2, true) & 0x3fffU) != 0;
    // A length of 0 is that of a packet that the network card was to cut up.
    if (total != 0 && total < ip.size()) ip = ip.substr(0, total);
    if (head < 20 || head > ip.size() || fragment || ip[9] != kTcp) return false;
    return parse_tcp(ip.substr(head), std::string(ip.substr(12, 8)), segment);
  }
  constexpr std::size_t kHead6 = 40;
  if (version != 6 || ip.size() < kHead6 || ip[6] != kTcp) return false;
  const std::size_t length = number(ip, 4, 2, true);
  return parse_tcp(ip.substr(kHead6, length == 0 ? std::string_view::npos : length),
                   std::string(ip.substr(8, 32)), segment);
}

std::string read_segments(std::span<const std::byte> bytes, const std::string& name,
                          const SegmentSink& sink) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());  // NOLINT
  if (text.size() >= 24) {
    if (number(text, 0, 4, true) == kSection) {
      Pcapng(sink).read(text);
      return "pcapng";
    }
    for (const bool big : {false, true}) {
      const std::uint32_t magic = number(text, 0, 4, big);
      if (magic != kPcapMicro && magic != kPcapNano) continue;
      read_pcap(text, big, magic == kPcapNano, sink);
      return "pcap";
    }
  }
  throw Error(Fault::input, "this is neither pcap nor pcapng").at(name);
}

}  // namespace velum::lms511
