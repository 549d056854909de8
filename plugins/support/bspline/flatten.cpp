// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "bspline/flatten.hpp"

#include <algorithm>
#include <cmath>

namespace velum::bspline {

using Eigen::Vector2d;
using Eigen::Vector3d;

Flat::Flat(const Patch& patch)
    : low_(patch.low()),
      size_(patch.high() - patch.low()),
      across_(kRows + 1, kColumns + 1),
      along_(kRows + 1) {
  const auto place = [&](Index column, Index row) -> Vector2d {
    return low_ + size_.cwiseProduct(Vector2d(static_cast<double>(column) / kColumns,
                                              static_cast<double>(row) / kRows));
  };
  Vector3d below = Vector3d::Zero();
  for (Index row = 0; row <= kRows; ++row) {
    across_(row, 0) = 0.0;
    Vector3d last = patch.at(place(0, row));
    Vector3d middle = last;
    for (Index column = 1; column <= kColumns; ++column) {
      const Vector3d here = patch.at(place(column, row));
      across_(row, column) = across_(row, column - 1) + (here - last).norm();
      last = here;
      if (column == kColumns / 2) middle = here;
    }
    const double centre = across_(row, kColumns / 2);
    across_.row(row).array() -= centre;
    along_[row] = row == 0 ? 0.0 : along_[row - 1] + (middle - below).norm();
    below = middle;
  }
  // A middle line that stands still (at a pole) still has an order.
  const double least = 1e-9 * (along_[kRows] + across_.cwiseAbs().maxCoeff());
  for (Index row = 1; row <= kRows; ++row)
    along_[row] = std::max(along_[row], along_[row - 1] + least);
}

double Flat::x_at(Index column, double v) const {
  const double place = std::clamp((v - low_.y()) / size_.y(), 0.0, 1.0) * kRows;
  const auto row = std::min<Index>(static_cast<Index>(place), kRows - 1);
  const double share = place - static_cast<double>(row);
  return (1.0 - share) * across_(row, column) + share * across_(row + 1, column);
}

Vector2d Flat::to_plane(const Vector2d& uv) const {
  const Vector2d place = (uv - low_).cwiseQuotient(size_).cwiseMax(0.0).cwiseMin(1.0);
  const double column = place.x() * kColumns;
  const auto left = std::min<Index>(static_cast<Index>(column), kColumns - 1);
  const double share = column - static_cast<double>(left);
  const double row = place.y() * kRows;
  const auto below = std::min<Index>(static_cast<Index>(row), kRows - 1);
  const double rise = row - static_cast<double>(below);
  return {(1.0 - share) * x_at(left, uv.y()) + share * x_at(left + 1, uv.y()),
          (1.0 - rise) * along_[below] + rise * along_[below + 1]};
}

Flat::Row Flat::row_at(double y) const {
  const auto* above = std::upper_bound(along_.data(), along_.data() + kRows, y);
  const Index row = std::clamp<Index>(above - along_.data() - 1, 0, kRows - 1);
  const double share = std::clamp((y - along_[row]) / (along_[row + 1] - along_[row]), 0.0, 1.0);
  Row found;
  found.v = low_.y() + size_.y() * (static_cast<double>(row) + share) / kRows;
  found.left = x_at(0, found.v);
  found.right = x_at(kColumns, found.v);
  return found;
}

double Flat::u_at(double x, double v) const {
  Index low = 0;
  Index high = kColumns;
  while (high - low > 1) {
    const Index middle = (low + high) / 2;
    (x_at(middle, v) <= x ? low : high) = middle;
  }
  const double from = x_at(low, v);
  const double to = x_at(high, v);
  const double share = to > from ? std::clamp((x - from) / (to - from), 0.0, 1.0) : 0.5;
  return low_.x() + size_.x() * (static_cast<double>(low) + share) / kColumns;
}

}  // namespace velum::bspline
