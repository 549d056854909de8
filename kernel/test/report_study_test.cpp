// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <fstream>

#include "folder.hpp"
#include "report/run_report.hpp"
#include "report/study_report.hpp"
#include "report/views_file.hpp"
#include "velum/files.hpp"

using namespace velum;
using run::Json;
using test::Folder;

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

Json variant(const std::string& id, const std::vector<std::string>& statuses, int rank) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < statuses.size(); ++i)
    runs.push_back({{"repeat", i + 1}, {"status", statuses[i]}});
  return {{"id", id}, {"runs", runs}, {"summary", {{"a.x", {{"rank", rank}}}}}};
}

Json study_of(Json variants) {
  return {{"velum", "0"},
          {"graph", "/somewhere/sails.toml"},
          {"title", ""},
          {"axes", Json::array()},
          {"measures", {{"a.x", {{"unit", "m"}}}}},
          {"variants", std::move(variants)}};
}

/// What a cell leaves: a cloud of so many points, and a truth that is the same in all.
void leave_cell(const fs::path& folder, int points) {
  write(folder / "run.json", R"({"velum": "0", "graph": {}, "nodes": [{"use": "test.none"}]})");
  report::ViewsFile content{hash_of(FileContent(folder / "run.json").bytes()), {}};
  for (const auto& [name, count] : {std::pair("made", points), std::pair("truth", 3)}) {
    Eigen::VectorXf heights = Eigen::VectorXf::LinSpaced(count, 0.0F, 1.0F);
    content.views.push_back(report::make_view(
        Cloud(Points(Points::Ones(3, count))).with("height", Column(std::move(heights)))));
    content.views.back().node = name;
    content.views.back().output = "cloud";
  }
  report::write_views(folder / "views.bin", content);
}

Json report_of(const Folder& folder, const Json& study, const std::string& table = "variant\n") {
  write(folder / "study.json", study.dump());
  write(folder / "study.csv", table);
  plugins::Registry registry(plugins::Registry::Trust::open, {});
  report::write_study_report(folder / "", report::Page("<!-- velum:data -->", "page"), registry);
  const std::string page(FileContent(folder / "report.html").text());
  const std::size_t begin = page.find('{');
  return Json::parse(page.substr(begin, page.find("</script>") - begin));
}

}  // namespace

TEST_CASE("a variant is shown by its first repeat that is ok") {
  const Folder folder;
  leave_cell(folder / "cells/v1/1", 10);  // failed: what it has left does not count
  leave_cell(folder / "cells/v1/2", 20);
  leave_cell(folder / "cells/v2/1", 30);
  leave_cell(folder / "cells/v2/2", 40);
  const Json report = report_of(
      folder, study_of({variant("v1", {"failed", "ok"}, 1), variant("v2", {"ok", "ok"}, 2),
                        variant("v3", {"crashed", "failed"}, 3)}));
  CHECK(report.at("title") == "sails");
  CHECK(report.at("views_of") == Json({{"variants", 2}, {"of", 3}}));
  std::vector<std::string> ids;
  for (const Json& value : report.at("values")) ids.push_back(value.at("id").get<std::string>());
  CHECK(ids == std::vector<std::string>{"v1/made.cloud", "v1/truth.cloud", "v2/made.cloud",
                                        "v2/truth.cloud"});
  CHECK(report.at("values").at(0).at("count") == 20);
  CHECK(report.at("values").at(2).at("count") == 30);
  // The truth is stored, and its heights told, once.
  CHECK(report.at("values").at(1).at("positions").at("at") ==
        report.at("values").at(3).at("positions").at("at"));
  std::vector<std::string> told;
  for (const Json& each : report.at("histograms")) told.push_back(each.at("value"));
  CHECK(told == std::vector<std::string>{"v1/made.cloud", "v1/truth.cloud", "v2/made.cloud"});
}

TEST_CASE("damaged and strange cells show nothing") {
  const Folder folder;
  leave_cell(folder / "cells/v1/1", 10);
  write(folder / "cells/v1/1/views.bin", "VELUMVW1");
  leave_cell(folder / "cells/v2/1", 10);
  write(folder / "cells/v2/1/run.json", "{}");  // another run's
  const Json report =
      report_of(folder, study_of({variant("v1", {"ok"}, 1), variant("v2", {"ok"}, 2)}));
  CHECK(report.at("values").empty());
  CHECK(report.at("views_of").at("variants") == 0);
}

TEST_CASE("of a very large study the best variants are told") {
  const Folder folder;
  Json variants = Json::array();
  for (int i = 0; i < 5000; ++i)
    variants.push_back(
        variant("v" + std::to_string(i), std::vector<std::string>(11, "ok"), 5000 - i));
  const Json report = report_of(folder, study_of(std::move(variants)), std::string(5'000'000, 'x'));
  const Json& told = report.at("study").at("variants");
  REQUIRE(told.size() == 2000);
  CHECK(told.front().at("id") == "v3000");  // the best ranks, in the study's order
  CHECK(told.back().at("id") == "v4999");
  CHECK_FALSE(told.front().contains("runs"));
  CHECK(report.at("told") == Json({{"variants", 2000}, {"of", 5000}}));
  CHECK_FALSE(report.contains("csv"));
}

TEST_CASE("what is no study's result is an error") {
  const Folder folder;
  CHECK_THROWS_AS(report_of(folder, {{"velum", "0"}}), Error);
  Json study = study_of(Json::array({variant("v1", {"ok"}, 1)}));
  study["variants"][0].erase("runs");
  CHECK_THROWS_AS(report_of(folder, study), Error);
}
