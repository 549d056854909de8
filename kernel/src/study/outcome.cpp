// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/outcome.hpp"

#include <algorithm>
#include <array>

#include "run/record.hpp"

namespace velum::study {
namespace {

constexpr std::array<std::string_view, 7> kNames = {
    "ok", "failed", "empty", "invalid", "crashed", "timed_out", "out_of_memory"};

template <class Enum, std::size_t N>
Enum named(const std::string& name, const std::array<std::string_view, N>& names) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw std::out_of_range("no status '" + name + "'");
  return static_cast<Enum>(found - names.begin());
}

}  // namespace

std::string_view name_of(Status status) {
  return kNames.at(static_cast<std::size_t>(status));
}

run::Json to_json(const Outcome& outcome) {
  run::Json figures = run::Json::object();
  for (const auto& [name, figure] : outcome.figures)
    figures[name] = {
        {"value", figure.value}, {"unit", figure.unit}, {"better", run::name_of(figure.better)}};
  return {{"status", name_of(outcome.status)}, {"message", outcome.message},
          {"figures", std::move(figures)},     {"source", outcome.source},
          {"seconds", outcome.seconds},        {"peak_bytes", outcome.peak_bytes}};
}

Outcome outcome_from_json(const run::Json& json) {
  constexpr std::array<std::string_view, 3> kBetter = {"lower", "higher", "neither"};
  Outcome outcome;
  outcome.status = named<Status>(json.at("status").get<std::string>(), kNames);
  outcome.message = json.at("message").get<std::string>();
  for (const auto& [name, figure] : json.at("figures").items())
    // What is not finite is null in JSON.
    outcome.figures[name] = {figure.at("value").is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                          : figure.at("value").get<double>(),
                             figure.at("unit").get<std::string>(),
                             named<Better>(figure.at("better").get<std::string>(), kBetter)};
  outcome.source = json.at("source").get<std::string>();
  outcome.seconds = json.at("seconds").get<double>();
  outcome.peak_bytes = json.at("peak_bytes").get<std::uint64_t>();
  return outcome;
}

}  // namespace velum::study
