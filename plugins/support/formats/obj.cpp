// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/obj.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formats/lines.hpp"
#include "formats/out_fields.hpp"
#include "formats/polygons.hpp"

namespace velum::formats {
namespace {

constexpr std::size_t kLinesBetweenChecks = std::size_t{1} << 18U;

/// Words that say nothing of points and polygons.
constexpr std::string_view kPassedOver[] = {
    "vt", "vp", "g", "o", "s", "l", "p", "mg", "mtllib", "usemtl", "lod", "bevel", "end", "parm"};

class ObjReader {
 public:
  ObjReader(const Source& source, Context& context) : source_(source), context_(context) {}

  Mesh read(const ReadOptions& options) {
    std::string_view rest = source_.text();
    for (std::size_t number = 0; !rest.empty(); ++number) {
      if (number % kLinesBetweenChecks == 0) context_.check();
      line_ = take_line(rest);
      std::string_view values = line_.substr(0, line_.find('#'));
      const std::string_view word = take_word(values);
      if (word.empty()) continue;
      if (word == "v")
        read_vertex(values);
      else if (word == "vn")
        read_normal(values);
      else if (word == "f")
        read_face(values);
      else if (std::find(std::begin(kPassedOver), std::end(kPassedOver), word) ==
               std::end(kPassedOver))
        refuse("found " + quote(word) + ", expected v, vt, vn, f, g, o, s or usemtl");
    }
    if (vertices() == 0) throw source_.bad_line(0, "no vertices ('v' lines)");
    return finish(options);
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const {
    throw source_.bad_line(line_, message);
  }
  [[nodiscard]] Index vertices() const { return static_cast<Index>(places_.size() / 3); }

  std::size_t read_numbers(std::string_view rest, std::array<double, 7>& values) const {
    std::size_t count = 0;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const auto value = as_real(word);
      if (!value || count == values.size())
        refuse("found " + quote(word) + ", expected a number, at most seven a line");
      values[count++] = *value;
    }
    return count;
  }

  /// x y z, with a weight (passed over) or a colour behind it, or both.
  void read_vertex(std::string_view rest) {
    std::array<double, 7> values{};
    const std::size_t count = read_numbers(rest, values);
    if (count != 3 && count != 4 && count < 6)
      refuse(fmt::format("a vertex of {} numbers, expected 3, 4, 6 or 7", count));
    places_.insert(places_.end(), values.begin(), values.begin() + 3);
    if (count < 6) return;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(count) - 3;
    colours_.resize(places_.size() - 3, 0.0);
    colours_.insert(colours_.end(), first, first + 3);
  }

  void read_normal(std::string_view rest) {
    std::array<double, 7> values{};
    if (read_numbers(rest, values) != 3) refuse("a normal of other than three numbers");
    normals_.push_back({values[0], values[1], values[2]});
  }

  /// A corner is v, v/vt, v//vn or v/vt/vn; negative numbers count back from the last.
  void read_face(std::string_view rest) {
    polygon_.clear();
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const std::size_t slash = word.find('/');
      const std::int64_t vertex = number_of(word.substr(0, slash), vertices());
      polygon_.push_back(vertex);
      const std::size_t last = word.rfind('/');
      if (last != slash && last + 1 < word.size())
        note_normal(vertex, number_of(word.substr(last + 1), static_cast<Index>(normals_.size())));
    }
    if (!polygons_.add(polygon_, vertices())) refuse("a corner out of range");
  }

  [[nodiscard]] std::int64_t number_of(std::string_view word, Index count) const {
    const auto value = as_integer(word);
    if (!value || *value == 0 || *value > count || *value < -count)
      refuse(fmt::format("a face refers to {}, expected 1 to {} or -{} to -1", quote(word), count,
                         count));
    return *value > 0 ? *value - 1 : count + *value;
  }

  void note_normal(std::int64_t vertex, std::int64_t normal) {
    const auto at = static_cast<std::size_t>(vertex);
    if (normal_of_.size() <= at) normal_of_.resize(at + 1, -1);
    // A vertex with two normals is an edge: the mesh then has none a vertex.
    if (normal_of_[at] >= 0 && normals_[static_cast<std::size_t>(normal_of_[at])] !=
                                   normals_[static_cast<std::size_t>(normal)])
      sharp_ = true;
    normal_of_[at] = normal;
  }

  /// One normal a vertex, where every vertex has one.
  [[nodiscard]] std::vector<double> vertex_normals() const {
    std::vector<double> result;
    const bool all = static_cast<Index>(normal_of_.size()) == vertices() &&
                     std::find(normal_of_.begin(), normal_of_.end(), -1) == normal_of_.end();
    if (sharp_ || !all) return result;
    for (const std::int64_t normal : normal_of_) {
      const auto& values = normals_[static_cast<std::size_t>(normal)];
      result.insert(result.end(), values.begin(), values.end());
    }
    return result;
  }

  Mesh finish(const ReadOptions& options) {
    const std::vector<double> normals = vertex_normals();
    if (!colours_.empty()) colours_.resize(places_.size(), 0.0);
    Records records;
    records.count = vertices();
    const auto add = [&](const std::vector<double>& values,
                         std::initializer_list<const char*> names) {
      if (values.empty()) return;
      const auto* data = reinterpret_cast<const std::byte*>(values.data());  // NOLINT
      for (const char* name : names) {
        records.fields.push_back({name, FieldType::f64, 1, data, 3 * sizeof(double)});
        data += sizeof(double);
      }
    };
    add(places_, {"x", "y", "z"});
    add(normals, {"nx", "ny", "nz"});
    add(colours_, {"red", "green", "blue"});
    return make_mesh(source_, assemble(source_, records, options, NotFinite::refuse, context_),
                     polygons_, options, context_);
  }

  const Source& source_;
  Context& context_;
  std::string_view line_;
  std::vector<double> places_;
  std::vector<double> colours_;
  std::vector<std::array<double, 3>> normals_;
  std::vector<std::int64_t> normal_of_;
  bool sharp_ = false;
  std::vector<std::int64_t> polygon_;
  Polygons polygons_;
};

void append_values(std::string& text, const char* word, const std::byte* row, FieldType type) {
  text += word;
  for (std::size_t a = 0; a < 3; ++a) {
    text += ' ';
    if (type == FieldType::f64)
      append_number(text, load<double>(row + 8 * a, false));
    else
      append_number(text, load<float>(row + 4 * a, false));
  }
}

std::string vertex_lines(const Mesh& mesh, double unit, Index begin, Index end) {
  const OutField positions = out_positions(mesh.vertices(), unit);
  std::vector<std::byte> rows(static_cast<std::size_t>(end - begin) * positions.bytes());
  positions.fill(begin, end, rows.data(), positions.bytes());
  const bool coloured = mesh.vertices().has(column::kColour);
  const bool normal = mesh.vertices().has(column::kNormals);
  std::string text;
  for (Index i = begin; i < end; ++i) {
    append_values(text, "v", rows.data() + static_cast<std::size_t>(i - begin) * positions.bytes(),
                  positions.type);
    if (coloured) {
      const auto colours = mesh.vertices().column(column::kColour).as<std::uint8_t>();
      for (Index c = 0; c < 3; ++c)
        append_number(text += ' ', static_cast<float>(colours(c, i)) / 255.0F);
    }
    text += '\n';
    if (!normal) continue;
    const Eigen::Vector3f direction = mesh.vertices().normals().col(i);
    append_values(text, "vn", reinterpret_cast<const std::byte*>(direction.data()),  // NOLINT
                  FieldType::f32);
    text += '\n';
  }
  return text;
}

std::string face_lines(const Mesh& mesh, Index begin, Index end) {
  const bool normal = mesh.vertices().has(column::kNormals);
  std::string text;
  for (Index i = begin; i < end; ++i) {
    text += 'f';
    for (Index c = 0; c < 3; ++c) {
      const std::int64_t number = std::int64_t{mesh.triangles()(c, i)} + 1;
      append_number(text += ' ', number);
      if (normal) append_number(text += "//", number);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

Mesh read_obj(const Source& source, const ReadOptions& options, Context& context) {
  return ObjReader(source, context).read(options);
}

void write_obj(AtomicFile& file, const Mesh& mesh, double unit, Context& context) {
  constexpr Index kGrain = 16384;
  file.write(std::string_view("# written by Velum\n"));
  write_pieces(file, mesh.vertices().size(), kGrain, context,
               [&](Index begin, Index end) { return vertex_lines(mesh, unit, begin, end); });
  write_pieces(file, mesh.size(), kGrain, context,
               [&](Index begin, Index end) { return face_lines(mesh, begin, end); });
}

}  // namespace velum::formats
