// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/elf.hpp"

#include <elf.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <span>
#include <string>

#include "velum/error.hpp"

namespace velum::plugins {
namespace {

/// Reads parts of a file; all offsets are checked against its size.
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& path) : path_(path) {
    // Not blocking: a FIFO of that name must not hang the command.
    fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd_ < 0) fail(std::string("cannot be read: ") + std::strerror(errno));
    struct stat status = {};
    const bool regular = ::fstat(fd_, &status) == 0 && S_ISREG(status.st_mode);
    if (!regular) {
      ::close(fd_);
      fail("is not a regular file");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
  ~ElfFile() { ::close(fd_); }
  ElfFile(const ElfFile&) = delete;
  ElfFile& operator=(const ElfFile&) = delete;

  void read(std::uint64_t offset, std::span<std::byte> out) const {
    if (!holds(offset, out.size())) cut_short();
    std::size_t done = 0;
    while (done < out.size()) {
      const ssize_t got =
          ::pread(fd_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) cut_short();
      done += static_cast<std::size_t>(got);
    }
  }
  template <class T>
  [[nodiscard]] T read(std::uint64_t offset) const {
    T value;
    read(offset, std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
  template <class T>
  [[nodiscard]] std::vector<T> read_table(std::uint64_t offset, std::size_t count) const {
    std::vector<T> table(count);
    read(offset, std::as_writable_bytes(std::span(table)));
    return table;
  }

  [[nodiscard]] bool holds(std::uint64_t offset, std::uint64_t count) const {
    return offset <= size_ && count <= size_ - offset;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Fault::plugin, "the plugin file " + what).at(path_.string());
  }
  [[noreturn]] void cut_short() const {
    throw Error(Fault::plugin, "the plugin file is damaged: " + std::to_string(size_) +
                                   " bytes are less than its header promises")
        .at(path_.string())
        .hint("copy or build it again");
  }

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

Elf64_Ehdr read_header(const ElfFile& file) {
  if (!file.holds(0, sizeof(Elf64_Ehdr))) file.fail("is not a shared object (too short)");
  const auto header = file.read<Elf64_Ehdr>(0);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
    file.fail("is not a shared object (no ELF header)");
  constexpr unsigned char kNative =
      std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_ident[EI_DATA] != kNative)
    file.fail("was built for another kind of machine");
  if (header.e_type != ET_DYN) file.fail("is an ELF file, but not a shared object");
  const bool sound = header.e_shentsize == sizeof(Elf64_Shdr) &&
                     header.e_phentsize == sizeof(Elf64_Phdr) && header.e_shnum > 0 &&
                     header.e_shstrndx < header.e_shnum;
  if (!sound) file.fail("is damaged: its ELF header makes no sense");
  return header;
}

/// The loader maps segments without asking for the file's size, and dies on what is not there.
void check_segments(const ElfFile& file, const Elf64_Ehdr& header) {
  for (const auto& segment : file.read_table<Elf64_Phdr>(header.e_phoff, header.e_phnum))
    if (segment.p_type != PT_NULL && segment.p_type != PT_GNU_STACK &&
        !file.holds(segment.p_offset, segment.p_filesz))
      file.cut_short();
}

}  // namespace

std::vector<std::byte> read_section(const std::filesystem::path& path, std::string_view name,
                                    std::size_t limit) {
  const ElfFile file(path);
  const Elf64_Ehdr header = read_header(file);
  check_segments(file, header);
  const auto sections = file.read_table<Elf64_Shdr>(header.e_shoff, header.e_shnum);
  const Elf64_Shdr& names = sections[header.e_shstrndx];

  std::vector<char> found(name.size() + 1);
  for (const Elf64_Shdr& section : sections) {
    // The name with its end mark must lie inside the table of names.
    if (section.sh_type != SHT_PROGBITS || section.sh_name > names.sh_size ||
        found.size() > names.sh_size - section.sh_name)
      continue;
    if (!file.holds(names.sh_offset, names.sh_size)) file.cut_short();
    file.read(names.sh_offset + section.sh_name, std::as_writable_bytes(std::span(found)));
    if (found.back() == '\0' && name == found.data()) {
      std::vector<std::byte> bytes(std::min<std::uint64_t>(section.sh_size, limit));
      file.read(section.sh_offset, bytes);
      return bytes;
    }
  }
  throw Error(Fault::plugin,
              "the file is a shared object, but not a plugin of Velum: it has no "
              "section " +
                  std::string(name))
      .at(path.string())
      .hint("end the plugin's source with VELUM_STAGE(Type)");
}

}  // namespace velum::plugins
