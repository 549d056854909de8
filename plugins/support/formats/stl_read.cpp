// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <unordered_map>

#include "formats/lines.hpp"
#include "formats/polygons.hpp"
#include "formats/stl.hpp"

namespace velum::formats {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kTriangle = 50;
constexpr std::size_t kTrianglesBetweenChecks = std::size_t{1} << 18U;

/// Corners as they come, each coordinate once.
class Merger {
 public:
  void add(const std::array<float, 3>& place) {
    Key key{};
    for (std::size_t a = 0; a < 3; ++a) key[a] = std::bit_cast<std::uint32_t>(place[a] + 0.0F);
    const auto [found, added] = known_.emplace(key, static_cast<std::int32_t>(known_.size()));
    if (added) places_.insert(places_.end(), place.begin(), place.end());
    polygons_.corners.push_back(found->second);
  }

  Mesh mesh(const Source& source, const ReadOptions& options, Context& context) const {
    if (places_.empty()) return {};
    Records records;
    records.count = static_cast<Index>(places_.size() / 3);
    const auto* data = reinterpret_cast<const std::byte*>(places_.data());  // NOLINT
    for (std::size_t a = 0; a < 3; ++a)
      records.fields.push_back({std::string(1, static_cast<char>('x' + a)), FieldType::f32, 1,
                                data + a * sizeof(float), 3 * sizeof(float)});
    return make_mesh(source, assemble(source, records, options, NotFinite::refuse, context),
                     polygons_, options, context);
  }

 private:
  using Key = std::array<std::uint32_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = key[0];
      hash = hash * 0x9E3779B97F4A7C15U + key[1];
      hash = (hash ^ hash >> 29U) * 0x9E3779B97F4A7C15U + key[2];
      return (hash ^ hash >> 32U) * 0x9E3779B97F4A7C15U >> 8U;
    }
  };
  std::unordered_map<Key, std::int32_t, Hash> known_;
  std::vector<float> places_;
  Polygons polygons_;
};

void read_binary(const Source& source, Merger& merger, Context& context) {
  const std::size_t count = (source.size() - kHeader) / kTriangle;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kTrianglesBetweenChecks == 0) context.check();
    const std::byte* corner = source.bytes().data() + kHeader + i * kTriangle + 12;
    for (int c = 0; c < 3; ++c, corner += 12)
      merger.add({load<float>(corner, false), load<float>(corner + 4, false),
                  load<float>(corner + 8, false)});
  }
}

/// Reads the text line by line; what a line must be follows from the one before.
class TextReader {
 public:
  TextReader(const Source& source, Merger& merger, Context& context)
      : source_(source), merger_(merger), context_(context) {}

  void read() {
    std::string_view rest = source_.text();
    for (std::size_t number = 0; !rest.empty(); ++number) {
      if (number % kTrianglesBetweenChecks == 0) context_.check();
      std::string_view line = take_line(rest);
      const std::string_view whole = line;
      const std::string word = lower(take_word(line));
      if (!word.empty()) read_line(whole, word, line);
    }
    if (state_ != State::outside)
      throw source_.bad_line(source_.size(), "the file ends within a solid");
    if (!solids_) throw source_.bad_line(0, "no solid");
  }

 private:
  enum class State { outside, solid, facet, loop, looped };

  void read_line(std::string_view whole, const std::string& word, std::string_view rest) {
    if (word == "solid")
      step(whole, State::outside, State::solid, "solid");
    else if (word == "facet")
      step(whole, State::solid, State::facet, "facet");
    else if (word == "outer")
      step(whole, State::facet, State::loop, "outer loop");
    else if (word == "vertex")
      read_vertex(whole, rest);
    else if (word == "endloop")
      end_loop(whole);
    else if (word == "endfacet")
      step(whole, State::looped, State::solid, "endfacet");
    else if (word == "endsolid")
      step(whole, State::solid, State::outside, "endsolid");
    else
      throw source_.bad_line(whole, "found " + quote(trimmed(whole)) +
                                        ", expected a line of a text "
                                        "STL");
    solids_ = true;
  }

  void step(std::string_view line, State from, State to, std::string_view word) {
    if (state_ != from)
      throw source_.bad_line(line, fmt::format("'{}' where it must not be", word));
    state_ = to;
  }

  void read_vertex(std::string_view line, std::string_view rest) {
    std::array<float, 3> place{};
    for (float& value : place) {
      const std::string_view word = take_word(rest);
      const char* end = word.data() + word.size();
      if (word.empty() || parse_real(word.data(), end, value) != end)
        throw source_.bad_line(
            line, "found " + quote(trimmed(line)) + ", expected 'vertex' and three numbers");
    }
    if (!trimmed(rest).empty() || state_ != State::loop || ++corners_ > 3)
      throw source_.bad_line(line,
                             "a vertex with more than three numbers, or not one of the three in "
                             "an outer loop");
    merger_.add(place);
  }

  void end_loop(std::string_view line) {
    if (corners_ != 3) throw source_.bad_line(line, fmt::format("a loop of {} vertices", corners_));
    corners_ = 0;
    step(line, State::loop, State::looped, "endloop");
  }

  const Source& source_;
  Merger& merger_;
  Context& context_;
  State state_ = State::outside;
  int corners_ = 0;
  bool solids_ = false;
};

}  // namespace

Mesh read_stl(const Source& source, const ReadOptions& options, Context& context) {
  Merger merger;
  const bool binary =
      source.size() >= kHeader &&
      source.size() ==
          kHeader + kTriangle * std::size_t{load<std::uint32_t>(source.bytes().data() + 80, false)};
  if (binary)
    read_binary(source, merger, context);
  else
    TextReader(source, merger, context).read();
  return merger.mesh(source, options, context);
}

}  // namespace velum::formats
