// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "velum/cloud.hpp"

namespace velum::formats {

/// Scalar types that files hold.
enum class FieldType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
std::size_t size_of(FieldType type);
std::string_view name_of(FieldType type);
inline bool is_real(FieldType type) {
  return type >= FieldType::f32;
}

/// One named value of every record. `data` is that of record 0, `stride` the way to the next.
struct Field {
  std::string name;
  FieldType type = FieldType::f32;
  Index width = 1;
  const std::byte* data = nullptr;
  std::size_t stride = 0;
};

/// What all point formats come down to: records of named values, not copied where the file is
/// binary.
struct Records {
  Index count = 0;
  bool swapped = false;  ///< in the other byte order than this machine's
  bool untyped = false;  ///< a text file that states no types: all fields are f64
  std::vector<Field> fields;
  std::vector<Sensor> sensors;  ///< in the file's unit

  /// The field of that name (in lower case), or null.
  [[nodiscard]] const Field* find(std::string_view lower_name) const;
};

/// The records that count: all of the first `count`, or those listed.
struct Kept {
  Index count = 0;
  const std::int32_t* list = nullptr;
};

std::string lower(std::string_view text);

/// One scalar at any address, in either byte order.
template <class T>
T load(const std::byte* from, bool swapped) {
  std::byte raw[sizeof(T)];
  if (swapped) {
    for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = from[sizeof(T) - 1 - i];
  } else {
    std::memcpy(raw, from, sizeof(T));
  }
  return std::bit_cast<T>(raw);
}

/// Calls body(T{}) with the C++ type of `type`.
template <class Body>
decltype(auto) with_type(FieldType type, const Body& body) {
  switch (type) {
    case FieldType::i8:
      return body(std::int8_t{});
    case FieldType::u8:
      return body(std::uint8_t{});
    case FieldType::i16:
      return body(std::int16_t{});
    case FieldType::u16:
      return body(std::uint16_t{});
    case FieldType::i32:
      return body(std::int32_t{});
    case FieldType::u32:
      return body(std::uint32_t{});
    case FieldType::i64:
      return body(std::int64_t{});
    case FieldType::u64:
      return body(std::uint64_t{});
    case FieldType::f32:
      return body(float{});
    case FieldType::f64:
      break;
  }
  return body(double{});
}

/// Elements [begin, begin + count) of one component as double.
void load_doubles(const Field& field, bool swapped, Index component, Index begin, Index count,
                  double* out);

}  // namespace velum::formats
