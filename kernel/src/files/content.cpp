// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "files/descriptor.hpp"
#include "velum/files.hpp"

namespace velum {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20U;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Error(Fault::input, "cannot be read: " + reason).at(path.string());
}

/// Asks for huge pages: first touching small ones costs more than the copy itself.
void prefer_huge_pages(std::byte* data, std::size_t size) {
  if (size < 2 * kHugePage) return;
  void* begin = data;
  std::size_t space = size;
  if (std::align(kHugePage, kHugePage, begin, space) == nullptr) return;
  ::madvise(begin, space / kHugePage * kHugePage, MADV_HUGEPAGE);
}

}  // namespace

FileContent::FileContent(const std::filesystem::path& path, std::uint64_t limit) {
  // O_NONBLOCK: a pipe without a writer must not hold us up before it is refused.
  const files::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file) refuse(path, files::reason(errno));
  struct stat status = {};
  if (::fstat(file.get(), &status) != 0) refuse(path, files::reason(errno));
  if (!S_ISREG(status.st_mode)) refuse(path, "not a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > limit)
    refuse(path, fmt::format("it has {} bytes, at most {} are expected", size, limit));
  size_ = static_cast<std::size_t>(size);
  data_ = std::make_unique_for_overwrite<std::byte[]>(size_);
  prefer_huge_pages(data_.get(), size_);
  // A plain read, no mapping: a mapped file that another process shortens kills the reader.
  std::size_t got = 0;
  try {
    got = files::read_fully(file.get(), {data_.get(), size_});
  } catch (const std::system_error& error) {
    refuse(path, files::reason(error.code().value()));
  }
  if (got != size_) refuse(path, fmt::format("it ends after {} of {} bytes", got, size_));
}

}  // namespace velum
