# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""tutorial.py CHECKOUT: does what docs/tutorial.md says, with a home of its own.

Its `sh` blocks are run in order in one shell, beginning in the checkout; its `toml` blocks are saved
under the name on their first line. The first command that fails ends it.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def script_of(page):
    """The page as one script."""
    lines = ["set -euo pipefail"]
    commands = 0
    for kind, text in BLOCK.findall(page):
        if kind == "sh":
            lines += [f"echo {shlex.quote('$ ' + line)}\n{line}" for line in text.splitlines()]
            commands += len(text.splitlines())
        elif kind == "toml":
            name = re.match(r"# (\S+\.toml)\n", text)
            assert name, f"a file without its name on the first line:\n{text[:80]}"
            lines.append(f"cat > {name[1]} <<'END'\n{text}END")
        else:
            raise AssertionError(f"a block of {kind}: only sh and toml can be run")
    assert commands > 15, f"only {commands} commands on the page"
    return "\n".join(lines) + "\n"


def main():
    checkout = pathlib.Path(sys.argv[1])
    page = (checkout / "docs/tutorial.md").read_text(encoding="utf-8")
    results = ["scan.out/gennaker.ply", "mesh.out/gennaker.stl", "gennaker.xyz", "sweep.out/study.csv",
               "compare.out/study.json", "mesh.out/report.html", "sweep.out/report.html"]
    if shutil.which("npm") is None:
        print("without npm there is no report.html: left out")
        page = page.replace("velum run mesh.toml --report\n", "true\n")
        results = results[:-2]
    script = script_of(page)
    home = tempfile.mkdtemp(prefix="velum-tutorial-")
    environment = {k: v for k, v in os.environ.items()
                   if not k.startswith(("VELUM", "XDG", "LD_LIBRARY"))}
    environment["CCACHE_DIR"] = os.environ.get("CCACHE_DIR", os.path.expanduser("~/.cache/ccache"))
    environment["HOME"] = home
    try:
        done = subprocess.run(["bash", "-c", script], cwd=checkout, env=environment, check=False,
                              capture_output=True, text=True)
        print(done.stdout[-20000:])
        if done.returncode != 0:
            sys.exit(f"exit {done.returncode} after the last command above:\n{done.stderr[-5000:]}")
        sails = pathlib.Path(home, "sails")
        for result in results:
            assert (sails / result).stat().st_size > 0, result
    finally:
        shutil.rmtree(home)


if __name__ == "__main__":
    main()
