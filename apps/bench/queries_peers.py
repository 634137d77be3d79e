"""The libraries that the report on queries asks, in processes of their own, and the programs that measure C++."""

import json
import os
import subprocess
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded: its products here are small

import numpy as np  # noqa: E402

import queries_rays  # noqa: E402
from machine import ROOT  # noqa: E402
from queries_tables import NAMES  # noqa: E402

RAW = ROOT / "build/queries"
VENV = ROOT / "build/query-peers"
PEERS = ROOT / "apps/bench/peers"
RATES = ROOT / "build/release/bin/limn_query_rates"
PACKAGES = ("open3d", "trimesh", "embreex", "rtree", "scipy")


def say(text):
    print(f"queries: {text}", file=sys.stderr, flush=True)


def run(*command):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    return "" if done.returncode == 0 else (done.stderr.strip().splitlines() or ["no message"])[-1]


def install():
    """Installs what there is; why the others are missing. limn itself must be there."""
    if problem := run(sys.executable, "-m", "venv", VENV):
        sys.exit(f"queries: {problem}")
    pip = [VENV / "bin/python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    say("builds limn's wheel")
    for command in (("cmake", "--install", ROOT / "build/release", "--prefix", RAW / "limn"),
                    (*pip, "--force-reinstall", "--no-deps", f"--config-settings=build-dir={RAW}/wheel",
                     "--config-settings=cmake.define.LIMN_INSTALLED=ON",
                     f"--config-settings=cmake.define.CMAKE_PREFIX_PATH={RAW}/limn", ROOT)):
        if problem := run(*command):
            sys.exit(f"queries: {problem}")
    missing = {}
    for package in ("numpy", *PACKAGES):
        if problem := run(*pip, package):
            missing[package] = problem
    say("builds CGAL's program")
    if problem := run("g++", "-O3", "-DNDEBUG", "-std=c++17", PEERS / "cgal_queries.cpp", "-o", RAW / "cgal_queries",
                      "-lgmp", "-lmpfr"):
        missing["cgal"] = problem
    return {library: reason for library, reason in missing.items() if library in NAMES}


def floats(whole):
    """Whole numbers of the grid as float32, which holds them exactly."""
    values = (whole * 2.0 ** -queries_rays.GRID).astype(np.float32)
    assert (values * 2.0 ** queries_rays.GRID == whole).all()
    return values


def write_input(vertices, faces, rays):
    """What the programs read."""
    sizes = np.array([len(vertices), len(faces), len(rays)], np.uint64)
    parts = (sizes, floats(vertices), faces.astype(np.uint32), floats(rays))
    (RAW / "input.bin").write_bytes(b"".join(part.tobytes() for part in parts))


def ask_cgal(vertices, faces, rays):
    write_input(vertices, faces, rays)
    if problem := run(RAW / "cgal_queries", RAW / "input.bin", RAW / "output.bin"):
        say(f"cgal failed: {problem}")
        return None
    raw = (RAW / "output.bin").read_bytes()
    rows = np.frombuffer(raw[8:], [("t", "f8"), ("counts", "u8")])
    return {"seconds": np.frombuffer(raw[:8])[0], "t": rows["t"], "counts": rows["counts"]}


def ask(library, threads, vertices, faces, rays, timed=None):
    """What a library answers, or the seconds of the method `timed` of query_worker.py; None if it fails."""
    if library == "cgal":
        return ask_cgal(vertices, faces, rays)
    source, target = RAW / "input.npz", RAW / "output.npz"
    target.unlink(missing_ok=True)
    np.savez(source, vertices=floats(vertices), faces=faces.astype(np.uint32), rays=floats(rays),
             **({"timed": timed} if timed else {}))
    if problem := run(VENV / "bin/python", "-B", PEERS / "query_worker.py", library, threads, source, target):
        say(f"{library} failed: {problem}")
        return None
    return dict(np.load(target))


def limn_rates(mode, vertices, faces, rays):
    """What limn_query_rates prints. limn itself must not fail."""
    write_input(vertices, faces, rays)
    done = subprocess.run([RATES, mode, RAW / "input.bin"], stdout=subprocess.PIPE, check=True, text=True)
    return json.loads(done.stdout)
