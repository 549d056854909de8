# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Every study of graphs/studies/ is a sound one; with --run, that of resampling ends as the thesis
found."""
import json
import pathlib
import subprocess
import sys
import tempfile

velum, folder = sys.argv[1], pathlib.Path(sys.argv[2])
studies = sorted(folder.glob("*.toml"))
assert studies, f"no studies in {folder}"
for study in studies:
    out = subprocess.run([velum, "check", study], check=True, capture_output=True, text=True).stdout
    assert " cells" in out, out
if "--run" not in sys.argv:
    sys.exit()

with tempfile.TemporaryDirectory() as work:
    out = pathlib.Path(work) / "out"
    subprocess.run([velum, "study", folder / "resampling.toml", "--out", out], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    result = json.loads((out / "study.json").read_text())

rms = {}
for variant in result["variants"]:
    assert variant["status"] == "ok", variant
    rms[variant["axes"]["radius"], variant["axes"]["order"]] = (
        variant["summary"]["error.rms"]["mean"])
radii = list(dict.fromkeys(radius for radius, _ in rms))
best = min(rms, key=rms.get)
print(f"best: radius {best[0]}, order {best[1]}, {1e3 * rms[best]:.2f} mm")
assert rms[best] < 0.8e-3, "the best must be under 0.8 mm"
# Planes flatten the sail the more, the wider they look; curved pieces are best in between.
assert rms[radii[-1], "1"] > 10 * rms[best]
assert best[0] not in (radii[0], radii[-1])
second = next(v for v in result["variants"]
              if v["axes"] == {"radius": radii[-1], "order": "1"})["summary"]["error.rms"]
assert second["difference"]["p"] < 0.05, second
