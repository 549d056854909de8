// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>

#include "lms511/vrec.hpp"
#include "lms511/vrec_layout.hpp"
#include "velum/error.hpp"

namespace velum::lms511 {

struct VrecReader::Impl {
  std::string_view bytes;
  std::string name;
  std::size_t at = vrec::kFileHead;
  std::string block;
  std::size_t in_block = 0;
  std::uint64_t expected = 0;
  std::uint64_t damaged = 0;
  std::uint64_t missing = 0;

  // The block at `from`, or false where there is no whole one.
  bool open(std::size_t from) {
    vrec::BlockHead head;
    if (bytes.size() - from < sizeof(head)) return false;
    std::memcpy(&head, bytes.data() + from, sizeof(head));
    const std::string_view rest = bytes.substr(from + sizeof(head));
    if (head.mark != vrec::kBlockMark || head.stored > rest.size() ||
        head.raw > vrec::kLargestBlock || head.raw == 0)
      return false;
    const std::string_view stored = rest.substr(0, head.stored);
    if (vrec::checksum(head, stored) != head.checksum) return false;
    block.resize(head.raw);
    if (ZSTD_decompress(block.data(), block.size(), stored.data(), stored.size()) != head.raw) {
      block.clear();
      return false;
    }
    in_block = 0;
    if (head.number > expected) missing += head.number - expected;
    expected = std::uint64_t{head.number} + 1;
    at = from + sizeof(head) + head.stored;
    return true;
  }

  bool next_block() {
    constexpr std::string_view kMark = "VFRM";
    const std::size_t begin = at;
    for (std::size_t from = begin; from < bytes.size();
         from = std::min(bytes.find(kMark, from + 1), bytes.size()))
      if (open(from)) {
        damaged += from - begin;
        return true;
      }
    damaged += bytes.size() - begin;
    at = bytes.size();
    return false;
  }

  // A record that does not fit into its block ends it.
  bool take(Record& record) {
    const std::string_view rest = std::string_view(block).substr(in_block);
    if (rest.size() < vrec::kRecordHead) return false;
    std::uint32_t size = 0;
    std::memcpy(&size, rest.data() + 4, sizeof(size));
    if (size > rest.size() - vrec::kRecordHead) return false;
    record.event = static_cast<Event>(rest.front());
    std::memcpy(&record.time, rest.data() + 8, sizeof(record.time));
    record.bytes = rest.substr(vrec::kRecordHead, size);
    in_block += vrec::kRecordHead + size;
    return true;
  }
};

VrecReader::VrecReader(std::span<const std::byte> bytes, std::string name)
    : impl_(std::make_unique<Impl>()) {
  impl_->bytes = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT
  impl_->name = std::move(name);
  if (!is_vrec(bytes))
    throw Error(Fault::input, "this is no recording: it does not begin with VELUMREC")
        .at(impl_->name);
  std::uint32_t version = 0;
  std::memcpy(&version, impl_->bytes.data() + vrec::kMagic.size(), sizeof(version));
  if (version != vrec::kVersion)
    throw Error(Fault::input,
                fmt::format("a recording of version {}, expected {}", version, vrec::kVersion))
        .at(impl_->name);
}

VrecReader::~VrecReader() = default;
VrecReader::VrecReader(VrecReader&&) noexcept = default;

bool VrecReader::next(Record& record) {
  while (!impl_->take(record)) {
    impl_->damaged += impl_->block.size() - impl_->in_block;
    impl_->in_block = impl_->block.size();
    if (!impl_->next_block()) return false;
  }
  return true;
}

std::uint64_t VrecReader::damaged_bytes() const {
  return impl_->damaged;
}
std::uint64_t VrecReader::missing_blocks() const {
  return impl_->missing;
}

bool is_vrec(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());  // NOLINT
  return bytes.size() >= vrec::kFileHead && text.starts_with(vrec::kMagic);
}

std::vector<std::filesystem::path> parts_of(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> parts = {path};
  std::error_code ignored;
  for (unsigned part = 1; std::filesystem::exists(vrec::part_path(path, part), ignored); ++part)
    parts.push_back(vrec::part_path(path, part));
  return parts;
}

}  // namespace velum::lms511
