"""The renderers of `./build.sh convergence`: limn's program, and its peers, which run in other processes.

A renderer is a class with three members. `key` is its short name. open(scene) prepares it for a scene and returns its
name, version and settings. render(picture, size, spp, seed, threads) writes an EXR file and returns the seconds of
rendering and the mean samples of a pixel."""

import json
import multiprocessing
import subprocess
import sys

from results import BIN, ROOT

SCENES = ("cornell-empty", "cornell", "lamps", "three-spheres", "depth-of-field", "still-spheres", "smoke", "mesh",
          "glass-mesh", "many-lights", "rough-copper", "rough-glass", "still-life", "window")
SCENES_OF_LIMN = ("bouncing", "glass", "fireflies")  # scenes that no peer can express
PROGRAM = BIN / "limn_transport"
VENV = ROOT / "build/peers"
PEERS = {"mitsuba": "mitsuba", "cycles": "bpy", "luxcore": "pyluxcore"}  # package on PyPI by key
UNIFORM = "uniform"  # the key of limn with the same number of samples in every pixel


class Failed(Exception):
    """A renderer failed."""


def checked(*command):
    """Runs a command and returns what it prints. Raises Failed with its last message."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed((done.stderr.strip() or done.stdout.strip() or str(done.returncode)).splitlines()[-1])
    return done.stdout


def limn(scene, picture, size, *options):
    return json.loads(checked(PROGRAM, scene, "--quiet", f"--size={size}x{size}", *options, "-o", picture,
                              "--report", "-"))


def compare(*pictures):
    """Compares a picture with a reference, or with the two halves of one. Returns what `limn compare` prints."""
    return json.loads(checked(BIN / "limn", "compare", *pictures, "--json", "-"))


class Limn:
    """limn, with adaptive or uniform sampling."""

    def __init__(self, key):
        # An error that is never reached makes limn sample adaptively up to the given mean number of samples.
        self.key, self.options = key, [] if key == UNIFORM else ["--error=1e-300"]

    def open(self, scene):
        self.scene = scene
        return " ".join([checked(BIN / "limn", "--version").strip(), *self.options])

    def render(self, path, size, spp, seed, threads):
        report = limn(self.scene, path, size, f"--spp={spp}", f"--seed={seed}", f"--threads={threads}", *self.options)
        return report["seconds"]["render"], report["spp"]


class Peer:
    """A peer. It runs peers/worker.py in the virtual environment of the peers, one process for each scene."""

    def __init__(self, key):
        self.key = key
        checked(sys.executable, "-m", "venv", VENV)
        checked(VENV / "bin/python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
                "--only-binary=:all:", PEERS[key], "numpy")

    def open(self, scene):
        self.pipe, theirs = multiprocessing.Pipe()  # closing the old pipe ends its worker
        worker = [VENV / "bin/python", "-B", ROOT / "apps/bench/peers/worker.py", self.key, str(theirs.fileno())]
        with open(VENV / f"{self.key}.log", "w") as log:
            subprocess.Popen(worker, pass_fds=[theirs.fileno()], stdout=log, stderr=log)
        theirs.close()
        return self.ask(checked(PROGRAM, scene, "--describe"))

    def ask(self, request):
        """Sends a request to the worker and returns the result. Raises Failed if it fails or crashes."""
        try:
            self.pipe.send(request)
            fine, answer = self.pipe.recv()
        except (EOFError, OSError):
            fine, answer = False, "it crashed"
        if not fine:
            raise Failed(f"{self.key}: {answer} (see build/peers/{self.key}.log)")
        return answer

    def render(self, picture, *arguments):
        return self.ask((str(picture), *arguments))
