// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// One stage run alone; what the checks that every plugin runs find, and that they find nothing
// where nothing is.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "error_of.hpp"
#include "testing/sound.hpp"
#include "testing/specimens.hpp"
#include "velum/testing.hpp"

namespace {

using namespace velum;
using Catch::Matchers::Contains;

/// All faults that the suite finds in bad.misbehaves, one a line.
std::string faults(const std::string& how) {
  ::setenv("VELUM_PLUGIN_PATH", VELUM_BINARY_DIR "/test-plugins", 1);
  std::string all;
  for (const auto& fault : test::conformance("bad.misbehaves", {{"how", how}})) all += fault + "\n";
  return all;
}

Cloud small_cloud() {
  static const Cloud cloud{Points(Points::Random(3, 10))};
  return cloud;
}

}  // namespace

TEST_CASE("test::Stage runs one stage as the kernel would") {
  ::setenv("VELUM_PLUGIN_PATH", VELUM_BINARY_DIR "/test-plugins", 1);
  const auto outcome = test::Stage("bad.sound").set("size", "5 mm").run(small_cloud());
  CHECK(outcome.cloud().size() == 10);
  CHECK(outcome.measure("size") == 0.005);
  CHECK(test::Stage("bad.sound").set("size", 2.0).run(small_cloud()).measure("size") == 2.0);
  const double spacing = small_cloud().spacing();
  CHECK(test::Stage("bad.sound").set("size", "2 spacing").run(small_cloud()).measure("size") ==
        Approx(2 * spacing));

  const auto fault = [](auto&& attempt) { return test::error_of(attempt).fault(); };
  CHECK(fault([] { test::Stage("bad.sound").set("sice", "5 mm"); }) == Fault::graph);
  CHECK(fault([] { test::Stage("bad.sound").set("size", "five"); }) == Fault::graph);
  CHECK(fault([] { test::Stage("bad.sound").set("size", "-5 mm"); }) == Fault::graph);
  CHECK(fault([] { test::Stage("bad.sound").run(); }) == Fault::graph);
  CHECK(fault([] { test::Stage("bad.sound").run(Mesh()); }) == Fault::graph);
  CHECK(fault([] { test::Stage("bad.sound").run(small_cloud(), small_cloud()); }) == Fault::graph);
  CHECK(fault([] {
          test::Stage("bad.sound").in_many({small_cloud(), small_cloud()}).run();
        }) == Fault::graph);
  const Error asked =
      test::error_of([] { test::Stage("bad.sound").set("fail", "true").run(small_cloud()); });
  CHECK(asked.fault() == Fault::input);
  CHECK(asked.where() == "here:1");
}

TEST_CASE("a stage that keeps its promises has no faults") {
  CHECK(faults("nothing").empty());
  CHECK(test::conformance("bad.sound").empty());
}

TEST_CASE("each broken promise is named in a line") {
  CHECK_THAT(faults("foreign"), Contains("bad.misbehaves with 2 points: throws what is not a "
                                         "velum::Error: no third point"));
  CHECK_THAT(faults("unsteady"), Contains("run a second time: the results are not the same"));
  CHECK_THAT(faults("threads"),
             Contains("with 1 thread instead of 2: the results are not the same"));
  CHECK_THAT(faults("normals"), Contains("output 'cloud' has a normal that is not of unit length"));
  CHECK_THAT(faults("column"), Contains("output 'cloud' lacks the column 'normals'"));
  CHECK_THAT(faults("measure"), Contains("measure 'size' is not finite"));
  CHECK_THAT(faults("cancels"), Contains("says that it was cancelled, it was not"));
  CHECK_THAT(faults("stubborn"), Contains("cancelled at once: throws what is not a velum::Error"));
}

TEST_CASE("the suite says what it cannot start with") {
  ::setenv("VELUM_PLUGIN_PATH", VELUM_BINARY_DIR "/test-plugins", 1);
  const auto one = [](const std::string& id, const std::map<std::string, std::string>& settings) {
    const auto all = test::conformance(id, settings);
    REQUIRE(all.size() == 1);
    return all.front();
  };
  CHECK_THAT(one("bad.sond", {}), Contains("there is no stage 'bad.sond'"));
  CHECK_THAT(one("bad.sound", {{"sice", "1"}}), Contains("no parameter 'sice'"));
  CHECK_THAT(one("bad.sound", {{"size", "-1"}}), Contains("size"));
}

TEST_CASE("specimens are sound values of every type, but for the one that is meant not to be") {
  auto all = test::degenerate_specimens();
  all.push_back(test::sheet());
  for (const auto& specimen : all) {
    INFO(specimen.name);
    const bool spoiled = specimen.name.find("not finite") != std::string::npos;
    for (int type = 0; type < 7; ++type) {
      const Value value = test::make_value(static_cast<ValueType>(type), specimen);
      CHECK(static_cast<int>(type_of(value)) == type);
      if (!spoiled) CHECK(test::unsound(value).empty());
    }
    if (spoiled) CHECK_FALSE(test::unsound(specimen.cloud).empty());
  }
}

TEST_CASE("values that are not sound are told apart") {
  const auto fault = [](const Value& value) { return test::unsound(value); };
  Transform motion;
  motion.matrix.linear() *= 2.0;
  CHECK_THAT(fault(motion), Contains("no rotation"));
  motion.matrix.setIdentity();
  motion.matrix.translation().x() = std::nan("");
  CHECK_THAT(fault(motion), Contains("not finite"));

  Clusters clusters;
  clusters.cloud = Cloud(Points(Points::Zero(3, 2)));
  CHECK_THAT(fault(clusters), Contains("do not fit"));
  clusters.labels = Column(Eigen::VectorXi(Eigen::Vector2i(0, 1)));
  CHECK_THAT(fault(clusters), Contains("without a row"));

  auto surface = std::get<Surface>(test::make_value(ValueType::surface, test::sheet()));
  CHECK(fault(surface).empty());
  surface.knots_u[4] = -1.0;
  CHECK_THAT(fault(surface), Contains("ascend"));
  surface.control.resize(3, 3);
  CHECK_THAT(fault(surface), Contains("do not fit the control points"));

  const Cloud bad = Cloud(Points(Points::Zero(3, 1)))
                        .with("curvature", Column(Eigen::VectorXf(Eigen::VectorXf::Ones(1))));
  CHECK_THAT(fault(bad), Contains("curvature"));
}
