// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/dialogue.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

constexpr double kPerRadian = 1e4 * 180.0 / std::numbers::pi;

std::int32_t telegram_angle(double radians) {
  return static_cast<std::int32_t>(std::lround(radians * kPerRadian));
}

std::uint32_t hundredths(double hertz) {
  return static_cast<std::uint32_t>(std::lround(100.0 * hertz));
}

[[noreturn]] void refuse(const char* parameter, const std::string& message,
                         const std::string& hint = "") {
  throw Error(Error(Fault::graph, message).at(parameter)).hint(hint);
}

class Start {
 public:
  Start(Session& session, Dialect dialect, const DeviceSettings& settings,
        const Interrupt& interrupt)
      : session_(session), dialect_(dialect), settings_(settings), interrupt_(interrupt) {}

  Started run() {
    login();
    identify();
    set_scan();
    set_view();
    set_echoes();
    set_data();
    begin();
    return std::move(started_);
  }

 private:
  [[nodiscard]] Writer request(const char* kind, const char* name) const {
    return {dialect_, kind, name};
  }

  // The answer, or a warning and nothing where the device refuses.
  std::optional<Answer> ask(const Writer& what, double seconds) {
    try {
      return session_.ask(what, seconds);
    } catch (const Refused& refused) {
      started_.warnings.emplace_back(refused.what());
      return std::nullopt;
    }
  }
  std::optional<Answer> ask(const Writer& what) { return ask(what, settings_.timeouts.answer); }

  void login() {
    if (!settings_.login) return;
    const auto answer = ask(
        request("sMN", "SetAccessMode").u8(kAuthorisedClient.level).u32(kAuthorisedClient.hash));
    if (answer && answer->reader().u8() == 1) return;
    started_.warnings.emplace_back("the login was refused: the device keeps its stored settings");
  }

  // Variables that a firmware may lack are asked for without a warning.
  std::optional<Answer> look(const char* name) {
    try {
      return session_.ask(request("sRN", name), settings_.timeouts.answer);
    } catch (const Refused&) {
      return std::nullopt;
    }
  }
  std::string look_text(const char* name, const char* fact) {
    const auto answer = look(name);
    if (!answer) return "";
    Reader reader = answer->reader();
    std::string text(reader.text16());
    while (!text.empty() && text.back() == ' ') text.pop_back();
    started_.identity.push_back(fmt::format("{} = {}", fact, text));
    return text;
  }

  void identify() {
    const std::string model = look_text("DeviceIdent", "model");
    const std::string firmware = look_text("FirmwareVersion", "firmware");
    look_text("SerialNumber", "serial");
    look_text("LocationName", "location");
    for (const auto& [name, fact] :
         {std::pair{"ODoprh", "operating_time_0.1_h"}, std::pair{"ODpwrc", "power_ups"}})
      if (const auto answer = look(name))
        started_.identity.push_back(fmt::format("{} = {}", fact, answer->reader().u32()));
    if (settings_.any_model) return;
    if (!model.empty() && model.find("LMS5") == std::string::npos) unsupported("model", model);
    const bool known =
        firmware.empty() || firmware.starts_with("V1.") || firmware.starts_with("V2.");
    if (!known) unsupported("firmware", firmware);
  }

  [[noreturn]] static void unsupported(const char* what, const std::string& name) {
    throw Error(Fault::device, fmt::format("the {} '{}' is not supported, expected an LMS 5xx with "
                                           "firmware V1 or V2",
                                           what, name))
        .hint("any_model = true tries it all the same");
  }

  void set_scan() {
    if (settings_.frequency && settings_.resolution) {
      const Mode mode = *mode_of(hundredths(*settings_.frequency),
                                 static_cast<std::uint32_t>(telegram_angle(*settings_.resolution)));
      const auto answer = ask(request("sMN", "mLMPsetscancfg")
                                  .u32(mode.frequency)
                                  .i16(1)
                                  .u32(mode.resolution)
                                  .i32(kViewFrom)
                                  .i32(kViewTo),
                              settings_.timeouts.ready);
      if (answer) judge(answer->reader().u8());
    }
    if (const auto answer = look("LMPscancfg")) {
      Reader reader = answer->reader();
      const std::uint32_t frequency = reader.u32();
      static_cast<void>(reader.i16());
      started_.configuration.push_back(fmt::format("scan_frequency = {}", frequency));
      started_.configuration.push_back(fmt::format("resolution = {}", reader.u32()));
    }
  }

  void judge(std::uint8_t status) {
    constexpr std::array<const char*, 6> kWhy = {
        "",         "the frequency", "the resolution", "frequency and resolution", "the scan area",
        "something"};
    if (status == 0) return;
    started_.warnings.push_back(fmt::format("the device does not take {} (status {})",
                                            status < kWhy.size() ? kWhy.at(status) : kWhy.back(),
                                            status));
  }

  void set_view() {
    if (settings_.view_from || settings_.view_to)
      ask(request("sWN", "LMPoutputRange")
              .u16(1)
              .u32(1667)
              .i32(settings_.view_from ? telegram_angle(*settings_.view_from) : kViewFrom)
              .i32(settings_.view_to ? telegram_angle(*settings_.view_to) : kViewTo));
    if (const auto answer = look("LMPoutputRange")) {
      Reader reader = answer->reader();
      static_cast<void>(reader.u16());
      static_cast<void>(reader.u32());
      started_.configuration.push_back(fmt::format("view_from = {}", reader.i32()));
      started_.configuration.push_back(fmt::format("view_to = {}", reader.i32()));
    }
  }

  void set_echoes() {
    if (!settings_.echo_filter) return;
    if (ask(request("sWN", "FREchoFilter").u8(*settings_.echo_filter)))
      started_.configuration.push_back(fmt::format("echo_filter = {}", *settings_.echo_filter));
  }

  void set_data() {
    const bool all = settings_.echo_filter == std::uint8_t{1};
    Writer data = request("sWN", "LMDscandatacfg");
    data.u8(all ? 0x1F : 1).u8(0).u8(settings_.remission ? 1 : 0).u8(0).u8(0);
    data.u8(settings_.encoder ? 1 : 0).u8(0).u8(0).u8(0).u8(0).u8(1).u16(1);
    if (!ask(data)) return;
    started_.configuration.push_back(fmt::format("remission = {}", settings_.remission));
    started_.configuration.push_back(fmt::format("encoder = {}", settings_.encoder));
  }

  void begin() {
    if (const auto answer = ask(request("sMN", "LMCstartmeas")))
      if (answer->reader().u8() != 0)
        started_.warnings.emplace_back("LMCstartmeas was not allowed");
    ask(request("sMN", "Run"), settings_.timeouts.ready);
    wait_until_measuring();
    static_cast<void>(session_.ask(request("sEN", "LMDscandata").u8(1), settings_.timeouts.answer));
  }

  void wait_until_measuring() {
    const auto end = SteadyClock::now() + std::chrono::duration<double>(settings_.timeouts.ready);
    while (true) {
      std::optional<Answer> answer;
      try {
        answer = look("STlms");
      } catch (const NoAnswer&) {  // while the motor changes its speed the device may be mute
        if (SteadyClock::now() >= end) throw;
        continue;
      }
      if (!answer) return;  // this firmware does not say
      const auto state = static_cast<DeviceState>(answer->reader().u16());
      if (state == DeviceState::measuring) return;
      if (state == DeviceState::error)
        throw Error(Fault::device, "the device says that it is in error (STlms 10)");
      if (SteadyClock::now() >= end)
        throw ConnectionLost(fmt::format("the device does not measure after {:g} s (STlms {})",
                                         settings_.timeouts.ready, static_cast<int>(state)));
      session_.pump(0.1);
      interrupt_();
    }
  }

  Session& session_;
  Dialect dialect_;
  const DeviceSettings& settings_;
  const Interrupt& interrupt_;
  Started started_;
};

}  // namespace

void DeviceSettings::check() const {
  static_cast<void>(parse_endpoint(address, kHostPort));
  if (frequency.has_value() != resolution.has_value())
    refuse(frequency ? "resolution" : "frequency", "frequency and resolution are set together");
  if (frequency &&
      !mode_of(hundredths(*frequency), static_cast<std::uint32_t>(telegram_angle(*resolution)))) {
    std::string pairs;
    for (const Mode& mode : kModes)
      pairs += fmt::format("{}{:g} Hz {:g}", pairs.empty() ? "" : ", ", 0.01 * mode.frequency,
                           1e-4 * mode.resolution);
    refuse("frequency",
           fmt::format("the device does not do {:g} Hz with {:.4g} degrees", *frequency,
                       1e-4 * telegram_angle(*resolution)),
           "it does " + pairs);
  }
  const std::int32_t from = view_from ? telegram_angle(*view_from) : kViewFrom;
  const std::int32_t to = view_to ? telegram_angle(*view_to) : kViewTo;
  if (from < kViewFrom || to > kViewTo || from >= to)
    refuse(view_from ? "view_from" : "view_to", "the view is -5 to 185 degrees, from below to");
}

Started start_device(Session& session, Dialect dialect, const DeviceSettings& settings,
                     const Interrupt& interrupt) {
  return Start(session, dialect, settings, interrupt).run();
}

void stop_device(Session& session, Dialect dialect, double seconds) noexcept {
  try {
    static_cast<void>(session.ask(Writer(dialect, "sEN", "LMDscandata").u8(0), seconds));
  } catch (...) {  // NOLINT(bugprone-empty-catch): the scan is done; the connection closes anyway
  }
}

}  // namespace velum::lms511
