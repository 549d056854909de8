# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""report.html of runs and studies: what is in it, and what happens when it cannot be made."""
import base64
import json
import re
import shutil
import signal
import struct
import unittest

from support import CHAIN, TEST_PLUGINS, VELUM, CommandTest

PAGE = "<html><body>\n<!-- velum:data -->\n</body></html>\n"
ESCAPE = 'title = "</script><b>"\n'


class ReportCase(CommandTest):
    def setUp(self):
        super().setUp()
        self.page = self.write("page/report.html", PAGE)
        self.environment["VELUM_REPORT_TEMPLATE"] = str(self.page)

    def report(self, name="g.out"):
        """The data of a report: its JSON and its block of arrays."""
        text = (self.folder / name / "report.html").read_text()
        found = re.fullmatch(
            r"<html><body>\n"
            r'<script id="velum-report" type="application/json">([^<]*)</script>\n'
            r'<script id="velum-data" type="text/plain">([^<]*)</script>\n'
            r"</body></html>\n",
            text,
        )
        self.assertTrue(found, text[:2000])
        return json.loads(found[1]), base64.b64decode(found[2], validate=True)

    def values(self, name="g.out"):
        return {value["id"]: value for value in self.report(name)[0]["values"]}


class ReportTest(ReportCase):
    def test_run_shows_every_value(self):
        self.write("g.toml", ESCAPE + CHAIN)
        out, error = self.velum("run", "g.toml", "--report")
        self.assertIn("report: g.out/report.html", out)
        self.assertEqual(error, "")
        data, block = self.report()
        self.assertEqual((data["format"], data["kind"]), (1, "run"))
        self.assertEqual(data["title"], "</script><b>")
        self.assertEqual(data["run"], self.record())
        self.assertEqual(set(data["stages"]), {"test.numbers", "test.move", "test.write"})
        self.assertNotIn("example", data["stages"]["test.move"])
        self.assertEqual(list(self.values()), ["start.cloud", "moved.cloud"])
        moved = self.values()["moved.cloud"]
        self.assertEqual((moved["count"], moved["shown"]), (100, 100))
        at = moved["positions"]["at"]
        steps = struct.unpack_from("<300H", block, at)
        self.assertEqual((min(steps), max(steps)), (0, 65535))
        self.assertEqual(self.leftovers(), [])

    def test_cached_nodes_are_shown(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml", "--report")
        first = self.report()
        self.velum("run", "g.toml", "--report")
        self.assertEqual(self.statuses()["moved"], "cached")
        again = self.report()
        self.assertEqual(again[0]["values"], first[0]["values"])
        self.assertEqual(again[1], first[1])

    def test_threads_make_no_difference(self):
        chains = "".join(CHAIN.replace('units = "m"\n', "").replace("start", f"start{i}")
                         .replace("moved", f"moved{i}").replace("[node.file]", f"[node.file{i}]")
                         .replace("n.txt", f"n{i}.txt") for i in range(4))
        self.write("g.toml", 'units = "m"\n' + chains)
        found = []
        for threads in (1, 4):
            self.velum("run", "g.toml", "--report", "--no-cache", "--threads", threads)
            data, block = self.report()
            found.append((data["values"], data["histograms"], block))
        self.assertEqual(found[0], found[1])

    def test_failed_run_shows_what_there_is(self):
        self.write("g.toml", CHAIN + '[node.bad]\nuse = "test.throws"\nin = "moved"\n')
        self.velum("run", "g.toml", "--report", status=1)
        data, _ = self.report()
        self.assertEqual(data["run"]["status"], "failed")
        self.assertIn("moved.cloud", self.values())

    def test_interrupted_run_shows_what_there_is(self):
        self.write("g.toml", CHAIN + '[node.slow]\nuse = "test.slow"\nin = "moved"\n')
        for stubborn in ("false", "true"):
            process = self.start(
                "run", "g.toml", "--report", "--no-cache",
                "--set", "slow.time=60 s", "--set", f"slow.stubborn={stubborn}",
            )
            self.wait_for((self.folder / "g.out/n.txt").exists)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130)
            self.assertEqual(self.report()[0]["run"]["status"], "interrupted")
            self.assertIn("moved.cloud", self.values())
            (self.folder / "g.out/n.txt").unlink()

    def test_json_event(self):
        self.write("g.toml", CHAIN)
        out, _ = self.velum("run", "g.toml", "--report", "--json")
        events = [json.loads(line) for line in out.splitlines()]
        self.assertEqual([e["event"] for e in events[-2:]], ["report", "end"])
        self.assertEqual(events[-2]["path"], "g.out/report.html")

    def test_without_a_page_nothing_runs(self):
        self.write("g.toml", CHAIN)
        self.page.unlink()
        _, error = self.velum("run", "g.toml", "--report", status=6)
        self.assertIn("the page for reports", error)
        self.assertIn("make build", error)
        self.assertFalse((self.folder / "g.out").exists())
        self.velum("run", "g.toml")

    def test_a_report_that_cannot_be_written_is_no_failure_of_the_run(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml")
        (self.folder / "g.out/report.html").mkdir()
        out, error = self.velum("run", "g.toml", "--report", status=6)
        self.assertIn("report.html", error)
        self.assertIn("done in", out)
        self.assertEqual(self.record()["status"], "ok")

    def test_report_replaced_by_a_run_without(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml", "--report")
        self.velum("run", "g.toml")
        names = sorted(path.name for path in (self.folder / "g.out").iterdir())
        self.assertEqual(names, ["n.txt", "run.json"])

    def test_no_path_of_this_machine_but_those_of_the_record(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml", "--report", "--png", "pictures")
        record = (self.folder / "g.out/run.json").read_text()
        report = (self.folder / "g.out/report.html").read_text()
        for path in (self.folder, TEST_PLUGINS, VELUM):
            self.assertEqual(report.count(str(path)), record.count(str(path)), path)

    def test_report_again(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml", "--report", "--no-cache")
        path = self.folder / "g.out/report.html"
        first = path.read_bytes()
        path.unlink()
        out, _ = self.velum("report", "g.out")
        self.assertEqual(out, "g.out/report.html\n")
        self.assertEqual(path.read_bytes(), first)
        # Without what the run has left, from the run itself.
        (self.folder / "g.out/views.bin").unlink()
        self.velum("report", "g.out")
        self.assertEqual(path.read_bytes(), first)
        self.assertTrue((self.folder / "g.out/views.bin").exists())

    def test_report_of_a_run_without_one(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml")
        record = (self.folder / "g.out/run.json").read_bytes()
        self.velum("report", "g.out")
        self.assertIn("moved.cloud", self.values())
        self.assertEqual((self.folder / "g.out/run.json").read_bytes(), record)
        self.assertEqual(self.leftovers(), [])

    def test_report_of_a_failed_run(self):
        self.write("g.toml", CHAIN + '[node.bad]\nuse = "test.throws"\nin = "moved"\n')
        self.velum("run", "g.toml", status=1)
        self.velum("report", "g.out")
        self.assertIn("moved.cloud", self.values())

    def test_what_cannot_be_shown_again_is_refused(self):
        points = self.write("points.txt", "1 2 3\n4 5 6\n")
        self.write("g.toml", 'units = "m"\n[node.a]\nuse = "test.read"\nfile = "points.txt"\n')
        self.velum("run", "g.toml")
        points.write_text("1 2 4\n4 5 6\n")
        _, error = self.velum("report", "g.out", status=1)
        self.assertIn("does not give the same again", error)
        self.assertIn("points.txt", error)
        self.assertFalse((self.folder / "g.out/report.html").exists())

    def test_no_device_is_started_for_a_report(self):
        self.write("g.toml", '[node.scan]\nuse = "test.dice"\n')
        self.velum("run", "g.toml")
        _, error = self.velum("report", "g.out", status=2)
        self.assertIn("node 'scan' (test.dice) does not give the same twice", error)
        self.velum("run", "g.toml", "--report")
        self.velum("report", "g.out")  # from views.bin
        self.assertIn("scan.cloud", self.values())

    def test_views_of_another_run_are_not_shown(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml", "--report")
        views = (self.folder / "g.out/views.bin").read_bytes()
        self.velum("run", "g.toml", "--set", "start.count=7")
        (self.folder / "g.out/views.bin").write_bytes(views)
        self.velum("report", "g.out")
        self.assertEqual(self.values()["start.cloud"]["count"], 7)
        (self.folder / "g.out/views.bin").write_bytes(views[:-9])
        _, error = self.velum("report", "g.out", status=5)
        self.assertIn("views.bin", error)

    def test_a_folder_without_results(self):
        _, error = self.velum("report", ".", status=2)
        self.assertIn("neither run.json nor study.json", error)

    def test_pictures(self):
        self.write("g.toml", CHAIN)
        self.velum("run", "g.toml", "--png", "a")
        self.velum("run", "g.toml", "--png", "b")  # from the cache
        names = sorted(path.name for path in (self.folder / "a").iterdir())
        self.assertEqual(names, ["moved.cloud.png", "start.cloud.png"])
        for name in names:
            first = (self.folder / "a" / name).read_bytes()
            self.assertEqual(first[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(first, (self.folder / "b" / name).read_bytes())
        _, error = self.velum("run", "g.toml", "--png", "g.out/pictures", status=2)
        self.assertIn("the pictures would lie in the output folder", error)
        self.write("file", "")
        self.velum("run", "g.toml", "--png", "file", status=6)


class StudyReportTest(ReportCase):
    STUDY = """
units = "m"
[node.start]
use = "test.numbers"
[node.moved]
use = "test.move"
in = "start"
[node.kept]
use = "test.move"
in = "moved"
[study]
title = "How far"
repeat = 2
measure = ["start.count"]
[[study.vary]]
node = "moved"
alternatives = [
  { title = "near", use = "test.move", by = 1 },
  { title = "far", use = "test.move", by = 2 },
  { title = "throw", use = "test.throws" },
]
"""

    def test_study(self):
        self.write("g.toml", self.STUDY)
        out, _ = self.velum("study", "g.toml", status=3)
        self.assertIn("g.out/report.html", out)
        data, block = self.report()
        self.assertEqual((data["kind"], data["title"]), ("study", "How far"))
        self.assertEqual(data["study"], json.loads((self.folder / "g.out/study.json").read_text()))
        self.assertEqual(data["csv"], (self.folder / "g.out/study.csv").read_text())
        self.assertEqual(data["views_of"], {"variants": 2, "of": 3})
        self.assertEqual(set(data["stages"]), {"test.numbers", "test.move"})
        values = self.values()
        self.assertEqual(
            list(values), ["v1/moved.cloud", "v1/kept.cloud", "v2/moved.cloud", "v2/kept.cloud"]
        )
        self.assertEqual(values["v2/kept.cloud"]["variant"], "v2")
        # Each variant once.
        views = sorted(
            str(path.relative_to(self.folder / "g.out/cells"))
            for path in (self.folder / "g.out").rglob("views.bin")
        )
        self.assertEqual(len(views), len({name.split("/")[0] for name in views}))
        first = (self.folder / "g.out/report.html").read_bytes()
        self.velum("report", "g.out")
        self.assertEqual((self.folder / "g.out/report.html").read_bytes(), first)

    def test_study_without_its_cells(self):
        self.write("g.toml", self.STUDY)
        self.velum("study", "g.toml", status=3)
        shutil.rmtree(self.folder / "g.out/cells")
        self.velum("report", "g.out")
        self.assertEqual(self.report()[0]["views_of"], {"variants": 0, "of": 3})

    def test_study_without_a_page_is_complete(self):
        self.page.unlink()
        self.write("g.toml", self.STUDY)
        _, error = self.velum("study", "g.toml", status=3)
        self.assertIn("warning: no report.html", error)
        self.assertTrue((self.folder / "g.out/study.json").exists())


if __name__ == "__main__":
    unittest.main()
