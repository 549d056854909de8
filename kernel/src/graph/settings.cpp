// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/settings.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "graph/setting_parser.hpp"
#include "velum/error.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

std::string article(Kind kind) {
  const std::string_view name = name_of(kind);
  const bool vowel = name.front() == 'a' || name.front() == 'i';
  return fmt::format("{} {}", vowel ? "an" : "a", name);
}

std::string bare_word_hint(const toml::Node& value) {
  return value.is(Kind::integer) || value.is(Kind::boolean) ? "put it in quotes" : "";
}

std::vector<std::string> choice_names(const Parameter& parameter) {
  std::vector<std::string> names;
  for (const ChoiceOption& option : parameter.choices) names.push_back(option.name);
  return names;
}

}  // namespace

std::string SettingParser::called() const {
  return fmt::format("'{}'{}{}", name_, report_.subject().empty() ? "" : " ", report_.subject());
}

Setting SettingParser::wrong_type(const toml::Node& value, std::string hint) const {
  report_.error("E0204", value.where,
                fmt::format("{} is {}; expected {}", called(), article(value.kind),
                            describe_type(parameter_)),
                std::move(hint));
  return {};
}

Setting SettingParser::list(const toml::Node& value) const {
  if (!value.is(Kind::array)) return wrong_type(value, "put it in [ ]");
  Parameter one = parameter_;
  one.list = false;
  Setting::List entries;
  bool good = true;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const SettingParser parser(one, fmt::format("{}[{}]", name_, i), units_, report_);
    const toml::Node& item = value.items[i];
    Setting entry = parameter_.type == ParameterType::rows ? parser.row(item) : parser.single(item);
    good = good && entry.is_set();
    entries.push_back(std::move(entry));
  }
  return good ? Setting{std::move(entries)} : Setting{};
}

Setting SettingParser::row(const toml::Node& value) const {
  if (!value.is(Kind::table)) {
    report_.error("E0204", value.where,
                  fmt::format("{} is {}; expected a table such as {}", called(),
                              article(value.kind), example_row()));
    return {};
  }
  bool good = only_fields(value);
  Setting::List cells;
  for (const Parameter& field : parameter_.fields) {
    const toml::Entry* entry = value.find(field.name);
    const std::string name = fmt::format("{}.{}", name_, field.name);
    if (entry == nullptr) {
      if (field.required) {
        report_.error("E0207", value.where, fmt::format("{} lacks '{}'", called(), field.name));
        good = false;
      }
      cells.push_back(field.initial);
      continue;
    }
    cells.push_back(SettingParser(field, name, units_, report_).parse(entry->value));
    good = good && cells.back().is_set();
  }
  return good ? Setting{std::move(cells)} : Setting{};
}

bool SettingParser::only_fields(const toml::Node& value) const {
  std::vector<std::string> known;
  for (const Parameter& field : parameter_.fields) known.push_back(field.name);
  bool good = true;
  for (const toml::Entry& entry : value.entries) {
    if (std::ranges::find(known, entry.key) != known.end()) continue;
    report_.error("E0202", entry.where, fmt::format("{}: unknown key '{}'", called(), entry.key),
                  did_you_mean(entry.key, known), known_list(known));
    good = false;
  }
  return good;
}

std::string SettingParser::example_row() const {
  std::vector<std::string> fields;
  for (const Parameter& field : parameter_.fields) fields.push_back(field.name + " = ...");
  return fmt::format("{{ {} }}", fmt::join(fields, ", "));
}

Setting SettingParser::single(const toml::Node& value) const {
  switch (parameter_.type) {
    case ParameterType::boolean:
      return value.is(Kind::boolean) ? Setting{value.boolean} : wrong_type(value);
    case ParameterType::integer:
      return integer(value);
    case ParameterType::number:
      return checked(number(value), value);
    case ParameterType::angle:
      return checked(quantity(value, to_angle, angle_units(), "an angle", "deg"), value);
    case ParameterType::duration:
      return checked(quantity(value, to_duration, duration_units(), "time", "s"), value);
    case ParameterType::length:
      return length(value);
    case ParameterType::vector:
    case ParameterType::point:
      return triple(value);
    case ParameterType::rows:
      return row(value);
    default:
      return text(value);
  }
}

Setting SettingParser::text(const toml::Node& value) const {
  if (!value.is(Kind::string)) return wrong_type(value, bare_word_hint(value));
  switch (parameter_.type) {
    case ParameterType::choice:
      return one_of(value, choice_names(parameter_));
    case ParameterType::length_unit:
      return one_of(value, length_units());
    case ParameterType::input_file:
    case ParameterType::output_file:
      if (!value.text.empty() && value.text.find('\0') == std::string::npos) break;
      report_.error("E0204", value.where, fmt::format("{} is no name of a file", called()));
      return {};
    default:
      break;
  }
  return {value.text};
}

Setting SettingParser::one_of(const toml::Node& value,
                              const std::vector<std::string>& known) const {
  if (std::ranges::find(known, value.text) != known.end()) return {value.text};
  report_.error("E0208", value.where, fmt::format("{} cannot be '{}'", called(), value.text),
                did_you_mean(value.text, known), known_list(known));
  return {};
}

Setting parse_setting(const Parameter& parameter, const toml::Node& value, const Units& units,
                      const Reporter& report) {
  return SettingParser(parameter, parameter.name, units, report).parse(value);
}

Setting parse_setting_text(const Parameter& parameter, std::string_view text) {
  Diagnostics diagnostics;
  const Source source{std::string(text), std::string(text)};
  const Units metres{length_unit("m")};
  Setting setting =
      parse_setting(parameter, toml::parse_value(text), metres, Reporter(diagnostics, source));
  if (diagnostics.empty()) return setting;
  const Diagnostic& first = diagnostics.front();
  std::string hint = first.hint;
  if (!first.known.empty()) hint += (hint.empty() ? "" : "; ") + first.known;
  throw Error(Fault::graph, first.message).hint(hint);
}

}  // namespace velum::graph
