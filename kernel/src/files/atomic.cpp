// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <span>
#include <system_error>
#include <vector>

#include "files/descriptor.hpp"
#include "files/hasher.hpp"
#include "files/lock.hpp"
#include "velum/files.hpp"

namespace velum {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBuffer = std::size_t{1} << 20U;
/// File systems allow names of 255 bytes; this leaves room for what is added.
constexpr std::size_t kLongestName = 180;
/// Names tried for the file aside when several writers in one process share a target.
constexpr int kMostWriters = 1000;
/// Written behind what a library made, then cut off again: fails where the disk was full.
constexpr std::size_t kProbe = 65536;

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  throw Error(Fault::output, "cannot be written: " + reason).at(target.string());
}

/// What all files aside of `target` begin with.
std::string prefix_of(const fs::path& target) {
  return fmt::format(".{}.partial.", target.filename().string().substr(0, kLongestName));
}

/// Tells hosts that share a folder apart: numbers of processes mean nothing on another one, and
/// locks may not reach there.
const std::string& host() {
  static const std::string tag = [] {
    std::array<char, 256> name{};
    ::gethostname(name.data(), name.size() - 1);
    return hash_of(std::as_bytes(std::span(name))).substr(0, 8);
  }();
  return tag;
}

/// Has the process that made `aside` on this host ended without removing it? Live writers hold a
/// lock.
bool is_left_over(const fs::path& aside, std::string_view behind_prefix) {
  pid_t process = 0;
  const auto parsed =
      std::from_chars(behind_prefix.data(), behind_prefix.data() + behind_prefix.size(), process);
  if (parsed.ec != std::errc() || process <= 0) return false;
  if (!std::string_view(parsed.ptr).starts_with("." + host())) return false;
  if (::kill(process, 0) == 0 || errno != ESRCH) return false;
  const files::Descriptor file(::open(aside.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  return file && files::lock_now(file.get());
}

void remove_left_overs(const fs::path& target) {
  const std::string prefix = prefix_of(target);
  std::error_code error;
  for (fs::directory_iterator entry(target.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix)) continue;
    std::error_code ignored;
    if (is_left_over(entry->path(), std::string_view(name).substr(prefix.size())))
      fs::remove(entry->path(), ignored);
  }
}

/// The absolute file to replace; links are followed, so that they go on pointing where they did.
fs::path resolve(const fs::path& target) {
  std::error_code error;
  fs::path absolute = fs::absolute(target, error);
  if (error || !absolute.has_filename()) refuse(target, "not the name of a file");
  const fs::file_status status = fs::status(absolute, error);
  if (fs::is_regular_file(status)) return fs::canonical(absolute);
  if (status.type() != fs::file_type::not_found || fs::is_symlink(fs::symlink_status(absolute)))
    refuse(target, fs::exists(status) ? "not a regular file" : error.message());
  return absolute;
}

}  // namespace

struct AtomicFile::Impl {
  fs::path given;   ///< for messages
  fs::path target;  ///< absolute
  fs::path aside;   ///< empty: committed
  files::Descriptor file;
  std::vector<std::byte> buffer;
  files::Hasher hasher;
  std::uint64_t size = 0;
  bool adopted = false;

  /// Runs `action`; what the system refuses becomes an Error.
  template <class Action>
  auto guarded(const Action& action) {
    try {
      return action();
    } catch (const std::system_error& error) {
      refuse(given, files::reason(error.code().value()));
    }
  }
  void check(int result) const {
    if (result != 0) refuse(given, files::reason(errno));
  }
  void open_aside();
  void flush();
  void put(std::span<const std::byte> bytes);
  void read_back();
  void probe();
  void rename();
};

void AtomicFile::Impl::open_aside() {
  const std::string stem = fmt::format("{}{}.{}", prefix_of(target), ::getpid(), host());
  // Some libraries choose the format by the name's ending.
  const std::string extension = target.extension().string().substr(0, 32);
  for (int writer = 0; writer < kMostWriters; ++writer) {
    const std::string name =
        writer == 0 ? stem + extension : fmt::format("{}-{}{}", stem, writer, extension);
    aside = target.parent_path() / name;
    file = files::Descriptor(
        ::open(aside.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (file) {
      (void)files::lock_now(file.get());  // tells other writers that we are alive
      return;
    }
    if (errno != EEXIST) break;
  }
  const int error = errno;
  aside.clear();
  refuse(given, files::reason(error));
}

void AtomicFile::Impl::put(std::span<const std::byte> bytes) {
  guarded([&] { files::write_fully(file.get(), bytes); });
  hasher.add(bytes);
  size += bytes.size();
}

void AtomicFile::Impl::flush() {
  put(buffer);
  buffer.clear();
}

void AtomicFile::Impl::read_back() {
  struct stat status = {};
  check(::fstat(file.get(), &status));
  if (static_cast<std::uint64_t>(status.st_size) != size)
    refuse(given,
           fmt::format("{} bytes arrived on the disk, {} were written", status.st_size, size));
  if (adopted) return;
  check(::lseek(file.get(), 0, SEEK_SET) == 0 ? 0 : -1);
  files::Hasher stored;
  buffer.resize(kBuffer);
  guarded([&] {
    while (const std::size_t got = files::read_fully(file.get(), buffer))
      stored.add(std::span<const std::byte>(buffer).first(got));
  });
  if (stored.hex() != hasher.hex())
    refuse(given, "the disk gives back other bytes than were written");
}

void AtomicFile::Impl::probe() {
  const std::vector<std::byte> zeros(kProbe);
  guarded([&] {
    check(::lseek(file.get(), 0, SEEK_END) >= 0 ? 0 : -1);
    files::write_fully(file.get(), zeros);
  });
  check(::fsync(file.get()));
  check(::ftruncate(file.get(), static_cast<off_t>(size)));
}

void AtomicFile::Impl::rename() {
  check(std::rename(aside.c_str(), target.c_str()));
  aside.clear();
  const files::Descriptor folder(
      ::open(target.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Not every file system can flush a folder.
  if (folder && ::fsync(folder.get()) != 0 && errno != EINVAL && errno != ENOTSUP)
    refuse(given, files::reason(errno));
}

AtomicFile::AtomicFile(fs::path target) : impl_(std::make_unique<Impl>()) {
  impl_->given = std::move(target);
  impl_->target = resolve(impl_->given);
  remove_left_overs(impl_->target);
  impl_->open_aside();
}

AtomicFile::~AtomicFile() {
  if (!impl_->aside.empty()) ::unlink(impl_->aside.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (impl_->buffer.size() + bytes.size() > kBuffer) impl_->flush();
  if (bytes.size() >= kBuffer) {
    impl_->put(bytes);
  } else {
    impl_->buffer.insert(impl_->buffer.end(), bytes.begin(), bytes.end());
  }
}

void AtomicFile::write(std::string_view text) {
  write(std::as_bytes(std::span(text)));
}

const fs::path& AtomicFile::aside() const {
  return impl_->aside;
}

void AtomicFile::adopt() {
  impl_->file = files::Descriptor(::open(impl_->aside.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
  impl_->check(impl_->file ? 0 : -1);
  struct stat status = {};
  impl_->check(::fstat(impl_->file.get(), &status));
  if (!S_ISREG(status.st_mode)) refuse(impl_->given, "not a regular file");
  impl_->size = static_cast<std::uint64_t>(status.st_size);
  impl_->adopted = true;
  impl_->probe();
}

void AtomicFile::commit() {
  if (impl_->aside.empty()) throw Error(Fault::output, "committed twice").at(impl_->given.string());
  if (!impl_->adopted) impl_->flush();
  impl_->check(::fsync(impl_->file.get()));
  impl_->read_back();
  impl_->rename();
}

void write_file(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

}  // namespace velum
