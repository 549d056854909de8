// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "lms511/scan.hpp"

namespace velum::lms511 {
namespace {

constexpr std::string_view kName = "LMDscandata";
constexpr std::size_t kChannelName = 5;
constexpr std::size_t kEventName = 4;
constexpr std::size_t kMostChannels = 5;
constexpr std::size_t kMostEncoders = 3;
constexpr std::size_t kMostEvents = 32;

bool is_channel_name(std::string_view name) {
  return (name.starts_with("DIST") || name.starts_with("RSSI")) && name[4] >= '1' && name[4] <= '5';
}

std::size_t counted(Reader& from, std::size_t most, const char* what) {
  const std::size_t count = from.u16();
  if (count > most)
    from.fail(ErrorCode::invalid_data, fmt::format("{} {}, at most {}", count, what, most));
  return count;
}

bool flagged(Reader& from) {
  const std::uint16_t flag = from.u16();
  if (flag > 1) from.fail(ErrorCode::invalid_data, fmt::format("a flag is {}, not 0 or 1", flag));
  return flag == 1;
}

void read_head(Reader& from, Scan& scan) {
  scan.version = from.u16();
  scan.device = from.u16();
  scan.serial = from.u32();
  for (auto& part : scan.status) part = from.u8();
  scan.telegram_counter = from.u16();
  scan.scan_counter = from.u16();
  scan.start_time = from.u32();
  scan.send_time = from.u32();
  for (auto& part : scan.inputs) part = from.u8();
  for (auto& part : scan.outputs) part = from.u8();
  scan.reserved = from.u16();
  scan.scan_frequency = from.u32();
  scan.measurement_frequency = from.u32();
  scan.encoders.resize(counted(from, kMostEncoders, "encoders"));
  for (EncoderReading& encoder : scan.encoders) {
    encoder.position = from.u32();
    encoder.speed = from.u16();
  }
}

Channel read_channel(Reader& from, bool wide) {
  Channel channel;
  channel.name = from.characters(kChannelName);
  if (!is_channel_name(channel.name))
    from.fail(ErrorCode::invalid_data, "a channel is neither DIST1..5 nor RSSI1..5");
  channel.scale = from.f32();
  channel.offset = from.f32();
  if (!(channel.scale > 0.0F) || !std::isfinite(channel.scale) || !std::isfinite(channel.offset))
    from.fail(ErrorCode::invalid_data, channel.name + ": scale or offset is no sound number");
  channel.start = from.i32();
  channel.step = from.u16();
  const std::size_t count = from.u16();
  if (channel.step == 0 && count > 1)
    from.fail(ErrorCode::invalid_data, channel.name + ": an angle of 0 between beams");
  constexpr double kFull = 3.6e6;  // a full turn [1/10000 deg]
  if (std::abs(static_cast<double>(channel.start)) > kFull ||
      static_cast<double>(channel.step) * static_cast<double>(count) > kFull)
    from.fail(ErrorCode::invalid_data, channel.name + ": more than a full turn");
  const std::size_t least = from.dialect() == Dialect::ascii || wide ? 2 : 1;
  if (count * least > from.left())
    from.fail(ErrorCode::too_few_parameters,
              fmt::format("{}: {} values do not fit into the telegram", channel.name, count));
  channel.values.resize(count);
  wide ? from.numbers16(channel.values) : from.numbers8(channel.values);
  return channel;
}

// All echoes of a scan have the same beams. Remission need not: a polled device now and then
// answers with the ranges of one interlaced revolution and the remission of the next.
void require_same_beams(const Reader& from, const std::vector<Channel>& channels) {
  const Channel* first = nullptr;
  for (const Channel& one : channels) {
    if (!one.name.starts_with("DIST")) continue;
    if (first == nullptr) first = &one;
    if (one.values.size() != first->values.size() || one.start != first->start ||
        one.step != first->step)
      from.fail(ErrorCode::invalid_data, one.name + " has other beams than " + first->name);
  }
}

void read_channels(Reader& from, Scan& scan) {
  const std::size_t wide = counted(from, 2 * kMostChannels, "channels of 16 bits");
  for (std::size_t i = 0; i < wide; ++i) scan.channels16.push_back(read_channel(from, true));
  const std::size_t narrow = counted(from, 2 * kMostChannels, "channels of 8 bits");
  for (std::size_t i = 0; i < narrow; ++i) scan.channels8.push_back(read_channel(from, false));
  require_same_beams(from, scan.channels16);
}

Placement read_placement(Reader& from) {
  Placement placement;
  for (float& value : placement.pose) value = from.f32();
  placement.rotation_type = from.u8();
  placement.named = from.u8();
  return placement;
}

Moment read_moment(Reader& from) {
  Moment moment;
  moment.year = from.u16();
  moment.month = from.u8();
  moment.day = from.u8();
  moment.hour = from.u8();
  moment.minute = from.u8();
  moment.second = from.u8();
  moment.microsecond = from.u32();
  if (moment.month < 1 || moment.month > 12 || moment.day < 1 || moment.day > 31 ||
      moment.hour > 23 || moment.minute > 59 || moment.second > 60 || moment.microsecond > 999999)
    from.fail(ErrorCode::invalid_data, "a date that does not exist");
  return moment;
}

InputEvent read_event(Reader& from) {
  InputEvent event;
  event.kind = from.characters(kEventName);
  event.encoder_position = from.u32();
  event.time = from.u32();
  event.angle = from.i32();
  return event;
}

void read_tail(Reader& from, Scan& scan) {
  if (from.at_end()) return;
  if (flagged(from)) scan.placement = read_placement(from);
  if (from.at_end()) return;
  if (flagged(from)) scan.name = from.text8();
  if (from.at_end()) return;
  if (flagged(from)) scan.comment = from.text8();
  if (from.at_end()) return;
  if (flagged(from)) scan.time = read_moment(from);
  if (from.at_end()) return;
  const std::size_t events = counted(from, kMostEvents, "events");
  for (std::size_t i = 0; i < events; ++i) scan.events.push_back(read_event(from));
}

void write_channel(Writer& to, const Channel& channel, bool wide) {
  to.characters(channel.name).f32(channel.scale).f32(channel.offset).i32(channel.start);
  to.u16(channel.step).u16(static_cast<std::uint16_t>(channel.values.size()));
  wide ? to.numbers16(channel.values) : to.numbers8(channel.values);
}

void write_head(Writer& to, const Scan& scan) {
  to.u16(scan.version).u16(scan.device).u32(scan.serial);
  for (const auto part : scan.status) to.u8(part);
  to.u16(scan.telegram_counter).u16(scan.scan_counter);
  to.u32(scan.start_time).u32(scan.send_time);
  for (const auto part : scan.inputs) to.u8(part);
  for (const auto part : scan.outputs) to.u8(part);
  to.u16(scan.reserved).u32(scan.scan_frequency).u32(scan.measurement_frequency);
  to.u16(static_cast<std::uint16_t>(scan.encoders.size()));
  for (const EncoderReading& encoder : scan.encoders) to.u32(encoder.position).u16(encoder.speed);
}

void write_tail(Writer& to, const Scan& scan) {
  to.u16(scan.placement ? 1 : 0);
  if (scan.placement) {
    for (const float value : scan.placement->pose) to.f32(value);
    to.u8(scan.placement->rotation_type).u8(scan.placement->named);
  }
  to.u16(scan.name ? 1 : 0);
  if (scan.name) to.text8(*scan.name);
  to.u16(scan.comment ? 1 : 0);
  if (scan.comment) to.text8(*scan.comment);
  to.u16(scan.time ? 1 : 0);
  if (const auto& time = scan.time) {
    to.u16(time->year).u8(time->month).u8(time->day).u8(time->hour).u8(time->minute);
    to.u8(time->second).u32(time->microsecond);
  }
  to.u16(static_cast<std::uint16_t>(scan.events.size()));
  for (const InputEvent& event : scan.events)
    to.characters(event.kind).u32(event.encoder_position).u32(event.time).i32(event.angle);
}

}  // namespace

bool is_scan(const Reader& reader) {
  return reader.name() == kName && (reader.kind() == "sSN" || reader.kind() == "sRA");
}

Scan decode_head(Reader& reader) {
  if (!is_scan(reader)) reader.fail(ErrorCode::command_unknown, "the telegram is no scan");
  Scan scan;
  scan.polled = reader.kind() == "sRA";
  read_head(reader, scan);
  return scan;
}

Scan decode_scan(Reader& reader) {
  Scan scan = decode_head(reader);
  read_channels(reader, scan);
  read_tail(reader, scan);
  return scan;
}

Scan decode_scan(const Telegram& telegram) {
  Reader reader(telegram);
  return decode_scan(reader);
}

std::string encode_scan(const Scan& scan, Dialect dialect) {
  Writer to(dialect, scan.polled ? "sRA" : "sSN", kName);
  write_head(to, scan);
  to.u16(static_cast<std::uint16_t>(scan.channels16.size()));
  for (const Channel& channel : scan.channels16) write_channel(to, channel, true);
  to.u16(static_cast<std::uint16_t>(scan.channels8.size()));
  for (const Channel& channel : scan.channels8) write_channel(to, channel, false);
  write_tail(to, scan);
  return to.payload();
}

}  // namespace velum::lms511
