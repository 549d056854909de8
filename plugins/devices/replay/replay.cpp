// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <velum/stage.hpp>

#include "lms511/import.hpp"
#include "lms511/parameters.hpp"
#include "points.hpp"

namespace {

namespace lms = velum::lms511;

// Lets records pass at the pace at which they arrived, or a multiple of it.
class Pace {
 public:
  Pace(double factor, const velum::Context& context) : factor_(factor), context_(context) {}

  void wait_until(std::int64_t time) {
    if (factor_ <= 0.0 || time == lms::kNoTime) return;
    if (!begun_) {
      begun_ = true;
      first_ = time;
      start_ = Clock::now();
    }
    constexpr double kLongest = 1e9;  // [s]; more is damage
    const double passed = 1e-9 * (static_cast<double>(time) - static_cast<double>(first_));
    const auto due =
        start_ + std::chrono::duration_cast<Clock::duration>(
                     std::chrono::duration<double>(std::clamp(passed / factor_, 0.0, kLongest)));
    constexpr std::chrono::milliseconds kSlice(20);
    for (auto now = Clock::now(); now < due; now = Clock::now()) {
      context_.check();
      std::this_thread::sleep_for(std::min<Clock::duration>(kSlice, due - now));
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  double factor_;
  const velum::Context& context_;
  bool begun_ = false;
  std::int64_t first_ = 0;
  Clock::time_point start_;
};

struct Replay : lms::SweepParameters {
  velum::InputFile file;
  double pace = 0.0;
  velum::LengthUnit units;

  static auto about() {
    velum::About<Replay> about("The cloud that a recorded scan of an LMS 511 gives.");
    about.out("cloud", "in the scanner's own frame")
        .drops_columns()
        .param(
            &Replay::file, "file",
            "a recording (.vrec), a capture (pcap, pcapng), telegrams back to back, or the points "
            "of the thesis's acquisition program, x y z a line")
        .required()
        .param(&Replay::units, "units", "unit of the lengths in a file of points")
        .param(&Replay::pace, "pace", "1: as fast as it was recorded; 2: twice as fast; 0: at once",
               velum::at_least(0.0));
    lms::add_sweep<Replay>(about);
    about.reference("SICK, telegram listing 8014631").reference("Canciani, thesis, 2.3 (scanner)");
    return about;
  }

  void check() const { check_sweep(); }

  velum::Cloud operator()(velum::Context& context) const {
    if (velum::replay::is_points(file.path))
      return velum::replay::read_points(file.path, units.metres, sensor, context);
    lms::LineGatherer lines;
    Pace clock(pace, context);
    const lms::ImportCounts counts = lms::read_records(
        file.path,
        [&](const lms::Record& record) {
          const bool line = lines.add(record);
          if (pace <= 0.0) return;
          clock.wait_until(record.time != lms::kNoTime ? record.time
                           : line                      ? 1000 * lines.lines().back().start
                                                       : lms::kNoTime);
        },
        context);
    if (lines.lines().empty())
      throw velum::Error(velum::Fault::input, "the file holds no scan that can be used")
          .at(file.path.string());
    lms::SweepCounts swept;
    velum::Cloud cloud = lms::make_sweep(lines, sweep(), swept, context);
    say(counts, context);
    lms::report(lines, swept, context);
    return cloud;
  }

 private:
  static void say(const lms::ImportCounts& counts, velum::Context& context) {
    if (!counts.ended)
      context.warn("the recording was not closed: it is read up to its last whole block");
    if (counts.damaged_bytes > 0)
      context.warn(fmt::format("{} bytes of the recording are damaged", counts.damaged_bytes));
    if (counts.missing_blocks > 0)
      context.warn(fmt::format("{} blocks of the recording are missing", counts.missing_blocks));
    if (counts.lost_bytes > 0)
      context.warn(fmt::format("{} bytes of TCP are not in the capture", counts.lost_bytes));
    if (counts.skipped_bytes > 0)
      context.info(fmt::format("{} bytes belong to no telegram", counts.skipped_bytes));
    if (counts.bad_checksums > 0)
      context.warn(fmt::format("{} telegrams with a wrong checksum", counts.bad_checksums));
  }
};

}  // namespace

VELUM_STAGE(Replay)
