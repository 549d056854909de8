// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "formats/lzf.hpp"
#include "formats/pcd.hpp"
#include "formats/pcd_header.hpp"
#include "formats/rows.hpp"

namespace velum::formats {
namespace {

/// Points `fields` at packed rows or, with `stride` 0, at one array a field.
void place_fields(std::vector<Field>& fields, const std::byte* data, std::size_t stride,
                  Index points) {
  for (Field& field : fields) {
    const std::size_t bytes = static_cast<std::size_t>(field.width) * size_of(field.type);
    field.data = data;
    field.stride = stride == 0 ? bytes : stride;
    data += stride == 0 ? bytes * static_cast<std::size_t>(points) : bytes;
  }
  std::erase_if(fields, [](const Field& field) { return field.width == 0; });
}

Cloud finish(const Source& source, PcdHeader& header, const ReadOptions& options,
             Context& context) {
  Records records;
  records.count = header.points;
  records.fields = std::move(header.fields);
  records.sensors = std::move(header.sensors);
  return assemble(source, records, options, NotFinite::drop, context);
}

Cloud read_ascii(Source& source, PcdHeader& header, const ReadOptions& options, Context& context) {
  const Lines lines = split_lines(source.text().substr(header.body), true, context);
  if (lines.count != header.points)
    throw source.bad_line(
        source.size(),
        fmt::format("found {} lines of points, expected {} (POINTS)", lines.count, header.points));
  RowLayout layout;
  layout.loose = true;
  for (Field& field : header.fields) {
    // The text may hold more digits than the type that the header states: large coordinates keep
    // them.
    const std::string name = lower(field.name);
    if (field.type == FieldType::f32 && (name == "x" || name == "y" || name == "z"))
      field.type = FieldType::f64;
    for (Index i = 0; i < field.width; ++i) layout.add(field.type);
  }
  // A line holds at least a digit a value, so this many rows cannot come from a lying header.
  const Buffer rows = parse_rows(source, lines, 0, header.points, layout, context);
  source.release();
  place_fields(header.fields, rows.data.get(), layout.stride, header.points);
  return finish(source, header, options, context);
}

Cloud read_binary(const Source& source, PcdHeader& header, const ReadOptions& options,
                  Context& context) {
  const std::size_t bytes = static_cast<std::size_t>(header.points) * header.stride;
  const std::size_t found = source.size() - header.body;
  if (found < bytes)
    throw source.bad_byte(source.size(),
                          fmt::format("the file ends after {} of {} bytes of points ({} points of "
                                      "{} bytes)",
                                      found, bytes, header.points, header.stride));
  source.require_end(header.body + bytes);
  place_fields(header.fields, source.bytes().data() + header.body, header.stride, header.points);
  return finish(source, header, options, context);
}

Cloud read_compressed(Source& source, PcdHeader& header, const ReadOptions& options,
                      Context& context) {
  const std::size_t body = header.body;
  const std::span<const std::byte> bytes = source.bytes();
  if (bytes.size() - body < 8)
    throw source.bad_byte(bytes.size(), "the file ends before the lengths of the packed data");
  const std::size_t packed = load<std::uint32_t>(bytes.data() + body, false);
  const std::size_t unpacked = load<std::uint32_t>(bytes.data() + body + 4, false);
  const std::size_t expected = static_cast<std::size_t>(header.points) * header.stride;
  if (packed > bytes.size() - body - 8)
    throw source.bad_byte(body, fmt::format("{} bytes of packed data expected, {} follow", packed,
                                            bytes.size() - body - 8));
  if (unpacked != expected || unpacked / kLzfMostRatio > packed)
    throw source.bad_byte(body + 4,
                          fmt::format("{} packed bytes said to hold {}, expected {} ({} "
                                      "points of {} bytes)",
                                      packed, unpacked, expected, header.points, header.stride));
  source.require_end(body + 8 + packed);
  const Buffer data(unpacked);
  context.check();
  if (!lzf_unpack(bytes.subspan(body + 8, packed), {data.data.get(), unpacked}))
    throw source.bad_byte(body + 8, "the packed data are damaged");
  source.release();
  place_fields(header.fields, data.data.get(), 0, header.points);
  return finish(source, header, options, context);
}

}  // namespace

Cloud read_pcd(Source& source, const ReadOptions& options, Context& context) {
  PcdHeader header = read_pcd_header(source);
  switch (header.data) {
    case PcdHeader::Data::ascii:
      return read_ascii(source, header, options, context);
    case PcdHeader::Data::binary:
      return read_binary(source, header, options, context);
    case PcdHeader::Data::compressed:
      break;
  }
  return read_compressed(source, header, options, context);
}

}  // namespace velum::formats
