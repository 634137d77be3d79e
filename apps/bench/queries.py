"""queries.py RAYS TIMED MODEL ...: wrong answers and speeds of limn and of other libraries, as JSON.

Is run by bench.py in an environment with these libraries. Judges the answers to RAYS rays of each kind. Takes the time
of TIMED rays or points. A library that fails or isn't installed has null."""

import importlib
import json
import multiprocessing
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded: its products here are small

import numpy as np  # noqa: E402

from query_truth import KINDS, floats, make_rays, meshes, truth  # noqa: E402

ROUNDS, LONG = 3, 10  # the least of some rounds, of which none begins after so many seconds
TOLERANCE = 1e-4  # of t: float32 after some roundings; a wrong triangle is much farther away
# The most rays or points of slow libraries and questions.
MOST = {"trimesh": 200, "compute_closest_points": 20000, "compute_signed_distance": 20000}
ON_POINTS = ("compute_occupancy", "compute_closest_points", "compute_signed_distance", "contains_points")
OPEN3D = ("cast_rays", "test_occlusions", "list_intersections", "count_intersections", *ON_POINTS[:3])
TRIMESH = ("intersects_first", "intersects_location", "contains_points")
MODULES = {"limn.open3d": "limn.open3d", "open3d": "open3d", "limn.trimesh": "limn.trimesh",
           "embreex": "trimesh.ray.ray_pyembree", "trimesh": "trimesh.ray.ray_triangle"}
QUESTIONS = {library: OPEN3D if library.endswith("open3d") else TRIMESH for library in MODULES}
THREADED = ("limn.open3d", "open3d", "limn.trimesh")


def tracer(library, vertices, faces, threads):
    """Returns a function that answers a question."""
    module = importlib.import_module(MODULES[library])
    if library.endswith("open3d"):
        scene = module.t.geometry.RaycastingScene(threads)
        scene.add_triangles(vertices, faces.astype(np.uint32))
        return lambda question, *given: getattr(scene, question)(*given, nthreads=threads)
    mesh = importlib.import_module("trimesh").Trimesh(vertices.astype(float), faces, process=False)
    scene = module.RayMeshIntersector(mesh, **({"threads": threads} if library == "limn.trimesh" else {}))
    once = {"intersects_location": {"multiple_hits": False}}
    return lambda question, *given: getattr(scene, question)(*given, **once.get(question, {}))


def given(library, question, rays):
    """Returns the arguments of a question. Points are those that the rays aim at."""
    if question in ON_POINTS:
        return [rays[:, :3] + rays[:, 3:]]
    return [rays] if library.endswith("open3d") else np.split(rays.astype(float), 2, axis=1)


def answers(library, mesh, rays):
    """Returns t of the nearest hits, inf for none, and counts of hits."""
    ask = tracer(library, *mesh, 0)
    if library.endswith("open3d"):
        return ask("cast_rays", rays)["t_hit"].numpy(), ask("count_intersections", rays).numpy()
    origins, ways = given(library, "intersects_location", rays)
    locations, index, _ = ask("intersects_location", origins, ways)
    t = np.full(len(rays), np.inf)
    t[index] = ((locations - origins[index]) * ways[index]).sum(axis=1) / (ways[index] ** 2).sum(axis=1)
    return t, np.bincount(ask("intersects_id", origins, ways)[1], minlength=len(rays))


def wrong(library, mesh, rays, nearest, inside):
    """Returns wrong answers a million: of nearest hits, and of counts whose parity contradicts `inside`, which is null
    if no origin has a truth."""
    t, counts = answers(library, mesh, rays)
    met, known = np.isfinite(nearest), inside >= 0
    with np.errstate(invalid="ignore"):
        bad = (np.isfinite(t) != met) | (met & (np.abs(t - nearest) > TOLERANCE * np.abs(nearest)))
    odd = counts[known].astype(np.int64) % 2
    return [1e6 * float(bad.mean()), 1e6 * float((odd != inside[known]).mean()) if known.any() else None]


def rate(library, mesh, question, threads, rays):
    """Returns million rays or points a second."""
    ask = tracer(library, *mesh, threads)
    ask(question, *given(library, question, rays[:100]))  # so that what is built on demand is built
    arguments, seconds, started = given(library, question, rays), [], time.perf_counter()
    while len(seconds) < ROUNDS and time.perf_counter() - started < LONG:
        begin = time.perf_counter()
        ask(question, *arguments)
        seconds.append(time.perf_counter() - begin)
    return len(rays) / min(seconds) / 1e6


def measure(library, mesh, judged, timed):
    results = {"wrong": {}, "rates": {}}
    for kind, parts in judged.items():
        results["wrong"][kind] = wrong(library, mesh, *(part[:MOST.get(library)] for part in parts))
    for question in QUESTIONS[library]:
        few = min(MOST.get(key, len(timed)) for key in (library, question))
        for threads in (1, 0) if library in THREADED else (1,):
            results["rates"][f"{question}, {threads or 'all'}"] = rate(library, mesh, question, threads, timed[:few])
    return results


def apart(library, *arguments):
    """Measures in a process of its own. Returns None if that fails."""
    print(f"bench: queries of {library}", file=sys.stderr, flush=True)
    try:
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
            return pool.submit(measure, library, *arguments).result()
    except Exception as problem:
        print(f"bench: {library}: {problem}", file=sys.stderr, flush=True)
        return None


def main(count, timed, *models):
    results = {}
    for name, (vertices, faces) in meshes(map(Path, models)).items():
        judged = {}
        for kind in KINDS:
            rays = make_rays(kind, vertices, faces, count, 7)
            judged[kind] = floats(rays), *truth(vertices, faces, rays)
        rays = floats(make_rays("at random", vertices, faces, timed, 8))
        results[f"{name}, {len(faces):,} triangles"] = {
            library: apart(library, (floats(vertices), faces), judged, rays) for library in QUESTIONS}
    print(json.dumps(results))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]), *sys.argv[3:])
