// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Names of the SDK's enumerations as users read them.
#include <array>

#include "velum/about.hpp"
#include "velum/column.hpp"
#include "velum/parameter.hpp"
#include "velum/values.hpp"

namespace velum {
namespace {

template <std::size_t N, class E>
std::string_view pick(const std::array<std::string_view, N>& names, E value) {
  const auto index = static_cast<std::size_t>(value);
  return index < N ? names[index] : "unknown";
}

}  // namespace

std::string_view name_of(Scalar scalar) {
  static constexpr std::array<std::string_view, 4> kNames = {"u8", "i32", "f32", "f64"};
  return pick(kNames, scalar);
}

std::size_t size_of(Scalar scalar) {
  switch (scalar) {
    case Scalar::u8:
      return 1;
    case Scalar::i32:
    case Scalar::f32:
      return 4;
    case Scalar::f64:
      return 8;
  }
  throw Error(Fault::stage, "a column of unknown scalar type");
}

std::string_view name_of(ValueType type) {
  static constexpr std::array<std::string_view, 7> kNames = {
      "cloud", "mesh", "surface", "transform", "clusters", "correspondences", "table"};
  return pick(kNames, type);
}

std::string_view name_of(Determinism determinism) {
  static constexpr std::array<std::string_view, 4> kNames = {"bitwise", "seeded", "tolerance",
                                                             "none"};
  return pick(kNames, determinism);
}

std::string_view name_of(ParameterType type) {
  static constexpr std::array<std::string_view, 14> kNames = {
      "boolean",  "integer", "number", "text",        "choice",     "length",      "angle",
      "duration", "vector",  "point",  "length_unit", "input_file", "output_file", "rows"};
  return pick(kNames, type);
}

}  // namespace velum
