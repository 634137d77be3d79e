#!/usr/bin/env python3
"""queries.py [--full] [MODEL.obj ...]: wrong answers and rays a second of limn, embreex, Open3D, trimesh and CGAL on the same rays.

Writes the table of docs/queries.md. The libraries come from PyPI into build/query-peers and run in processes of their own,
CGAL in a program that is built here; one that cannot be had is named as missing. What has been measured is kept in
build/queries until the sources change, so that an interrupted run goes on where it was.
"""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded: its products here are small

import numpy as np  # noqa: E402

import queries_rays  # noqa: E402
import reports  # noqa: E402
from machine import ROOT  # noqa: E402

RAW = ROOT / "build/queries"
VENV = ROOT / "build/query-peers"
PEERS = ROOT / "apps/bench/peers"
PACKAGES = ("open3d", "trimesh", "embreex", "rtree", "scipy")
NAMES = {"limn": "limn", "embreex": "embreex (through trimesh)", "open3d": "Open3D", "trimesh": "trimesh's own",
         "cgal": "CGAL, exact predicates"}
FEW, MANY = 200, 2000  # rays of each kind; --full: many
MOST = {"trimesh": 200}  # that are asked of one
TIMED = {"trimesh": 200, "cgal": 20000}  # 1,000,000 by default
TOLERANCE = 1e-4  # of t: float32 after some roundings; a wrong triangle is much farther


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
    if problem := run("g++", "-O3", "-DNDEBUG", "-std=c++17", PEERS / "cgal_queries.cpp", "-o", RAW / "cgal_queries", "-lgmp",
                      "-lmpfr"):
        missing["cgal"] = problem
    return {library: reason for library, reason in missing.items() if library in NAMES}


def floats(whole):
    """Whole numbers of the grid as float32, which holds them exactly."""
    values = (whole * 2.0 ** -queries_rays.GRID).astype(np.float32)
    assert (values * 2.0 ** queries_rays.GRID == whole).all()
    return values


def ask(library, threads, vertices, faces, rays, timed=False):
    """What a library answers; None if it fails."""
    given = {"vertices": floats(vertices), "faces": faces.astype(np.uint32), "rays": floats(rays)}
    source, target = RAW / "input.npz", RAW / "output.npz"
    target.unlink(missing_ok=True)
    if library == "cgal":
        sizes = np.array([len(vertices), len(faces), len(rays)], np.uint64)
        (RAW / "input.bin").write_bytes(b"".join(array.tobytes() for array in (sizes, *given.values())))
        problem = run(RAW / "cgal_queries", RAW / "input.bin", RAW / "output.bin")
        if not problem:
            raw = (RAW / "output.bin").read_bytes()
            rows = np.frombuffer(raw[8:], [("t", "f8"), ("counts", "u8")])
            return {"seconds": np.frombuffer(raw[:8])[0], "t": rows["t"], "counts": rows["counts"]}
    else:
        np.savez(source, **given, **({"timed": True} if timed else {}))
        problem = run(VENV / "bin/python", "-B", PEERS / "query_worker.py", library, threads, source, target)
        if not problem:
            return dict(np.load(target))
    say(f"{library} failed: {problem}")
    return None


def wrong(answer, nearest, inside):
    """Wrong answers a million: of nearest hits, and of counts whose parity does not tell inside; None: no truth."""
    met = np.isfinite(nearest)
    t = np.asarray(answer["t"], float)
    with np.errstate(invalid="ignore"):
        bad = (np.isfinite(t) != met) | (met & (np.abs(t - nearest) > TOLERANCE * np.abs(nearest)))
    known = inside >= 0
    odd = np.asarray(answer["counts"])[known].astype(np.int64) % 2
    return [1e6 * bad.mean(), 1e6 * (odd != inside[known]).mean() if known.any() else None]


class Measured:
    def __init__(self, models, missing, count):
        self.count = count
        key = hashlib.sha256(b"".join(path.read_bytes() for path in models)).hexdigest()
        self.kept = reports.Kept(RAW / "kept.json", sources=reports.digest(reports.report_of("queries").sources), models=key, count=count)
        self.meshes, self.libraries = queries_rays.meshes(models), [name for name in NAMES if name not in missing]

    def truth(self, name, vertices, faces, kind, rays):
        say(f"{name}, {kind}: exact")
        measure = lambda: [part.tolist() for part in queries_rays.truth(vertices, faces, rays,
                                                                        queries_rays.is_closed(vertices, faces))]
        return [np.array(part) for part in self.kept(f"truth {name} {kind}", measure)]

    def wrong(self, name, vertices, faces, kind):
        """For each library what `wrong` says."""
        rays = queries_rays.make_rays(kind, vertices, faces, self.count, 7)
        nearest, inside = self.truth(name, vertices, faces, kind, rays)
        found = {}
        for library in self.libraries:
            count = min(MOST.get(library, len(rays)), len(rays))

            def measure():
                answer = ask(library, 0, vertices, faces, rays[:count])
                return answer and wrong(answer, nearest[:count], inside[:count])

            found[library] = self.kept(f"wrong {library} {name} {kind}", measure, bool)
        return found

    def speed(self, library, threads):
        """Million random rays a second, of the nearest hit on the last mesh; None where there is no such number."""
        if threads != 1 and library not in ("limn", "open3d"):
            return None
        name, vertices, faces = self.meshes[-1]
        say(f"{name}, speed of {library}, {threads or 'all'} threads")
        rays = queries_rays.make_rays("random", vertices, faces, TIMED.get(library, 1000000), 8)
        measure = lambda: (lambda a: a and len(rays) / float(a["seconds"]) / 1e6)(ask(library, threads, vertices, faces, rays,
                                                                                      timed=True))
        return self.kept(f"speed {library} {name} {threads}", measure, bool)


def cell(values):
    if values is None:
        return "failed"
    return " / ".join("–" if value is None else f"{value:,.0f}" for value in values)


def table(measured, missing):
    lines = ["| rays | " + " | ".join(NAMES[library] for library in measured.libraries) + " |",
             "|---" * (1 + len(measured.libraries)) + "|"]
    for name, vertices, faces in measured.meshes:
        for kind, words in queries_rays.KINDS.items():
            found = measured.wrong(name, vertices, faces, kind)
            lines.append(f"| {name}, {words} | " + " | ".join(cell(found[one]) for one in measured.libraries) + " |")
    last = measured.meshes[-1][0]
    for threads, words in ((1, "one thread"), (0, "all threads")):
        speeds = [measured.speed(one, threads) for one in measured.libraries]
        lines.append(f"| **million rays a second**, {last}, {words} | " +
                     " | ".join("–" if one is None else f"{one:.2g}" for one in speeds) + " |")
    lines += ["", "Missing: " + "; ".join(f"{one} ({why})" for one, why in missing.items())] if missing else []
    return "\n".join(lines)


def main(arguments):
    RAW.mkdir(parents=True, exist_ok=True)
    head = reports.origin("queries")
    missing = install()
    models = [Path(argument) for argument in arguments if argument != "--full"]
    measured = Measured(models, missing, MANY if "--full" in arguments else FEW)
    text = table(measured, missing)
    sizes = ", ".join(f"{name} {len(faces):,}" for name, _, faces in measured.meshes)
    reports.write("queries", f"{reports.stamp(head)}. Triangles: {sizes}; {measured.count} rays of each kind.\n\n{text}")
    measured.kept.forget()


if __name__ == "__main__":
    main(sys.argv[1:])
