// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <span>
#include <system_error>

#include "files/descriptor.hpp"

namespace velum::app {
namespace {

int standard_output = STDOUT_FILENO;

std::atomic<int> failed_output = 0;  // errno of the first write that failed

int put(int descriptor, std::string_view text) {
  try {
    files::write_fully(descriptor, std::as_bytes(std::span(text)));
    return 0;
  } catch (const std::system_error& error) {
    return error.code().value();
  }
}

// A closed descriptor would be given to the next file that is opened, which would then get what is
// printed.
void fill_standard_descriptors() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
}

}  // namespace

void take_standard_output() {
  fill_standard_descriptors();
  // A reader that goes away and a file that may not grow are errors of the write.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const int kept = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return;
  standard_output = kept;
}

void print(std::string_view text) {
  const int failed = put(standard_output, text);
  // A pipe's reader may have what it wanted.
  if (failed != 0 && failed != EPIPE && failed_output == 0) failed_output = failed;
}

void check_output() {
  if (failed_output != 0)
    throw Error(Fault::output,
                "standard output cannot be written: " + files::reason(failed_output));
}

bool on_terminal() {
  return ::isatty(standard_output) == 1;
}

void complain(std::string_view text) {
  put(STDERR_FILENO, text);
}

std::string format(const Error& error) {
  std::string text = "error: " + std::string(error.what()) + "\n";
  if (!error.where().empty()) text += "  at " + error.where() + "\n";
  if (!error.hint().empty()) text += "  " + error.hint() + "\n";
  return text;
}

}  // namespace velum::app
