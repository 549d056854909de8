// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <system_error>

#include "lms511/vrec.hpp"
#include "lms511/vrec_layout.hpp"
#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

constexpr int kLevel = 3;

bool is_repeated(Event event) {
  return event == Event::start || event == Event::identity || event == Event::configuration ||
         event == Event::connected;
}

}  // namespace

struct VrecWriter::Impl {
  std::filesystem::path first;
  Options options;
  std::vector<std::filesystem::path> parts;
  std::string block;
  std::string stored;
  std::string beginning;  ///< the start record
  std::string repeated;   ///< what is known of the connection
  std::int64_t block_begin = kNoTime;
  int file = -1;
  std::uint32_t number = 0;
  std::uint64_t in_part = 0;
  std::uint64_t written = 0;
  std::uint64_t records = 0;
  bool failed = false;

  [[noreturn]] void fail(const char* what) {
    const int error = errno;
    failed = true;
    throw Error(Fault::output, fmt::format("{}: {}", what, std::generic_category().message(error)))
        .at(parts.back().string());
  }

  void open() {
    parts.push_back(vrec::part_path(first, static_cast<unsigned>(parts.size())));
    constexpr int kMode = 0644;
    file = ::open(parts.back().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);  // NOLINT
    if (file < 0) fail("the recording cannot be opened");
    number = 0;
    in_part = 0;
    std::string head(vrec::kMagic);
    head.append(reinterpret_cast<const char*>(&vrec::kVersion), sizeof(vrec::kVersion));  // NOLINT
    head.append(vrec::kFileHead - head.size(), '\0');
    write(head);
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t done = ::write(file, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) fail("the recording cannot be written");
      bytes.remove_prefix(static_cast<std::size_t>(done));
      in_part += static_cast<std::uint64_t>(done);
      written += static_cast<std::uint64_t>(done);
    }
  }

  static void append(std::string& to, const Record& record) {
    const std::array<std::uint8_t, 4> head = {static_cast<std::uint8_t>(record.event)};
    const auto size = static_cast<std::uint32_t>(record.bytes.size());
    to.append(reinterpret_cast<const char*>(head.data()), head.size());           // NOLINT
    to.append(reinterpret_cast<const char*>(&size), sizeof(size));                // NOLINT
    to.append(reinterpret_cast<const char*>(&record.time), sizeof(record.time));  // NOLINT
    to.append(record.bytes);
  }

  // One block is one call of write, so that a kill leaves it whole or not at all, but for the disk.
  void flush() {
    if (block.empty() || failed) return;
    const std::size_t room = ZSTD_compressBound(block.size());
    stored.resize(sizeof(vrec::BlockHead) + room);
    const std::size_t size = ZSTD_compress(stored.data() + sizeof(vrec::BlockHead), room,
                                           block.data(), block.size(), kLevel);
    if (ZSTD_isError(size) != 0)
      throw Error(Fault::output, fmt::format("zstd: {}", ZSTD_getErrorName(size)))
          .at(parts.back().string());
    vrec::BlockHead head;
    head.number = number++;
    head.raw = static_cast<std::uint32_t>(block.size());
    head.stored = static_cast<std::uint32_t>(size);
    head.checksum = vrec::checksum(head, {stored.data() + sizeof(head), size});
    std::memcpy(stored.data(), &head, sizeof(head));
    block.clear();
    block_begin = kNoTime;
    write({stored.data(), sizeof(head) + size});
  }

  void rotate() {
    flush();
    close();
    open();
    block = beginning + repeated;
    append(block, {Event::part, kNoTime, std::to_string(parts.size() - 1)});
  }
  // A part repeats this of the ones before, so that it can be read without them.
  void keep(const Record& record) {
    if (record.event == Event::start) beginning.clear();
    if (record.event == Event::start) return append(beginning, record);
    if (record.event == Event::connected) repeated.clear();
    append(repeated, record);
  }

  void close() {
    if (file < 0) return;
    const bool synced = ::fdatasync(file) == 0 || errno == EINVAL || errno == EROFS;
    const bool closed = ::close(file) == 0;
    file = -1;
    if (!synced || !closed) fail("the recording cannot be flushed to the disk");
  }
};

VrecWriter::VrecWriter(std::filesystem::path path, Options options)
    : impl_(std::make_unique<Impl>()) {
  impl_->first = std::move(path);
  impl_->options = options;
  impl_->open();
}

VrecWriter::~VrecWriter() {
  try {
    impl_->flush();
    impl_->close();
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): close() reports, this cannot
  }
}

void VrecWriter::add(const Record& record) {
  Impl& to = *impl_;
  if (to.options.rotate > 0 && to.in_part >= to.options.rotate) to.rotate();
  const std::size_t size = vrec::kRecordHead + record.bytes.size();
  if (size > vrec::kLargestBlock)
    throw Error(Fault::output, fmt::format("a record of {} bytes", size))
        .at(to.parts.back().string());
  if (to.block.size() + size > vrec::kLargestBlock) to.flush();
  if (is_repeated(record.event)) to.keep(record);
  Impl::append(to.block, record);
  ++to.records;
  if (to.block_begin == kNoTime) to.block_begin = record.time;
  const bool old = record.time != kNoTime && to.block_begin != kNoTime &&
                   record.time - to.block_begin >= to.options.block_time;
  if (old || to.block.size() >= to.options.block_size) to.flush();
}

void VrecWriter::flush() {
  impl_->flush();
}

void VrecWriter::close() {
  impl_->flush();
  impl_->close();
}

std::uint64_t VrecWriter::written() const {
  return impl_->written;
}
std::uint64_t VrecWriter::records() const {
  return impl_->records;
}
const std::vector<std::filesystem::path>& VrecWriter::parts() const {
  return impl_->parts;
}

}  // namespace velum::lms511
