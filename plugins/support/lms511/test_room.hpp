// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "lms511/sweep.hpp"
#include "lms511/test_tools.hpp"

/// A box-shaped room as an LMS 511 on a tilt plate would see it, with every beam cast at the tilt
/// of its own time.
namespace lms {

inline constexpr double kDegree = std::numbers::pi / 180.0;

struct Room {
  Eigen::Vector3d low{-3.0, -2.5, -1.2};
  Eigen::Vector3d high{4.0, 5.0, 1.8};

  /// From inside to the wall [m].
  [[nodiscard]] double range(const Eigen::Vector3d& from, const Eigen::Vector3d& along) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      if (along[i] == 0.0) continue;
      const double wall = along[i] > 0.0 ? high[i] : low[i];
      nearest = std::min(nearest, (wall - from[i]) / along[i]);
    }
    return nearest;
  }
  /// How far a point is from the nearest wall [m].
  [[nodiscard]] double error(const Eigen::Vector3d& p) const {
    return std::min((p - low).cwiseAbs().minCoeff(), (high - p).cwiseAbs().minCoeff());
  }
};

/// The scans of one sweep, at 25 Hz with a degree between beams.
struct RoomScan {
  Room room;
  velum::lms511::Mounting mounting = velum::lms511::Mounting::plate;
  velum::lms511::Calibration calibration;
  velum::lms511::TiltSettings tilt{
      .source = velum::lms511::TiltSource::constant, .start = -0.5, .end = 0.55, .speed = 0.25};
  int lines = 101;
  std::int32_t step = 10000;  ///< [1/10000 deg]
  double counts = 0.0;        ///< of an encoder in each telegram; 0: none

  [[nodiscard]] velum::lms511::Scan line(int number) const {
    using namespace velum::lms511;  // NOLINT
    constexpr double kPeriod = 0.04;
    const TiltCurve curve(tilt, kPeriod * (lines - 1));
    const Mount mount(mounting, calibration);
    const auto beams = static_cast<std::uint16_t>(1900000 / step + 1);
    Scan scan = sample(beams, static_cast<std::uint16_t>(number));
    scan.start_time = 4294000000U + 40000U * static_cast<std::uint32_t>(number);  // soon wraps
    scan.send_time = scan.start_time + 40500;
    const double start = kPeriod * number;
    if (counts != 0.0)
      scan.encoders = {{static_cast<std::uint32_t>(static_cast<std::int64_t>(
                            std::llround(*curve.at(start) / (2.0 * std::numbers::pi) * counts))),
                        0}};
    for (auto* channel : {&scan.channels16.front(), &scan.channels8.front()})
      channel->step = static_cast<std::uint16_t>(step);
    for (std::uint16_t i = 0; i < beams; ++i) {
      const double angle = (-5.0 + 1e-4 * step * i) * kDegree;
      const double at = *curve.at(start + beam_delay(angle, 25.0) + calibration.time_offset);
      const Eigen::Vector3d from = mount.point(0.0, angle, at);
      const double range = room.range(from, mount.point(1.0, angle, at) - from);
      scan.channels16.front().values[i] = static_cast<std::uint16_t>(std::lround(1000.0 * range));
    }
    return scan;
  }

  /// All lines as records of a binary connection, 40 ms apart.
  void play(const velum::lms511::RecordSink& sink) const {
    using namespace velum::lms511;  // NOLINT
    sink({Event::start, 0, "2026-01-01T00:00:00Z"});
    sink({Event::connected, 0, "room"});
    for (int i = 0; i < lines; ++i) {
      const std::string payload = encode_scan(line(i), Dialect::binary);
      sink({Event::binary_telegram, 40'600'000 + std::int64_t{i} * 40'000'000, payload});
    }
    sink({Event::end, std::int64_t{lines} * 40'000'000, "done"});
  }
};

/// For stages that are called without a kernel.
class QuietContext : public velum::Context {
 public:
  [[nodiscard]] int threads() const override { return 1; }
  [[nodiscard]] velum::Random random() const override { return velum::Random(1); }
  void progress(double) override {}
  [[nodiscard]] bool cancelled() const noexcept override { return false; }
  void warn(const std::string&) override {}
  void info(const std::string&) override {}
  void measure(const std::string&, double, const std::string&, velum::Better) override {}
  void run_chunks(velum::Index chunks, const std::function<void(velum::Index)>& body) override {
    for (velum::Index i = 0; i < chunks; ++i) body(i);
  }
};

}  // namespace lms
