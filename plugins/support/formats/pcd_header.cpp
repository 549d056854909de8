// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/pcd_header.hpp"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <set>

#include "formats/lines.hpp"

namespace velum::formats {
namespace {

constexpr std::size_t kMostFields = 1000;
constexpr std::int64_t kMostValues = 100000;  // of one field

using Words = std::vector<std::string_view>;

struct Entry {
  std::string_view line;
  Words words;  // without the key
};

class HeaderReader {
 public:
  explicit HeaderReader(const Source& source) : source_(source) {}

  PcdHeader read() {
    read_entries();
    read_fields();
    read_count();
    read_viewpoint();
    return std::move(header_);
  }

 private:
  void read_entries() {
    std::string_view rest = source_.text();
    while (!rest.empty()) {
      const std::string_view line = take_line(rest);
      Words words = words_of(line);
      if (words.empty()) continue;
      if (words.front().starts_with('#')) {
        read_sensor_line(trimmed(line).substr(1), header_.sensors);
        continue;
      }
      std::string_view key = words.front();
      if (key == "COLUMNS") key = "FIELDS";
      if (!kKeys.contains(key))
        throw source_.bad_line(line, "found " + quote(words.front()) +
                                         ", expected an entry of a PCD header (VERSION, FIELDS, "
                                         "SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS or "
                                         "DATA)");
      words.erase(words.begin());
      if (!entries_.emplace(key, Entry{line, std::move(words)}).second)
        throw source_.bad_line(line, fmt::format("a second {} entry", key));
      if (key == "DATA") {
        header_.body = source_.size() - rest.size();
        return read_data_kind();
      }
    }
    throw Error(Fault::input, "the PCD header has no DATA entry").at(source_.name());
  }

  void read_data_kind() {
    const Entry& entry = entries_.at("DATA");
    const std::string_view kind = entry.words.size() == 1 ? entry.words[0] : "";
    if (kind == "ascii")
      header_.data = PcdHeader::Data::ascii;
    else if (kind == "binary")
      header_.data = PcdHeader::Data::binary;
    else if (kind == "binary_compressed")
      header_.data = PcdHeader::Data::compressed;
    else
      throw source_.bad_line(
          entry.line, "DATA is " + quote(kind) + ", expected ascii, binary or binary_compressed");
  }

  const Entry& need(std::string_view key) const {
    const auto found = entries_.find(key);
    if (found == entries_.end())
      throw Error(Fault::input, fmt::format("the PCD header has no {} entry", key))
          .at(source_.name());
    return found->second;
  }

  const Entry& one_per_field(std::string_view key) const {
    const Entry& entry = need(key);
    if (entry.words.size() != header_.fields.size())
      throw source_.bad_line(entry.line, fmt::format("{} has {} entries for {} fields", key,
                                                     entry.words.size(), header_.fields.size()));
    return entry;
  }

  std::int64_t whole(const Entry& entry, std::size_t i, std::int64_t least,
                     std::int64_t most) const {
    const auto value = i < entry.words.size() ? as_integer(entry.words[i]) : std::nullopt;
    if (!value || *value < least || *value > most)
      throw source_.bad_line(
          entry.line,
          fmt::format("found {}, expected a whole number from {} to {}",
                      quote(i < entry.words.size() ? entry.words[i] : ""), least, most));
    return *value;
  }

  void read_fields() {
    const Entry& names = need("FIELDS");
    if (names.words.empty() || names.words.size() > kMostFields)
      throw source_.bad_line(
          names.line, fmt::format("{} fields, expected 1 to {}", names.words.size(), kMostFields));
    std::set<std::string, std::less<>> seen;
    for (const std::string_view name : names.words) {
      if (name != "_" && !seen.insert(lower(name)).second)
        throw source_.bad_line(names.line, "a second field " + quote(name));
      header_.fields.push_back({std::string(name)});
    }
    const Entry& sizes = one_per_field("SIZE");
    const Entry& types = one_per_field("TYPE");
    const Entry* counts = entries_.contains("COUNT") ? &one_per_field("COUNT") : nullptr;
    for (std::size_t i = 0; i < header_.fields.size(); ++i) {
      Field& field = header_.fields[i];
      field.type = type_of(types, i, whole(sizes, i, 1, 8));
      field.width = counts == nullptr ? 1 : whole(*counts, i, 0, kMostValues);
      header_.stride += static_cast<std::size_t>(field.width) * size_of(field.type);
      header_.values += field.width;
    }
    if (header_.values == 0) throw source_.bad_line(names.line, "points without any value");
  }

  FieldType type_of(const Entry& types, std::size_t i, std::int64_t size) const {
    constexpr std::pair<std::string_view, FieldType> kTypes[] = {
        {"I1", FieldType::i8},  {"I2", FieldType::i16}, {"I4", FieldType::i32},
        {"I8", FieldType::i64}, {"U1", FieldType::u8},  {"U2", FieldType::u16},
        {"U4", FieldType::u32}, {"U8", FieldType::u64}, {"F4", FieldType::f32},
        {"F8", FieldType::f64}};
    const std::string code = fmt::format("{}{}", types.words[i], size);
    for (const auto& [name, type] : kTypes)
      if (name == code) return type;
    throw source_.bad_line(types.line,
                           fmt::format("field '{}' has type {} and size {}, expected I or U with "
                                       "1, 2, 4 or 8, or F with 4 or 8",
                                       header_.fields[i].name, quote(types.words[i]), size));
  }

  void read_count() {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    const bool sized = entries_.contains("WIDTH");
    if (sized) {
      const std::int64_t width = whole(need("WIDTH"), 0, 0, kMost);
      const std::int64_t height =
          entries_.contains("HEIGHT") ? whole(need("HEIGHT"), 0, 0, kMost) : 1;
      header_.points = width * height;
    }
    if (sized && !entries_.contains("POINTS")) {
      if (header_.points > kMost)
        throw source_.bad_line(need("WIDTH").line, fmt::format("{} points, at most {} are possible",
                                                               header_.points, kMost));
      return;
    }
    const Entry& points = need("POINTS");
    const std::int64_t count = whole(points, 0, 0, kMost);
    if (sized && count != header_.points)
      throw source_.bad_line(
          points.line, fmt::format("POINTS is {}, WIDTH times HEIGHT {}", count, header_.points));
    header_.points = count;
  }

  void read_viewpoint() {
    if (!entries_.contains("VIEWPOINT") || !header_.sensors.empty()) return;
    const Entry& entry = need("VIEWPOINT");
    std::array<double, 7> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto value = entry.words.size() == 7 ? as_real(entry.words[i]) : std::nullopt;
      if (!value)
        throw source_.bad_line(entry.line, "VIEWPOINT needs seven numbers: tx ty tz qw qx qy qz");
      values[i] = *value;
    }
    const auto pose = pose_of(values);
    if (!pose)
      throw source_.bad_line(entry.line,
                             "VIEWPOINT is no pose: its quaternion is zero or "
                             "its place not finite");
    header_.sensors.push_back({"", *pose});
  }

  static inline const std::set<std::string_view> kKeys = {
      "VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
      "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
  const Source& source_;
  PcdHeader header_;
  std::map<std::string_view, Entry> entries_;
};

}  // namespace

PcdHeader read_pcd_header(const Source& source) {
  return HeaderReader(source).read();
}

}  // namespace velum::formats
