// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/session.hpp"

#include <fmt/format.h>

#include <optional>

namespace velum::lms511 {
namespace {

// The kind of telegram that answers a request: sRN by sRA, sMN by sAN.
std::string answer_to(std::string_view request) {
  std::string kind(request.substr(0, 3));
  if (kind == "sMN") return "sAN";
  kind[2] = 'A';
  return kind;
}

}  // namespace

std::size_t Session::pump(double seconds) {
  constexpr std::uint64_t kMostGarbage = std::uint64_t{4} << 20U;
  framer_.feed(socket_.receive(seconds, interrupt_));
  std::size_t count = 0;
  while (const auto telegram = framer_.next()) {
    ++count;
    events_(*telegram);
  }
  if (framer_.counts().telegrams == 0 && framer_.counts().skipped_bytes > kMostGarbage)
    throw ConnectionLost("the peer sends much, and nothing of it is a telegram");
  return count;
}

Answer Session::ask(const Writer& request, double seconds) {
  const std::string& payload = request.payload();
  const std::string kind = answer_to(payload);
  const std::string_view rest = std::string_view(payload).substr(4);
  const std::string name(rest.substr(0, rest.find(' ')));
  socket_.send(request.frame(), seconds, interrupt_);
  const auto end = SteadyClock::now() + std::chrono::duration<double>(seconds);
  std::optional<Answer> answer;
  while (!answer) {
    const std::chrono::duration<double> left = end - SteadyClock::now();
    if (left.count() <= 0.0)
      throw NoAnswer(fmt::format("no answer to {} within {:g} s", name, seconds));
    framer_.feed(socket_.receive(left.count(), interrupt_));
    while (const auto telegram = framer_.next()) {
      std::optional<Reader> reader;
      try {
        reader.emplace(*telegram);
      } catch (const Malformed&) {
        continue;
      }
      if (reader->error() && !answer)
        throw Refused(*reader->error(), fmt::format("{}: {}", name, in_words(*reader->error())));
      if (!answer && reader->kind() == kind && reader->name() == name)
        answer = Answer{telegram->dialect, std::string(telegram->payload)};
      else
        events_(*telegram);
    }
  }
  return *answer;
}

}  // namespace velum::lms511
