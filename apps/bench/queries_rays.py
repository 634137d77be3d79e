"""Meshes, rays that are hard on them, and what is true of these in exact arithmetic.

All coordinates are whole numbers of 2^-GRID, so that all differences below are exact in float32 and the rays of all
libraries are the same to the last bit.
"""

import sys
from fractions import Fraction

import numpy as np

from machine import ROOT

sys.path.insert(0, str(ROOT / "tests/python"))
from meshes import icosphere, voxels  # noqa: E402

GRID = 16
KNOT = "knot"
KINDS = {"random": "at random", "vertices": "at vertices", "edges": "along edges", "planes": "in planes of faces"}


def on_grid(vertices):
    """Moved into the cube from -1 to 1 and onto the grid, as whole numbers."""
    lower, upper = vertices.min(axis=0), vertices.max(axis=0)
    scale = 2 / (upper - lower).max()
    return np.rint((vertices - (lower + upper) / 2) * scale * 2 ** GRID).astype(np.int64)


def read_obj(path):
    vertices, faces = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [c - 1 if c > 0 else c + len(vertices) for c in corners]
            faces += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
    return np.array(vertices), np.array(faces)


def knot(along, around):
    """A closed tube around a trefoil, rough and uneven as what is scanned; 2 * along * around triangles."""
    rng = np.random.default_rng(24)
    # Less than a quarter of a step aside, so that each quad stays convex and either diagonal cuts it well.
    aside = lambda: rng.uniform(-0.2, 0.2, (along, around))
    s = (np.arange(along)[:, None] + aside()) * 2 * np.pi / along
    a = (np.arange(around) + aside()) * 2 * np.pi / around
    vector = lambda *parts: np.stack(np.broadcast_arrays(*parts), axis=-1)
    unit = lambda v: v / np.linalg.norm(v, axis=-1, keepdims=True)
    far, slope, x, y = 2 + np.cos(3 * s), -3 * np.sin(3 * s), np.cos(2 * s), np.sin(2 * s)
    centre = vector(far * x, far * y, np.sin(3 * s))
    way = unit(vector(slope * x - 2 * far * y, slope * y + 2 * far * x, 3 * np.cos(3 * s)))
    out = vector(x, y, 0)
    out = unit(out - way * (out * way).sum(axis=-1, keepdims=True))
    radius = 0.35 + 0.04 * np.sin(14 * s) * np.sin(5 * a) + rng.uniform(-0.002, 0.002, (along, around))
    points = centre + radius[..., None] * (np.cos(a)[..., None] * out + np.sin(a)[..., None] * np.cross(way, out))
    corner = lambda i, j: np.roll(np.arange(along * around).reshape(along, around), (-i, -j), (0, 1)).ravel()
    p, q, r, t = corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)
    other = rng.random(along * around)[:, None] < 0.5
    faces = [np.where(other, vector(p, r, q), vector(p, t, q)), np.where(other, vector(p, t, r), vector(q, t, r))]
    return points.reshape(-1, 3), np.concatenate(faces)


def ball_and_ring():
    """Cells of a grid: edges that four faces share, and rays in the planes of many."""
    x, y, z = (np.indices((24, 24, 24)) + 0.5) / 12 - 1
    return voxels((x * x + y * y + z * z < 0.3) ^ ((np.hypot(x, y) - 0.7) ** 2 + z * z < 0.05))


def meshes(models):
    """Name, vertices as whole numbers, faces. What is made here comes first, so that anyone can repeat the report; the
    speed is measured of the last of these and of the models."""
    rng = np.random.default_rng(20)
    soup = rng.uniform(-1, 1, (1000, 1, 3)) + rng.normal(size=(1000, 3, 3)) * 0.2
    found = [("icosphere", *icosphere(5)), ("soup", soup.reshape(-1, 3), np.arange(3000).reshape(-1, 3)),
             ("voxels", *ball_and_ring()), (KNOT, *knot(300, 117))]
    found += [(path.stem, *read_obj(path)) for path in models]
    return [(name, on_grid(np.asarray(vertices, float)), np.ascontiguousarray(faces, np.int64))
            for name, vertices, faces in found]


def is_closed(vertices, faces):
    """Whether each edge, by its positions, is used as often one way as the other."""
    _, number = np.unique(vertices, axis=0, return_inverse=True)
    ends = number.reshape(-1)[faces[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2)
    ends = ends[ends[:, 0] != ends[:, 1]]
    code = lambda pairs: np.sort(pairs[:, 0] * len(vertices) + pairs[:, 1])
    return np.array_equal(code(ends), code(ends[:, ::-1]))


def make_rays(kind, vertices, faces, count, seed):
    """(count, 6) whole numbers: origin and direction."""
    rng = np.random.default_rng([seed, list(KINDS).index(kind)])
    anywhere = lambda: rng.integers(-3 << (GRID - 1), 3 << (GRID - 1), (count, 3))
    if kind == "random":
        start, target = anywhere(), rng.integers(-1 << GRID, 1 << GRID, (count, 3))
        return np.concatenate([start, target - start], axis=1)
    if kind == "vertices":
        start, target = anywhere(), vertices[faces[rng.integers(len(faces), size=count), 0]]
        return np.concatenate([start, target - start], axis=1)
    a, b, c = (vertices[faces[rng.integers(len(faces), size=count)]].transpose(1, 0, 2))
    k = rng.integers(1, 4, (count, 1))
    if kind == "edges":
        return np.concatenate([a - k * (b - a), b - a], axis=1)
    m, n = rng.integers(-2, 3, (2, count, 1))
    way = np.where((m == 0) & (n == 0), c - a, m * (b - a) + n * (c - a))
    return np.concatenate([a + k * (a - b), way], axis=1)


def volumes(vertices, faces, origin, direction, number):
    """Six times the signed volumes of the ray with each edge, and the ray's share across the plane, in `number`."""
    a, b, c = ((vertices[faces[:, i]] - origin).astype(number) for i in range(3))
    d = direction.astype(number)
    cross = lambda p, q: np.stack([p[:, 1] * q[:, 2] - p[:, 2] * q[:, 1], p[:, 2] * q[:, 0] - p[:, 0] * q[:, 2],
                                   p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]], axis=1)
    u, v, w = (cross(p, q) @ d for p, q in ((b, c), (c, a), (a, b)))
    return u, v, w, (cross(a, b) * c).sum(axis=1)


def candidates(vertices, faces, origin, direction):
    """Faces whose line the ray may meet: those that float64, with a bound on its error, does not rule out."""
    u, v, w, _ = volumes(vertices, faces, origin, direction, np.float64)
    error = 2.0 ** -45 * float(np.abs(direction).max()) * float((np.abs(origin).max() + (1 << GRID))) ** 2 * 16
    return np.flatnonzero(((u >= -error) & (v >= -error) & (w >= -error)) | ((u <= error) & (v <= error) & (w <= error)))


def meets(vertices, faces, ray):
    """(t, whether it lies on an edge) of each face that the ray meets, exactly, also with t = 0. Faces in its plane are
    not met."""
    origin, direction = ray[:3], ray[3:]
    chosen = faces[candidates(vertices, faces, origin, direction)]
    if not len(chosen):
        return []
    found = []
    for u, v, w, volume in zip(*volumes(vertices, chosen, origin, direction, object)):
        total = u + v + w
        if total == 0 or min(u, v, w) < 0 < max(u, v, w):
            continue
        t = Fraction(volume, total)
        if t >= 0:
            found.append((t, 0 in (u, v, w)))
    return found


def is_inside(vertices, faces, origin, rng):
    """By parity along a ray that meets no edge; None for a point on the surface."""
    for _ in range(50):
        direction = rng.integers(-1 << GRID, 1 << GRID, 3)
        met = meets(vertices, faces, np.concatenate([origin, direction]))
        if any(t == 0 for t, _ in met):
            return None
        if not any(on_edge for _, on_edge in met):
            return len(met) % 2 == 1
    return None


def truth(vertices, faces, rays, closed):
    """t of the nearest hit, inf for none; whether the origin is inside, -1 where that means nothing."""
    rng = np.random.default_rng(1)
    nearest, inside = np.full(len(rays), np.inf), np.full(len(rays), -1)
    for i, ray in enumerate(rays):
        met = [t for t, _ in meets(vertices, faces, ray) if t > 0]
        if met:
            nearest[i] = float(min(met))
        if closed:
            answer = is_inside(vertices, faces, ray[:3], rng)
            inside[i] = -1 if answer is None else answer
    return nearest, inside
