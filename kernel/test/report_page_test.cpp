// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numeric>

#include "folder.hpp"
#include "report/histogram.hpp"
#include "report/page.hpp"
#include "report/run_report.hpp"
#include "report/views_file.hpp"
#include "run/local_context.hpp"
#include "velum/files.hpp"

using namespace velum;
using test::Folder;

namespace {

constexpr const char* kPage =
    "<html><body>\n<!-- velum:data -->\n<script>1 < 2</script></body></html>";

std::string written(const run::Json& json, std::span<const std::byte> block) {
  const Folder folder;
  report::Page(kPage, "page").write(folder / "report.html", json, block);
  return std::string(FileContent(folder / "report.html").text());
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

report::View points_view(Index count, std::size_t order) {
  Points points(3, count);
  for (Index i = 0; i < count; ++i)
    points.col(i) =
        Eigen::Vector3f(static_cast<float>(i),
                        std::sin(static_cast<float>(order + 1) * static_cast<float>(i)), 0.0F);
  report::View view = report::make_view(Cloud(points));
  view.node = "n" + std::to_string(order);
  view.output = "cloud";
  view.order = order;
  return view;
}

}  // namespace

TEST_CASE("no text of the data can end its element") {
  const run::Json json = {{"title", "</script><script>alert(1)</script><!-- \" \\ \xff"}};
  const std::string page = written(json, {});
  const std::string inside =
      between(page, "<script id=\"velum-report\" type=\"application/json\">", "</script>");
  CHECK(inside.find('<') == std::string::npos);
  const auto title = run::Json::parse(inside).at("title").get<std::string>();
  CHECK(title.starts_with("</script><script>alert(1)</script><!-- \" \\ "));
  CHECK(page.starts_with("<html><body>\n<script id="));
  CHECK(page.ends_with("</script>\n<script>1 < 2</script></body></html>"));
}

TEST_CASE("base64 is that of RFC 4648") {
  const auto encoded = [](std::string_view text) {
    return report::base64(std::as_bytes(std::span(text)));
  };
  CHECK(encoded("").empty());
  CHECK(encoded("f") == "Zg==");
  CHECK(encoded("fo") == "Zm8=");
  CHECK(encoded("foobar") == "Zm9vYmFy");
  CHECK(encoded("\xff\xfe\xfd\xfb\xef") == "//79++8=");
}

TEST_CASE("a page without a place for the data, or with two, is refused") {
  CHECK_THROWS_AS(report::Page("<html></html>", "page"), Error);
  CHECK_THROWS_AS(report::Page(std::string(kPage) + kPage, "page"), Error);
}

TEST_CASE("a page that is not there is an error with its fix") {
  ::setenv("VELUM_REPORT_TEMPLATE", "/nowhere/page.html", 1);
  try {
    const report::Page page;
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::output);
    CHECK(error.where() == "/nowhere/page.html");
    CHECK(std::string(error.hint()).find("make build") != std::string::npos);
  }
  ::unsetenv("VELUM_REPORT_TEMPLATE");
}

TEST_CASE("a file of views is read as it was written, and refused when it is damaged") {
  const Folder folder;
  const auto file = folder / "views.bin";
  report::write_views(file, {"abc", {points_view(1000, 0), points_view(10, 1)}});
  const report::ViewsFile again = report::read_views(file);
  CHECK(again.record == "abc");
  REQUIRE(again.views.size() == 2);
  CHECK(again.views[0].positions.key() == points_view(1000, 0).positions.key());
  std::string text(FileContent(file).text());
  for (const std::size_t at : {std::size_t{3}, std::size_t{20}, std::size_t{60}, text.size() - 1}) {
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    std::ofstream(file, std::ios::binary) << damaged;
    CHECK_THROWS_AS(report::read_views(file), Error);
  }
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{39}, std::size_t{100}, text.size() - 1}) {
    std::ofstream(file, std::ios::binary) << text.substr(0, size);
    CHECK_THROWS_AS(report::read_views(file), Error);
  }
}

TEST_CASE("a report of many points stays under 20 MB") {
  report::Views views(100'000'000);
  for (std::size_t i = 0; i < 6; ++i) views.add(points_view(1'000'000, i));
  const report::Page page(std::string(3'000'000, ' ') + kPage, "page");
  const report::Packed packed = report::pack_within(views, page, {{"title", "x"}});
  CHECK(report::base64(packed.block).size() + page.size() < report::kMostBytes);
  // Thinning goes by halves: at least half of the room is used.
  CHECK(packed.block.size() > 6'000'000);
  for (const auto& value : packed.values) CHECK(value.at("count") == 1'000'000);
}

TEST_CASE("a histogram counts every finite number once") {
  std::vector<double> numbers(10000);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  numbers.push_back(std::nan(""));
  report::Histogram flat = report::histogram("x", "m", numbers);
  CHECK(flat.lo == 0.0);
  CHECK(flat.hi == 9999.0);
  CHECK(std::accumulate(flat.counts.begin(), flat.counts.end(), std::uint64_t{0}) == 10000);
  CHECK(*std::ranges::max_element(flat.counts) <= 158);
  numbers.push_back(1e9);  // one far off
  report::Histogram tailed = report::histogram("x", "m", numbers);
  CHECK(tailed.hi < 1e6);
  CHECK(tailed.above == 1);
  CHECK(std::accumulate(tailed.counts.begin(), tailed.counts.end(), std::uint64_t{0}) == 10000);
  const report::Histogram none = report::histogram("x", "m", {std::nan("")});
  CHECK(std::accumulate(none.counts.begin(), none.counts.end(), std::uint64_t{0}) == 0);
  for (const double most : {1.7e308, 5e-324}) {
    const report::Histogram extreme = report::histogram("x", "m", {-most, 0.0, most});
    CHECK(std::accumulate(extreme.counts.begin(), extreme.counts.end(), std::uint64_t{0}) +
              extreme.below + extreme.above ==
          3);
  }
  const report::Histogram equal = report::histogram("x", "m", {2.0, 2.0});
  CHECK(equal.counts[0] == 2);
}

TEST_CASE("angles and edge ratios are those of the triangles") {
  Points points(3, 4);
  points << 0, 4, 0, 8, 0, 0, 3, 0, 0, 0, 0, 0;
  Triangles triangles(3, 2);
  triangles << 0, 0, 1, 1, 2, 3;  // 3-4-5, and one without area
  const auto found = report::triangle_histograms(Mesh(Cloud(points), triangles));
  REQUIRE(found.size() == 2);
  CHECK(found[0].unit == "deg");
  CHECK(found[0].counts[static_cast<std::size_t>(90.0 / 180.0 * 64)] == 1);
  CHECK(found[0].counts[static_cast<std::size_t>(36.87 / 180.0 * 64)] == 1);
  CHECK(found[0].counts[static_cast<std::size_t>(53.13 / 180.0 * 64)] == 1);
  CHECK(found[1].lo == Approx(5.0 / 3.0));
  CHECK(std::accumulate(found[1].counts.begin(), found[1].counts.end(), std::uint64_t{0}) == 1);
}

TEST_CASE("distances are between true positions") {
  const Points grid = Points::Random(3, 200);
  const Cloud target(grid, Eigen::Vector3d(1000.0, 0.0, 0.0));
  Points moved = grid;
  moved.row(0).array() += 1000.0F;
  run::LocalContext context(1, 1);
  const report::Histogram same = report::distances("distance", Cloud(moved), target, context);
  CHECK(same.better == "lower");
  CHECK(same.hi < 1e-3);
}
