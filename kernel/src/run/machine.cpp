// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/machine.hpp"

#include <fcntl.h>
#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <array>
#include <span>
#include <string_view>
#include <system_error>

#include "files/descriptor.hpp"
#include "run/local_context.hpp"

namespace velum::run {
namespace {

// The start of a small system file; enough for what is looked for, as /proc/cpuinfo takes long to
// make where there are many cores.
std::string head_of(const char* path) {
  const files::Descriptor file(::open(path, O_RDONLY | O_CLOEXEC));
  std::array<char, 2048> text{};
  if (!file) return "";
  try {
    return {text.data(), files::read_fully(file.get(), std::as_writable_bytes(std::span(text)))};
  } catch (const std::system_error&) {
    return "";
  }
}

// What stands behind `key` and the separator, to the end of the line, without quotes.
std::string value_of(std::string_view text, std::string_view key, char separator) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return "unknown";
  const std::size_t begin = text.find(separator, at);
  if (begin == std::string_view::npos) return "unknown";
  std::string_view value = text.substr(begin + 1, text.find('\n', begin) - begin - 1);
  while (!value.empty() && (value.front() == ' ' || value.front() == '"')) value.remove_prefix(1);
  while (!value.empty() && (value.back() == ' ' || value.back() == '"')) value.remove_suffix(1);
  return std::string(value);
}

}  // namespace

std::string instruction_set() {
#if defined(__x86_64__)
  std::string set = "x86-64";
  if (__builtin_cpu_supports("sse4.2")) set += " sse4.2";
  if (__builtin_cpu_supports("avx")) set += " avx";
  if (__builtin_cpu_supports("avx2")) set += " avx2";
  if (__builtin_cpu_supports("fma")) set += " fma";
  if (__builtin_cpu_supports("avx512f")) set += " avx512f";
  return set;
#else
  struct utsname names = {};
  return ::uname(&names) == 0 ? names.machine : "unknown";
#endif
}

Json machine() {
  struct utsname names = {};
  ::uname(&names);
  struct sysinfo system = {};
  ::sysinfo(&system);
  return {{"cpu", value_of(head_of("/proc/cpuinfo"), "model name", ':')},
          {"cores", default_threads()},
          {"instruction_set", instruction_set()},
          {"os", value_of(head_of("/etc/os-release"), "PRETTY_NAME", '=')},
          {"kernel", std::string(names.sysname) + " " + names.release},
          {"memory_bytes", std::uint64_t{system.totalram} * system.mem_unit}};
}

}  // namespace velum::run
