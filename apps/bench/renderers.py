"""Who renders in `./build.sh convergence`: limn's program, and its peers in processes of their own.

Each has a `key`. open(scene) makes it ready and returns its name, version and settings. render(size, spp, seed, threads)
returns the picture, its seconds and the samples a pixel that it has.
"""

import json
import multiprocessing
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO

from results import BIN, ROOT

SCENES = ("cornell-empty", "cornell", "lamps", "three-spheres", "depth-of-field", "still-spheres", "smoke", "mesh",
          "glass-mesh", "many-lights", "rough-copper", "rough-glass", "still-life", "window")
SCENES_OF_LIMN = ("bouncing", "glass", "fireflies")  # no peer can express them
PROGRAM = BIN / "limn_transport"
VENV = ROOT / "build/peers"
PEERS = {"mitsuba": "mitsuba", "cycles": "bpy"}  # and their packages on PyPI
UNIFORM = "uniform"  # limn with the same number of samples in every pixel


class Failed(Exception):
    """A renderer failed."""


def checked(*command):
    """Runs a command and returns what it prints. Raises Failed with its last message."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed((done.stderr.strip() or done.stdout.strip() or str(done.returncode)).splitlines()[-1])
    return done.stdout


def limn(scene, size, *options):
    """Renders with limn. Returns the picture and the report."""
    with tempfile.TemporaryDirectory() as folder:
        exr, report = Path(folder) / "a.exr", Path(folder) / "a.json"
        checked(PROGRAM, scene, "--quiet", f"--size={size}x{size}", *options, "-o", exr, "--report", report)
        file = OpenImageIO.ImageInput.open(str(exr))
        picture = np.array(file.read_image("float"), dtype=np.float64)[:, :, :3]
        file.close()
        return picture, json.loads(report.read_text())


class Limn:
    def __init__(self, key):
        # An error that is never reached: the given number of samples on average, but more where a pixel is noisier.
        self.key, self.options = key, [] if key == UNIFORM else ["--error=1e-300"]

    def open(self, scene):
        self.scene = scene
        return " ".join([checked(BIN / "limn", "--version").strip(), *self.options])

    def render(self, size, spp, seed, threads):
        picture, report = limn(self.scene, size, f"--spp={spp}", f"--seed={seed}", f"--threads={threads}", *self.options)
        return picture, report["seconds"]["render"], report["spp"]

    def close(self):
        pass


class Peer:
    """Runs peers/worker.py, in the environment of the peers. A new process for each scene."""

    def __init__(self, key):
        self.key, self.process = key, None
        checked(sys.executable, "-m", "venv", VENV)
        checked(VENV / "bin/python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
                "--only-binary=:all:", PEERS[key], "numpy")

    def open(self, scene):
        self.close()
        self.pipe, theirs = multiprocessing.Pipe()
        with open(VENV / f"{self.key}.log", "w") as log:
            self.process = subprocess.Popen(
                [VENV / "bin/python", "-B", ROOT / "apps/bench/peers/worker.py", self.key, str(theirs.fileno())],
                pass_fds=[theirs.fileno()], stdout=log, stderr=log)
        theirs.close()
        return self.ask("open", checked(PROGRAM, scene, "--describe"))

    def ask(self, *request):
        try:
            self.pipe.send(request)
            fine, answer = self.pipe.recv()
        except (EOFError, OSError):
            fine, answer = False, f"ended with status {self.process.wait()}"
        if not fine:
            raise Failed(f"{answer} (see build/peers/{self.key}.log)")
        return answer

    def render(self, size, spp, seed, threads):
        picture, seconds, taken = self.ask("render", size, spp, seed, threads)
        return np.frombuffer(picture).reshape(size, size, 3), seconds, taken

    def close(self):
        if self.process:
            self.pipe.close()
            self.process.wait()
