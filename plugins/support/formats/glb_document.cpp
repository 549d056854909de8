// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/glb_document.hpp"

#include <fmt/format.h>

namespace velum::formats {
namespace {

using json = nlohmann::json;

constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr std::uint32_t kJson = 0x4E4F534AU;
constexpr std::uint32_t kBinary = 0x004E4942U;

/// Extensions of how surfaces look; they change no triangle.
constexpr std::string_view kLooks[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                       "KHR_lights_"};

/// Numbers of component types in the file.
std::optional<FieldType> component_type(std::size_t number) {
  switch (number) {
    case 5120:
      return FieldType::i8;
    case 5121:
      return FieldType::u8;
    case 5122:
      return FieldType::i16;
    case 5123:
      return FieldType::u16;
    case 5125:
      return FieldType::u32;
    case 5126:
      return FieldType::f32;
    default:
      return std::nullopt;
  }
}

Index width_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

}  // namespace

std::string place_of(const char* list, std::size_t index) {
  return fmt::format("{}[{}]", list, index);
}

GlbDocument::GlbDocument(const Source& source) : source_(source) {
  read_chunks();
  require_known_extensions();
}

Error GlbDocument::bad(const std::string& place, const std::string& message) const {
  return Error(Fault::input, message).at(source_.name() + ": " + place);
}

void GlbDocument::read_chunks() {
  const auto number = [&](std::size_t at) {
    return load<std::uint32_t>(source_.bytes().data() + at, false);
  };
  if (source_.size() < kHeader + kChunkHeader)
    throw source_.bad_byte(source_.size(), "the file ends within its header of 20 bytes");
  if (number(4) != 2)
    throw source_.bad_byte(4, fmt::format("glTF version {}, expected 2", number(4)));
  const std::size_t end = number(8);
  if (end > source_.size() || end < kHeader + kChunkHeader)
    throw source_.bad_byte(
        8, fmt::format("the header says {} bytes, the file has {}", end, source_.size()));
  source_.require_end(end);
  bool binary = false;
  for (std::size_t at = kHeader; at < end;) {
    if (end - at < kChunkHeader)
      throw source_.bad_byte(at, fmt::format("{} bytes, expected a chunk of 8 or more", end - at));
    const std::size_t length = number(at);
    const std::uint32_t kind = number(at + 4);
    const std::size_t begin = at + kChunkHeader;
    if (length > end - begin)
      throw source_.bad_byte(
          at, fmt::format("a chunk of {} bytes, but {} are left", length, end - begin));
    if ((at == kHeader) != (kind == kJson))
      throw source_.bad_byte(
          at + 4, at == kHeader ? "the first chunk is not the JSON one" : "a second JSON chunk");
    if (kind == kJson) parse(begin, length);
    if (kind == kBinary && !binary) binary_ = source_.bytes().subspan(begin, length);
    binary = binary || kind == kBinary;
    at = begin + length;
  }
}

void GlbDocument::parse(std::size_t begin, std::size_t length) {
  try {
    root_ = json::parse(source_.text().substr(begin, length));
  } catch (const json::parse_error& error) {
    throw source_.bad_byte(begin + (error.byte == 0 ? 0 : error.byte - 1),
                           "the JSON cannot be read from here on");
  } catch (const json::exception&) {
    throw source_.bad_byte(begin, "the JSON has a number that is out of range");
  }
  if (!root_.is_object()) throw source_.bad_byte(begin, "the JSON is no object");
}

void GlbDocument::require_known_extensions() const {
  const auto found = root_.find("extensionsRequired");
  if (found == root_.end()) return;
  if (!found->is_array()) throw bad("extensionsRequired", "found no list of names");
  for (const json& name : *found) {
    const std::string text = name.is_string() ? name.get<std::string>() : name.type_name();
    if (std::none_of(std::begin(kLooks), std::end(kLooks),
                     [&](std::string_view look) { return text.starts_with(look); }))
      throw bad("extensionsRequired",
                "the file needs " + quote(text) + ", expected plain glTF 2.0 without extensions")
          .hint("export it without compression");
  }
}

const json& GlbDocument::entry(const std::string& list, std::size_t index) const {
  const auto found = root_.find(list);
  const std::size_t count = found != root_.end() && found->is_array() ? found->size() : 0;
  if (index >= count)
    throw bad(place_of(list.c_str(), index), fmt::format("there is none; the file has {}", count));
  const json& result = (*found)[index];
  if (!result.is_object()) throw bad(place_of(list.c_str(), index), "found no object");
  return result;
}

std::optional<std::size_t> GlbDocument::whole(const json& object, const char* key,
                                              const std::string& place) const {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  if (!found->is_number_unsigned())
    throw bad(place,
              fmt::format("'{}' is {}, expected a whole number from 0", key,
                          quote(found->dump(-1, ' ', true, json::error_handler_t::replace))));
  return found->get<std::size_t>();
}

std::size_t GlbDocument::required(const json& object, const char* key,
                                  const std::string& place) const {
  const auto number = whole(object, key, place);
  if (!number) throw bad(place, fmt::format("there is no '{}'", key));
  return *number;
}

std::string GlbDocument::text(const json& object, const char* key) const {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::span<const std::byte> GlbDocument::view(std::size_t index) const {
  const json& view = entry("bufferViews", index);
  const std::string place = place_of("bufferViews", index);
  const std::size_t number = required(view, "buffer", place);
  const json& buffer = entry("buffers", number);
  if (number != 0 || buffer.contains("uri"))
    throw bad(place,
              fmt::format("buffers[{}] is not within the file, expected the binary chunk", number))
        .hint("export it as a GLB that holds all of its data");
  const std::size_t size = required(buffer, "byteLength", "buffers[0]");
  if (size > binary_.size())
    throw bad("buffers[0]",
              fmt::format("{} bytes, but the binary chunk has {}", size, binary_.size()));
  const std::size_t offset = whole(view, "byteOffset", place).value_or(0);
  const std::size_t length = required(view, "byteLength", place);
  if (offset > size || length > size - offset)
    throw bad(place,
              fmt::format("{} bytes from byte {}, but the buffer has {}", length, offset, size));
  return binary_.subspan(offset, length);
}

GlbArray GlbDocument::accessor(std::size_t index) const {
  const json& accessor = entry("accessors", index);
  const std::string place = place_of("accessors", index);
  if (accessor.contains("sparse"))
    throw bad(place, "a sparse accessor, expected one with all of its values");
  const std::size_t component = required(accessor, "componentType", place);
  const auto type = component_type(component);
  if (!type)
    throw bad(place,
              fmt::format("component type {}, expected 5120 to 5123, 5125 or 5126", component));
  GlbArray array;
  array.type = *type;
  array.width = width_of(text(accessor, "type"));
  if (array.width == 0)
    throw bad(place,
              "type " + quote(text(accessor, "type")) + ", expected SCALAR, VEC2, VEC3 or VEC4");
  array.normalised = accessor.value("normalized", json()) == json(true);
  const std::size_t number = required(accessor, "bufferView", place);
  const std::span<const std::byte> bytes = view(number);
  const std::size_t element = static_cast<std::size_t>(array.width) * size_of(array.type);
  array.stride = whole(entry("bufferViews", number), "byteStride", place_of("bufferViews", number))
                     .value_or(element);
  constexpr std::size_t kMostStride = 252;
  if (array.stride < element || array.stride > kMostStride)
    throw bad(place, fmt::format("a step of {} bytes, expected {} to {}", array.stride, element,
                                 kMostStride));
  const std::size_t count = required(accessor, "count", place);
  const std::size_t offset = whole(accessor, "byteOffset", place).value_or(0);
  if (count == 0) throw bad(place, "0 elements, expected one or more");
  if (offset > bytes.size() || bytes.size() - offset < element ||
      (bytes.size() - offset - element) / array.stride < count - 1)
    throw bad(place, fmt::format("{} elements of {} bytes from byte {}, but bufferViews[{}] has {}",
                                 count, element, offset, number, bytes.size()));
  array.count = static_cast<Index>(count);
  array.data = bytes.data() + offset;
  return array;
}

}  // namespace velum::formats
