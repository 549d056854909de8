// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/attributes.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <optional>

#include "formats/gather.hpp"

namespace velum::formats {
namespace {

/// Names that files use for one component of a column.
struct Alias {
  std::string_view name;
  std::string_view column;
  Index component = 0;
};
constexpr Alias kAliases[] = {{"nx", column::kNormals, 0},
                              {"ny", column::kNormals, 1},
                              {"nz", column::kNormals, 2},
                              {"normal_x", column::kNormals, 0},
                              {"normal_y", column::kNormals, 1},
                              {"normal_z", column::kNormals, 2},
                              {"normalx", column::kNormals, 0},
                              {"normaly", column::kNormals, 1},
                              {"normalz", column::kNormals, 2},
                              {"red", column::kColour, 0},
                              {"green", column::kColour, 1},
                              {"blue", column::kColour, 2},
                              {"r", column::kColour, 0},
                              {"g", column::kColour, 1},
                              {"b", column::kColour, 2},
                              {"curvature", column::kCurvature},
                              {"intensity", column::kIntensity},
                              {"scalar_intensity", column::kIntensity},
                              {"label", column::kLabel},
                              {"scalar_label", column::kLabel},
                              {"classification", column::kLabel},
                              {"scalar_classification", column::kLabel},
                              {"time", column::kTime},
                              {"gps_time", column::kTime},
                              {"gpstime", column::kTime},
                              {"sensor", column::kSensor},
                              {"beam", column::kBeam},
                              {"line", column::kLine},
                              {"tilt", column::kTilt}};

constexpr std::string_view kMeanings[] = {
    column::kNormals, column::kColour, column::kCurvature, column::kIntensity, column::kTime,
    column::kLabel,   column::kSensor, column::kBeam,      column::kLine,      column::kTilt};

using Components = std::vector<Component>;

double same(double value, Index) {
  return value;
}

class AttributeReader {
 public:
  AttributeReader(const Records& records, const Kept& kept, bool left_handed, Context& context)
      : records_(records), kept_(kept), left_handed_(left_handed), context_(context) {}

  Columns read(std::span<const std::string> used) {
    for (const Field& field : records_.fields) {
      const std::string name = lower(field.name);
      if (name != "_" && std::find(used.begin(), used.end(), name) == used.end())
        left_.push_back(&field);
    }
    for (const std::string_view meaning : kMeanings) {
      Components components = find(meaning);
      std::optional<Column> column = make(meaning, components);
      if (!column) continue;
      for (const Component& component : components) std::erase(left_, component.field);
      columns_.emplace(meaning, std::move(*column));
    }
    read_packed_colour();
    while (!left_.empty()) read_extra();
    return std::move(columns_);
  }

 private:
  /// The fields that make up a column; empty when there are none.
  Components find(std::string_view meaning) const {
    const bool colour = meaning == column::kColour;
    const std::size_t width = colour || meaning == column::kNormals ? 3 : 1;
    Components found(width);
    for (const Field* field : left_) {
      const std::string name = lower(field->name);
      const bool whole_name = name == meaning || (colour && (name == "rgb" || name == "rgba")) ||
                              (name == "normal" && meaning == column::kNormals);
      if (width == 3 && whole_name && (field->width == 3 || (colour && field->width == 4)))
        return {{field, 0}, {field, 1}, {field, 2}};
      for (const Alias& alias : kAliases) {
        if (field->width != 1 || alias.name != name || alias.column != meaning) continue;
        Component& slot = found[static_cast<std::size_t>(alias.component)];
        if (slot.field == nullptr) slot.field = field;
      }
    }
    for (const Component& component : found)
      if (component.field == nullptr) return {};
    return found;
  }

  std::optional<Column> make(std::string_view meaning, const Components& from) {
    if (from.empty()) return std::nullopt;
    if (meaning == column::kNormals) return make_normals(from);
    if (meaning == column::kColour) return make_colour(from);
    if (meaning == column::kTime) return gather<double>(records_, from, kept_, context_, same);
    const bool real =
        meaning == column::kCurvature || meaning == column::kIntensity || meaning == column::kTilt;
    if (real) return gather<float>(records_, from, kept_, context_, same);
    const Extent extent = extent_of(records_, from.front(), kept_, context_);
    if (meaning == column::kSensor) {
      if (!extent.whole || !extent.within(0.0, static_cast<double>(records_.sensors.size()) - 1.0))
        return std::nullopt;
      return gather<std::uint8_t>(records_, from, kept_, context_, same);
    }
    if (!extent.fits_i32()) return std::nullopt;
    return gather<std::int32_t>(records_, from, kept_, context_, same);
  }

  /// A point without a normal (NaN in organised clouds) gets the zero vector.
  Column make_normals(Components from) {
    if (left_handed_) from = {from[2], from[0], from[1]};
    return gather<float>(records_, from, kept_, context_, [this](double value, Index component) {
      if (!std::isfinite(value)) return 0.0;
      return left_handed_ && component == 1 ? -value : value;
    });
  }

  /// 8-bit colours as they are; others by their largest value: 0 to 1, 0 to 255 or 0 to 65535.
  std::optional<Column> make_colour(const Components& from) {
    const FieldType type = from.front().field->type;
    double scale = 1.0;
    if (type != FieldType::u8) {
      double high = 0.0;
      bool whole = true;
      for (const Component& component : from) {
        const Extent extent = extent_of(records_, component, kept_, context_);
        if (!extent.within(0.0, 65535.0)) return std::nullopt;
        high = std::max(high, extent.high);
        whole = whole && extent.whole;
      }
      const bool share = is_real(type) && high <= 1.0 && !(records_.untyped && whole);
      scale = share ? 255.0 : high <= 255.0 ? 1.0 : 255.0 / 65535.0;
    }
    return gather<std::uint8_t>(records_, from, kept_, context_,
                                [scale](double value, Index) { return std::round(value * scale); });
  }

  /// PCL's colour: the bytes of 0x00RRGGBB in a field of four bytes of any type.
  void read_packed_colour() {
    const auto found = std::find_if(left_.begin(), left_.end(), [](const Field* field) {
      const std::string name = lower(field->name);
      return field->width == 1 && size_of(field->type) == 4 && (name == "rgb" || name == "rgba");
    });
    if (found == left_.end() || columns_.contains(column::kColour)) return;
    Field bits = **found;
    bits.type = FieldType::u32;
    const Components packed(3, Component{&bits, 0});
    columns_.emplace(
        column::kColour,
        gather<std::uint8_t>(records_, packed, kept_, context_, [](double value, Index component) {
          const auto word = static_cast<std::uint32_t>(value);
          return (word >> (16U - 8U * unsigned(component))) & 255U;
        }));
    left_.erase(found);
  }

  void read_extra() {
    Components from;
    std::string name = take_extra(from);
    if (std::find(std::begin(kMeanings), std::end(kMeanings), name) != std::end(kMeanings))
      name += "_raw";
    while (columns_.contains(name)) name += "_";
    const FieldType type = from.front().field->type;
    Column column;
    if (type == FieldType::u8) {
      column = gather<std::uint8_t>(records_, from, kept_, context_, same);
    } else if (type == FieldType::f32) {
      column = gather<float>(records_, from, kept_, context_, same);
    } else if ((type != FieldType::f64 || records_.untyped) && fit_i32(from)) {
      column = gather<std::int32_t>(records_, from, kept_, context_, same);
    } else {
      column = gather<double>(records_, from, kept_, context_, same);
    }
    columns_.emplace(std::move(name), std::move(column));
  }

  /// Takes the next extra column off the fields that are left: one of them, or several called
  /// name_0, name_1, ... of one type.
  std::string take_extra(Components& from) {
    const Field* first = left_.front();
    std::size_t fields = 1;
    std::string name = first->name;
    if (first->width == 1 && name.size() > 2 && name.ends_with("_0")) {
      const std::string stem = name.substr(0, name.size() - 2);
      while (fields < left_.size() && left_[fields]->width == 1 &&
             left_[fields]->type == first->type &&
             left_[fields]->name == fmt::format("{}_{}", stem, fields))
        ++fields;
      if (fields > 1) name = stem;
    }
    for (std::size_t i = 0; i < fields; ++i)
      for (Index c = 0; c < left_[i]->width; ++c) from.push_back({left_[i], c});
    left_.erase(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(fields));
    return name;
  }

  bool fit_i32(const Components& components) {
    return std::all_of(components.begin(), components.end(), [this](const Component& component) {
      return extent_of(records_, component, kept_, context_).fits_i32();
    });
  }

  const Records& records_;
  const Kept& kept_;
  bool left_handed_;
  Context& context_;
  std::vector<const Field*> left_;
  Columns columns_;
};

}  // namespace

Columns read_attributes(const Records& records, const Kept& kept, std::span<const std::string> used,
                        bool left_handed, Context& context) {
  return AttributeReader(records, kept, left_handed, context).read(used);
}

}  // namespace velum::formats
