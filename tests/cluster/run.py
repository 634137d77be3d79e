#!/usr/bin/env python3
"""A picture by a Slurm of two nodes on this machine, one of which is lost on the way. Writes docs/long-renders.md.

Run through ./build.sh cluster, which installs Slurm. Needs root. Starts slurmctld and two slurmd, submits
examples/cluster/slurm.sh, kills a node with all that runs there, waits for the merge, compares, stops everything. Exit
status 0 only where the picture is that of one render, bit for bit.
"""

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "apps/bench"), str(ROOT / "tests/faults")]
import reports  # noqa: E402
from bits import pixels  # noqa: E402

BIN = ROOT / "build/release/bin"
FIGURE = ["--size", "160x160", "--spp", "1536"]
PARTS = 6
EVERY = 0.5  # seconds between checkpoints
NODES = {"n1": 17001, "n2": 17002}


def configuration(folder):
    host = socket.gethostname()
    lines = ["ClusterName=limn", f"SlurmctldHost={host}(127.0.0.1)", "SlurmctldPort=16817", "SlurmUser=root",
             "SlurmdUser=root", "AuthType=auth/none", "CredType=cred/none", "ProctrackType=proctrack/linuxproc",
             "TaskPlugin=task/none", "JobAcctGatherType=jobacct_gather/none", "MpiDefault=none", "ReturnToService=2",
             "SlurmdTimeout=20", "SelectType=select/cons_tres", "SelectTypeParameters=CR_Core",
             f"StateSaveLocation={folder}/state", f"SlurmdSpoolDir={folder}/spool-%n",
             f"SlurmctldPidFile={folder}/slurmctld.pid", f"SlurmdPidFile={folder}/slurmd-%n.pid",
             f"SlurmctldLogFile={folder}/slurmctld.log", f"SlurmdLogFile={folder}/slurmd-%n.log"]
    lines += [f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1" for name, port in NODES.items()]
    lines += ["PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP"]
    return "\n".join(lines) + "\n"


def output(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout.strip()


def wait_for(condition, seconds, what):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return
        time.sleep(0.2)
    raise RuntimeError(f"cluster: waited {seconds} s for {what}")


class Slurm:
    """The daemons, in a folder of their own, as long as the `with` lasts."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, {}
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")

    def start(self, name, *command):
        log = open(self.folder / f"{name}.out", "w")
        self.daemons[name] = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def __enter__(self):
        (self.folder / "slurm.conf").write_text(configuration(self.folder))
        for name in ("state", "spool-n1", "spool-n2"):
            (self.folder / name).mkdir()
        self.start("slurmctld", "slurmctld", "-D")
        for node in NODES:
            self.start(node, "slurmd", "-D", "-N", node)
        wait_for(lambda: output("sinfo", "-h", "-t", "idle", "-o", "%D") == str(len(NODES)), 60, "the nodes")
        return self

    def kill(self, node):
        """What a power cut does: the daemon, the daemons of its steps and what they run end at once."""
        jobs = output("squeue", "-h", "-w", node, "-o", "%A").split()
        self.daemons[node].kill()
        for process in Path("/proc").glob("[0-9]*"):
            try:
                title = (process / "cmdline").read_bytes().decode(errors="replace")
                variables = (process / "environ").read_bytes().decode(errors="replace").split("\0")
            except OSError:
                continue
            if any(title.startswith(f"slurmstepd: [{job}.") for job in jobs) or f"SLURMD_NODENAME={node}" in variables:
                os.kill(int(process.name), signal.SIGKILL)
        return jobs

    def __exit__(self, *_):
        output("scancel", "--user", "root")
        for daemon in self.daemons.values():
            daemon.terminate()
        for daemon in self.daemons.values():
            daemon.wait()


def render_by_slurm(slurm, work):
    """Seconds from submitting to the picture, jobs that were lost."""
    begin = time.monotonic()
    program = str(BIN / "fig15_cornell_box")
    merge = subprocess.run([str(ROOT / "examples/cluster/slurm.sh"), str(PARTS), "cluster.exr", program, *FIGURE,
                            "--threads", "1"], cwd=work, capture_output=True, text=True, check=True,
                           env={**os.environ, "LIMN": str(BIN / "limn"), "EVERY": str(EVERY)}).stdout.strip()
    running = lambda: output("squeue", "-h", "-w", "n1", "-t", "running", "-o", "%K")  # noqa: E731
    wait_for(running, 60, "a task on n1")
    wait_for((work / f"cluster-{running()}.film").exists, 60, "its checkpoint")
    lost = slurm.kill("n1")
    wait_for(lambda: (work / "cluster.exr").exists() or not output("squeue", "-h", "-j", merge), 600, "the merge")
    wait_for(lambda: not output("squeue", "-h", "-j", merge), 60, "its end")
    return time.monotonic() - begin, lost


def main():
    head = reports.origin("cluster")
    with tempfile.TemporaryDirectory(prefix="limn-slurm-") as name:
        folder = Path(name)
        work = folder / "work"
        work.mkdir()
        begin = time.monotonic()
        subprocess.run([str(BIN / "fig15_cornell_box"), *FIGURE, "--quiet", "-o", "one.exr"], cwd=work, check=True)
        alone = time.monotonic() - begin
        try:
            with Slurm(folder) as slurm:
                seconds, lost = render_by_slurm(slurm, work)
            same = (work / "cluster.exr").exists() and pixels(work / "cluster.exr") == pixels(work / "one.exr")
        finally:
            kept = ROOT / "build/cluster"
            kept.mkdir(parents=True, exist_ok=True)
            for log in (*folder.glob("*.log"), *folder.glob("*.out"), *work.glob("*.log")):
                shutil.copy(log, kept)
    head["faults"] = int(not same or not lost)
    text = (f"{reports.stamp(head)}.\n\nFigure 15, {' '.join(FIGURE)}, in {PARTS} parts on two nodes of one processor each; "
            f"the node n1 was killed with all that ran on it (jobs {', '.join(lost)}). After {seconds:.0f} s, "
            f"most of them Slurm's, which notices after 20 to 40 and starts the task again two minutes later, the merged picture is {'the same' if same else 'NOT the same'}, in every "
            f"bit, as that of one render on both processors, which took {alone:.0f} s.")
    reports.write("cluster", text)
    print(text)
    return 0 if same and lost else 1


if __name__ == "__main__":
    sys.exit(main())
