"""A picture by a Slurm of two nodes on this machine, one of which is lost on the way. Needs root.

Starts slurmctld and two slurmd, submits examples/cluster/slurm.sh, kills a node with all that runs there, waits for the
merge, and compares the picture with that of one render, bit for bit. The logs are kept in build/results/cluster.
"""

import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

from faults import pixels
from results import BIN, RESULTS, ROOT

RENDER = [str(BIN / "fig15_cornell_box"), "--size", "160x160", "--spp", "1536"]
PARTS = "6"
NODES = {"n1": 17001, "n2": 17002}  # and their ports


def configuration(folder):
    host = socket.gethostname()
    nodes = [f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1" for name, port in
             NODES.items()]
    return "\n".join([
        "ClusterName=limn", f"SlurmctldHost={host}(127.0.0.1)", "SlurmctldPort=16817", "SlurmUser=root",
        "SlurmdUser=root", "AuthType=auth/none", "CredType=cred/none", "ProctrackType=proctrack/linuxproc",
        "TaskPlugin=task/none", "JobAcctGatherType=jobacct_gather/none", "MpiDefault=none", "ReturnToService=2",
        "SlurmdTimeout=20", "SelectType=select/cons_tres", "SelectTypeParameters=CR_Core",
        f"StateSaveLocation={folder}", f"SlurmdSpoolDir={folder}/spool-%n",
        f"SlurmctldPidFile={folder}/slurmctld.pid", f"SlurmdPidFile={folder}/slurmd-%n.pid", *nodes,
        "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n"])


def output(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout.strip()


def wait_for(condition, seconds, what):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise RuntimeError(f"cluster: waited {seconds} s for {what}; see build/results/cluster")
        time.sleep(0.2)


@contextmanager
def slurm(folder):
    """The daemons, by name, as long as the `with` lasts."""
    (folder / "slurm.conf").write_text(configuration(folder))
    os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
    commands = {"slurmctld": ["slurmctld", "-D"], **{node: ["slurmd", "-D", "-N", node] for node in NODES}}
    daemons = {}
    try:
        for name, command in commands.items():
            with open(folder / f"{name}.log", "w") as log:
                daemons[name] = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        wait_for(lambda: output("sinfo", "-h", "-t", "idle", "-o", "%D") == str(len(NODES)), 60, "the nodes")
        yield daemons
    finally:
        output("scancel", "--user", "root")
        for daemon in daemons.values():
            daemon.terminate()
            daemon.wait()
        for log in folder.glob("*.log"):
            shutil.copy(log, RESULTS / "cluster")


def kill(node, daemon):
    """What a power cut does: the daemon, the daemons of its steps and what they run end at once."""
    jobs = output("squeue", "-h", "-w", node, "-o", "%A").split()
    daemon.kill()
    for process in Path("/proc").glob("[0-9]*"):
        try:
            title, variables = ((process / name).read_bytes().decode(errors="replace")
                                for name in ("cmdline", "environ"))
        except OSError:
            continue
        if (any(title.startswith(f"slurmstepd: [{job}.") for job in jobs)
                or f"SLURMD_NODENAME={node}" in variables.split("\0")):
            os.kill(int(process.name), signal.SIGKILL)
    return jobs


def measure():
    """Yields what was tried, how often, how often it went wrong, and what happened."""
    (RESULTS / "cluster").mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="limn-slurm-") as name:
        folder = Path(name)
        subprocess.run([*RENDER, "--quiet", "-o", "one.exr"], cwd=folder, check=True)
        with slurm(folder) as daemons:
            begin = time.monotonic()
            os.environ.update(LIMN=str(BIN / "limn"), EVERY="0.5")
            script = [ROOT / "examples/cluster/slurm.sh", PARTS, "cluster.exr", *RENDER, "--threads", "1"]
            merge = subprocess.run(script, cwd=folder, capture_output=True, text=True, check=True).stdout.strip()

            def part():
                return output("squeue", "-h", "-w", "n1", "-t", "running", "-o", "%K")

            wait_for(lambda: part() and (folder / f"cluster-{part()}.film").exists(), 60, "a checkpoint on n1")
            jobs = kill("n1", daemons["n1"])
            wait_for(lambda: not output("squeue", "-h", "-j", merge), 600, "the merge")
            seconds = time.monotonic() - begin
        picture = folder / "cluster.exr"
        same = picture.exists() and pixels(picture) == pixels(folder / "one.exr")
    said = f"the same picture after {seconds:.0f} s, most of them Slurm's; lost were jobs {' '.join(jobs)}"
    yield [f"a node of two is lost, figure 15 in {PARTS} parts", 1, int(not same or not jobs), said]
