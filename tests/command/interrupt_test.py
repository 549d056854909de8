# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Runs that are interrupted or killed, and what comes after."""
import random
import signal
import time
import unittest

from support import CHAIN, CommandTest


class InterruptTest(CommandTest):
    def read_to(self, process, text):
        for line in process.stdout:
            if text in line:
                return
        self.fail(process.stderr.read())

    def interrupted(self, *arguments, signals=(signal.SIGINT,)):
        """Interrupts a run when its slow node has begun; returns how long it then took."""
        process = self.start("run", "g.toml", "--json", *arguments)
        self.read_to(process, '"node_start","node":"moved"')
        time.sleep(0.2)
        began = time.monotonic()
        for each in signals:
            process.send_signal(each)
            time.sleep(0.1)
        out, _ = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130, out)
        return time.monotonic() - began

    def setUp(self):
        super().setUp()
        self.write("g.toml", CHAIN.replace("test.move", "test.slow"))

    def test_a_stage_that_listens(self):
        for each in (signal.SIGINT, signal.SIGTERM):
            self.assertLess(self.interrupted("--set", "moved.time=60 s", signals=(each,)), 1.5)
            self.assertEqual(self.record()["status"], "interrupted")
            self.assertEqual(self.statuses()["moved"], "interrupted")
            self.assertEqual(self.statuses()["file"], "skipped")
            self.assertEqual(self.leftovers(), [])

    def test_a_stage_that_does_not_listen(self):
        took = self.interrupted("--set", "moved.time=60 s", "--set", "moved.stubborn=true")
        self.assertGreater(took, 1.4)
        self.assertLess(took, 3.0)
        self.assertEqual(self.record()["status"], "interrupted")
        self.assertEqual(self.statuses()["moved"], "interrupted")
        self.assertEqual(self.leftovers(), [])

    def test_the_second_time_at_once(self):
        took = self.interrupted("--set", "moved.time=60 s", "--set", "moved.stubborn=true",
                                signals=(signal.SIGINT, signal.SIGINT))
        self.assertLess(took, 1.2)
        self.velum("run", "g.toml", "--set", "moved.time=0 s")

    def test_a_new_run_goes_on(self):
        self.interrupted("--set", "moved.time=60 s")
        self.velum("run", "g.toml", "--set", "moved.time=0 s")
        self.assertEqual(self.statuses(), {"start": "cached", "moved": "ok", "file": "ok"})

    def test_what_is_kept_is_said(self):
        process = self.start("run", "g.toml", "--set", "moved.time=60 s")
        self.read_to(process, "ok      start")
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=30)
        self.assertRegex(out, r"interrupted after .* kept: 0 files and the record in g.out")

    def test_killed_at_any_time(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml", "--out", "whole", "--set", "start.count=300000")
        whole = self.record("whole")
        chance = random.Random(1)
        for _ in range(20):
            process = self.start("run", "g.toml", "--cache", "killed", "--set",
                                 "start.count=300000")
            time.sleep(chance.uniform(0.0, 0.12))
            process.kill()
            process.communicate()
            result = self.folder / "g.out/n.txt"
            if result.exists():
                self.assertEqual(result.read_text(), "300000\n")
        self.velum("run", "g.toml", "--cache", "killed", "--set", "start.count=300000")
        self.assertEqual(self.leftovers(), [])
        for before, after in zip(whole["nodes"], self.record()["nodes"]):
            self.assertEqual(before["out"], after["out"])


if __name__ == "__main__":
    unittest.main()
