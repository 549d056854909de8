// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/out_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace velum::formats {
namespace {

FieldType type_of(Scalar scalar) {
  switch (scalar) {
    case Scalar::u8:
      return FieldType::u8;
    case Scalar::i32:
      return FieldType::i32;
    case Scalar::f32:
      return FieldType::f32;
    case Scalar::f64:
      break;
  }
  return FieldType::f64;
}

/// A name that needs no quotes in any header.
std::string plain(std::string name) {
  for (char& c : name)
    if (c <= ' ' || c > '~' || c == ',' || c == ';' || c == '"' || c == '#') c = '_';
  return name.empty() ? "_" : name;
}

/// Copies `bytes` from elements that are `from_step` apart to ones that are `stride` apart.
void copy_strided(const std::byte* from, std::size_t from_step, std::size_t bytes, Index count,
                  std::byte* to, std::size_t stride) {
  for (Index i = 0; i < count; ++i, from += from_step, to += stride) std::memcpy(to, from, bytes);
}

/// Components [first, first + width) of a column.
OutField column_field(std::string name, FieldType type, const Column& column, Index first,
                      Index width) {
  OutField field{plain(std::move(name)), type, width, {}};
  const std::size_t element = size_of(column.scalar());
  field.fill = [column, element, first, bytes = field.bytes()](Index begin, Index end,
                                                               std::byte* to, std::size_t stride) {
    if (begin == end) return;
    const std::size_t step = element * static_cast<std::size_t>(column.width());
    copy_strided(column.bytes().data() + static_cast<std::size_t>(begin) * step +
                     static_cast<std::size_t>(first) * element,
                 step, bytes, end - begin, to, stride);
  };
  return field;
}

template <class T>
void fill_positions(const Cloud& cloud, double unit, Index begin, Index end, std::byte* to,
                    std::size_t stride) {
  const ConstPoints positions = cloud.positions();
  const Eigen::Vector3d origin = cloud.origin();
  for (Index i = begin; i < end; ++i, to += stride) {
    T place[3];
    for (Index a = 0; a < 3; ++a) {
      const double offset = static_cast<double>(positions(a, i));
      place[a] = static_cast<T>(unit == 1.0 ? origin[a] + offset : (origin[a] + offset) / unit);
    }
    std::memcpy(to, place, sizeof(place));
  }
}

void add_packed_colour(OutFields& fields, const Column& column) {
  OutField field{"rgb", FieldType::f32, 1, {}};
  field.fill = [column](Index begin, Index end, std::byte* to, std::size_t stride) {
    const auto colours = column.as<std::uint8_t>();
    for (Index i = begin; i < end; ++i, to += stride) {
      const std::uint32_t word =
          std::uint32_t{colours(0, i)} << 16U | std::uint32_t{colours(1, i)} << 8U | colours(2, i);
      std::memcpy(to, &word, sizeof(word));
    }
  };
  fields.push_back(std::move(field));
}

void add_column(OutFields& fields, const std::string& name, const Column& column,
                const OutStyle& style) {
  const FieldType type = type_of(column.scalar());
  const auto add_named = [&](std::initializer_list<const char*> names) {
    Index component = 0;
    for (const char* part : names)
      fields.push_back(column_field(part, type, column, component++, 1));
  };
  if (name == column::kNormals) {
    if (style.pcd)
      add_named({"normal_x", "normal_y", "normal_z"});
    else
      add_named({"nx", "ny", "nz"});
  } else if (name == column::kColour) {
    if (style.pcd)
      add_packed_colour(fields, column);
    else
      add_named({"red", "green", "blue"});
  } else if (name == column::kLabel && style.pcd) {
    // PCL knows labels as unsigned; ours may be negative.
    const auto labels = column.vector<std::int32_t>();
    const bool negative = labels.size() > 0 && labels.minCoeff() < 0;
    fields.push_back(column_field(name, negative ? type : FieldType::u32, column, 0, 1));
  } else if (style.pcd || column.width() == 1) {
    fields.push_back(column_field(name, type, column, 0, column.width()));
  } else {
    for (Index c = 0; c < column.width(); ++c)
      fields.push_back(column_field(fmt::format("{}_{}", name, c), type, column, c, 1));
  }
}

}  // namespace

OutField out_positions(const Cloud& cloud, double unit) {
  const bool wide = !cloud.origin().isZero(0.0);
  OutField field{"xyz", wide ? FieldType::f64 : FieldType::f32, 3, {}};
  field.fill = [cloud, unit, wide](Index begin, Index end, std::byte* to, std::size_t stride) {
    if (wide)
      fill_positions<double>(cloud, unit, begin, end, to, stride);
    else
      fill_positions<float>(cloud, unit, begin, end, to, stride);
  };
  return field;
}

OutFields out_fields(const Cloud& cloud, const OutStyle& style) {
  OutFields fields;
  if (style.positions) fields.push_back(out_positions(cloud, style.unit));
  for (const auto& [name, column] : cloud.columns()) add_column(fields, name, column, style);
  return fields;
}

std::size_t stride_of(const OutFields& fields) {
  std::size_t stride = 0;
  for (const OutField& field : fields) stride += field.bytes();
  return stride;
}

void fill_rows(const OutFields& fields, Index begin, Index end, std::byte* rows) {
  const std::size_t stride = stride_of(fields);
  for (const OutField& field : fields) {
    field.fill(begin, end, rows, stride);
    rows += field.bytes();
  }
}

}  // namespace velum::formats
