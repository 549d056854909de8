#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""live.py VELUM GRAPHS LIMITS: the live graph against two emulated scanners, within the limits that the
simulated scans keep, and with as many lines.

live.py VELUM GRAPHS --faults: what becomes of a recording when the scanner misbehaves.

live.py VELUM GRAPHS --long: two scanners at 100 Hz and 1/6 degree, 30,000 revolutions each, as fast as they
go: no line lost, memory flat.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import threading

velum, graphs = sys.argv[1], pathlib.Path(sys.argv[2])
SCENE = graphs / "scenes" / "wind_tunnel.toml"
faults = []


class Emulator:
    """A scanner that streams as fast as it is read."""

    def __init__(self, scanner, *options):
        self.process = subprocess.Popen(
            [velum, "emulate", SCENE, "--scanner", scanner, "--port", "0", "--speed", "0", *options],
            stdout=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        found = re.search(r"^listening .*port (\d+) \(host port", line)
        assert found, line
        self.address = f"127.0.0.1:{found[1]}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        assert self.process.wait(30) == 130, self.process.returncode


def run(*arguments, out):
    process = subprocess.Popen([velum, "run", *arguments, "--out", out, "--no-cache"],
                               stdout=subprocess.DEVNULL)
    return process


def finished(process, out):
    if process.wait() != 0:
        sys.exit(f"velum run ended with {process.returncode}")
    record = json.loads((out / "run.json").read_text())
    return {f"{node['name']}.{name}": measure["value"]
            for node in record["nodes"] for name, measure in node["measures"].items()}


def live(limits):
    wanted = json.loads(pathlib.Path(limits).read_text())
    with tempfile.TemporaryDirectory() as work, Emulator("gennaker") as a, \
            Emulator("mainsail") as b:
        out = pathlib.Path(work) / "out"
        measures = finished(run(graphs / "wind_tunnel_live.toml", "--set",
                                f"scan_gennaker.address={a.address}", "--set",
                                f"scan_mainsail.address={b.address}", out=out), out)
    compared = 0
    for name, limit in wanted.items():
        value = measures.get(name)
        if value is None:  # by labels, or a cell of a table
            continue
        compared += 1
        if value > limit.get("most", value) or value < limit.get("least", value) or \
                value != limit.get("is", value):
            faults.append(f"{name} is {value}, wanted {limit}")
    assert compared >= 15, f"only {compared} measures were compared"
    for scan in ("scan_gennaker", "scan_mainsail"):
        for name, least, most in (("lost_lines", 0, 0), ("malformed", 0, 0), ("lines", 199, 202)):
            if not least <= measures[f"{scan}.{name}"] <= most:
                faults.append(f"{scan}.{name} is {measures[f'{scan}.{name}']}")


RECORD = """
format = 1
[node.a]
use = "devices.recorder"
address = "ADDRESS_A"
frequency = 100
resolution = 0.1667
lines = LINES
file = "a.vrec"
[node.b]
use = "devices.recorder"
address = "ADDRESS_B"
frequency = 100
resolution = 0.1667
lines = LINES
file = "b.vrec"
"""


def resident(pid):
    """Resident memory of a process [kB]."""
    with open(f"/proc/{pid}/status", encoding="utf-8") as file:
        return int(re.search(r"VmRSS:\s+(\d+)", file.read())[1])


def watch(processes, samples, done):
    while not done.wait(0.5):
        try:
            samples.append([resident(process.pid) for process in processes])
        except (OSError, TypeError):
            return


def cpu(pid):
    """CPU time of a process [s]."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / 100.0


def long(lines=30000):
    with tempfile.TemporaryDirectory() as work, Emulator("gennaker", "--frequency", "100",
                                                         "--resolution", "0.1667") as a, \
            Emulator("mainsail", "--frequency", "100", "--resolution", "0.1667") as b:
        out = pathlib.Path(work) / "out"
        graph = pathlib.Path(work) / "record.toml"
        graph.write_text(RECORD.replace("ADDRESS_A", a.address).replace("ADDRESS_B", b.address)
                         .replace("LINES", str(lines)))
        process = run(graph, "--threads", "2", out=out)
        samples, done = [], threading.Event()
        watcher = threading.Thread(target=watch, args=((process, a.process, b.process), samples,
                                                       done))
        watcher.start()
        measures = finished(process, out)
        done.set()
        watcher.join()
        record = json.loads((out / "run.json").read_text())
        emulators = cpu(a.process.pid), cpu(b.process.pid)
    revolutions = lines / 100.0
    print(f"{2 * lines} telegrams in {record['seconds']:.1f} s; of a core at 100 Hz: recorders "
          f"{50 * record['cpu_seconds'] / revolutions:.2f} % each, emulators "
          f"{100 * emulators[0] / revolutions:.1f} and {100 * emulators[1] / revolutions:.1f} %")
    for node in "ab":
        for name, value in (("lines", lines), ("lost_lines", 0), ("malformed", 0),
                            ("bad_checksums", 0), ("gaps", 0)):
            if measures[f"{node}.{name}"] != value:
                faults.append(f"{node}.{name} is {measures[f'{node}.{name}']}, wanted {value}")
    # From the second quarter on: at first libraries are loaded and buffers made.
    for number, what in enumerate(("recorders", "first emulator", "second emulator")):
        later = [sample[number] for sample in samples[len(samples) // 4:-1]]
        print(f"memory of the {what}: {min(later) / 1024:.1f} to {max(later) / 1024:.1f} MB "
              f"({len(later)} samples)")
        if max(later) - min(later) > 8 * 1024:
            faults.append(f"memory of the {what} is not flat")


FAULT = """
format = 1
[node.a]
use = "devices.recorder"
address = "ADDRESS"
lines = 60
give_up = "4 s"
file = "a.vrec"
"""


def recording_of(fault, *options):
    """Exit status, measures and warnings of a recording of 60 lines; the fault comes after 20."""
    with tempfile.TemporaryDirectory() as work, Emulator("gennaker", "--fault", fault,
                                                         *options) as emulator:
        graph, out = pathlib.Path(work) / "g.toml", pathlib.Path(work) / "out"
        graph.write_text(FAULT.replace("ADDRESS", emulator.address))
        status = subprocess.run([velum, "run", graph, "--out", out], stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, timeout=120).returncode
        node = json.loads((out / "run.json").read_text())["nodes"][0]
    return status, {name: m["value"] for name, m in node["measures"].items()}, node["warnings"]


def expect(fault, *conditions, status=0, options=()):
    found, measures, warnings = recording_of(fault, *options)
    if found != status:
        faults.append(f"{fault}: exit {found}, wanted {status}: {warnings}")
        return
    for name, least, most in conditions:
        value = len(warnings) if name == "warnings" else measures[name]
        if not least <= value <= most:
            faults.append(f"{fault}: {name} is {value}, wanted {least} to {most}: {warnings}")


def all_faults():
    whole = (("lines", 60, 60), ("lost_lines", 0, 0), ("connections", 1, 1))
    again = (("lines", 60, 60), ("connections", 2, 9), ("gaps", 1, 9), ("warnings", 1, 99))
    expect("none", *whole, ("bad_checksums", 0, 0))
    expect("split", *whole)
    expect("drip", *whole)
    expect("flood", *whole)
    expect("garbage", *whole)
    expect("refuse", *whole, ("warnings", 1, 99))
    expect("gap", ("lines", 60, 60), ("lost_lines", 3, 9))
    expect("checksum", ("lines", 60, 60), ("lost_lines", 3, 9), ("bad_checksums", 3, 9))
    expect("length", ("lines", 60, 60), ("lost_lines", 3, 9))
    expect("half", *again)
    expect("reset", *again)
    expect("power_cycle", *again)
    expect("silence", *again)
    expect("model", status=7)
    expect("error", status=7, options=("--set", "fault_code=13"))


if sys.argv[3] == "--faults":
    all_faults()
elif sys.argv[3] == "--long":
    long(*map(int, sys.argv[4:]))
else:
    live(sys.argv[3])
sys.exit("\n".join(faults) or 0)
