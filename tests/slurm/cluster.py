# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""A Slurm of its own for a test: one controller and two nodes on loopback, all in one folder."""
import ctypes
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scancel")
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"
PR_SET_PDEATHSIG = 1

CONF = """
ClusterName=velum
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
ReturnToService=2
SlurmdTimeout=5
KillWait=2
NodeName=n[1-2] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{ports[1]}-{ports[2]}] CPUs=2 RealMemory=4000
PartitionName=all Nodes=ALL Default=YES State=UP
"""


class Unavailable(Exception):
    """Slurm cannot be started here, and why."""


def free_ports():
    """Three ports that nobody has, the last two side by side."""
    for first in range(17000 + os.getpid() % 1000 * 10, 65000, 3):
        try:
            for port in (first, first + 1, first + 2):
                with socket.socket() as one:
                    one.bind(("127.0.0.1", port))
            return first, first + 1, first + 2
        except OSError:
            continue
    raise Unavailable("no free ports")


class Cluster:
    """Use it with `with`: whatever happens, its daemons end with it."""

    def __init__(self):
        missing = [name for name in PROGRAMS if shutil.which(name, path=PATH) is None]
        if missing:
            raise Unavailable(f"not installed: {', '.join(missing)} (Debian: slurm-wlm, munge)")
        if os.geteuid() != 0:
            raise Unavailable("Slurm's daemons want the superuser here")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="velum-slurm-"))
        self.daemons = {}
        self.environment = dict(
            os.environ, PATH=PATH, SLURM_CONF=str(self.folder / "slurm.conf"))
        for name in list(self.environment):
            if name.startswith(("SBATCH_", "SQUEUE_")):
                del self.environment[name]

    def __enter__(self):
        try:
            self.begin()
        except BaseException:
            self.end()
            raise
        return self

    def __exit__(self, *_):
        self.end()

    def begin(self):
        host = socket.gethostname().split(".")[0]
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text(CONF.format(
            host=host, folder=self.folder, user="root", ports=free_ports()))
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.daemon("munged", "--foreground", "--force", f"--key-file={key}",
                    *(f"--{name}-file={self.folder}/munge.{name}" for name in ("pid", "log", "seed")),
                    f"--socket={self.folder}/munge.socket")
        self.wait(lambda: (self.folder / "munge.socket").exists(), "munged does not start")
        self.daemon("slurmctld", "-D")
        self.start_node("n1")
        self.start_node("n2")
        self.wait(lambda: self.nodes().count("idle") == 2, "the nodes do not become idle", 60)

    def start_node(self, name):
        (self.folder / f"spool-{name}").mkdir(exist_ok=True)
        self.daemon("slurmd", "-D", "-N", name, name=name)

    def daemon(self, program, *arguments, name=None):
        libc = ctypes.CDLL(None)
        log = open(self.folder / f"{name or program}.out", "ab")
        # It also ends when this test is killed.
        self.daemons[name or program] = subprocess.Popen(
            [shutil.which(program, path=PATH), *arguments], env=self.environment,
            stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True,
            preexec_fn=lambda: libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL))
        log.close()

    def run(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True,
                              timeout=60).stdout

    def nodes(self):
        return self.run("sinfo", "--noheader", "--Node", "--format=%t").split()

    def wait(self, condition, reason, limit=20.0):
        end = time.monotonic() + limit
        while not condition():
            dead = [name for name, one in self.daemons.items() if one.poll() is not None]
            if dead or time.monotonic() > end:
                raise Unavailable(f"{', '.join(dead)} ended" if dead else reason)
            time.sleep(0.05)

    def processes_of(self, node=None):
        """All that this Slurm has started; with a name, the tasks on that node and their steps."""
        found = []
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                environment = (process / "environ").read_bytes().split(b"\0")
                parent = int((process / "stat").read_text().rsplit(")", 1)[1].split()[1])
            except OSError:
                continue
            if f"SLURM_CONF={self.folder}/slurm.conf".encode() not in environment:
                continue
            if node is None:
                found.append(int(process.name))
            elif f"SLURMD_NODENAME={node}".encode() in environment:
                found += [parent, int(process.name)] if is_step(parent) else [int(process.name)]
        return [process for process in found if process != os.getpid()]

    def kill_node(self, name):
        """As when its power fails: the daemon and all that it runs."""
        daemon = self.daemons.pop(name)
        daemon.kill()
        daemon.wait()
        end = time.monotonic() + 1.0  # a step may be about to start its task
        while time.monotonic() < end:
            for process in self.processes_of(name):
                kill(process)
            time.sleep(0.02)

    def end(self):
        for process in self.daemons.values():
            process.kill()
        for process in self.processes_of():
            kill(process)
        for process in self.daemons.values():
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


def is_step(process):
    try:
        return b"slurmstepd" in pathlib.Path(f"/proc/{process}/cmdline").read_bytes()
    except OSError:
        return False


def kill(process):
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        pass
