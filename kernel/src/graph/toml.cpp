// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/toml.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "graph/toml_form.hpp"

namespace velum::graph::toml {
// An assertion of toml++ 3.3.0 that fails on a document is a refusal of the document, never an
// abort.
[[noreturn]] static void refuse() {
  throw SyntaxError({}, "this is not TOML");
}
}  // namespace velum::graph::toml

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#define TOML_FLOAT_CHARCONV 1  // the stream that it would use otherwise is slow
#define TOML_ENABLE_FORMATTERS 0
#define TOML_ASSERT(expr)                        \
  do {                                           \
    if (!(expr)) ::velum::graph::toml::refuse(); \
  } while (false)
// In release builds toml++ would turn its assertions off, this one included.
#undef NDEBUG
#include <toml++/toml.h>

namespace velum::graph::toml {
namespace {

Region region_of(const ::toml::source_region& source) {
  return {{source.begin.line, source.begin.column}, {source.end.line, source.end.column}};
}

std::string to_text(const ::toml::date& d) {
  return fmt::format("{:04}-{:02}-{:02}", d.year, d.month, d.day);
}

std::string to_text(const ::toml::time& t) {
  std::string text = fmt::format("{:02}:{:02}:{:02}", t.hour, t.minute, t.second);
  if (t.nanosecond == 0) return text;
  text += fmt::format(".{:09}", t.nanosecond);
  text.erase(text.find_last_not_of('0') + 1);
  return text;
}

std::string to_text(const ::toml::date_time& dt) {
  std::string text = to_text(dt.date) + "T" + to_text(dt.time);
  if (!dt.offset) return text;
  const int minutes = dt.offset->minutes;
  if (minutes == 0) return text + "Z";
  const int size = std::abs(minutes);
  return text + fmt::format("{}{:02}:{:02}", minutes < 0 ? '-' : '+', size / 60, size % 60);
}

Node convert(const ::toml::node& from);

void convert_table(const ::toml::table& from, Node& to) {
  to.kind = Kind::table;
  for (const auto& [key, value] : from)
    to.entries.push_back({std::string(key.str()), region_of(key.source()), convert(value)});
  // toml++ sorts by name; places tell the order of the file.
  std::ranges::stable_sort(to.entries, {}, [](const Entry& entry) { return entry.where.begin; });
}

void convert_value(const ::toml::node& from, Node& to) {
  if (const auto* text = from.as_string()) {
    to.kind = Kind::string;
    to.text = text->get();
  } else if (const auto* integer = from.as_integer()) {
    to.kind = Kind::integer;
    to.integer = integer->get();
  } else if (const auto* number = from.as_floating_point()) {
    to.kind = Kind::number;
    to.number = number->get();
  } else if (const auto* boolean = from.as_boolean()) {
    to.kind = Kind::boolean;
    to.boolean = boolean->get();
  } else if (const auto* date = from.as_date()) {
    to.kind = Kind::local_date;
    to.text = to_text(date->get());
  } else if (const auto* time = from.as_time()) {
    to.kind = Kind::local_time;
    to.text = to_text(time->get());
  } else if (const auto* both = from.as_date_time()) {
    to.kind = both->get().offset ? Kind::offset_date_time : Kind::local_date_time;
    to.text = to_text(both->get());
  }
}

// Recursion is bounded by kMaxDepth.
Node convert(const ::toml::node& from) {
  Node to;
  to.where = region_of(from.source());
  if (const auto* table = from.as_table()) {
    convert_table(*table, to);
  } else if (const auto* array = from.as_array()) {
    to.kind = Kind::array;
    for (const auto& item : *array) to.items.push_back(convert(item));
  } else {
    convert_value(from, to);
  }
  return to;
}

// "Error while parsing key-value pair: cannot redefine ..." without its beginning.
std::string reason(std::string_view description) {
  const auto colon = description.find(": ");
  if (description.starts_with("Error while parsing") && colon != std::string_view::npos)
    description.remove_prefix(colon + 2);
  return std::string(description);
}

}  // namespace

const Entry* Node::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &Entry::key);
  return found == entries.end() ? nullptr : &*found;
}

std::string_view name_of(Kind kind) {
  switch (kind) {
    case Kind::table:
      return "table";
    case Kind::array:
      return "array";
    case Kind::string:
      return "string";
    case Kind::integer:
      return "integer";
    case Kind::number:
      return "number";
    case Kind::boolean:
      return "boolean";
    case Kind::offset_date_time:
    case Kind::local_date_time:
      return "date and time";
    case Kind::local_date:
      return "date";
    case Kind::local_time:
      return "time";
  }
  return "value";
}

Node parse(std::string_view document) {
  if (document.starts_with("\xEF\xBB\xBF")) document.remove_prefix(3);
  check_form(document);
  try {
    return convert(::toml::parse(document));
  } catch (const ::toml::parse_error& error) {
    Region where = region_of(error.source());
    where.end = std::max(where.end, Position{where.begin.line, where.begin.column + 1});
    throw SyntaxError(where, reason(error.description()));
  }
}

Node parse_value(std::string_view text) {
  try {
    Node document = parse(fmt::format("v = {}", text));
    if (document.entries.size() == 1) return std::move(document.entries.front().value);
  } catch (const SyntaxError&) {  // then it is a bare word
  }
  Node node;
  node.kind = Kind::string;
  node.text = text;
  return node;
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace velum::graph::toml
