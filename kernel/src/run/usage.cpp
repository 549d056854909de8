// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/usage.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string_view>

namespace velum::run {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::uint64_t resident_bytes(pid_t process) {
  const files::Descriptor file(
      ::open(fmt::format("/proc/{}/statm", process).c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 128> text{};
  if (!file || ::read(file.get(), text.data(), text.size() - 1) <= 0) return 0;
  const char* second = std::strchr(text.data(), ' ');
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return second == nullptr ? 0 : std::strtoull(second, nullptr, 10) * page;
}

double own_cpu_seconds() {
  struct timespec time = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double cpu_seconds() {
  double total = 0.0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    struct rusage usage = {};
    ::getrusage(who, &usage);
    total += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return total;
}

// Writing "5" to clear_refs sets VmHWM back to what is resident now (proc(5); Linux 4.0 and newer).
// The peak that getrusage() tells is of no use: it may be that of the process that started this
// one.
PeakMeter::PeakMeter()
    : status_(::open("/proc/self/status", O_RDONLY | O_CLOEXEC)),
      reset_(::open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC)) {}

void PeakMeter::mark() {
  const std::lock_guard lock(mutex_);
  if (!reset_) return;
  read();
  if (::write(reset_.get(), "5", 1) != 1) reset_ = files::Descriptor();
}

std::uint64_t PeakMeter::since_mark() {
  const std::lock_guard lock(mutex_);
  return reset_ ? read() : 0;
}

std::uint64_t PeakMeter::whole() {
  const std::lock_guard lock(mutex_);
  read();
  return whole_;
}

std::uint64_t PeakMeter::read() {
  std::array<char, 4096> text{};
  if (!status_ || ::pread(status_.get(), text.data(), text.size() - 1, 0) <= 0) return 0;
  constexpr std::string_view kKey = "VmHWM:";
  const char* found = std::strstr(text.data(), kKey.data());
  if (found == nullptr) return 0;
  const char* digits = found + kKey.size();
  digits += std::strspn(digits, " \t");
  std::uint64_t kilobytes = 0;
  std::from_chars(digits, text.data() + text.size(), kilobytes);
  whole_ = std::max(whole_, kilobytes * 1024U);
  return kilobytes * 1024U;
}

}  // namespace velum::run
