// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/calendar.hpp"

#include <chrono>
#include <cmath>

namespace velum::emulator {

namespace chrono = std::chrono;

lms511::Moment moment_of(double seconds) {
  // Real devices write whole milliseconds.
  const auto whole = chrono::sys_time<chrono::milliseconds>(
      chrono::milliseconds(static_cast<std::int64_t>(std::floor(seconds * 1e3))));
  const auto day = chrono::floor<chrono::days>(whole);
  const chrono::year_month_day date(day);
  const chrono::hh_mm_ss time(whole - day);
  return {.year = static_cast<std::uint16_t>(static_cast<int>(date.year())),
          .month = static_cast<std::uint8_t>(static_cast<unsigned>(date.month())),
          .day = static_cast<std::uint8_t>(static_cast<unsigned>(date.day())),
          .hour = static_cast<std::uint8_t>(time.hours().count()),
          .minute = static_cast<std::uint8_t>(time.minutes().count()),
          .second = static_cast<std::uint8_t>(time.seconds().count()),
          .microsecond = static_cast<std::uint32_t>(1000 * time.subseconds().count())};
}

double seconds_of(const lms511::Moment& moment) {
  const chrono::sys_days day(chrono::year(moment.year) / chrono::month(moment.month) /
                             chrono::day(moment.day));
  const double days = static_cast<double>(day.time_since_epoch().count());
  return days * 86400.0 + moment.hour * 3600.0 + moment.minute * 60.0 + moment.second +
         1e-6 * moment.microsecond;
}

void write_moment(lms511::Writer& answer, const lms511::Moment& moment) {
  answer.u16(moment.year).u8(moment.month).u8(moment.day);
  answer.u8(moment.hour).u8(moment.minute).u8(moment.second).u32(moment.microsecond);
}

}  // namespace velum::emulator
