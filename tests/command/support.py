# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""What the tests of the command share: a folder each, and the command run in it."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

VELUM = os.environ["VELUM"]
TEST_PLUGINS = os.environ["VELUM_TEST_PLUGINS"]
BUILT_PLUGINS = os.environ["VELUM_BUILT_PLUGINS"]

CHAIN = """
units = "m"
[node.start]
use = "test.numbers"
[node.moved]
use = "test.move"
in = "start"
[node.file]
use = "test.write"
in = "moved"
file = "n.txt"
"""


class CommandTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="velum-command-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.environment = dict(
            os.environ,
            VELUM_PLUGIN_PATH=f"{TEST_PLUGINS}:{BUILT_PLUGINS}",
            XDG_CACHE_HOME=str(self.folder / "cache"),
        )

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def start(self, *arguments, **more):
        more.setdefault("env", self.environment)
        more.setdefault("cwd", self.folder)
        return subprocess.Popen(
            [VELUM, *map(str, arguments)],
            stdout=more.pop("stdout", subprocess.PIPE),
            stderr=subprocess.PIPE,
            text=True,
            **more,
        )

    def velum(self, *arguments, status=0, **more):
        """Standard output and standard error of a run that ends with `status`."""
        process = self.start(*arguments, **more)
        out, error = process.communicate(timeout=60)
        self.assertEqual(process.returncode, status, f"{arguments}\n{out}\n{error}")
        return out, error

    def wait_for(self, condition):
        end = time.monotonic() + 30
        while not condition():
            self.assertLess(time.monotonic(), end, "waited in vain")
            time.sleep(0.01)

    def record(self, name="g.out"):
        return json.loads((self.folder / name / "run.json").read_text())

    def statuses(self, name="g.out"):
        return {node["name"]: node["status"] for node in self.record(name)["nodes"]}

    def leftovers(self, name="g.out"):
        """Files in the output folder that are no results."""
        return [path.name for path in (self.folder / name).rglob(".*")]

    def needs(self, stage):
        kind, name = stage.split(".")
        if not pathlib.Path(BUILT_PLUGINS, kind, name + ".so").exists():
            self.skipTest(f"{stage} is not built")
