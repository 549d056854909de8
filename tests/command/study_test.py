# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""`velum study`: every variant a cell of its own, whatever happens in it."""
import csv
import json
import os
import random
import signal
import subprocess
import time
import unittest

from support import CommandTest, VELUM

KILLS = int(os.environ.get("VELUM_KILLS", "4"))

GRAPH = """
units = "m"
[node.start]
use = "test.numbers"
[node.moved]
use = "test.move"
in = "start"
[node.other]
use = "test.move"
in = "start"
[study]
measure = ["start.count", "moved.by", "moved.seconds"]
"""

BAD = """
units = "m"
[node.start]
use = "test.numbers"
[node.moved]
use = "test.move"
in = "start"
[study]
repeat = 2
measure = ["total.seconds"]
timeout = "3 s"
memory = "300 MB"
[[study.vary]]
node = "moved"
alternatives = [
  { title = "good", use = "test.move", by = 2 },
  { title = "crash", use = "test.crash", how = "segv" },
  { title = "hang", use = "test.crash", how = "endless" },
  { title = "eater", use = "test.crash", how = "memory" },
  { title = "throw", use = "test.throws" },
  { title = "wrong", use = "test.move", byy = 2 },
  { title = "empty", use = "test.drop", above = -1 },
]
"""


class StudyTest(CommandTest):
    def cells(self, name="g.out"):
        with open(self.folder / name / "study.csv", newline="") as file:
            return list(csv.DictReader(file))

    def study(self, name="g.out"):
        return json.loads((self.folder / name / "study.json").read_text())

    def test_every_way_to_fail_is_a_row(self):
        self.write("g.toml", BAD)
        out, _ = self.velum("study", "g.toml", status=3)
        found = {}
        for cell in self.cells():
            found.setdefault(cell["moved"], set()).add(cell["status"])
        self.assertEqual(found, {
            "good": {"ok"}, "crash": {"crashed"}, "hang": {"timed_out"},
            "eater": {"out_of_memory"}, "throw": {"failed"}, "wrong": {"invalid"},
            "empty": {"empty"}})
        messages = {cell["moved"]: cell["message"] for cell in self.cells()}
        self.assertIn("SIGSEGV", messages["crash"])
        self.assertIn("3 s", messages["hang"])
        self.assertIn("300 MB", messages["eater"])
        self.assertRegex(messages["wrong"], r"g.toml:\d+:\d+ unknown parameter 'byy'")
        self.assertEqual(len({messages[name] for name in messages}), 7)
        self.assertIn("out_of_memory", out)
        good = [cell for cell in self.cells() if cell["moved"] == "good"]
        self.assertTrue(all(float(cell["total.seconds [s]"]) > 0 for cell in good))

    def test_a_product_with_its_statistics(self):
        self.write("g.toml", GRAPH + """
repeat = 6
reference = { "moved.by" = 1 }
[[study.vary]]
param = "moved.by"
values = [1, 2, 3]
[[study.vary]]
param = "start.count"
values = [4, 5]
""")
        out, error = self.velum("check", "g.toml")
        self.assertIn("6 variants x 6 repeats = 36 cells; no earlier run", out)
        self.velum("run", "g.toml")
        out, error = self.velum("check", "g.toml")
        self.assertRegex(out, r"36 cells, about \d+ s with \d+ at a time, .* the run before")
        out, error = self.velum("study", "g.toml")
        self.assertIn("[36/36]", error)
        self.assertEqual(len(self.cells()), 36)
        # An axis and a measure without a unit of one name are two columns.
        self.assertEqual({cell["start.count"] for cell in self.cells()}, {"4", "5"})
        self.assertEqual({cell["start.count []"] for cell in self.cells()}, {"4", "5"})
        study = self.study()
        self.assertEqual([axis["name"] for axis in study["axes"]], ["moved.by", "start.count"])
        self.assertEqual({variant["data"] for variant in study["variants"]}, {0, 1})
        points = [v["summary"]["start.count"]["mean"] for v in study["variants"]]
        self.assertEqual(points, [4, 5, 4, 5, 4, 5])
        seeds = [run["seed"] for run in study["variants"][0]["runs"]]
        self.assertEqual(seeds, [1, 2, 3, 4, 5, 6])
        moved = study["variants"][2]["summary"]["moved.by"]
        self.assertEqual(moved["difference"],
                         {"reference": "v1", "pairs": 6, "mean": 1.0, "p": 2 * 4 / 2**6})
        self.assertEqual(moved["rank"], 2)
        self.assertIn("v1", out)
        out, _ = self.velum("check", "g.toml")
        self.assertRegex(out, r"36 cells, about \d+ s .* the cells of the study before")
        # The run of the same graph, in the same folder, is still there, and so is the study after
        # another one.
        self.assertEqual(self.record()["status"], "ok")
        self.velum("run", "g.toml")
        self.assertEqual(len(self.cells()), 36)

    def test_what_is_timed_runs_every_time_and_the_rest_once(self):
        self.write("g.toml", GRAPH + """
[[study.vary]]
param = "moved.by"
values = [1, 2, 3]
""")
        _, error = self.velum("study", "g.toml", "--set", "moved.by=9", status=2)
        self.assertIn("the study varies 'moved.by': the value would be lost", error)
        self.velum("study", "g.toml", "--jobs", "2", "--set", "start.count=7")
        self.assertEqual({cell["start.count"] for cell in self.cells()}, {"7"})
        statuses = {"start": [], "moved": [], "other": []}
        for variant in ("v1", "v2", "v3"):
            record = json.loads((self.folder / f"g.out/cells/{variant}/1/run.json").read_text())
            for node in record["nodes"]:
                statuses[node["name"]].append(node["status"])
        self.assertEqual(statuses["moved"], ["ok"] * 3)
        # Also where two cells want the same at the same time.
        self.assertEqual(sorted(statuses["start"]), ["cached", "cached", "ok"])
        self.assertEqual(sorted(statuses["other"]), ["cached", "cached", "ok"])

    def test_killed_at_any_moment_it_goes_on(self):
        self.write("g.toml", GRAPH.replace(', "moved.seconds"', "") + """
repeat = 5
[[study.vary]]
param = "moved.by"
range = { from = 1, to = 8, steps = 8 }
""")
        self.velum("study", "g.toml", "--out", "whole", "--jobs", "2")
        chance = random.Random(4)
        kills, studies = 0, 0
        while kills < KILLS:
            studies += 1
            kills += self.kill_until_it_ends(f"cut{studies}", chance, KILLS - kills)
            for name in ("study.csv", "study.json"):
                self.assertEqual((self.folder / f"cut{studies}" / name).read_bytes(),
                                 (self.folder / "whole" / name).read_bytes())
        print(f"{kills} kills in {studies} studies")

    def kill_until_it_ends(self, out, chance, most):
        """How often it was killed, which is `most` times at most."""
        for kills in range(most + 1):
            process = subprocess.Popen(
                [VELUM, "study", "g.toml", "--out", out, "--jobs", "2", "--resume"],
                cwd=self.folder, env=self.environment, stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL)
            try:
                status = process.wait(chance.uniform(0.02, 0.4) if kills < most else 120)
                self.assertEqual(status, 0)
                return kills
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
        return self.fail("it does not end")

    def test_interrupted_it_keeps_what_is_done(self):
        self.write("g.toml", GRAPH + """
repeat = 50
[[study.vary]]
node = "moved"
alternatives = [{ use = "test.slow" }, { use = "test.move" }]
""")
        process = subprocess.Popen([VELUM, "study", "g.toml", "--jobs", "2"], cwd=self.folder,
                                   env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while "[1/" not in process.stderr.readline():
            pass
        began = time.monotonic()
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130)
        self.assertLess(time.monotonic() - began, 5)
        self.assertIn("--resume goes on", error)
        self.assertFalse((self.folder / "g.out/study.csv").exists())

    def test_a_changed_study_does_not_go_on(self):
        self.write("g.toml", GRAPH)
        self.velum("study", "g.toml")
        self.velum("study", "g.toml", "--resume")
        self.write("g.toml", GRAPH + "repeat = 2\n")
        _, error = self.velum("study", "g.toml", "--resume", status=2)
        self.assertIn("has changed since", error)
        self.velum("study", "g.toml")
        self.assertEqual(len(self.cells()), 2)

    def test_what_failed_runs_again_when_asked(self):
        self.write("g.toml", GRAPH + """
[[study.vary]]
node = "moved"
alternatives = [{ use = "test.move" }, { use = "test.throws" }]
""")
        self.velum("study", "g.toml", status=3)
        _, error = self.velum("study", "g.toml", "--resume", status=3)
        self.assertNotIn("/2]", error)
        _, error = self.velum("study", "g.toml", "--resume", "--retry", status=3)
        self.assertIn("[2/2] v2", error)
        self.assertNotIn("] v1", error)

    def test_a_helper_that_reads_other_data_is_another_group(self):
        self.write("a.txt", "3\n")
        self.write("b.txt", "4\n")
        graph = """
units = "m"
[node.start]
use = "test.read"
file = "a.txt"
[node.moved]
use = "test.move"
in = "start"
[study]
measure = ["moved.by"]
[[study.vary]]
node = "moved"
alternatives = [
  { use = "test.move" },
  { title = "other", use = "test.move", in = "h", with = { h = { use = "test.read", file = "FILE" } } },
]
"""
        for file, groups in (("a.txt", [0, 0]), ("b.txt", [0, 1])):
            self.write("g.toml", graph.replace("FILE", file))
            self.velum("study", "g.toml")
            self.assertEqual([variant["data"] for variant in self.study()["variants"]], groups)
        self.velum("study", "g.toml", "--resume")
        self.write("b.txt", "5\n")
        _, error = self.velum("study", "g.toml", "--resume", status=2)
        self.assertIn("has changed since", error)

    def test_other_files_are_another_study(self):
        for name in ("b", "c"):
            self.write(f"scans/{name}.txt", "3\n")
        self.write("g.toml", """
units = "m"
[node.start]
use = "test.read"
file = "scans/b.txt"
[study]
measure = ["start.count"]
[[study.vary]]
param = "start.file"
files = "scans/*.txt"
""")
        self.velum("study", "g.toml")
        self.velum("study", "g.toml", "--resume")
        self.write("scans/a.txt", "3\n")  # would move the others down by a row
        _, error = self.velum("study", "g.toml", "--resume", status=2)
        self.assertIn("has changed since", error)
        (self.folder / "scans/a.txt").unlink()
        self.write("scans/c.txt", "4\n")
        self.velum("study", "g.toml", "--resume", status=2)

    def test_nobodys_files_are_removed(self):
        self.write("g.toml", GRAPH)
        for name in ("cells/data.txt", "study.csv", "report.html"):
            mine = self.write(f"mine/{name}", "mine")
            _, error = self.velum("study", "g.toml", "--out", "mine", status=6)
            self.assertIn("not a result of a study", error)
            self.assertEqual(mine.read_text(), "mine")
            mine.unlink()
            if mine.parent.name == "cells":
                mine.parent.rmdir()

    def test_a_measure_that_nobody_has_is_said(self):
        self.write("g.toml", GRAPH.replace("moved.by", "moved.byy"))
        _, error = self.velum("study", "g.toml")
        self.assertIn("no cell has the measure 'moved.byy'", error)
        self.assertEqual(self.cells()[0]["moved.byy"], "")

    def test_mistakes_stop_it_before_it_starts(self):
        self.write("g.toml", GRAPH.replace("test.move", "test.moev"))
        _, error = self.velum("study", "g.toml", status=2)
        self.assertIn("did you mean 'test.move'?", error)
        self.write("g.toml", GRAPH.split("[study]")[0])
        _, error = self.velum("study", "g.toml", status=2)
        self.assertIn("the graph has no study", error)
        self.write("g.toml", GRAPH)
        (self.folder / "g.out").mkdir()
        (self.folder / "g.out/mine.txt").write_text("mine")
        _, error = self.velum("study", "g.toml", status=6)
        self.assertIn("mine.txt", error)

    def test_two_hundred_cheap_cells_are_quick(self):
        self.write("g.toml", GRAPH.replace(', "moved.seconds"', "") + """
[[study.vary]]
param = "moved.by"
range = { from = 0.05, to = 10, steps = 200 }
""")
        began = time.monotonic()
        self.velum("study", "g.toml")
        print(f"200 cells: {time.monotonic() - began:.1f} s")
        self.assertEqual(len(self.cells()), 200)


if __name__ == "__main__":
    unittest.main()
