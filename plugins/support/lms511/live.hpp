// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <velum/about.hpp>

#include "lms511/acquire.hpp"
#include "lms511/lines.hpp"
#include "lms511/parameters.hpp"

/// Parameters that the stages which talk to a scanner have in common.
namespace velum::lms511 {

enum class Encoding : std::uint8_t { automatic, cola_a, cola_b };
enum class EchoFilter : std::uint8_t { stored, first, all, last };

/// Base of a stage that has these parameters.
struct ScannerParameters {
  std::string address = "192.168.0.1";
  Encoding encoding = Encoding::automatic;
  bool login = true;
  std::optional<double> frequency;
  std::optional<Angle> resolution;
  std::optional<Angle> view_from;
  std::optional<Angle> view_to;
  EchoFilter echo_filter = EchoFilter::stored;
  bool remission = true;
  bool encoder_block = false;
  bool any_model = false;
  std::optional<int> lines;
  std::optional<Duration> duration;
  std::string trigger;
  int trigger_count = 2;
  Duration trigger_timeout{60.0};
  std::string feed;
  Duration connect_timeout{2.0};
  Duration answer_timeout{2.0};
  Duration ready_timeout{35.0};
  Duration silence_timeout{1.0};
  Duration give_up{30.0};

  /// Throws Error (Fault::graph) at the parameter that makes no sense or that the device refuses.
  void check_scanner() const;
  [[nodiscard]] Acquisition::Settings acquisition() const;
};

/// Describes ScannerParameters.
template <class Stage>
void add_scanner(AboutStage& about) {
  using P = ScannerParameters;
  const auto own = []<class M>(M P::*member) -> M Stage::* { return member; };
  about
      .param(own(&P::address), "address",
             "IPv4, IPv6 or name, with :PORT where it is not 2112 (2111 for cola_a)")
      .choice(
          own(&P::encoding), "encoding", "how telegrams are written",
          {{"auto", Encoding::automatic, "CoLa A on port 2111, else CoLa B; the other on silence"},
           {"cola_a", Encoding::cola_a, "text"},
           {"cola_b", Encoding::cola_b, "binary, with a checksum"}})
      .param(own(&P::login), "login", "log in, so that settings can be written")
      .param(own(&P::frequency), "frequency", "revolutions a second; else as the device has it",
             above(0.0))
      .unit("Hz")
      .param(own(&P::resolution), "resolution", "angle between beams; with frequency", above(0.0))
      .param(own(&P::view_from), "view_from", "first beam, -5 degrees or more")
      .param(own(&P::view_to), "view_to", "last beam, 185 degrees or less")
      .choice(own(&P::echo_filter), "echo_filter", "which echoes the device sends",
              {{"stored", EchoFilter::stored, "as the device has it"},
               {"first", EchoFilter::first, "the nearest"},
               {"all", EchoFilter::all, "up to five"},
               {"last", EchoFilter::last, "the farthest"}})
      .param(own(&P::remission), "remission", "ask for remission: the column intensity")
      .param(own(&P::encoder_block), "encoder_block", "ask for the encoder in each telegram")
      .param(own(&P::any_model), "any_model", "also a device that says it is no LMS 5xx")
      .advanced()
      .param(own(&P::lines), "lines", "end the sweep after that many lines", at_least(1))
      .param(own(&P::duration), "duration", "end the sweep after that time", above(0.0))
      .param(own(&P::trigger), "trigger",
             "what the sweep begins with: udp:PORT, tcp:PORT (a message there), local:NAME (when "
             "trigger_count scanners of this run are ready); else at once")
      .param(own(&P::trigger_count), "trigger_count", "scanners that a local trigger waits for",
             between(1, 64))
      .param(own(&P::trigger_timeout), "trigger_timeout", "the longest to wait for the trigger",
             above(0.0))
      .param(own(&P::feed), "feed",
             "udp:PORT or tcp:PORT where angles of the tilt plate [deg] arrive, one a message or "
             "line")
      .param(own(&P::connect_timeout), "connect_timeout", "for a connection", above(0.0))
      .advanced()
      .param(own(&P::answer_timeout), "answer_timeout", "for an answer", above(0.0))
      .advanced()
      .param(own(&P::ready_timeout), "ready_timeout",
             "for the scanner to measure; its motor takes up to 30 s", above(0.0))
      .advanced()
      .param(own(&P::silence_timeout), "silence_timeout",
             "without a scan for longer, and for three revolutions, the connection is lost",
             above(0.0))
      .advanced()
      .param(own(&P::give_up), "give_up",
             "without a scan for longer, all attempts included, the stage fails", above(0.0));
}

/// Knows when a sweep is over: by lines, time, or the angle where the tilt ends.
class SweepEnd {
 public:
  /// Throws Error (Fault::graph) when nothing would ever end the sweep.
  SweepEnd(const ScannerParameters& scanner, const TiltSettings& tilt);
  /// Looks at what came last.
  void see(const LineGatherer& lines);
  [[nodiscard]] bool reached() const { return share_ >= 1.0; }
  /// How much of the sweep is done, 0 to 1.
  [[nodiscard]] double share() const { return share_; }

 private:
  void now_at(double share) { share_ = std::max(share_, share); }
  void see_angle(double angle);

  std::optional<int> lines_;
  std::optional<double> duration_;
  TiltSettings tilt_;
  std::optional<std::int64_t> first_;
  std::optional<double> first_angle_;
  double share_ = 0.0;
};

}  // namespace velum::lms511
