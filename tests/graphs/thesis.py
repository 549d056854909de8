# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""thesis.py VELUM CHECKOUT [--run]: the studies of graphs/thesis/ are sound, and what stands beside them
in expected.toml fits; with --run they are run, in under 15 minutes of processor time, and every finding is
seen again, or not, as docs/thesis.md says."""
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

velum, checkout = sys.argv[1], pathlib.Path(sys.argv[2])
folder = checkout / "graphs/thesis"
sys.path.insert(0, str(checkout / "tools/thesis"))
sys.dont_write_bytecode = True


def load(path):
    with open(path, "rb") as file:
        return tomllib.load(file)


def fits(table, study):
    """A table's measures are the study's, and its labels are on the study's axes."""
    measures = {c["measure"] for c in table["columns"] if "measure" in c}
    for row in table["rows"]:
        measures |= set(row.get("measures", {}).values())
        for labels in (row[key] for key in ("ours", "best") if key in row):
            axes = {axis.get("title", axis.get("node", axis.get("param"))) for axis in study["vary"]}
            assert set(labels) <= axes, (table["id"], labels, axes)
        assert len(row.get("thesis", table["columns"])) == len(table["columns"]), (table["id"], row)
    assert measures <= set(study["measure"]), (table["id"], measures - set(study["measure"]))


def printed_matrices_are_compared():
    """Three printed digits are enough for a tenth of a degree, near 0 and far from it."""
    from matrices import rotation_between, shift_between
    still = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    nearly = [[1, 0.001, 0, 3], [-0.001, 1, 0.001, 4], [0, -0.001, 1, 0], [0, 0, 0, 1]]
    turned = [[-0.5, -0.866, 0, 0], [0.866, -0.5, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    assert abs(math.degrees(rotation_between(still, nearly))) < 0.1
    assert abs(math.degrees(rotation_between(still, turned)) - 120) < 0.1
    assert shift_between(still, nearly) == 5


def words(page):
    """The verdicts of the table on a page."""
    return dict(re.findall(r"^\| \[(F\d\d)\].*\| \*\*(\w+)\*\* \|$", page, re.MULTILINE))


def main():
    printed_matrices_are_compared()
    expected = load(folder / "expected.toml")
    graphs = sorted(g for g in folder.glob("*.toml") if g.stem != "expected")
    assert graphs, f"no graphs in {folder}"
    for graph in graphs:
        subprocess.run([velum, "check", graph], check=True, stdout=subprocess.DEVNULL)
    for table in expected["table"]:
        fits(table, load(folder / f"{table['study']}.toml")["study"])
    assert [f["id"] for f in expected["finding"]] == [f"F{k:02}" for k in range(1, 32)]
    committed = words((checkout / "docs/thesis.md").read_text(encoding="utf-8"))
    assert len(committed) == 31, committed
    if "--run" not in sys.argv:
        return
    with tempfile.TemporaryDirectory() as work:
        page = pathlib.Path(work, "thesis.md")
        subprocess.run([sys.executable, checkout / "tools/thesis", "--velum", velum, "--out", work,
                        "--page", page], check=True)
        text = page.read_text(encoding="utf-8")
    assert words(text) == committed, (words(text), committed)
    minutes = float(re.search(r"studies took ([0-9.]+) minutes", text).group(1))
    assert minutes < 15, f"{minutes} minutes of processor time"


if __name__ == "__main__":
    main()
