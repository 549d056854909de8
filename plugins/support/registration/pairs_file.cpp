// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/pairs_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "formats/numbers.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::registration {
namespace {

constexpr std::uint64_t kLargest = std::uint64_t{1} << 26U;

bool separates(char c) {
  return formats::is_blank(c) || c == ',' || c == ';';
}

/// The numbers of a line; empty when one of its words is none.
std::vector<double> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  while (true) {
    while (!line.empty() && separates(line.front())) line.remove_prefix(1);
    if (line.empty()) return numbers;
    std::size_t length = 0;
    while (length < line.size() && !separates(line[length])) ++length;
    const auto number = formats::as_real(line.substr(0, length));
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
    line.remove_prefix(length);
  }
}

}  // namespace

std::vector<PickedPair> read_pairs(const std::filesystem::path& file, double unit) {
  const FileContent content(file, kLargest);
  std::string_view text = content.text();
  std::vector<PickedPair> pairs;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = formats::trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::vector<double> n = numbers_of(line);
    if (n.empty() && number == 1) continue;
    if (n.size() != 6)
      throw Error(
          Fault::input,
          n.empty()
              ? std::string("found something that is no finite number, expected six")
              : fmt::format("found {} numbers, expected six: source x y z, target x y z", n.size()))
          .at(fmt::format("{}:{}", file.string(), number));
    pairs.push_back(
        {{unit * Eigen::Vector3d(n[0], n[1], n[2])}, {unit * Eigen::Vector3d(n[3], n[4], n[5])}});
  }
  return pairs;
}

}  // namespace velum::registration
