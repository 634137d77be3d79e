#!/usr/bin/env python3
"""queries.py [--full] [MODEL.obj ...]: wrong answers and speeds of limn, embreex, Open3D, trimesh and CGAL.

Writes the tables of docs/queries.md, of meshes that are made here and of the models, all on the same rays. The
libraries come from PyPI into build/query-peers and run in processes of their own, CGAL in a program that is built here;
one that cannot be had is named as missing. What has been measured is kept in build/queries until the sources change, so
that an interrupted run goes on where it was.
"""

import hashlib
import sys
from pathlib import Path

import queries_peers as peers  # first: it tells numpy's library about threads

import numpy as np

import queries_rays
import queries_tables as tables
import reports

FEW, MANY = 200, 2000  # rays of each kind; --full: many
MOST = {"trimesh": 200}  # that are asked of one
TIMED, TIMED_TRIMESH, TIMED_CPP = 1000000, 200, 200000  # rays: from Python, of trimesh's own, in C++
TOLERANCE = 1e-4  # of t: float32 after some roundings; a wrong triangle is much farther


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
        self.count, self.missing = count, missing
        key = hashlib.sha256(b"".join(path.read_bytes() for path in models)).hexdigest()
        self.kept = reports.Kept(peers.RAW / "kept.json", sources=reports.digest(reports.report_of("queries").sources),
                                 models=key, count=count)
        self.meshes = queries_rays.meshes(models)
        self.timed = self.meshes[[name for name, _, _ in self.meshes].index(queries_rays.KNOT):]
        self.libraries = [name for name in tables.NAMES if name not in missing]

    def truth(self, name, vertices, faces, kind, rays):
        peers.say(f"{name}, {kind}: exact")
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
                answer = peers.ask(library, 0, vertices, faces, rays[:count])
                return answer and wrong(answer, nearest[:count], inside[:count])

            found[library] = self.kept(f"wrong {library} {name} {kind}", measure, bool)
        return found

    def rate(self, question, library, threads, mesh):
        """Million random rays, or points, a second from Python; None where there is no such number."""
        if library in self.missing:
            return None
        name, vertices, faces = mesh
        peers.say(f"{name}, {question} of {library}, {threads or 'all'} threads")
        rays = queries_rays.make_rays("random", vertices, faces, TIMED_TRIMESH if library == "trimesh" else TIMED, 8)
        if question == "contains":
            rays[:, :3] += rays[:, 3:]  # what the rays aim at lies in the mesh's cube

        def measure():
            answer = peers.ask(library, threads, vertices, faces, rays, question)
            return answer and len(rays) / float(answer["seconds"]) / 1e6

        return self.kept(f"rate {question} {library} {name} {threads}", measure, bool)

    def rates(self, mesh):
        """By question, library and threads."""
        asked = {(pair.question, library, tables.threads_of(library, threads)) for pair in tables.PAIRS
                 for library in (pair.ours, pair.theirs) for threads in tables.THREADS}
        return {key: self.rate(*key, mesh) for key in sorted(asked)}

    def in_cpp(self, mesh):
        """What limn_query_rates says of rays, and CGAL's seconds for the same."""
        name, vertices, faces = mesh
        peers.say(f"{name}, C++")
        rays = queries_rays.make_rays("random", vertices, faces, TIMED_CPP, 8)
        limn = self.kept(f"C++ limn {name}", lambda: peers.limn_rates("rays", vertices, faces, rays))
        if "cgal" in self.missing:
            return limn, None

        def measure():
            answers = [peers.ask("cgal", 1, vertices, faces, rays) for _ in range(3)]
            return min(float(answer["seconds"]) for answer in answers) if all(answers) else None

        return limn, self.kept(f"C++ cgal {name}", measure, bool)

    def moved(self, mesh):
        """Seconds of recompile."""
        name, vertices, faces = mesh
        peers.say(f"{name}, moved instances")
        measure = lambda: peers.limn_rates("move", vertices, faces, np.zeros((0, 6)))
        return self.kept(f"moved {name}", measure)["recompile"]


def wrong_answers(measured):
    rows = [(f"{name}, {words}", measured.wrong(name, vertices, faces, kind))
            for name, vertices, faces in measured.meshes for kind, words in queries_rays.KINDS.items()]
    return tables.wrong_answers(measured.libraries, rows)


def speeds(measured):
    rates, times = [], []
    for mesh in measured.timed:
        limn, cgal = measured.in_cpp(mesh)
        rates += tables.python_rows(mesh[0], measured.rates(mesh)) + tables.cpp_rows(mesh[0], limn, cgal)
        times += tables.one_hit_rows(mesh[0], limn) + [tables.move_row(mesh[0], measured.moved(mesh))]
    return tables.speeds(rates, times)


def main(arguments):
    peers.RAW.mkdir(parents=True, exist_ok=True)
    head = reports.origin("queries")
    missing = peers.install()
    models = [Path(argument) for argument in arguments if argument != "--full"]
    measured = Measured(models, missing, MANY if "--full" in arguments else FEW)
    sizes = ", ".join(f"{name} {len(faces):,}" for name, _, faces in measured.meshes)
    parts = [f"{reports.stamp(head)}. Triangles: {sizes}; {measured.count} rays of each kind.", wrong_answers(measured),
             speeds(measured)]
    parts += ["Missing: " + "; ".join(f"{one} ({why})" for one, why in missing.items())] if missing else []
    reports.write("queries", "\n\n".join(parts))
    measured.kept.forget()


if __name__ == "__main__":
    main(sys.argv[1:])
