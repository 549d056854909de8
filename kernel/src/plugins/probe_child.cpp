// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What runs in the child process that tries a plugin.
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>
#include <nlohmann/json.hpp>

#include "plugins/library.hpp"
#include "plugins/probe.hpp"
#include "plugins/registry.hpp"
#include "velum/error.hpp"

namespace velum::plugins {
namespace {

int answer_to = -1;

void answer(const nlohmann::json& json) {
  const std::string text =
      json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
  const char* at = text.data();
  for (std::size_t left = text.size(); left > 0;) {
    const ssize_t put = ::write(answer_to, at, left);
    if (put <= 0 && errno != EINTR) return;
    if (put > 0) {
      at += put;
      left -= static_cast<std::size_t>(put);
    }
  }
}

/// Names what a static constructor threw, for which the run-time ends the process.
[[noreturn]] void on_terminate() {
  std::string thrown;
  try {
    if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::exception& error) {
    thrown = error.what();
  } catch (...) {
    thrown = "something that is not a std::exception";
  }
  if (!thrown.empty()) answer({{"thrown", thrown}});
  ::_exit(1);
}

/// The child dies quietly and at once, whatever a sanitizer or library has set up.
void make_plain() {
  const rlimit none = {0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP})
    ::signal(signal, SIG_DFL);
  std::set_terminate(on_terminate);
}

}  // namespace

int probe_child(const char* file, int out) {
  answer_to = out;
  make_plain();
  try {
    answer({{"summary", open_stage(file).info().summary}});
  } catch (const Error& error) {
    answer({{"refused", one_line(error)}});
  }
  // Neither static destructors nor leak checks: they are the plugin's, and it was only looked at.
  ::_exit(0);
}

}  // namespace velum::plugins
