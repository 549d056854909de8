// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include <clocale>
#include <numbers>

#include "fake_catalog.hpp"
#include "graph/settings.hpp"
#include "graph/units.hpp"

using namespace velum;         // NOLINT
using namespace velum::graph;  // NOLINT

namespace {

const Parameter& parameter(const std::string& stage, const std::string& name) {
  static fake::Catalog catalog;
  for (const Parameter& p : catalog.find(stage)->parameters)
    if (p.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}

Parameter plain(ParameterType type, Range range = anything()) {
  Parameter p;
  p.name = "x";
  p.type = type;
  p.range = range;
  return p;
}

Setting set(ParameterType type, const std::string& text) {
  return parse_setting_text(plain(type), text);
}

std::string fault(const Parameter& p, const std::string& text) {
  try {
    (void)parse_setting_text(p, text);
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::graph);
    return std::string(error.what()) + (error.hint().empty() ? "" : " | " + error.hint());
  }
  return "";
}

}  // namespace

TEST_CASE("amounts") {
  CHECK(parse_amount("5 mm")->number == 5);
  CHECK(parse_amount("5 mm")->unit == "mm");
  CHECK(parse_amount("  -1.5e-3m ")->number == -1.5e-3);
  CHECK(parse_amount("+2 spacing")->unit == "spacing");
  CHECK(parse_amount("1 %   diagonal")->unit == "% diagonal");
  for (const char* wrong : {"", "mm", "mm 5", "inf m", "nan", "+-1", "--1", "1e999 m", "."})
    CHECK_FALSE(parse_amount(wrong));
  CHECK(parse_number("0.1") == 0.1);
  CHECK_FALSE(parse_number("0.1 m"));
  CHECK_FALSE(parse_number("0,1"));
}

TEST_CASE("units are converted with one rounding") {
  const auto metres = [](const char* text) { return to_length(*parse_amount(text))->value; };
  CHECK(metres("7 mm") == 0.007);
  CHECK(metres("80 mm") == 0.08);
  CHECK(metres("3 um") == 0.000003);
  CHECK(metres("12 cm") == 0.12);
  CHECK(metres("1.5 km") == 1500);
  CHECK(metres("1 in") == 0.0254);
  CHECK(metres("10 ft") == 3.048);
  CHECK(metres("2 m") == 2);
  CHECK(to_angle({180, "deg"}) == std::numbers::pi);
  CHECK(to_angle({1, "rad"}) == 1);
  CHECK(to_duration({250, "ms"}) == 0.25);
  CHECK(to_duration({2, "min"}) == 120);
  CHECK(to_duration({1, "h"}) == 3600);
  CHECK(to_bytes({2, "MiB"}) == 2097152);
  CHECK_FALSE(to_length({1, "furlong"}));
  CHECK_FALSE(to_angle({1, "m"}));
  CHECK(length_unit("mm").metres == 0.001);
  CHECK_THROWS_AS(length_unit("yard"), Error);
}

TEST_CASE("lengths may be relative") {
  CHECK(set(ParameterType::length, "2 spacing") == Setting{spacings(2)});
  CHECK(set(ParameterType::length, "1 % diagonal") == Setting{diagonals(0.01)});
  CHECK(set(ParameterType::length, "1% diagonal") == Setting{diagonals(0.01)});
  CHECK(set(ParameterType::length, "0.5") == Setting{Length(0.5)});
  CHECK(set(ParameterType::length, "\"5 mm\"") == Setting{Length(0.005)});
}

TEST_CASE("resolve turns them into metres and checks the range again") {
  const Parameter size = plain(ParameterType::length, between(0.001, 1.0));
  CHECK(is_relative({spacings(2)}));
  CHECK_FALSE(is_relative({Length(2)}));
  CHECK(resolve(size, {spacings(2)}, 0.01, 5) == Setting{Length(0.02)});
  CHECK(resolve(size, {diagonals(0.01)}, 0.01, 5) == Setting{Length(0.05)});
  CHECK(resolve(size, {Length(0.5)}, 0, 0) == Setting{Length(0.5)});
  CHECK(resolve(size, {}, 0, 0) == Setting{});
  CHECK_THROWS_WITH(resolve(size, {spacings(2)}, 0.00025, 5),
                    "'x' is 2 spacing, here 0.0005 m; it must be between 0.001 and 1 m");
  Parameter list = size;
  list.list = true;
  const Setting both{Setting::List{{spacings(2)}, {Length(0.3)}}};
  CHECK(is_relative(both));
  CHECK(resolve(list, both, 0.1, 1) == Setting{Setting::List{{Length(0.2)}, {Length(0.3)}}});
}

TEST_CASE("plain types") {
  CHECK(set(ParameterType::boolean, "true") == Setting{true});
  CHECK(set(ParameterType::integer, "0x10") == Setting{std::int64_t{16}});
  CHECK(set(ParameterType::number, "5") == Setting{5.0});
  CHECK(set(ParameterType::number, "50 %") == Setting{0.5});
  CHECK(set(ParameterType::text, "hello world") == Setting{std::string("hello world")});
  CHECK(set(ParameterType::angle, "180") == Setting{std::numbers::pi});
  CHECK(set(ParameterType::angle, "0.5 rad") == Setting{0.5});
  CHECK(set(ParameterType::duration, "3") == Setting{3.0});
  CHECK(set(ParameterType::length_unit, "ft") == Setting{std::string("ft")});
  CHECK(set(ParameterType::vector, "[0, 0.5, 1]") == Setting{Setting::List{{0.0}, {0.5}, {1.0}}});
  CHECK(set(ParameterType::point, "[1, \"5 mm\", 0]") ==
        Setting{Setting::List{{1.0}, {0.005}, {0.0}}});
  CHECK(parse_setting_text(parameter("registration.icp", "metric"), "point_to_plane") ==
        Setting{std::string("point_to_plane")});
  CHECK(parse_setting_text(parameter("registration.svd", "weights"), "[1, 2.5]") ==
        Setting{Setting::List{{1.0}, {2.5}}});
}

TEST_CASE("a number may repeat its own unit") {
  Parameter p = plain(ParameterType::number);
  p.unit = "points";
  CHECK(parse_setting_text(p, "3 points") == Setting{3.0});
  CHECK(fault(p, "3 %") == "'x': '%' is no unit of this number | known: points");
}

TEST_CASE("what is wrong is said") {
  CHECK(fault(plain(ParameterType::integer), "1.5") ==
        "'x' is a number; expected an integer | write it without a point");
  CHECK(fault(plain(ParameterType::boolean), "yes") == "'x' is a string; expected true or false");
  CHECK(fault(plain(ParameterType::vector), "[1, 2]") ==
        "'x' has 2 entries; expected three numbers such as [0, 0, 1]");
  CHECK(fault(plain(ParameterType::point), "[1, 2, \"2 spacing\"]") ==
        "'x': 'spacing' is no unit of a position | known: m, mm, cm, km, um, in, ft");
  CHECK(fault(plain(ParameterType::angle), "5 m") ==
        "'x': 'm' is no unit of an angle | known: deg, rad");
  CHECK(fault(plain(ParameterType::angle, between(0, std::numbers::pi / 2)), "91") ==
        "'x' is 91; it must be between 0 and 90 deg");
  CHECK(fault(plain(ParameterType::number, {.low = 0, .high = 1, .low_open = true}), "2") ==
        "'x' is 2; it must be above 0 and at most 1");
  CHECK(fault(plain(ParameterType::input_file), "\"\"") == "'x' is no name of a file");
  CHECK(fault(plain(ParameterType::input_file), "\"a\\u0000b\"") == "'x' is no name of a file");
  CHECK(fault(parameter("registration.svd", "weights"), "3") ==
        "'weights' is an integer; expected an array, each a number | put it in [ ]");
  CHECK(fault(parameter("registration.svd", "weights"), "[1, -1]") ==
        "'weights[1]' is -1; it must be at least 0");
}

TEST_CASE("rows of a small table") {
  const Parameter& pairs = parameter("registration.svd", "pairs");
  const Setting setting =
      parse_setting_text(pairs,
                         "[{ source = [1, 2, 3], target = [\"4 mm\", 5, 6] }, "
                         "{ target = [0, 0, 0], source = [0, 0, 0], weight = 2 }]");
  const auto& rows = std::get<Setting::List>(setting.value);
  REQUIRE(rows.size() == 2);
  const auto& first = std::get<Setting::List>(rows[0].value);
  REQUIRE(first.size() == 3);
  CHECK(first[1] == Setting{Setting::List{{0.004}, {5.0}, {6.0}}});
  CHECK(first[2] == Setting{1.0});
  CHECK(
      fault(pairs, "[{ source = [1, 2, 3], tarrget = [0, 0, 0] }]") ==
      "'pairs[0]': unknown key 'tarrget' | did you mean 'target'?; known: source, target, weight");
  CHECK(fault(pairs, "[{ weight = 0 }]") == "'pairs[0].weight' is 0; it must be above 0");
  CHECK(fault(pairs, "[3]") ==
        "'pairs[0]' is an integer; expected a table such as { source = ..., "
        "target = ..., weight = ... }");
}

TEST_CASE("settings written as TOML read the same") {
  const auto same = [](const Parameter& p, const std::string& text) {
    const Setting setting = parse_setting_text(p, text);
    INFO(to_toml(p, setting));
    CHECK(parse_setting_text(p, to_toml(p, setting)) == setting);
  };
  same(plain(ParameterType::length), "3.3 in");
  same(plain(ParameterType::length), "0.7 % diagonal");
  same(plain(ParameterType::angle), "7");
  same(plain(ParameterType::duration), "1 min");
  same(plain(ParameterType::number), "1e300");
  same(plain(ParameterType::number), "-3");
  same(plain(ParameterType::text), "\"quo\\\"te \\\\ \\n \\u0001 \\u00e9\"");
  same(plain(ParameterType::vector), "[0.1, 2, -3]");
  same(plain(ParameterType::point), "[\"1 ft\", 2, 3]");
  same(parameter("registration.svd", "pairs"),
       "[{ source = [1, 2, 3], target = [4, 5, 6], weight = 0.1 }]");
  same(parameter("registration.svd", "weights"), "[0.1, 0.25]");
  same(parameter("registration.svd", "weights"), "[]");
}

TEST_CASE("numbers do not depend on the locale") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) {
    WARN("skipped: the locale de_DE.UTF-8 is not there");
    return;
  }
  CHECK(set(ParameterType::length, "2.5 mm") == Setting{Length(0.0025)});
  CHECK(set(ParameterType::number, "2.5") == Setting{2.5});
  CHECK(to_toml(plain(ParameterType::number), {2.5}) == "2.5");
  std::setlocale(LC_ALL, before.c_str());
}
