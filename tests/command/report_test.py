# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""report.html of runs and studies: what is in it, and what happens when it cannot be made."""
import base64
import json
import re
import shutil
import struct
import unittest

from support import CHAIN, CommandTest

PAGE = "<html><body>\n<!-- velum:data -->\n</body></html>\n"
ESCAPE = 'title = "</script><b>"\n'


class ReportTest(CommandTest):
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


if __name__ == "__main__":
    unittest.main()
