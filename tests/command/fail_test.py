# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""The ways to fail: each has its exit status and its form of message."""
import json
import os
import resource
import unittest

from support import CHAIN, CommandTest


class FailTest(CommandTest):
    def test_no_command(self):
        out, error = self.velum(status=2)
        self.assertEqual(out, "")
        self.assertIn("Usage", error)

    def test_unknown_command_and_flag(self):
        out, error = self.velum("rnu", "g.toml", status=2)
        self.assertEqual(out, "")
        self.assertIn("unknown command 'rnu'", error)
        self.assertIn("did you mean 'run'?", error)
        _, error = self.velum("run", "--thread", "2", "g.toml", status=2)
        self.assertIn("did you mean '--threads'?", error)
        self.velum("run", status=2)
        self.velum("run", "g.toml", "--threads", "0", status=2)
        self.velum("run", "g.toml", "--seed", "many", status=2)
        self.velum("run", "g.toml", "--cache", "c", "--no-cache", status=2)

    def test_a_mistake_in_the_graph(self):
        self.write("g.toml", CHAIN.replace("test.move", "test.moev"))
        for command in ("run", "check"):
            _, error = self.velum(command, "g.toml", status=2)
            self.assertRegex(error, r"error\[E\d{4}\] g.toml:6:\d+")
            self.assertIn("did you mean 'test.move'?", error)
        self.assertFalse((self.folder / "g.out").exists())
        _, error = self.velum("run", "nowhere.toml", status=2)
        self.assertIn("nowhere.toml", error)
        self.write("g.toml", CHAIN)
        _, error = self.velum("run", "g.toml", "--set", "moved.byy=2", status=2)
        self.assertIn("did you mean 'by'?", error)
        self.velum("run", "g.toml")
        _, error = self.velum("run", "g.toml", "--only", "movd", status=2)
        self.assertIn("did you mean 'moved'?", error)
        self.assertTrue((self.folder / "g.out/n.txt").exists())

    def test_an_ending_without_a_format(self):
        self.needs("io.write_mesh")
        self.write("g.toml", CHAIN + '[node.w]\nuse = "io.write_cloud"\nin = "moved"\nfile = "a.plx"\n')
        for command in ("run", "check"):
            _, error = self.velum(command, "g.toml", status=2)
            self.assertRegex(error, r"error\[E0211\] g.toml:\d+:1 ")
            self.assertIn("no format is known for 'a.plx', expected .pcd, .ply", error)
        self.assertFalse((self.folder / "g.out").exists())

    def test_a_name_that_a_scene_does_not_have(self):
        self.write("inner/s.toml", 'format = 1\nunits = "m"\n[object.floor]\nshape = "plane"\nlabel = 1\n'
                   'position = [0, 0, 0]\nnormal = [0, 0, 1]\nsize = [1, 1]\n')
        self.write("inner/g.toml", 'format = 1\n[node.s]\nuse = "devices.truth"\n'
                   'scene = "s.toml"\nobject = "flor"\n')
        _, error = self.velum("check", "inner/g.toml", status=2)
        self.assertRegex(error, r"error\[E0211\] inner/g.toml:5:1 .*no object 'flor'")
        self.assertIn("known: floor", error)

    def test_seeds(self):
        self.write("g.toml", CHAIN)
        for seed in ("-1", "1.5", "9223372036854775808"):
            _, error = self.velum("run", "g.toml", "--seed", seed, status=2)
            self.assertIn("whole number", error)
        self.velum("run", "g.toml", "--seed", "9223372036854775807")

    def test_bad_data(self):
        self.write("points.txt", "many\n")
        self.write("g.toml", '[node.scan]\nuse = "test.read"\nfile = "points.txt"\n')
        _, error = self.velum("run", "g.toml", status=5)
        self.assertRegex(error, r"error\[E1050\] .*points.txt:1  found no number, expected")
        self.assertIn("read by node 'scan' (test.read)", error)
        self.assertEqual(self.record()["error"]["code"], "E1050")

    def test_a_stage_that_throws(self):
        graph = CHAIN.replace("test.move", "test.throws")
        for what, status, words in (
            ("error", 1, "three points are too few"),
            ("standard", 1, "matrix is singular"),
            ("own", 1, "not a std::exception"),
            ("integer", 1, "not a std::exception"),
            ("device", 7, "no answer"),
        ):
            self.write("g.toml", graph)
            _, error = self.velum("run", "g.toml", "--set", f"moved.what={what}", status=status)
            self.assertRegex(error, r"error\[E10\d\d\] node 'moved' \(test.throws\): ")
            self.assertIn(words, error)
            self.assertEqual(
                self.statuses(), {"start": "ok" if what == "error" else "cached",
                                  "moved": "failed", "file": "skipped"})

    def test_an_empty_result(self):
        self.write("g.toml", CHAIN.replace("test.move", "test.drop"))
        _, error = self.velum("run", "g.toml", "--set", "moved.above=-1 m", status=1)
        self.assertIn("error[E1002]", error)
        self.assertIn("'moved' (test.drop) was given 100 points and kept nothing", error)

    def test_a_plugin_that_does_not_load(self):
        self.write("plugins/test/broken.so", "this is no shared object, but long enough " * 99)
        self.environment["VELUM_PLUGIN_PATH"] += f":{self.folder}/plugins"
        self.write("g.toml", CHAIN.replace("test.move", "test.broken"))
        for command in ("check", "run"):
            _, error = self.velum(command, "g.toml", status=4)
            self.assertIn("broken.so", error)
        # With a mistake besides, the graph is what is wrong.
        self.write("g.toml", CHAIN.replace("test.move", "test.broken") + "sise = 3\n")
        self.velum("check", "g.toml", status=2)

    def test_output_that_cannot_be_written(self):
        self.write("g.toml", CHAIN)
        self.write("g.out/notes.txt", "mine")
        _, error = self.velum("run", "g.toml", status=6)
        self.assertIn("notes.txt", error)
        self.assertEqual((self.folder / "g.out/notes.txt").read_text(), "mine")
        self.assertEqual(self.leftovers(), [])

        self.write("a-file", "mine")
        self.velum("run", "g.toml", "--out", "a-file", status=6)  # found by the check
        self.assertEqual((self.folder / "a-file").read_text(), "mine")

    def test_a_disk_that_is_full(self):
        self.write("g.toml", CHAIN.replace('file = "n.txt"', 'file = "n.txt"\ntimes = 100000'))

        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        _, error = self.velum("run", "g.toml", "--no-cache", status=6, preexec_fn=small_files)
        self.assertRegex(error, r"error\[E1060\] .*n.txt  cannot be written")
        self.assertIn("written by node 'file' (test.write)", error)
        self.assertFalse((self.folder / "g.out/n.txt").exists())
        self.assertEqual(self.leftovers(), [])

    def test_standard_output_that_is_full(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            _, error = self.velum("list", stdout=full, status=6)
        self.assertIn("standard output cannot be written", error)

    def test_numbers_that_wrap(self):
        self.write("g.toml", CHAIN)
        for option in (("--seed", "-1"), ("--cache-size", "-5"), ("--threads", "-4")):
            self.velum("run", "g.toml", *option, status=2)

    def test_files_that_are_none(self):
        os.mkfifo(self.folder / "pipe.xyz")
        for name in ("pipe.xyz", ".", "missing.xyz"):
            self.velum("info", name, status=2)

    def test_a_cache_among_the_results(self):
        self.write("g.toml", CHAIN)
        _, error = self.velum("run", "g.toml", "--out", "o", "--cache", "o/c", status=2)
        self.assertIn("the cache lies in the output folder", error)
        self.assertFalse((self.folder / "o").exists())

    def test_a_crash_in_a_process_of_its_own(self):
        self.write("g.toml", CHAIN.replace(
            'use = "test.move"', 'use = "test.crash"\nisolate = true') +
            '[node.other]\nuse = "test.move"\nin = "start"\n')
        _, error = self.velum("run", "g.toml", status=1)
        self.assertRegex(error, r"error\[E1003\] node 'moved' \(test.crash\): .*SIGSEGV")
        self.assertEqual(self.statuses()["other"], "ok")
        self.assertEqual(self.leftovers(), [])

    def test_errors_as_events(self):
        self.write("g.toml", CHAIN.replace("test.move", "test.throws"))
        out, _ = self.velum("run", "g.toml", "--json", status=1)
        events = [json.loads(line) for line in out.splitlines()]
        error = next(event for event in events if event["event"] == "error")
        self.assertEqual((error["node"], error["code"]), ("moved", "E1001"))
        self.assertEqual((events[-1]["event"], events[-1]["exit"]), ("end", 1))
        self.write("g.toml", "[node.a]\nuse = 5\n")
        out, _ = self.velum("run", "g.toml", "--json", status=2)
        events = [json.loads(line) for line in out.splitlines()]
        self.assertIn("g.toml:2:", events[0]["where"])
        self.assertEqual(events[-1]["exit"], 2)

    def test_a_folder_in_use(self):
        self.write("g.toml", CHAIN.replace("test.move", "test.slow"))
        first = self.start("run", "g.toml", "--set", "moved.time=3 s")
        self.wait_for((self.folder / "g.out/.velum.lock").exists)
        _, error = self.velum("run", "g.toml", status=6)
        self.assertIn(f"process {first.pid} is writing", error)
        first.communicate()
        self.assertEqual(first.returncode, 0)


if __name__ == "__main__":
    unittest.main()
