// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What `velum describe`, `list` and `new` give.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "plugins/describe.hpp"
#include "plugins/listing.hpp"
#include "plugins/scaffold.hpp"
#include "velum/files.hpp"
#include "velum/stage.hpp"

namespace {

namespace fs = std::filesystem;
using namespace velum;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

enum class Metric { point, plane };
struct Pick {
  Place source;
};

struct Everything {
  Length size = spacings(2);
  Angle limit{0.5};
  double share = 0.25;
  Metric metric = Metric::plane;
  std::vector<Pick> pairs;
  std::optional<double> trim;
  InputFile file;

  static auto about() {
    return About<Everything>("Has one of each.")
        .in("source", "what moves")
        .in("target")
        .in("more")
        .out("cloud")
        .out("table")
        .needs("target", "normals")
        .needs_when("metric", "plane", "source", "normals")
        .adds("cloud", "distance")
        .param(&Everything::size, "size", "edge", above(0.0))
        .of("target")
        .was("edge")
        .param(&Everything::limit, "limit", "largest angle", between(0.0, 1.0))
        .param(&Everything::share, "share", "of the points")
        .unit("%")
        .advanced()
        .choice(&Everything::metric, "metric", "what is minimised",
                {{"point", Metric::point, "to points"}, {"plane", Metric::plane, "to planes"}})
        .rows(&Everything::pairs, "pairs", "picked",
              Row<Pick>().field(&Pick::source, "source", "s"))
        .param(&Everything::trim, "trim", "share left out", between(0.0, 1.0))
        .param(&Everything::file, "file", "to read")
        .required()
        .seeded()
        .reference("Besl and McKay 1992")
        .licence("BSD-3-Clause");
  }
  std::tuple<Cloud, std::optional<Table>> operator()(const std::variant<Cloud, Mesh>&, const Cloud&,
                                                     const std::vector<Cloud>&, Context&) const {
    return {};
  }
};

StageInfo everything() {
  StageInfo info = Everything::about().info();
  info.id = "testing.everything";
  return info;
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("velum-new-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

std::string text_of(const fs::path& file) {
  return std::string(FileContent(file).text());
}

}  // namespace

TEST_CASE("describe --json gives all that is known, in SI units") {
  const auto json = plugins::describe_json(everything(), "format = 1\n");
  CHECK(json["id"] == "testing.everything");
  CHECK(json["determinism"] == "seeded");
  CHECK(json["licence"] == "BSD-3-Clause");
  CHECK(json["references"] == Json{"Besl and McKay 1992"});
  CHECK(json["example"] == "format = 1\n");
  CHECK(json["inputs"][0]["type"] == Json{"cloud", "mesh"});
  CHECK(json["inputs"][0]["needs"][0] ==
        Json{{"column", "normals"}, {"when", {{"metric", "plane"}}}});
  CHECK(json["inputs"][1]["type"] == "cloud");
  CHECK(json["inputs"][1]["needs"] == Json{"normals"});
  CHECK(json["inputs"][2]["many"] == true);
  CHECK(json["outputs"][0]["adds"] == Json{"distance"});
  CHECK(json["outputs"][1]["type"] == "table");

  const auto& parameters = json["parameters"];
  CHECK(parameters[0]["default"] == "2 spacing");
  CHECK(parameters[0]["unit"] == "m");
  CHECK(parameters[0]["range"]["min"] == 0.0);
  CHECK(parameters[0]["range"]["min_open"] == true);
  CHECK(parameters[0]["range"]["max"].is_null());
  CHECK(parameters[0]["relative_to"] == "target");
  CHECK(parameters[1]["default"] == 0.5);
  CHECK(parameters[1]["unit"] == "rad");
  CHECK(parameters[2]["range"].is_null());
  CHECK(parameters[3]["default"] == "plane");
  CHECK(parameters[3]["choices"][1]["doc"] == "to planes");
  CHECK(parameters[4]["fields"][0]["name"] == "source");
  CHECK(parameters[5]["default"].is_null());
  CHECK(parameters[6]["required"] == true);
  CHECK(parameters[6]["type"] == "input_file");
}

TEST_CASE("describe gives the same in words") {
  const auto text = plugins::describe_text(everything(), "format = 1\n\n[node.a]\n");
  for (const char* part :
       {"testing.everything\n  Has one of each.\n",
        "cloud or mesh; needs normals when metric = plane", "cloud, any number", "adds distance",
        "default \"2 spacing\", above 0 m, relative to 'target'", "formerly 'edge'",
        "plane: to planes", "file    input_file, required", "determinism seeded",
        "Besl and McKay 1992", "example\n  format = 1\n\n  [node.a]\n", "what moves"})
    CHECK_THAT(text, Contains(part));
}

TEST_CASE("the example is read without its licence lines") {
  const Folder folder;
  std::ofstream(folder.path / "a.toml")
      << "# SPDX-FileCopyrightText: x\n# SPDX-License-Identifier: MIT\nformat = 1\n";
  CHECK(plugins::example_beside(folder.path / "a.so") == "format = 1\n");
  CHECK(plugins::example_beside(folder.path / "b.so").empty());
}

TEST_CASE("the list has summaries, what is refused and what is hidden") {
  const Folder folder;
  ::setenv("XDG_CACHE_HOME", folder.path.c_str(), 1);
  const fs::path built = fs::path(VELUM_BINARY_DIR) / "test-plugins" / "bad";
  for (const char* place : {"first/bad", "second/bad"}) fs::create_directories(folder.path / place);
  for (const char* name : {"sound", "crash", "not_a_plugin", "undefined_symbol"})
    fs::copy(built / (std::string(name) + ".so"), folder.path / "first/bad");
  fs::copy(built / "sound.so", folder.path / "second/bad");
  std::ofstream(folder.path / "first/bad/README.so") << "no name of a stage";
  const auto all = plugins::list_plugins(
      {folder.path / "first", folder.path / "none", folder.path / "second"}, "bad");
  REQUIRE(all.size() == 4);
  CHECK(std::is_sorted(all.begin(), all.end(),
                       [](const auto& a, const auto& b) { return a.id < b.id; }));
  for (const auto& listed : all) {
    if (listed.id == "bad.sound") {
      CHECK(listed.summary == "Gives its cloud back.");
      CHECK(listed.refused.empty());
      CHECK(listed.files.size() == 2);
    }
    if (listed.id == "bad.crash") CHECK_THAT(listed.refused, Contains("in quarantine"));
    if (listed.id == "bad.not_a_plugin") CHECK_THAT(listed.refused, Contains("no section .velum"));
    if (listed.id == "bad.undefined_symbol")
      CHECK_THAT(listed.refused, Contains("undefined symbol"));
  }
  CHECK(plugins::list_plugins({folder.path / "first"}, "good").empty());
}

TEST_CASE("a new plugin outside a checkout is a project of its own") {
  const Folder folder;
  const auto made = plugins::new_plugin("resampling.my_method2", folder.path);
  CHECK_FALSE(made.in_checkout);
  CHECK(made.files.size() == 6);
  const fs::path at = folder.path / "my_method2";
  CHECK_THAT(text_of(at / "my_method2.cpp"), Contains("VELUM_STAGE(MyMethod2)"));
  CHECK_THAT(text_of(at / "my_method2_test.cpp"),
             Contains("conformance(\"resampling.my_method2\")"));
  CHECK_THAT(text_of(at / "CMakeLists.txt"), Contains("velum_add_plugin(resampling my_method2)"));
  CHECK_THAT(text_of(at / "example.toml"), Contains("use = \"resampling.my_method2\""));
  for (const auto& file : made.files) CHECK_THAT(text_of(file), !Contains("{{"));
  CHECK_THROWS_WITH(plugins::new_plugin("resampling.my_method2", folder.path),
                    Contains("there is such a folder already"));
}

TEST_CASE("a new plugin in a checkout comes to lie beside the others") {
  const Folder folder;
  fs::create_directories(folder.path / "kernel/include/velum");
  fs::create_directories(folder.path / "plugins/filtering");
  std::ofstream(folder.path / "kernel/include/velum/stage.hpp") << "\n";
  std::ofstream(folder.path / "plugins/CMakeLists.txt") << "\n";
  std::ofstream(folder.path / "plugins/filtering/CMakeLists.txt")
      << "velum_plugin(filtering merge)";
  const auto made = plugins::new_plugin("filtering.thin", folder.path / "plugins");
  CHECK(made.in_checkout);
  CHECK(fs::exists(folder.path / "plugins/filtering/thin/thin.cpp"));
  CHECK_FALSE(fs::exists(folder.path / "plugins/filtering/thin/CMakeLists.txt"));
  CHECK(text_of(folder.path / "plugins/filtering/CMakeLists.txt") ==
        "velum_plugin(filtering merge)\nvelum_plugin(filtering thin)\n");
}

TEST_CASE("names that cannot be are refused with what can be") {
  const Folder folder;
  const auto hint = [&](const std::string& id) {
    try {
      plugins::new_plugin(id, folder.path);
    } catch (const Error& error) {
      CHECK(error.fault() == Fault::graph);
      return error.hint();
    }
    FAIL("no error for " << id);
    return std::string();
  };
  for (const char* id : {"mls", "resampling.", ".mls", "resampling.My", "resampling.a-b",
                         "resampling.2d", "resampling.a/b", "resampling.a.b", "../x.y", ""})
    CHECK_THAT(hint(id), Contains("resampling.my_method"));
  CHECK_THAT(hint("resampling." + std::string(41, 'a')), Contains("at most 40"));
  CHECK_THAT(hint("resampeling.mls"), Contains("did you mean 'resampling'?"));
  CHECK_THAT(hint("magic.mls"), Contains("analysis") && Contains("segmentation"));
  CHECK(fs::is_empty(folder.path));
}
