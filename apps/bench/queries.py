"""Measures wrong answers and speeds of limn and of other libraries: queries.py RAYS TIMED MODEL ...

bench.py runs this script in a virtual environment with the libraries. The script judges the answers to RAYS rays of
each kind, takes the time of TIMED rays or points, and prints the results as JSON. A library that fails or isn't
installed has the result null.

All coordinates of meshes and rays are multiples of 2^-GRID. float32 represents them exactly, so that all libraries get
the same numbers and the truth can be computed exactly."""

import importlib
import json
import multiprocessing
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # must be set before numpy is loaded; the products are small

import numpy as np  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/python"))
from meshes import icosphere, voxels  # noqa: E402

GRID = 16
KINDS = ("at random", "at vertices", "along edges", "in planes of faces")
ROUNDS, LONG = 3, 10  # largest number of rounds, of which the fastest counts; seconds after which none begins
# The largest relative error of t, for float32 after some roundings. Only t is judged: a wrong triangle with nearly the
# same t does not count.
TOLERANCE = 1e-4
# The largest numbers of rays or points for slow libraries and queries.
MOST = {"trimesh": 200, "compute_closest_points": 20000, "compute_signed_distance": 20000}
ON_POINTS = ("compute_occupancy", "compute_closest_points", "compute_signed_distance", "contains_points")
OPEN3D = ("cast_rays", "test_occlusions", "list_intersections", "count_intersections", *ON_POINTS[:3])
TRIMESH = ("intersects_first", "intersects_location", "contains_points")
MODULES = {"limn.open3d": "limn.open3d", "open3d": "open3d", "limn.trimesh": "limn.trimesh",
           "embreex": "trimesh.ray.ray_pyembree", "trimesh": "trimesh.ray.ray_triangle"}
QUESTIONS = {library: OPEN3D if library.endswith("open3d") else TRIMESH for library in MODULES}


def floats(whole):
    return (whole * 2.0 ** -GRID).astype(np.float32)


def meshes(models):
    """Returns the meshes by name: vertices as whole numbers of the grid, in the cube from -1 to 1, and faces."""
    # Make a ball and a ring of voxels. They have edges that four faces share, and many faces in the same plane.
    x, y, z = (np.indices((24, 24, 24)) + 0.5) / 12 - 1
    cells = (x * x + y * y + z * z < 0.3) ^ ((np.hypot(x, y) - 0.7) ** 2 + z * z < 0.05)
    found = {"icosphere": icosphere(6), "voxels": voxels(cells)}
    for path in models:
        mesh = importlib.import_module("trimesh").load(path, force="mesh", process=False)
        found[path.stem] = mesh.vertices, mesh.faces
    for name, (vertices, faces) in found.items():
        lower, upper = vertices.min(axis=0), vertices.max(axis=0)
        scaled = (vertices.astype(float) - (lower + upper) / 2) * 2 / (upper - lower).max()
        found[name] = np.rint(scaled * 2 ** GRID).astype(np.int64), faces.astype(np.int64)
    return found


def is_closed(vertices, faces):
    """Returns True if each edge occurs equally often in both directions. Vertices of the same position are the same."""
    _, number = np.unique(vertices, axis=0, return_inverse=True)
    ends = number.reshape(-1)[faces[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2)
    ends = ends[ends[:, 0] != ends[:, 1]]
    code = lambda pairs: np.sort(pairs[:, 0] * len(vertices) + pairs[:, 1])
    return np.array_equal(code(ends), code(ends[:, ::-1]))


def make_rays(kind, vertices, faces, count, seed):
    """Returns (count, 6) whole numbers: origin and direction."""
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    a, b, c = vertices[faces[rng.integers(len(faces), size=count)]].transpose(1, 0, 2)
    if kind in ("at random", "at vertices"):
        start = rng.integers(-3 << (GRID - 1), 3 << (GRID - 1), (count, 3))
        target = rng.integers(-1 << GRID, 1 << GRID, (count, 3)) if kind == "at random" else a
        return np.concatenate([start, target - start], axis=1)
    k = rng.integers(1, 4, (count, 1))
    if kind == "along edges":
        return np.concatenate([a - k * (b - a), b - a], axis=1)
    m, n = rng.integers(-2, 3, (2, count, 1))
    way = np.where((m == 0) & (n == 0), c - a, m * (b - a) + n * (c - a))
    return np.concatenate([a + k * (a - b), way], axis=1)


def meets(triangles, origin, direction):
    """Returns t >= 0 for each triangle that the ray hits, and True for each hit on an edge. Leaves out triangles whose
    plane contains the ray. Only t is rounded: a sum of six products of three numbers below 2^20 is below 2^63."""
    corners = triangles - origin
    assert max(np.abs(corners).max(), np.abs(direction).max()) < 1 << 20
    a, b, c = corners.transpose(1, 0, 2)
    ab = np.cross(a, b)
    # Compute six times the volumes of tetrahedra: of each edge and the direction, and of the triangle and the origin.
    parts = np.stack([np.cross(b, c) @ direction, np.cross(c, a) @ direction, ab @ direction])
    volume, total = (ab * c).sum(axis=1), parts.sum(axis=0)
    met = (total != 0) & ((parts >= 0).all(axis=0) | (parts <= 0).all(axis=0))
    met &= np.sign(volume) * np.sign(total) >= 0
    return volume[met] / total[met], (parts[:, met] == 0).any(axis=0)


def is_inside(triangles, point, rng):
    """Returns 1 inside, 0 outside and -1 on the surface. Counts the hits of the first random ray that hits no edge."""
    while True:
        t, on_edge = meets(triangles, point, rng.integers(-1 << GRID, 1 << GRID, 3))
        if (t == 0).any():
            return -1
        if not on_edge.any():
            return len(t) % 2


def truth(vertices, faces, rays):
    """Returns for each ray t of the nearest hit, or inf, and is_inside of the origin, which is -1 for an open mesh."""
    rng, triangles, closed = np.random.default_rng(1), vertices[faces], is_closed(vertices, faces)
    hits = [meets(triangles, ray[:3], ray[3:])[0] for ray in rays]
    inside = [is_inside(triangles, ray[:3], rng) if closed else -1 for ray in rays]
    return np.array([min(t[t > 0], default=np.inf) for t in hits]), np.array(inside)


def tracer(library, vertices, faces, threads):
    """Returns a function ask(question, *arguments) that calls the library for the mesh."""
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
    """Returns the arguments of a question. Points are the points of the rays at t = 1."""
    if question in ON_POINTS:
        return [rays[:, :3] + rays[:, 3:]]
    return [rays] if library.endswith("open3d") else np.split(rays.astype(float), 2, axis=1)


def answers(library, mesh, rays):
    """Returns for each ray t of the nearest hit, or inf, and the number of hits."""
    ask = tracer(library, *mesh, 0)
    if library.endswith("open3d"):
        return ask("cast_rays", rays)["t_hit"].numpy(), ask("count_intersections", rays).numpy()
    origins, ways = given(library, "intersects_location", rays)
    locations, index, _ = ask("intersects_location", origins, ways)
    t = np.full(len(rays), np.inf)
    t[index] = ((locations - origins[index]) * ways[index]).sum(axis=1) / (ways[index] ** 2).sum(axis=1)
    return t, np.bincount(ask("intersects_id", origins, ways)[1], minlength=len(rays))


def wrong(library, mesh, rays, nearest, inside):
    """Returns two rates of wrong answers, in a million rays: of nearest hits, and of counts whose parity contradicts
    `inside`. The second is None if nothing is known of any origin."""
    t, counts = answers(library, mesh, rays)
    met, known = np.isfinite(nearest), inside >= 0
    with np.errstate(invalid="ignore"):
        bad = (np.isfinite(t) != met) | (met & (np.abs(t - nearest) > TOLERANCE * np.abs(nearest)))
    odd = counts[known].astype(np.int64) % 2
    return [1e6 * float(bad.mean()), 1e6 * float((odd != inside[known]).mean()) if known.any() else None]


def rate(library, mesh, question, threads, rays):
    """Returns million rays or points a second."""
    ask = tracer(library, *mesh, threads)
    ask(question, *given(library, question, rays[:100]))  # some libraries build at the first query
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
        for threads in (1, 0) if library not in ("embreex", "trimesh") else (1,):
            results["rates"][f"{question}, {threads or 'all'}"] = rate(library, mesh, question, threads, timed[:few])
    return results


def main(count, timed, *models):
    results = {}
    for name, (vertices, faces) in meshes(map(Path, models)).items():
        judged = {}
        for kind in KINDS:
            rays = make_rays(kind, vertices, faces, count, 7)
            judged[kind] = floats(rays), *truth(vertices, faces, rays)
        rays = floats(make_rays("at random", vertices, faces, timed, 8))
        found = results[f"{name}, {len(faces):,} triangles"] = dict.fromkeys(QUESTIONS)
        for library in QUESTIONS:
            print(f"bench: queries of {library}", file=sys.stderr, flush=True)
            try:  # run in a new process, so that a crash ends only that process
                with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
                    found[library] = pool.submit(measure, library, (floats(vertices), faces), judged, rays).result()
            except Exception as problem:
                print(f"bench: {library}: {problem}", file=sys.stderr, flush=True)
    print(json.dumps(results))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]), *sys.argv[3:])
