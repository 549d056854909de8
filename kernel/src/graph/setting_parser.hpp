// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/settings.hpp"

namespace velum::graph {

/// Reads one value of one parameter; `name` is how messages call it: "pairs[0].source".
class SettingParser {
 public:
  SettingParser(const Parameter& parameter, std::string name, const Units& units,
                const Reporter& report)
      : parameter_(parameter), name_(std::move(name)), units_(units), report_(report) {}

  [[nodiscard]] Setting parse(const toml::Node& value) const {
    const bool listed = parameter_.list || parameter_.type == ParameterType::rows;
    return listed ? list(value) : single(value);
  }

 private:
  using Kind = toml::Kind;

  [[nodiscard]] std::string called() const;
  Setting wrong_type(const toml::Node& value, std::string hint = "") const;
  [[nodiscard]] Setting list(const toml::Node& value) const;
  [[nodiscard]] Setting row(const toml::Node& value) const;
  [[nodiscard]] bool only_fields(const toml::Node& value) const;
  [[nodiscard]] std::string example_row() const;
  [[nodiscard]] Setting single(const toml::Node& value) const;
  [[nodiscard]] Setting text(const toml::Node& value) const;
  [[nodiscard]] Setting one_of(const toml::Node& value,
                               const std::vector<std::string>& known) const;

  // Numbers, with and without units.
  [[nodiscard]] Setting integer(const toml::Node& value) const;
  /// As a double; a text is a share ("50 %") or repeats the parameter's own unit ("3 points").
  [[nodiscard]] std::optional<double> number(const toml::Node& value) const;
  void unknown_unit(const toml::Node& value, const std::string& unit, std::string_view of,
                    const std::vector<std::string>& known) const;
  using Convert = std::optional<double> (*)(const Amount&);
  /// A bare number is in `bare`.
  [[nodiscard]] std::optional<double> quantity(const toml::Node& value, Convert convert,
                                               const std::vector<std::string>& known,
                                               std::string_view of, const char* bare) const;
  [[nodiscard]] Setting checked(std::optional<double> number, const toml::Node& value) const;
  [[nodiscard]] Setting length(const toml::Node& value) const;
  [[nodiscard]] std::optional<Length> to_length(const toml::Node& value, bool relative) const;
  [[nodiscard]] std::optional<Length> bare_length(double number, const toml::Node& value) const;
  [[nodiscard]] Setting triple(const toml::Node& value) const;
  [[nodiscard]] bool in_range(double x, const toml::Node& value) const;

  const Parameter& parameter_;
  std::string name_;
  const Units& units_;
  const Reporter& report_;
};

}  // namespace velum::graph
