// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "velum/error.hpp"
#include "velum/types.hpp"

namespace velum {

/// Scalar type of a column.
enum class Scalar : std::uint8_t { u8, i32, f32, f64 };

template <class T>
inline constexpr Scalar kScalarOf = static_cast<Scalar>(detail::position<T>(
    static_cast<std::tuple<std::uint8_t, std::int32_t, float, double>*>(nullptr)));

VELUM_API std::size_t size_of(Scalar scalar);
VELUM_API std::string_view name_of(Scalar scalar);

/// An immutable array of `count` elements of `width` scalars each, shared by all its copies.
class VELUM_API Column {
 public:
  Column() = default;

  /// Takes a width×count matrix (or a vector: width 1) without copying its elements.
  template <class T, int Rows, int Cols>
  explicit Column(Eigen::Matrix<T, Rows, Cols> matrix) {
    constexpr bool vector = Cols == 1;
    width_ = vector ? 1 : matrix.rows();
    count_ = vector ? matrix.size() : matrix.cols();
    scalar_ = kScalarOf<T>;
    auto owner = std::make_shared<const Eigen::Matrix<T, Rows, Cols>>(std::move(matrix));
    data_ = owner->data();
    owner_ = std::move(owner);
  }

  /// A view of memory that `owner` keeps alive (a cache file, say).
  Column(Scalar scalar, Index width, Index count, const void* data,
         std::shared_ptr<const void> owner)
      : owner_(std::move(owner)), data_(data), width_(width), count_(count), scalar_(scalar) {}

  [[nodiscard]] Scalar scalar() const { return scalar_; }
  [[nodiscard]] Index width() const { return width_; }
  [[nodiscard]] Index count() const { return count_; }
  [[nodiscard]] std::span<const std::byte> bytes() const {
    return {static_cast<const std::byte*>(data_),
            static_cast<std::size_t>(width_ * count_) * size_of(scalar_)};
  }

  /// The elements as a width×count matrix; throws Error when T is not the column's type.
  template <class T>
  [[nodiscard]] auto as() const {
    require(kScalarOf<T>);
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    return Eigen::Map<const Matrix>(static_cast<const T*>(data_), width_, count_);
  }
  /// The elements of a column of width 1 as a vector.
  template <class T>
  [[nodiscard]] auto vector() const {
    require(kScalarOf<T>);
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    return Eigen::Map<const Vector>(static_cast<const T*>(data_), width_ * count_);
  }

  /// The elements at `indices`, in that order.
  [[nodiscard]] Column select(std::span<const std::int32_t> indices) const;
  /// The elements of `a`, then those of `b`; throws Error when type or width differ.
  [[nodiscard]] static Column concatenate(const Column& a, const Column& b);
  /// The elements of all `parts`, of which there is at least one.
  [[nodiscard]] static Column concatenate(std::span<const Column> parts);
  /// `count` elements of zero.
  [[nodiscard]] static Column zeros(Scalar scalar, Index width, Index count);

  /// Do both share the same memory?
  [[nodiscard]] bool same_storage(const Column& other) const { return data_ == other.data_; }

 private:
  void require(Scalar scalar) const;

  std::shared_ptr<const void> owner_;
  const void* data_ = nullptr;
  Index width_ = 0;
  Index count_ = 0;
  Scalar scalar_ = Scalar::f32;
};

/// Columns by name, in the order of their names.
using Columns = std::map<std::string, Column, std::less<>>;

/// Names of the columns that have a meaning of their own; any other name is an extra column.
namespace column {
inline constexpr const char* kNormals = "normals";      ///< f32 ×3, unit length
inline constexpr const char* kCurvature = "curvature";  ///< f32, λ0/Σλ (thesis 3.2), at most 1/3
inline constexpr const char* kIntensity = "intensity";  ///< f32, the device's own scale
inline constexpr const char* kColour = "colour";        ///< u8 ×3, red, green, blue
inline constexpr const char* kTime = "time";            ///< f64 [s]
inline constexpr const char* kLabel = "label";          ///< i32
inline constexpr const char* kSensor = "sensor";        ///< u8, index into sensors; 255: not known
inline constexpr const char* kBeam = "beam";            ///< i32, beam within the scan line
inline constexpr const char* kLine = "line";            ///< i32, scan line within the sweep
inline constexpr const char* kTilt = "tilt";            ///< f32 [rad], tilt of the beam
}  // namespace column

}  // namespace velum
