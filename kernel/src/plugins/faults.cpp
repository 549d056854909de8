// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The rules that every stage's description keeps.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "plugins/library.hpp"
#include "plugins/search.hpp"

namespace velum::plugins {
namespace {

class Rules {
 public:
  explicit Rules(const StageInfo& info) : info_(info) {}

  std::vector<std::string> broken() {
    if (info_.summary.empty()) fault("no summary");
    if (info_.version.empty()) fault("an empty version");
    if (info_.licence.empty()) fault("an empty licence");
    ports("input", info_.inputs);
    ports("output", info_.outputs);
    std::set<std::string> names = kNodeKeys;
    parameters("", info_.parameters, names);
    return std::move(faults_);
  }

 private:
  template <class... A>
  void fault(fmt::format_string<A...> text, A&&... values) {
    faults_.push_back(fmt::format(text, std::forward<A>(values)...));
  }

  void ports(std::string_view what, const std::vector<Port>& all) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Port& port = all[i];
      if (port.name.empty())
        fault("{} {} has no name (.in and .out name them)", what, i + 1);
      else if (!is_name(port.name))
        fault("{} '{}' is not in snake_case", what, port.name);
      else if (!names.insert(port.name).second)
        fault("two {}s are named '{}'", what, port.name);
      for (const ColumnRule& rule : port.columns) column_rule(port, rule);
    }
  }

  void column_rule(const Port& port, const ColumnRule& rule) {
    if (rule.column.empty()) fault("'{}' needs or adds a column without a name", port.name);
    if (rule.parameter.empty()) return;
    const Parameter* parameter = find(rule.parameter);
    if (parameter == nullptr)
      fault("column '{}' of '{}' depends on '{}', which is no parameter", rule.column, port.name,
            rule.parameter);
    else if (parameter->type == ParameterType::choice && !has_choice(*parameter, rule.value))
      fault("column '{}' of '{}' depends on '{}', which has no choice '{}'", rule.column, port.name,
            rule.parameter, rule.value);
  }

  void parameters(const std::string& prefix, const std::vector<Parameter>& all,
                  std::set<std::string>& names) {
    for (const Parameter& parameter : all) {
      const std::string name = prefix + parameter.name;
      if (!is_name(parameter.name)) fault("parameter '{}' is not in snake_case", name);
      if (!names.insert(parameter.name).second)
        fault("parameter '{}' is named twice or like a key of every node", name);
      for (const std::string& old : parameter.old_names)
        if (!names.insert(old).second) fault("old name '{}' of '{}' is in use", old, name);
      one(name, parameter);
      std::set<std::string> fields;
      parameters(name + ".", parameter.fields, fields);
    }
  }

  void one(const std::string& name, const Parameter& parameter) {
    if (parameter.doc.empty()) fault("parameter '{}' has no doc", name);
    if (!parameter.set) fault("parameter '{}' sets nothing", name);
    if (!parameter.relative_to.empty() && !has_input(parameter.relative_to))
      fault("parameter '{}' is relative to '{}', which is no input", name, parameter.relative_to);
    if (parameter.type == ParameterType::rows && parameter.fields.empty())
      fault("parameter '{}' has rows without fields", name);
    if (parameter.type == ParameterType::choice)
      choices(name, parameter);
    else if (!parameter.required)
      range(name, parameter, parameter.initial);
  }

  void choices(const std::string& name, const Parameter& parameter) {
    std::set<std::string> names;
    for (const ChoiceOption& choice : parameter.choices) {
      if (choice.doc.empty()) fault("choice '{}' of '{}' has no doc", choice.name, name);
      if (!names.insert(choice.name).second)
        fault("two choices of '{}' are named '{}'", name, choice.name);
    }
    if (names.empty())
      fault("parameter '{}' has no choices", name);
    else if (!parameter.required && !parameter.initial.is_set())
      fault("the default of '{}' is none of its choices", name);
  }

  /// Relative lengths are checked when the input is known; a factor has the same sign at least.
  void range(const std::string& name, const Parameter& parameter, const Setting& setting) {
    std::optional<double> number;
    if (const auto* integer = std::get_if<std::int64_t>(&setting.value))
      number = static_cast<double>(*integer);
    if (const auto* real = std::get_if<double>(&setting.value)) number = *real;
    if (const auto* length = std::get_if<Length>(&setting.value))
      if (length->of == Length::Of::metres) number = length->value;
    if (const auto* list = std::get_if<Setting::List>(&setting.value))
      for (const Setting& entry : *list) range(name, parameter, entry);
    if (number && !parameter.range.contains(*number))
      fault("the default of '{}', {}, is outside its range", name, *number);
  }

  [[nodiscard]] const Parameter* find(const std::string& name) const {
    const auto at = std::find_if(info_.parameters.begin(), info_.parameters.end(),
                                 [&](const Parameter& p) { return p.name == name; });
    return at == info_.parameters.end() ? nullptr : &*at;
  }
  static bool has_choice(const Parameter& parameter, const std::string& name) {
    return std::any_of(parameter.choices.begin(), parameter.choices.end(),
                       [&](const ChoiceOption& choice) { return choice.name == name; });
  }
  [[nodiscard]] bool has_input(const std::string& name) const {
    return std::any_of(info_.inputs.begin(), info_.inputs.end(),
                       [&](const Port& port) { return port.name == name; });
  }

  /// Keys of a node that no parameter may take.
  inline static const std::set<std::string> kNodeKeys = {"use",   "in",   "isolate", "allow_empty",
                                                         "cache", "seed", "limits",  "title"};
  const StageInfo& info_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> faults_of(const StageInfo& info) {
  return Rules(info).broken();
}

}  // namespace velum::plugins
