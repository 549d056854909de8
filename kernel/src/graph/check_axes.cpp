// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "graph/study_reader.hpp"

namespace velum::graph {
namespace {

class AxesCheck : public StudyReader {
 public:
  AxesCheck(const Check& check, const std::vector<Axis>& axes,
            const std::vector<toml::Region>& places)
      : StudyReader(check), axes_(axes), places_(places) {}

  void names() const {
    constexpr std::array<std::string_view, 5> kColumns = {"variant", "repeat", "seed", "status",
                                                          "message"};
    std::map<std::string, std::size_t> known;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const std::string& name = axes_[a].name;
      if (!known.emplace(name, a).second)
        refuse(a, fmt::format("two axes are called '{}'", name), "give one of them a title");
      else if (std::ranges::find(kColumns, name) != kColumns.end())
        refuse(a, fmt::format("an axis cannot be called '{}': study.csv has that column", name),
               "give it another title");
    }
  }

  /// The later axis would win without a word.
  void what_varies() const {
    std::map<std::string, std::size_t> known;  // "node" or "node.parameter" and its axis
    for (std::size_t a = 0; a < axes_.size(); ++a)
      for (const Choice& choice : axes_[a].choices)
        for (const std::string& target : targets(choice.variation))
          if (const auto [other, fresh] = known.emplace(target, a); !fresh && other->second != a) {
            refuse(a,
                   fmt::format("axis '{}' and axis '{}' both vary '{}'", axes_[other->second].name,
                               axes_[a].name, target),
                   "take one of them away");
            return;
          }
  }

 private:
  static std::vector<std::string> targets(const Variation& variation) {
    std::vector<std::string> all;
    for (const auto& alternative : variation.alternatives) all.push_back(alternative.node);
    for (const auto& value : variation.values) all.push_back(value.node + "." + value.parameter);
    return all;
  }

  void refuse(std::size_t axis, const std::string& message, const std::string& hint) const {
    report().error("E0601", places_[axis], message, hint);
  }

  const std::vector<Axis>& axes_;
  const std::vector<toml::Region>& places_;
};

}  // namespace

void check_axes(const Check& check, const std::vector<Axis>& axes,
                const std::vector<toml::Region>& places) {
  const AxesCheck axes_check(check, axes, places);
  axes_check.names();
  axes_check.what_varies();
}

}  // namespace velum::graph
