// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/plan.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "graph/study_slurm.hpp"
#include "graph_support.hpp"

using velum::study::Plan;
using velum::test::mistakes;

namespace {

using Lines = std::vector<std::string>;

const std::string kGraph = R"(units = "mm"
[node.scan]
use = "devices.simulator"
[node.down]
use = "resampling.voxel_grid"
in = "scan"
size = 5
[node.mesh]
use = "meshing.delaunay_projected"
in = "down"
[study]
)";

Plan plan(const std::string& study) {
  auto loaded = velum::test::load_text(kGraph + study);
  INFO(velum::graph::format(loaded.diagnostics));
  REQUIRE(loaded.graph);
  return velum::study::make_plan(*loaded.graph->study);
}

/// "a b" for each variant.
Lines labels(const Plan& plan) {
  Lines all;
  for (const auto& variant : plan.variants) {
    std::string line;
    for (std::size_t a = 0; a < plan.study.axes.size(); ++a)
      line += (a > 0 ? " " : "") + plan.label(variant, a);
    all.push_back(line);
  }
  return all;
}

const std::string kTwo = R"(
[[study.vary]]
title = "a"
param = "down.size"
values = [1, 2]
[[study.vary]]
title = "b"
param = "mesh.max_edge"
values = [7, 8, 9]
)";

/// The graph of variant `index` as it would run.
velum::graph::Loaded variant(const std::string& text, std::size_t index) {
  auto loaded = velum::test::load_text(text);
  INFO(velum::graph::format(loaded.diagnostics));
  REQUIRE(loaded.graph);
  const Plan made = velum::study::make_plan(*loaded.graph->study);
  const auto variation = made.variation(made.variants.at(index));
  return velum::graph::load_text(text, "g.toml", {}, velum::test::catalog(),
                                 {.out = {}, .variation = &variation});
}

}  // namespace

TEST_CASE("the product of all axes, the last one fastest") {
  const Plan made = plan("repeat = 3\nseed = 5" + kTwo);
  CHECK(labels(made) == Lines{"1 7", "1 8", "1 9", "2 7", "2 8", "2 9"});
  CHECK(made.variants.front().id == "v1");
  CHECK(made.study.seeds == std::vector<std::uint64_t>{5, 6, 7});
  CHECK(made.cells() == 18);
}

TEST_CASE("a study without axes is the graph itself, repeated") {
  const Plan made = plan("repeat = 2\n");
  REQUIRE(made.variants.size() == 1);
  CHECK(made.cells() == 2);
}

TEST_CASE("zipped axes go along together, excluded variants are left out") {
  CHECK(labels(plan("[[study.vary]]\nzip = \"z\"\nparam = \"down.size\"\nvalues = [1, 2]\n"
                    "[[study.vary]]\nparam = \"scan.sweep\"\nvalues = [3, 4]\n"
                    "[[study.vary]]\nzip = \"z\"\nparam = \"mesh.max_edge\"\nvalues = [8, 9]\n")) ==
        Lines{"1 3 8", "1 4 8", "2 3 9", "2 4 9"});
  CHECK(labels(plan("exclude = [{ a = 1, b = 8 }, { b = 9 }]" + kTwo)) ==
        Lines{"1 7", "2 7", "2 8"});
  CHECK_THROWS_WITH(plan("exclude = [{ a = 1 }, { a = 2 }]" + kTwo),
                    "the study excludes every variant");
}

TEST_CASE("a sample is part of the product, the same each time") {
  const std::string many = R"(
[[study.vary]]
param = "down.size"
range = { from = 1, to = 100, steps = 100 }
[[study.vary]]
param = "mesh.max_edge"
range = { from = 1, to = 100, steps = 100 }
)";
  const Lines some = labels(plan("sample = 20" + many));
  CHECK(some.size() == 20);
  CHECK(some == labels(plan("sample = 20" + many)));
  CHECK(std::set<std::string>(some.begin(), some.end()).size() == 20);
}

TEST_CASE("ranges, linear and logarithmic, with units") {
  const auto values = [](const std::string& range) {
    return labels(plan("[[study.vary]]\nparam = \"down.size\"\nrange = " + range + "\n"));
  };
  CHECK(values(R"({ from = "1 mm", to = "2 mm", steps = 3 })") == Lines{"1 mm", "1.5 mm", "2 mm"});
  CHECK(values(R"({ from = 1, to = 100, steps = 3, scale = "log" })") == Lines{"1", "10", "100"});
  CHECK(values("{ from = 0.5, to = 1.5, steps = 2 }") == Lines{"0.5", "1.5"});
  CHECK(values("{ from = 1, to = 3, steps = 5 }") == Lines{"1", "2", "3"});  // whole, each once
  CHECK(values("{ from = 1000001, to = 1000009, steps = 3 }") ==
        Lines{"1000001", "1000005", "1000009"});
  CHECK(values("{ from = 0.12345678, to = 1.5, steps = 2 }") == Lines{"0.12345678", "1.5"});
}

TEST_CASE("each variant has the reference that is like it but for the reference's labels") {
  const Plan made = plan("reference = { a = 1 }" + kTwo);
  CHECK(made.references() == std::vector<std::size_t>{0, 1, 2, 0, 1, 2});
  CHECK(plan(kTwo).references().front() == 6);  // none
  const std::string zipped =
      "[[study.vary]]\ntitle = \"a\"\nzip = \"z\"\nparam = \"down.size\"\n"
      "values = [1, 2]\n[[study.vary]]\nzip = \"z\"\n"
      "param = \"mesh.max_edge\"\nvalues = [8, 9]\n";
  CHECK(plan("reference = { a = 1 }\n" + zipped).references() == std::vector<std::size_t>{0, 0});
  CHECK_THROWS_WITH(plan("reference = { a = 1 }\nexclude = [{ a = 1 }]" + kTwo),
                    "no variant has the labels of 'reference'");
}

TEST_CASE("an alternative keeps the wire, brings its helpers, and hides their names") {
  const std::string text = kGraph + R"([[study.vary]]
node = "down"
alternatives = [
  { use = "resampling.voxel_grid", size = 9 },
  { title = "smooth", use = "segmentation.region_growing", in = "n", with = { n = { use = "features.normals", in = "scan" } } },
]
)";
  const auto first = variant(text, 0);
  REQUIRE(first.graph);
  CHECK(first.graph->resolved.find("size = \"0.009 m\"") != std::string::npos);
  CHECK_FALSE(first.graph->study);
  const auto second = variant(text, 1);
  // The mesh cannot be made of clusters: a mistake of this variant alone, with its place.
  REQUIRE_FALSE(second.graph);
  CHECK(second.diagnostics.front().message.find("down") != std::string::npos);
  CHECK(labels(plan(text.substr(kGraph.size()))) == Lines{"resampling.voxel_grid", "smooth"});
}

TEST_CASE("helper nodes are nodes of the variant's graph") {
  const std::string text = kGraph + R"([[study.vary]]
node = "down"
[[study.vary.alternatives]]
use = "features.normals"
neighbours = 9
in = "first"
with.first = { use = "resampling.voxel_grid", size = 1, in = "scan" }
)";
  const auto loaded = variant(text, 0);
  INFO(velum::graph::format(loaded.diagnostics));
  REQUIRE(loaded.graph);
  REQUIRE(loaded.graph->find("down-first"));
  CHECK(loaded.graph->resolved.find("in = { cloud = \"down-first.cloud\" }") != std::string::npos);
}

TEST_CASE("rows set several parameters at once") {
  const Plan made = plan(R"([[study.vary]]
title = "data"
rows = [{ title = "calm", "scan.sweep" = 1, "down.size" = 2 }, { scan.sweep = 3, down.size = 4 }]
)");
  CHECK(labels(made) == Lines{"calm", "3, 4"});
  CHECK(made.variation(made.variants[1]).values.size() == 2);
}

TEST_CASE("files that match a pattern, by name") {
  const velum::test::Folder folder;
  folder.write("scans/b.pcd", "");
  folder.write("scans/a.pcd", "");
  const auto file = folder.write("g.toml", R"(units = "m"
[node.scan]
use = "io.read_cloud"
file = "scans/a.pcd"
[study]
[[study.vary]]
param = "scan.file"
files = "scans/*.pcd"
)");
  const auto loaded = velum::graph::load(file, {}, velum::test::catalog());
  INFO(velum::graph::format(loaded.diagnostics));
  REQUIRE(loaded.graph);
  CHECK(labels(velum::study::make_plan(*loaded.graph->study)) ==
        Lines{"scans/a.pcd", "scans/b.pcd"});
}

TEST_CASE("E0601: what cannot be a study") {
  const auto wrong = [](const std::string& study) {
    Lines messages;
    for (const std::string& line : mistakes(kGraph + study))
      messages.push_back(line.substr(line.find(' ', 6) + 1));
    return messages;
  };
  CHECK(wrong("exclude = [{ c = 1 }, { a = 3 }]" + kTwo) ==
        Lines{"there is no axis 'c' | known: a, b", "axis 'a' has no '3' | known: 1, 2"});
  CHECK(wrong("[[study.vary]]\nparam = \"down.size\"\nfiles = \"nowhere/*.pcd\"\n").front() ==
        "no file matches 'nowhere/*.pcd' | the pattern is relative to the graph's folder");
  CHECK(wrong("timing = \"alone\"\n").front() ==
        "'timing' must be one of two words | known: shared, exclusive");
  CHECK(wrong("[[study.vary]]\nzip = \"z\"\nparam = \"down.size\"\nvalues = [1, 2]\n"
              "[[study.vary]]\nzip = \"z\"\nparam = \"mesh.max_edge\"\nvalues = [8]\n")
            .front()
            .starts_with("axis 'mesh.max_edge' has 1 values, another of zip = 'z' has 2"));
  CHECK(wrong("[[study.vary]]\nparam = \"down.size\"\nvalues = [1]\n"
              "[[study.vary]]\nparam = \"down.size\"\nvalues = [2]\n")
            .front()
            .starts_with("two axes are called 'down.size'"));
  // The later one would win without a word.
  CHECK(wrong("[[study.vary]]\ntitle = \"a\"\nparam = \"down.size\"\nvalues = [1]\n"
              "[[study.vary]]\ntitle = \"b\"\nrows = [{ \"down.size\" = 2 }]\n") ==
        Lines{"axis 'a' and axis 'b' both vary 'down.size' | take one of them away"});
  // Columns of study.csv.
  CHECK(wrong("[[study.vary]]\ntitle = \"seed\"\nparam = \"down.size\"\nvalues = [1]\n").front() ==
        "an axis cannot be called 'seed': study.csv has that column | give it another title");
}

TEST_CASE("E0601 says where: the line of the second axis") {
  const auto loaded = velum::test::load_text(
      kGraph +
      "[[study.vary]]\ntitle = \"a\"\nparam = \"down.size\"\nvalues = [1]\n"
      "[[study.vary]]\ntitle = \"b\"\nparam = \"down.size\"\nvalues = [2]\n");
  REQUIRE(loaded.diagnostics.size() == 1);
  const auto lines = std::count(kGraph.begin(), kGraph.end(), '\n');
  CHECK(loaded.diagnostics.front().where.begin.line == lines + 5);
}

TEST_CASE("control characters in labels are escaped, equal labels numbered") {
  const Plan made = plan(
      "[[study.vary]]\ntitle = \"a\\tb\"\nrows = [{ title = \"x\\n\\u001b[2J\", "
      "\"down.size\" = 1 }, { title = \"y\", \"down.size\" = 2 }, "
      "{ title = \"y\", \"down.size\" = 3 }]\n");
  CHECK(made.study.axes.front().name == "a\\x09b");
  CHECK(labels(made) == Lines{"x\\x0a\\x1b[2J", "y", "y (2)"});
}

TEST_CASE("what Slurm is asked for") {
  const auto slurm = velum::graph::slurm_in(
      kGraph +
      "[study.slurm]\npartition = \"short\"\ntime = \"2 h\"\nmemory = \"4 GB\"\n"
      "cpus = 2\ncells = 20\narray = 500\noptions = [\"--qos=low\"]\n");
  CHECK(slurm.partition == "short");
  CHECK(slurm.seconds == 7200.0);
  CHECK(slurm.bytes == 4'000'000'000);
  CHECK(slurm.cpus == 2);
  CHECK(slurm.cells == 20);
  CHECK(slurm.array == 500);
  CHECK(slurm.options == Lines{"--qos=low"});
  CHECK(mistakes(kGraph + "[study.slurm]\npartion = \"a\"\ncells = 0\noptions = [3]\n").size() ==
        3);
  velum::graph::Slurm changed = slurm;
  velum::graph::set_slurm("partition=long", changed);
  velum::graph::set_slurm("time=30 min", changed);
  CHECK(changed.partition == "long");
  CHECK(changed.seconds == 1800.0);
  CHECK_THROWS_WITH(velum::graph::set_slurm("cells=many", changed), "'cells' must be an integer");
  CHECK_THROWS_WITH(velum::graph::set_slurm("cells", changed), "'cells' is no setting");
}
