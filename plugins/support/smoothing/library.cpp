// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "smoothing/library.hpp"

#include <cmath>
#include <new>

namespace velum::smoothing {

Eigen::Vector3d centre_of(const Cloud& cloud) {
  if (cloud.empty()) return Eigen::Vector3d::Zero();
  const Eigen::AlignedBox3f box = bounding_box(cloud.positions());
  return 0.5 * (box.min().cast<double>() + box.max().cast<double>());
}

void guarded(const std::string& what, const std::function<void()>& call) {
  try {
    call();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(Fault::stage, what + " failed: " + error.what());
  }
}

std::function<bool(double)> progress(Context& context) {
  return [&context](double share) {
    context.progress(share);
    return !context.cancelled();
  };
}

Cloud moved(const Cloud& cloud, Points positions, Context& context) {
  double squares = 0.0, most = 0.0, unmoved = 0.0;
  const ConstPoints before = cloud.positions();
  for (Index i = 0; i < positions.cols(); ++i) {
    if (!positions.col(i).allFinite()) {
      positions.col(i) = before.col(i);
      unmoved += 1.0;
    }
    const double step = (positions.col(i) - before.col(i)).cast<double>().norm();
    squares += step * step;
    most = std::max(most, step);
  }
  const double count = static_cast<double>(std::max<Index>(positions.cols(), 1));
  context.measure("moved_rms", std::sqrt(squares / count), "m");
  context.measure("moved_most", most, "m");
  context.measure("unmoved", unmoved, "", Better::lower);
  return cloud.with_positions(std::move(positions));
}

}  // namespace velum::smoothing
