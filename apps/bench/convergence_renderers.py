"""Who renders in the convergence report: limn's program, and its peers in processes of their own that stay alive.

Each has a `key`, a `name` for people, `about` (version, settings, seconds of starting), open(scene), which tells the
seconds of loading, and render(size, spp, seed, threads), which returns the picture and what is known of the render. As long as
identity() stays the same, so do its pictures.
"""

import hashlib
import json
import subprocess
import sys
import time

import numpy as np

from machine import ROOT

BIN = ROOT / "build/release/bin"
RAW = ROOT / "build/convergence"
VENV = ROOT / "build/peers"
PEERS = {"mitsuba": "mitsuba", "cycles": "bpy", "luxcore": "pyluxcore"}  # and what they are called on PyPI
WORKER_NEEDS = ("numpy",)  # of peers/*.py, whatever the renderer's own package brings

# An error that is never reached: the given number of samples in the mean, but more where it is noisier.
NEVER = "--error=1e-300"

# What each ingredient gives: every step with the options that leave out what the later ones add.
LADDER = (
    ("limn-naive", "limn, scattering alone", ["--estimator=naive", "--sampler=independent"]),
    ("limn-light", "limn, + lamps sampled, both weighted", ["--sampler=independent"]),
    ("limn-uniform", "limn, + Sobol points", []),
    ("limn", "limn", [NEVER]),
)


class Failed(Exception):
    """A renderer failed."""


def say(text):
    print(f"convergence: {text}", file=sys.stderr, flush=True)


def read_exr(path):
    import OpenImageIO  # Debian's python3-openimageio; not needed to write the report again

    file = OpenImageIO.ImageInput.open(str(path))
    pixels = np.array(file.read_image("float"))[:, :, :3]
    file.close()
    return pixels


class Limn:
    def __init__(self, key, name, options, version):
        self.key, self.name, self.options = key, name, options
        self.about = {"version": version, "settings": " ".join(options) or "as it comes", "seconds": {"start": 0}}

    def identity(self):
        return hashlib.sha256((BIN / "limn_transport").read_bytes()).digest()

    def open(self, scene, _):
        self.scene = scene
        return {"load": 0}

    def render(self, size, spp, seed, threads):
        exr, report = RAW / "limn.exr", RAW / "limn.json"
        run = subprocess.run([BIN / "limn_transport", self.scene, "--quiet", "-o", exr, "--report", report,
                              f"--size={size}x{size}", f"--spp={spp}", f"--seed={seed}", f"--threads={threads}",
                              *self.options], capture_output=True, text=True)
        if run.returncode != 0:
            raise Failed(run.stderr.strip())
        told = json.loads(report.read_text())
        return read_exr(exr), {"render": told["seconds"]["render"], "setup": told["seconds"]["compile"],
                               "spp": told["spp"], "rays": told["rays"], "error": told["error"]}


class Peer:
    def __init__(self, key):
        self.key = key
        self.log = open(RAW / f"{key}.log", "w")
        self.start()

    def start(self):
        begin = time.monotonic()
        self.process = subprocess.Popen([VENV / "bin/python", "-B", ROOT / "apps/bench/peers/worker.py", self.key],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.about = self.answer()
        self.name = self.about["name"]
        self.about["seconds"]["start"] = time.monotonic() - begin

    def answer(self):
        line = self.process.stdout.readline()
        told = json.loads(line) if line else {"error": f"ended with status {self.process.wait()}"}
        if "error" in told:
            raise Failed(f"{told['error']} (see {self.log.name})")
        return told

    def ask(self, **request):
        try:
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            raise Failed(f"ended with status {self.process.wait()} (see {self.log.name})") from None
        return self.answer()

    def identity(self):
        return self.about["version"].encode()

    def open(self, _, description):
        if self.process.poll() is not None:  # the scene before was too much for it
            self.start()
        return self.ask(do="open", scene=str(description))["seconds"]

    def render(self, size, spp, seed, threads):
        out = RAW / f"{self.key}.npy"
        told = self.ask(do="render", size=size, spp=spp, seed=seed, threads=threads, out=str(out))
        return np.load(out), {**told["seconds"], "spp": told["spp"]}

    def close(self):
        self.process.stdin.close()
        self.process.wait()
        self.log.close()


def describe(scene):
    path = RAW / f"{scene}.json"
    subprocess.run([BIN / "limn_transport", scene, "--describe", path], check=True)
    return path


def limn_ladder():
    program = BIN / "limn_transport"
    if not program.exists():
        sys.exit(f"convergence: {program} is not built")
    version = subprocess.run([BIN / "limn", "--version"], capture_output=True, text=True).stdout.strip() or "unknown"
    return [Limn(key, name, options, version) for key, name, options in LADDER]


def install_peers(wanted):
    """Into a virtual environment of their own, each the newest that this Python takes. Returns those that lack, and
    why; nothing here ends the report."""
    missing = {}
    if not (VENV / "bin/python").exists():
        made = subprocess.run([sys.executable, "-m", "venv", VENV], capture_output=True, text=True)
        if made.returncode != 0:
            return {peer: f"no virtual environment: {made.stdout.strip()}" for peer in wanted}
    for peer in wanted:
        package = PEERS[peer]
        run = subprocess.run([VENV / "bin/python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
                              "--only-binary=:all:", package, *WORKER_NEEDS], capture_output=True, text=True)
        if run.returncode != 0:
            missing[peer] = f"pip cannot install {package}: {(run.stderr.strip().splitlines() or ['?'])[-1]}"
    return missing


def start_peers(wanted):
    """Those that can be had, and why the others cannot."""
    started, missing = [], install_peers(wanted)
    for key in wanted:
        if key in missing:
            continue
        try:
            peer = Peer(key)
        except Failed as problem:
            missing[key] = str(problem)
            continue
        say(f"{peer.name} {peer.about['version']}: {peer.about['settings']}")
        started.append(peer)
    for key, why in missing.items():
        say(f"without {key}: {why}")
    return started, missing
