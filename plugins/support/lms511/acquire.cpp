// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/acquire.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <thread>

#include "lms511/scan.hpp"
#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

constexpr std::string_view kLocal = "local:";

Dialect first_dialect(const DeviceSettings& device) {
  if (device.dialect) return *device.dialect;
  const bool ascii = parse_endpoint(device.address, kHostPort).port == kAsciiPort;
  return ascii ? Dialect::ascii : Dialect::binary;
}

// An angle [deg] at the end of a message, in radians: "12.5" or "1700000000.25 12.5".
std::optional<double> angle_in(std::string_view text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r' || text.back() == '\n'))
    text.remove_suffix(1);
  const std::size_t blank = text.find_last_of(" \t,;");
  if (blank != std::string_view::npos) text.remove_prefix(blank + 1);
  double degrees = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), degrees);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() ||
      !std::isfinite(degrees))
    return std::nullopt;
  return degrees * std::numbers::pi / 180.0;
}

// To the nanosecond, so that no two recordings begin the same.
std::string wall_clock() {
  const auto now = std::chrono::system_clock::now();
  const auto nanoseconds = now.time_since_epoch() % std::chrono::seconds(1);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:09}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(now)),
                     std::chrono::duration_cast<std::chrono::nanoseconds>(nanoseconds).count());
}

}  // namespace

void TriggerSettings::check() const {
  if (source.empty() || (source.starts_with(kLocal) && source.size() > kLocal.size())) return;
  try {
    Listener::check(source);
  } catch (const Error&) {
    throw Error(Fault::graph, fmt::format("'{}' is no trigger, expected udp:PORT, tcp:PORT or "
                                          "local:NAME",
                                          source))
        .at("trigger");
  }
}

Acquisition::Acquisition(Settings settings, AcquireLog log, Interrupt interrupt)
    : settings_(std::move(settings)),
      log_(std::move(log)),
      interrupt_(std::move(interrupt)),
      begin_(SteadyClock::now()),
      last_line_(begin_),
      dialect_(first_dialect(settings_.device)),
      triggered_(settings_.trigger.source.empty()) {
  const std::string& source = settings_.trigger.source;
  if (!source.empty() && !source.starts_with(kLocal)) {
    trigger_ = Listener::at(source);
    trigger_seen_ = trigger_->count();
  }
  if (!settings_.feed.empty()) {
    feed_ = Listener::at(settings_.feed);
    feed_seen_ = feed_->count();
  }
}

Acquisition::~Acquisition() = default;

std::int64_t Acquisition::since_start(SteadyClock::time_point time) const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time - begin_).count();
}

double Acquisition::idle() const {
  return std::chrono::duration<double>(SteadyClock::now() - last_line_).count();
}

void Acquisition::wait_between(double seconds) {
  const auto end = SteadyClock::now() + std::chrono::duration<double>(seconds);
  constexpr std::chrono::milliseconds kSlice(20);
  while (SteadyClock::now() < end) {
    interrupt_();
    std::this_thread::sleep_for(kSlice);
  }
}

// One connection from its start to its end.
class Acquisition::Connection {
 public:
  Connection(Acquisition& owner, const RecordSink& sink)
      : owner_(owner),
        sink_(sink),
        endpoint_(parse_endpoint(owner.settings_.device.address,
                                 owner.dialect_ == Dialect::ascii && owner.settings_.device.dialect
                                     ? kAsciiPort
                                     : kHostPort)),
        session_(
            TcpSocket::connect(endpoint_, timeouts().connect, owner.interrupt_), owner.dialect_,
            [this](const Telegram& telegram) { take(telegram); }, owner.interrupt_) {}

  ~Connection() {
    const Framer::Counts& now = session_.counts();
    owner_.counts_.telegrams += now.telegrams;
    owner_.counts_.skipped_bytes += now.skipped_bytes;
    owner_.counts_.bad_checksums += now.bad_checksums;
    owner_.counts_.bad_lengths += now.bad_lengths;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void start() {
    sink_({Event::connected, now(), in_words(endpoint_)});
    const Started started =
        start_device(session_, owner_.dialect_, owner_.settings_.device, owner_.interrupt_);
    owner_.ever_answered_ = true;
    for (const std::string& fact : started.identity) sink_({Event::identity, now(), fact});
    for (const std::string& fact : started.configuration)
      sink_({Event::configuration, now(), fact});
    for (const std::string& warning : started.warnings) owner_.log_.warn(warning);
    heard_ = SteadyClock::now();
  }

  void stream(const std::function<bool()>& done) {
    constexpr double kSlice = 0.05;
    while (!done()) {
      session_.pump(kSlice);
      owner_.take_messages(sink_);
      const std::chrono::duration<double> quiet = SteadyClock::now() - heard_;
      // Before the first scan the motor may be changing its speed.
      const double patience =
          owner_.streaming_
              ? std::min(std::max(timeouts().silence, 3.0 / frequency_), timeouts().give_up)
              : timeouts().ready;
      if (quiet.count() > patience)
        throw ConnectionLost(fmt::format("no scan for {:.1f} s", quiet.count()));
    }
    stop_device(session_, owner_.dialect_, timeouts().answer);
  }

 private:
  [[nodiscard]] const Timeouts& timeouts() const { return owner_.settings_.device.timeouts; }
  [[nodiscard]] std::int64_t now() const { return owner_.since_start(SteadyClock::now()); }

  // Scans are passed on once the sweep has begun, other events at once.
  void take(const Telegram& telegram) {
    try {
      Reader reader(telegram);
      if (!is_scan(reader)) return sink_(record_of(telegram, now()));
      const Scan scan = decode_head(reader);
      heard_ = SteadyClock::now();
      if (scan.usable()) {
        owner_.last_line_ = heard_;
        owner_.streaming_ = true;
        frequency_ = std::max(0.01 * scan.scan_frequency, 1.0);
        owner_.arm();
      }
    } catch (const Malformed&) {  // counted by whoever gathers the lines
    }
    if (owner_.triggered_) sink_(record_of(telegram, now()));
  }

  Acquisition& owner_;
  const RecordSink& sink_;
  Endpoint endpoint_;
  Session session_;
  SteadyClock::time_point heard_;
  double frequency_ = 25.0;
};

void Acquisition::arm() {
  if (armed_) return;
  armed_ = true;
  armed_at_ = SteadyClock::now();
  if (triggered_) return;
  const std::string& source = settings_.trigger.source;
  if (source.starts_with(kLocal)) rendezvous_.emplace(source, settings_.trigger.count);
  log_.info("ready, waiting for the trigger");
}

// What was heard on the ports: the trigger, and angles of the tilt plate.
void Acquisition::take_messages(const RecordSink& sink) {
  if (feed_)
    for (const Listener::Message& message : feed_->since(feed_seen_))
      if (const auto angle = angle_in(message.text))
        sink({Event::tilt,
              since_start(message.arrival),
              {reinterpret_cast<const char*>(&*angle), sizeof(*angle)}});  // NOLINT
  if (triggered_) return;
  std::optional<SteadyClock::time_point> begun;
  if (rendezvous_) begun = rendezvous_->begun();
  if (trigger_) {
    // A trigger before the scanner is ready would begin a sweep without its lines.
    for (const Listener::Message& message : trigger_->since(trigger_seen_))
      if (armed_ && !begun) begun = message.arrival;
  }
  if (begun) {
    triggered_ = true;
    sink({Event::trigger, since_start(*begun), settings_.trigger.source});
    return;
  }
  const std::chrono::duration<double> waited = SteadyClock::now() - armed_at_;
  if (armed_ && waited.count() > settings_.trigger.timeout) {
    Error error(Fault::device, fmt::format("no trigger from {} within {:g} s",
                                           settings_.trigger.source, settings_.trigger.timeout));
    if (!rendezvous_) throw error;
    throw std::move(error).hint(
        fmt::format("{} of {} scanners were ready; each needs a thread of its own (--threads)",
                    rendezvous_->present(), settings_.trigger.count));
  }
}

void Acquisition::attempt(const RecordSink& sink, const std::function<bool()>& done) {
  Connection connection(*this, sink);
  connection.start();
  connection.stream(done);
}

void Acquisition::run(const RecordSink& sink, const std::function<bool()>& done) {
  sink({Event::start, 0, wall_clock()});
  const double give_up = settings_.device.timeouts.give_up;
  constexpr double kFirstWait = 0.2;
  constexpr double kLongestWait = 5.0;
  double wait = kFirstWait;
  while (true) {
    std::string why;
    streaming_ = false;
    try {
      attempt(sink, done);
      break;
    } catch (const NoAnswer& none) {
      // Silence may mean that the port speaks the other dialect.
      if (!ever_answered_ && !settings_.device.dialect)
        dialect_ = dialect_ == Dialect::ascii ? Dialect::binary : Dialect::ascii;
      why = none.what();
    } catch (const ConnectionLost& lost) {
      why = lost.what();
    } catch (const Refused& refused) {
      why = refused.what();
    } catch (const Malformed& malformed) {
      why = malformed.what();
    }
    if (streaming_) {
      wait = kFirstWait;
      sink({Event::gap, since_start(SteadyClock::now()), why});
    }
    const double left = give_up - idle();
    if (left <= 0.0)
      throw Error(Fault::device,
                  fmt::format("{}; given up after {:g} s without a scan", why, give_up))
          .at(settings_.device.address);
    log_.warn(fmt::format("{}; connecting again", why));
    wait_between(std::min(wait, left));
    wait = std::min(2.0 * wait, kLongestWait);
  }
  sink({Event::end, since_start(SteadyClock::now()), "done"});
}

}  // namespace velum::lms511
