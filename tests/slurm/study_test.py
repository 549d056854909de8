# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""`velum study --engine slurm` on a Slurm of its own: what is killed, and what comes of it."""
import csv
import json
import pathlib
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "command"))
from support import CommandTest  # noqa: E402

import cluster  # noqa: E402

SKIPPED = 77

# 40 cells of nearly half a second.
GRAPH = """
units = "m"
[node.start]
use = "test.numbers"
[node.moved]
use = "test.move"
in = "start"
[node.waits]
use = "test.slow"
in = "moved"
time = "0.4 s"
cache = false
[study]
repeat = 4
measure = ["start.count", "moved.by"]
[[study.vary]]
param = "moved.by"
range = { from = 1, to = 10, steps = 10 }
[study.slurm]
cells = 5
"""

BAD = """
units = "m"
[node.start]
use = "test.numbers"
[node.moved]
use = "test.move"
in = "start"
[study]
measure = ["start.count"]
memory = "300 MB"
[[study.vary]]
node = "moved"
alternatives = [
  { title = "good", use = "test.move", by = 2 },
  { title = "crash", use = "test.crash", how = "segv" },
  { title = "throw", use = "test.throws" },
  { title = "wrong", use = "test.move", byy = 2 },
]
[study.slurm]
cells = 4
"""


class SlurmTest(CommandTest):
    slurm = None  # the cluster that all tests share

    def setUp(self):
        super().setUp()
        self.environment.update(
            {name: self.slurm.environment[name] for name in ("PATH", "SLURM_CONF")})

    def cells(self, name):
        with open(self.folder / name / "study.csv", newline="") as file:
            return list(csv.DictReader(file))

    def assert_same(self, name, other):
        for file in ("study.csv", "study.json"):
            self.assertEqual((self.folder / name / file).read_bytes(),
                             (self.folder / other / file).read_bytes())

    def queue(self, *states):
        return self.slurm.run("squeue", "--noheader", "--array", f"--states={','.join(states)}",
                              "--format=%K|%T|%N").split()

    def ended(self, name):
        """Cells whose outcome some task has written."""
        return sum(file.read_text().count('"cell"')
                   for file in self.folder.glob(f"{name}/slurm/*/*.journal"))

    def follow(self, *more):
        return self.start("study", "g.toml", "--engine", "slurm", "--out", "far", *more)

    def amid_a_task(self):
        """Has some task on n2 run one or two of its cells?"""
        return any(
            1 <= file.read_text().count('"cell"') <= 2
            for line in self.queue("RUNNING") if line.endswith("n2")
            for file in self.folder.glob(f"far/slurm/*/{line.split('|')[0]}.journal"))

    def test_a_node_fails_and_the_follower_is_killed(self):
        self.write("g.toml", GRAPH)
        self.velum("study", "g.toml", "--out", "near", "--jobs", "4")
        follower = self.follow()
        self.wait_for(lambda: self.ended("far") >= 3)
        follower.send_signal(signal.SIGKILL)
        follower.communicate()
        self.wait_for(self.amid_a_task)
        self.slurm.kill_node("n2")
        try:
            follower = self.follow("--resume")
            out, error = follower.communicate(timeout=120)
        finally:
            self.slurm.start_node("n2")
        self.assertEqual(follower.returncode, 0, error)
        self.assertIn("are taken up", error)
        self.assertRegex(error, r"ended as NODE_FAIL on n2")
        self.assertTrue(list(self.folder.glob("far/slurm/*/*.lost")))
        self.assertEqual(len(self.cells("far")), 40)
        self.assert_same("near", "far")
        self.assertIn("v10", out)
        self.slurm.wait(lambda: self.slurm.nodes().count("idle") == 2, "n2 is not back", 60)

    def test_bad_cells_are_rows_as_on_one_machine(self):
        self.write("g.toml", BAD)
        self.velum("study", "g.toml", "--out", "near", status=3)
        self.velum("study", "g.toml", "--out", "far", "--engine", "slurm", status=3)
        self.assertEqual([cell["status"] for cell in self.cells("far")],
                         ["ok", "crashed", "failed", "invalid"])
        self.assert_same("near", "far")
        # What is not ok runs again when it is asked for, and only that.
        before = (self.folder / "far/cells/v1/1/run.json").stat().st_mtime_ns
        _, error = self.velum("study", "g.toml", "--out", "far", "--engine", "slurm", "--resume",
                              "--retry", status=3)
        self.assertIn("3 cells in 1 tasks", error)
        self.assertEqual((self.folder / "far/cells/v1/1/run.json").stat().st_mtime_ns, before)

    def test_interrupted_the_tasks_go_on(self):
        self.write("g.toml", GRAPH.replace("repeat = 4", "repeat = 1"))
        follower = self.follow("--slurm", "cells=1")
        while ": ok" not in follower.stderr.readline():
            pass
        follower.send_signal(signal.SIGINT)
        _, error = follower.communicate(timeout=30)
        self.assertEqual(follower.returncode, 130)
        self.assertIn("--engine slurm --resume takes them up", error)
        name = error.split("scancel --name=")[1].split("`")[0]
        # Begun anew they would write where the new ones do.
        _, error = self.velum("study", "g.toml", "--out", "far", "--engine", "slurm", status=6)
        self.assertIn("wait or run", error)
        _, error = self.velum("study", "g.toml", "--out", "far", "--resume", status=6)
        self.slurm.run("scancel", f"--name={name}")
        self.wait_for(lambda: not self.queue("PENDING", "RUNNING", "COMPLETING"))
        self.velum("study", "g.toml", "--out", "far", "--resume")  # the rest here
        self.velum("study", "g.toml", "--out", "near")
        self.assert_same("near", "far")

    def test_cancelled_tasks_are_not_submitted_again(self):
        self.write("g.toml", GRAPH.replace("0.4 s", "30 s"))
        follower = self.follow()
        self.wait_for(lambda: len(self.queue("RUNNING")) > 0)
        self.slurm.run("scancel", "--user=root")
        _, error = follower.communicate(timeout=60)
        self.assertEqual(follower.returncode, 130, error)
        self.assertIn("8 tasks were cancelled", error)
        self.assertEqual(len(list(self.folder.glob("far/slurm/*"))), 1)

    def test_what_slurm_refuses_is_said(self):
        self.write("g.toml", GRAPH)
        _, error = self.velum("study", "g.toml", "--engine", "slurm", "--slurm",
                              "partition=nowhere", status=2)
        self.assertRegex(error, "refuses the study's tasks: .*nvalid partition")
        _, error = self.velum("study", "g.toml", "--engine", "slurm", "--slurm", "partion=all",
                              status=2)
        self.assertIn("did you mean 'partition'?", error)


if __name__ == "__main__":
    began = time.monotonic()
    try:
        with cluster.Cluster() as SlurmTest.slurm:
            print(f"a cluster after {time.monotonic() - began:.1f} s")
            program = unittest.main(exit=False)
    except cluster.Unavailable as reason:
        print(f"skipped: {reason}")
        sys.exit(SKIPPED)
    sys.exit(0 if program.result.wasSuccessful() else 1)
