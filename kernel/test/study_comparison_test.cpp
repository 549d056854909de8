// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/comparison.hpp"

#include <catch2/catch.hpp>

#include "study/tables.hpp"

using namespace velum::study;  // NOLINT: a test

namespace {

/// `variants` variants on one axis "method", with one measure.
Plan plan(std::size_t variants, std::size_t repeats) {
  Plan made;
  velum::graph::Axis axis{"method", "", {}};
  for (std::size_t v = 0; v < variants; ++v) {
    axis.choices.push_back({"m" + std::to_string(v), {}});
    made.variants.push_back({"v" + std::to_string(v + 1), {v}});
  }
  made.study.axes = {axis};
  made.study.measures = {{"error", "rms"}};
  made.study.reference = velum::graph::Labels{{"method", "m0"}};
  for (std::size_t r = 0; r < repeats; ++r) made.study.seeds.push_back(r + 1);
  return made;
}

Outcome ok(double value, const std::string& source = "s") {
  Outcome outcome;
  outcome.status = Status::ok;
  outcome.figures["error.rms"] = {value, "m", velum::Better::lower};
  outcome.source = source;
  return outcome;
}

Outcome crashed() {
  Outcome outcome;
  outcome.status = Status::crashed;
  outcome.message = "the process died of SIGSEGV";
  return outcome;
}

const MeasureSummary& rms(const Comparison& comparison, std::size_t variant) {
  return comparison.variants.at(variant).measures.at("error.rms");
}

}  // namespace

TEST_CASE("a difference in every one of eight repeats is claimed, also after Holm") {
  Outcomes outcomes;
  for (std::size_t r = 0; r < 8; ++r) {
    const double noise = 0.1 * static_cast<double>(r);
    outcomes[{0, r}] = ok(5.0 + noise);
    outcomes[{1, r}] = ok(4.0 + noise + 0.01 * static_cast<double>(r));
    outcomes[{2, r}] = ok(5.0 + noise + (r % 2 == 0 ? 0.3 : -0.3) + 0.001 * noise);
  }
  const Comparison found = compare(plan(3, 8), outcomes);
  CHECK(rms(found, 1).rank == 1);
  REQUIRE(rms(found, 1).difference);
  CHECK(rms(found, 1).difference->mean == Approx(-0.965));
  CHECK(rms(found, 1).difference->p.value() == Approx(2.0 * 2.0 / 256));
  CHECK(rms(found, 2).difference->p.value() > 0.25);
  CHECK_FALSE(rms(found, 0).difference);
}

TEST_CASE("nothing is claimed below six repeats") {
  Outcomes outcomes;
  for (std::size_t r = 0; r < 5; ++r) {
    outcomes[{0, r}] = ok(5.0);
    outcomes[{1, r}] = ok(1.0);
  }
  const Comparison found = compare(plan(2, 5), outcomes);
  CHECK(rms(found, 1).difference->mean == -4.0);
  CHECK_FALSE(rms(found, 1).difference->p);
}

TEST_CASE("variants of other data are not compared, variants that failed have no rank") {
  Outcomes outcomes;
  for (std::size_t r = 0; r < 6; ++r) {
    outcomes[{0, r}] = ok(5.0);
    outcomes[{1, r}] = ok(1.0, "other");
    outcomes[{2, r}] = r == 3 ? crashed() : ok(2.0);
    outcomes[{3, r}] = crashed();
  }
  const Comparison found = compare(plan(4, 6), outcomes);
  CHECK(found.groups == 2);
  CHECK(rms(found, 0).rank == 1);
  CHECK(rms(found, 1).rank == 1);
  CHECK_FALSE(rms(found, 1).difference);
  CHECK_FALSE(rms(found, 2).rank);
  CHECK(rms(found, 2).difference->pairs == 5);
  CHECK(found.variants[2].success == Approx(5.0 / 6));
  CHECK(found.variants[2].status == Status::crashed);
  CHECK(found.variants[3].measures.empty());
}

TEST_CASE("a variant that never ended well is no other data") {
  Outcomes outcomes;
  for (std::size_t r = 0; r < 2; ++r) {
    outcomes[{0, r}] = crashed();
    outcomes[{1, r}] = ok(1.0);
    outcomes[{2, r}] = ok(2.0);
  }
  const Comparison found = compare(plan(3, 2), outcomes);
  CHECK(found.groups == 1);
  CHECK(rms(found, 2).rank == 2);
}

TEST_CASE("the tables hold every cell, also the failed ones") {
  Outcomes outcomes;
  outcomes[{0, 0}] = ok(0.25);
  outcomes[{1, 0}] = crashed();
  outcomes[{1, 0}].message = "a \"quoted\", line";
  const Plan made = plan(2, 1);
  const Comparison found = compare(made, outcomes);
  CHECK(csv(made, outcomes, found) ==
        "variant,repeat,seed,status,message,method,error.rms [m]\n"
        "v1,1,1,ok,,m0,0.25\n"
        "v2,1,1,crashed,\"a \"\"quoted\"\", line\",m1,\n");
  const auto all = velum::run::Json::parse(json(made, outcomes, found, "g.toml"));
  CHECK(all["measures"]["error.rms"]["better"] == "lower");
  CHECK(all["variants"][0]["summary"]["error.rms"]["rank"] == 1);
  CHECK(all["variants"][1]["status"] == "crashed");
  CHECK(text(made, found).find("crashed") != std::string::npos);
}
