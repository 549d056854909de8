// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/lzf.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace velum::formats {
namespace {

// A control byte below 32 is followed by that many bytes plus one to copy as they are. Otherwise
// its upper three bits are the length of a match less two (seven: the next byte is added), and its
// lower five with the last byte the distance back less one.
constexpr std::size_t kLongestLiteral = 32;
constexpr std::size_t kLongestMatch = 264;
constexpr std::size_t kFarthest = 8192;
constexpr unsigned kHashBits = 16;

std::size_t slot_of(const std::byte* at) {
  std::uint32_t word = 0;
  std::memcpy(&word, at, 3);
  return (word * 2654435761U) >> (32U - kHashBits);
}

class Packer {
 public:
  explicit Packer(std::span<const std::byte> in) : in_(in), last_(std::size_t{1} << kHashBits, -1) {
    out_.reserve(in.size() + in.size() / kLongestLiteral + 16);
  }

  std::vector<std::byte> pack() {
    std::size_t at = 0;
    while (at + 3 <= in_.size()) {
      std::ptrdiff_t& slot = last_[slot_of(in_.data() + at)];
      const std::ptrdiff_t candidate = slot;
      slot = static_cast<std::ptrdiff_t>(at);
      const std::size_t length = candidate < 0 ? 0 : match(static_cast<std::size_t>(candidate), at);
      if (length < 3) {
        ++at;
        continue;
      }
      write_literals(at);
      write_match(at - static_cast<std::size_t>(candidate) - 1, length);
      at += length;
      literal_ = at;
    }
    write_literals(in_.size());
    return std::move(out_);
  }

 private:
  std::size_t match(std::size_t from, std::size_t at) const {
    if (at - from > kFarthest) return 0;
    const std::size_t most = std::min(kLongestMatch, in_.size() - at);
    std::size_t length = 0;
    while (length < most && in_[from + length] == in_[at + length]) ++length;
    return length;
  }

  void write_literals(std::size_t end) {
    while (literal_ < end) {
      const std::size_t count = std::min(kLongestLiteral, end - literal_);
      out_.push_back(static_cast<std::byte>(count - 1));
      const auto first = in_.begin() + static_cast<std::ptrdiff_t>(literal_);
      out_.insert(out_.end(), first, first + static_cast<std::ptrdiff_t>(count));
      literal_ += count;
    }
  }

  void write_match(std::size_t distance, std::size_t length) {
    const std::size_t code = length - 2;
    out_.push_back(static_cast<std::byte>((std::min<std::size_t>(code, 7) << 5U) | distance >> 8U));
    if (code >= 7) out_.push_back(static_cast<std::byte>(code - 7));
    out_.push_back(static_cast<std::byte>(distance & 255U));
  }

  std::span<const std::byte> in_;
  std::vector<std::ptrdiff_t> last_;
  std::vector<std::byte> out_;
  std::size_t literal_ = 0;
};

/// Copies a match, which may overlap what it writes.
void copy_match(std::byte* to, std::size_t distance, std::size_t length) {
  const std::byte* from = to - distance;
  if (distance >= length) {
    std::memcpy(to, from, length);
  } else {
    for (std::size_t i = 0; i < length; ++i) to[i] = from[i];
  }
}

}  // namespace

bool lzf_unpack(std::span<const std::byte> in, std::span<std::byte> out) {
  std::size_t at = 0;
  std::size_t written = 0;
  while (at < in.size()) {
    const auto control = static_cast<std::size_t>(in[at++]);
    if (control < kLongestLiteral) {
      const std::size_t count = control + 1;
      if (count > in.size() - at || count > out.size() - written) return false;
      std::memcpy(out.data() + written, in.data() + at, count);
      at += count;
      written += count;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == 7) {
      if (at == in.size()) return false;
      length += static_cast<std::size_t>(in[at++]);
    }
    length += 2;
    if (at == in.size()) return false;
    const std::size_t distance = ((control & 31U) << 8U | static_cast<std::size_t>(in[at++])) + 1;
    if (distance > written || length > out.size() - written) return false;
    copy_match(out.data() + written, distance, length);
    written += length;
  }
  return written == out.size();
}

std::vector<std::byte> lzf_pack(std::span<const std::byte> in) {
  return Packer(in).pack();
}

}  // namespace velum::formats
