"""Meshes, rays that are hard on them, and what is true of these in exact arithmetic.

All coordinates are whole multiples of 2^-GRID, so that float32 holds the meshes and the rays exactly and all libraries
get the same ones."""

import importlib
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/python"))
from meshes import icosphere, voxels  # noqa: E402

GRID = 16
KINDS = ("at random", "at vertices", "along edges", "in planes of faces")


def floats(whole):
    """Returns whole numbers of the grid as float32."""
    return (whole * 2.0 ** -GRID).astype(np.float32)


def read_model(path):
    mesh = importlib.import_module("trimesh").load(path, force="mesh", process=False)
    return mesh.vertices, mesh.faces


def ball_and_ring():
    """Cells of a grid: edges that four faces share, and rays in the planes of many."""
    x, y, z = (np.indices((24, 24, 24)) + 0.5) / 12 - 1
    return voxels((x * x + y * y + z * z < 0.3) ^ ((np.hypot(x, y) - 0.7) ** 2 + z * z < 0.05))


def meshes(models):
    """Returns vertices as whole numbers, in the cube from -1 to 1, and faces, by name."""
    found = {"icosphere": icosphere(6), "voxels": ball_and_ring()} | {path.stem: read_model(path) for path in models}
    for name, (vertices, faces) in found.items():
        lower, upper = vertices.min(axis=0), vertices.max(axis=0)
        scaled = (vertices.astype(float) - (lower + upper) / 2) * 2 / (upper - lower).max()
        found[name] = np.rint(scaled * 2 ** GRID).astype(np.int64), faces.astype(np.int64)
    return found


def is_closed(vertices, faces):
    """Returns whether each edge, by its positions, is used as often one way as the other."""
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
    """Returns t >= 0 of each triangle that the ray meets, and whether that is on an edge. Triangles in whose plane the
    ray lies are left out. Only t is rounded: products of three numbers below 2^20 have sums of six below 2^63."""
    corners = triangles - origin
    assert max(np.abs(corners).max(), np.abs(direction).max()) < 1 << 20
    a, b, c = corners.transpose(1, 0, 2)
    ab = np.cross(a, b)
    # Six times the signed volumes of the direction with each edge, and of the triangle with the origin.
    parts = np.stack([np.cross(b, c) @ direction, np.cross(c, a) @ direction, ab @ direction])
    volume, total = (ab * c).sum(axis=1), parts.sum(axis=0)
    met = (total != 0) & ((parts >= 0).all(axis=0) | (parts <= 0).all(axis=0))
    met &= np.sign(volume) * np.sign(total) >= 0
    return volume[met] / total[met], (parts[:, met] == 0).any(axis=0)


def is_inside(triangles, point, rng):
    """Returns the parity along a ray that meets no edge, or -1 for a point on the surface."""
    while True:
        t, on_edge = meets(triangles, point, rng.integers(-1 << GRID, 1 << GRID, 3))
        if (t == 0).any():
            return -1
        if not on_edge.any():
            return len(t) % 2


def truth(vertices, faces, rays):
    """Returns t of the nearest hit, inf for none; and whether the origin is inside, -1 if that is undefined."""
    rng, triangles, closed = np.random.default_rng(1), vertices[faces], is_closed(vertices, faces)
    hits = [meets(triangles, ray[:3], ray[3:])[0] for ray in rays]
    inside = [is_inside(triangles, ray[:3], rng) if closed else -1 for ray in rays]
    return np.array([min(t[t > 0], default=np.inf) for t in hits]), np.array(inside)
