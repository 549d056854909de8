// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace bench {
namespace {

constexpr const char* kNothing = "–";

std::string milliseconds(double seconds) {
  const double ms = 1e3 * seconds;
  return ms < 10.0 ? fmt::format("{:.2f}", ms) : fmt::format("{:.{}f}", ms, ms < 100.0 ? 1 : 0);
}

std::string ours(const Contender& contender, const Input& input, double seconds) {
  if (contender.file.empty()) return milliseconds(seconds);
  const auto bytes =
      static_cast<double>(std::filesystem::file_size(input.folder + "/" + contender.file));
  return fmt::format("{} ({:.0f} MB/s)", milliseconds(seconds), 1e-6 * bytes / seconds);
}

std::string ratio(double theirs, double ours) {
  return std::isnan(ours) ? milliseconds(theirs) + " ms" : fmt::format("{:.2f}", theirs / ours);
}

std::string joined(const std::vector<std::string>& cells) {
  return fmt::format("{}", fmt::join(cells, " / "));
}

}  // namespace

Tables::Row& Tables::row(const std::string& kind, const std::string& operation) {
  auto group = std::find_if(kinds_.begin(), kinds_.end(), [&](auto& k) { return k.name == kind; });
  if (group == kinds_.end()) group = kinds_.insert(kinds_.end(), Kind{kind, {}});
  auto& rows = group->rows;
  auto found =
      std::find_if(rows.begin(), rows.end(), [&](auto& r) { return r.operation == operation; });
  if (found == rows.end()) found = rows.insert(rows.end(), Row{operation, {}, {}});
  return *found;
}

void Tables::add(const std::string& kind, const Input& input, const Contenders& contenders,
                 const std::vector<double>& seconds) {
  const auto place = std::find(sizes_.begin(), sizes_.end(), input.cloud.size()) - sizes_.begin();
  Row& row = this->row(kind, contenders.front().operation);
  std::string shown;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const Contender& contender = contenders[i];
    if (row.by_name.count(contender.name) == 0) {
      row.names.push_back(contender.name);
      row.by_name[contender.name].resize(sizes_.size(), kNothing);
    }
    std::string& cell = row.by_name[contender.name][static_cast<std::size_t>(place)];
    if (std::isnan(seconds[i]))
      cell = "refused";
    else
      cell = i == 0 ? ours(contender, input, seconds[0]) : ratio(seconds[i], seconds[0]);
    shown += fmt::format("{} {}{}", i > 0 ? "," : "", contender.name + " ", cell);
  }
  fmt::print(stderr, "{} points, {}:{}\n", input.cloud.size(), row.operation, shown);
}

void Tables::append(std::string& text, const Row& row) const {
  std::vector<std::string> others;
  for (std::size_t i = 1; i < row.names.size(); ++i)
    others.push_back(row.names[i] + " " + joined(row.by_name.at(row.names[i])));
  text += fmt::format("| {} | {} | {} |\n", row.operation, joined(row.by_name.at(row.names[0])),
                      fmt::join(others, "; "));
}

std::string Tables::text() const {
  std::vector<std::string> sizes;
  for (const velum::Index size : sizes_) sizes.push_back(fmt::format("{}", size));
  std::string text = fmt::format("Sizes: {} points.\n", joined(sizes));
  for (const Kind& kind : kinds_) {
    text += fmt::format(
        "\n### {}\n\n| operation | Velum [ms] | the others' time / ours |\n|---|--:|---|\n",
        kind.name);
    for (const Row& row : kind.rows) append(text, row);
  }
  return text;
}

}  // namespace bench
