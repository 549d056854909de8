// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/settings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "velum/error.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

/// Reads one value of one parameter; `name` is how messages call it: "pairs[0].source".
class Parser {
 public:
  Parser(const Parameter& parameter, std::string name, const Units& units, const Reporter& report)
      : parameter_(parameter), name_(std::move(name)), units_(units), report_(report) {}

  [[nodiscard]] Setting parse(const toml::Node& value) const {
    const bool listed = parameter_.list || parameter_.type == ParameterType::rows;
    return listed ? list(value) : single(value);
  }

 private:
  [[nodiscard]] std::string called() const {
    return fmt::format("'{}'{}{}", name_, report_.subject().empty() ? "" : " ", report_.subject());
  }

  Setting wrong_type(const toml::Node& value, std::string hint = "") const {
    report_.error("E0204", value.where,
                  fmt::format("{} is {}; expected {}", called(), article(value.kind),
                              describe_type(parameter_)),
                  std::move(hint));
    return {};
  }

  static std::string article(Kind kind) {
    const std::string_view name = name_of(kind);
    const bool vowel = name.front() == 'a' || name.front() == 'i';
    return fmt::format("{} {}", vowel ? "an" : "a", name);
  }

  [[nodiscard]] Setting list(const toml::Node& value) const {
    if (!value.is(Kind::array)) return wrong_type(value, "put it in [ ]");
    Parameter one = parameter_;
    one.list = false;
    Setting::List entries;
    bool good = true;
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      const Parser parser(one, fmt::format("{}[{}]", name_, i), units_, report_);
      const toml::Node& item = value.items[i];
      Setting entry =
          parameter_.type == ParameterType::rows ? parser.row(item) : parser.single(item);
      good = good && entry.is_set();
      entries.push_back(std::move(entry));
    }
    return good ? Setting{std::move(entries)} : Setting{};
  }

  [[nodiscard]] Setting row(const toml::Node& value) const {
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
      cells.push_back(Parser(field, name, units_, report_).parse(entry->value));
      good = good && cells.back().is_set();
    }
    return good ? Setting{std::move(cells)} : Setting{};
  }

  [[nodiscard]] bool only_fields(const toml::Node& value) const {
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

  [[nodiscard]] std::string example_row() const {
    std::vector<std::string> fields;
    for (const Parameter& field : parameter_.fields) fields.push_back(field.name + " = ...");
    return fmt::format("{{ {} }}", fmt::join(fields, ", "));
  }

  [[nodiscard]] Setting single(const toml::Node& value) const {
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

  [[nodiscard]] Setting integer(const toml::Node& value) const {
    if (!value.is(Kind::integer))
      return wrong_type(value, value.is(Kind::number) ? "write it without a point" : "");
    if (!in_range(static_cast<double>(value.integer), value)) return {};
    // Stages hold an integer in 32 bits unless its range says that it may be larger.
    constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
    const double high = parameter_.range.high;
    if ((value.integer >= -kLargest && value.integer <= kLargest) ||
        (std::isfinite(high) && high > static_cast<double>(kLargest)))
      return {value.integer};
    report_.error("E0206", value.where,
                  fmt::format("{} is {}; it must be between {} and {}", called(), value.integer,
                              -kLargest, kLargest));
    return {};
  }

  /// As a double; a text is a share ("50 %") or repeats the parameter's own unit ("3 points").
  [[nodiscard]] std::optional<double> number(const toml::Node& value) const {
    if (value.is(Kind::integer)) return static_cast<double>(value.integer);
    if (value.is(Kind::number)) return value.number;
    const auto amount = value.is(Kind::string) ? parse_amount(value.text) : std::nullopt;
    if (!amount) {
      wrong_type(value);
      return std::nullopt;
    }
    if (amount->unit.empty() || amount->unit == parameter_.unit) return amount->number;
    if (amount->unit == "%" && parameter_.unit.empty()) return amount->number / 100;
    const std::string unit = parameter_.unit.empty() ? "%" : parameter_.unit;
    unknown_unit(value, amount->unit, "this number", {unit});
    return std::nullopt;
  }

  void unknown_unit(const toml::Node& value, const std::string& unit, std::string_view of,
                    const std::vector<std::string>& known) const {
    report_.error("E0205", value.where,
                  fmt::format("{}: '{}' is no unit of {}", called(), unit, of),
                  did_you_mean(unit, known), known_list(known));
  }

  using Convert = std::optional<double> (*)(const Amount&);
  /// A bare number is in `bare`.
  [[nodiscard]] std::optional<double> quantity(const toml::Node& value, Convert convert,
                                               const std::vector<std::string>& known,
                                               std::string_view of, const char* bare) const {
    if (value.is(Kind::integer)) return convert({static_cast<double>(value.integer), bare});
    if (value.is(Kind::number)) return convert({value.number, bare});
    auto amount = value.is(Kind::string) ? parse_amount(value.text) : std::nullopt;
    if (!amount) {
      wrong_type(value);
      return std::nullopt;
    }
    if (amount->unit.empty()) amount->unit = bare;
    const auto result = convert(*amount);
    if (!result) unknown_unit(value, amount->unit, of, known);
    return result;
  }

  [[nodiscard]] Setting checked(std::optional<double> number, const toml::Node& value) const {
    if (!number || !in_range(*number, value)) return {};
    return {*number};
  }

  [[nodiscard]] Setting length(const toml::Node& value) const {
    const auto length = to_length(value, true);
    if (!length) return {};
    const bool relative = length->of != Length::Of::metres;
    // Of a relative length only the sign is known yet.
    const Range sign{.low = parameter_.range.low, .low_open = parameter_.range.low_open};
    if (relative && (parameter_.range.low < 0 || sign.contains(length->value) ||
                     (parameter_.range.low > 0 && length->value > 0)))
      return {*length};
    if (!in_range(length->value, value)) return {};
    return {*length};
  }

  [[nodiscard]] std::optional<Length> to_length(const toml::Node& value, bool relative) const {
    if (value.is(Kind::integer)) return bare_length(static_cast<double>(value.integer), value);
    if (value.is(Kind::number)) return bare_length(value.number, value);
    const auto amount = value.is(Kind::string) ? parse_amount(value.text) : std::nullopt;
    if (!amount) {
      wrong_type(value);
      return std::nullopt;
    }
    if (amount->unit.empty()) return bare_length(amount->number, value);
    const auto length = graph::to_length(*amount);
    if (length && (relative || length->of == Length::Of::metres)) return length;
    auto known = length_units();
    if (relative) known.insert(known.end(), relative_units().begin(), relative_units().end());
    unknown_unit(value, amount->unit, relative ? "length" : "a position", known);
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Length> bare_length(double number, const toml::Node& value) const {
    if (units_.length) return Length(in_metres(number, *units_.length));
    report_.error("E0205", value.where, fmt::format("{}: {} has no unit", called(), number),
                  fmt::format("write \"{} mm\", or units = \"mm\" at the top of the file", number));
    return std::nullopt;
  }

  [[nodiscard]] Setting triple(const toml::Node& value) const {
    const bool point = parameter_.type == ParameterType::point;
    if (!value.is(Kind::array)) return wrong_type(value);
    if (value.items.size() != 3) {
      report_.error("E0204", value.where,
                    fmt::format("{} has {} entries; expected {}", called(), value.items.size(),
                                describe_type(parameter_)));
      return {};
    }
    Setting::List entries;
    for (const toml::Node& item : value.items) {
      std::optional<double> entry;
      if (!point)
        entry = number(item);
      else if (const auto length = to_length(item, false))
        entry = length->value;
      if (!entry || !in_range(*entry, item)) return {};
      entries.push_back({*entry});
    }
    return {std::move(entries)};
  }

  [[nodiscard]] Setting text(const toml::Node& value) const {
    if (!value.is(Kind::string)) return wrong_type(value, bare_word_hint(value));
    switch (parameter_.type) {
      case ParameterType::choice:
        return one_of(value, choice_names());
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

  static std::string bare_word_hint(const toml::Node& value) {
    return value.is(Kind::integer) || value.is(Kind::boolean) ? "put it in quotes" : "";
  }

  [[nodiscard]] std::vector<std::string> choice_names() const {
    std::vector<std::string> names;
    for (const ChoiceOption& option : parameter_.choices) names.push_back(option.name);
    return names;
  }

  [[nodiscard]] Setting one_of(const toml::Node& value,
                               const std::vector<std::string>& known) const {
    if (std::ranges::find(known, value.text) != known.end()) return {value.text};
    report_.error("E0208", value.where, fmt::format("{} cannot be '{}'", called(), value.text),
                  did_you_mean(value.text, known), known_list(known));
    return {};
  }

  [[nodiscard]] bool in_range(double x, const toml::Node& value) const {
    const bool finite = std::isfinite(x);
    if (finite && parameter_.range.contains(x)) return true;
    const std::string found = value.is(Kind::string)    ? fmt::format("\"{}\"", value.text)
                              : value.is(Kind::integer) ? fmt::format("{}", value.integer)
                                                        : fmt::format("{}", value.number);
    report_.error("E0206", value.where,
                  fmt::format("{} is {}; it must be {}", called(), found,
                              finite ? describe(parameter_, parameter_.range) : "a finite number"));
    return false;
  }

  const Parameter& parameter_;
  std::string name_;
  const Units& units_;
  const Reporter& report_;
};

}  // namespace

Setting parse_setting(const Parameter& parameter, const toml::Node& value, const Units& units,
                      const Reporter& report) {
  return Parser(parameter, parameter.name, units, report).parse(value);
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
