"""What the writers share: a scene as `limn_transport SCENE --describe` tells it, and the meshes that it turns into."""

import json
from pathlib import Path

import numpy as np

LARGE = 50  # spheres from this radius on are grounds: seen from near their top only
RARELY = 0.02  # how often, of once, the back of a lamp is sampled that has a wall behind it


class Scene:
    """A description, with its numbers as arrays. Colours are three numbers, {"cell", "even", "odd"}: a checker, or
    {"picture"}: rows from the top, bilinear and repeated, (0, 0) of texture coordinates in its lower left corner."""

    def __init__(self, path):
        told = json.loads(Path(path).read_text())
        self.name, self.max_depth = told["name"], told["max_depth"]
        self.camera, self.background = told["camera"], told["background"]
        self.spheres, self.quads, self.meshes = told["spheres"], told["quads"], told["meshes"]
        self.media, self.suns = told["media"], told["suns"]
        self.environment = pixels(told["environment"]) if told["environment"] else None
        for mesh in self.meshes:
            mesh["vertices"] = np.array(mesh["vertices"], dtype=np.float32)
            mesh["triangles"] = np.array(mesh["triangles"], dtype=np.uint32)
            for name in ("normals", "uvs"):
                mesh[name] = np.array(mesh[name], dtype=np.float32) if mesh[name] else None

    def has(self, kind):
        return any(shape["material"]["kind"] == kind for shape in self.spheres + self.quads + self.meshes)

    def has_gradient(self):
        return self.background["bottom"] != self.background["top"]

    def is_dark(self):
        return not any(self.background["bottom"] + self.background["top"])


def pixels(picture):
    return np.array(picture["values"], dtype=np.float32).reshape(picture["height"], picture["width"], 3)


def is_checker(color):
    return isinstance(color, dict) and "cell" in color


def is_picture(color):
    return isinstance(color, dict) and "picture" in color


def quad_corners(quad):
    """Four corners around the parallelogram, counter-clockwise seen from outside, and the outward normal."""
    corner, u, v = (np.array(quad[k]) for k in ("corner", "edge_u", "edge_v"))
    normal = np.cross(u, v)
    return np.array([corner, corner + u, corner + u + v, corner + v]), normal / np.linalg.norm(normal)


def quads_mesh(quads):
    """One mesh of two triangles for each quad."""
    vertices = np.concatenate([quad_corners(q)[0] for q in quads])
    first = 4 * np.arange(len(quads))[:, None, None]
    triangles = first + np.array([[0, 1, 2], [0, 2, 3]])
    return vertices.astype(np.float32), triangles.reshape(-1, 3).astype(np.uint32)


def sphere_mesh(center, radius, rings=128):
    """A ball of triangles around +y with its exact normals. Rings of a large one close up towards the top, in
    proportion to the distance from there, so that what is seen of it is flat to 1e-5 of that distance."""
    segments, polar = 2 * rings, np.linspace(0, np.pi, rings + 1)[1:-1]
    if abs(radius) >= LARGE:
        segments, polar = 512, np.geomspace(1e-4, np.pi, 400)[:-1]
    around = 2 * np.pi * np.arange(segments) / segments
    sine, cosine = np.sin(polar)[:, None], np.cos(polar)[:, None]
    ring_normals = np.stack(np.broadcast_arrays(sine * np.cos(around), cosine, -sine * np.sin(around)), axis=-1)
    normals = np.concatenate([[[0, 1, 0]], ring_normals.reshape(-1, 3), [[0, -1, 0]]])

    here, next_one = np.arange(segments), (np.arange(segments) + 1) % segments
    rows = 1 + segments * np.arange(len(polar))[:, None]
    a, b = (rows[:-1] + here).ravel(), (rows[:-1] + next_one).ravel()
    c, d = a + segments, b + segments
    top, bottom = np.zeros(segments, int), np.full(segments, len(normals) - 1)
    faces = np.concatenate([np.stack([top, 1 + here, 1 + next_one], axis=-1), np.stack([a, c, d], axis=-1),
                            np.stack([a, d, b], axis=-1),
                            np.stack([rows[-1] + here, bottom, rows[-1] + next_one], axis=-1)])
    vertices = np.array(center) + abs(radius) * normals
    if radius < 0:
        faces, normals = faces[:, ::-1], -normals
    return vertices.astype(np.float32), faces.astype(np.uint32), normals.astype(np.float32)


def sky_image(background, height=512):
    """The gradient over a latitude-longitude map, from straight up in its first row to straight down in its last."""
    upward = np.cos(np.pi * (np.arange(height) + 0.5) / height)[:, None, None]
    a = (upward + 1) / 2
    rows = (1 - a) * np.array(background["bottom"]) + a * np.array(background["top"])
    return np.ascontiguousarray(np.broadcast_to(rows, (height, 2 * height, 3)), dtype=np.float32)


def lifted(quads, by):
    """Boundaries of media a little off the floor, for who passes over what touches."""
    return [{**q, "corner": [q["corner"][0], q["corner"][1] + by, q["corner"][2]]} for q in quads]


def has_wall_behind(lamp, quads, near=2.0):
    """Whether the side of the lamp that its normal points away from looks at a wall right beside it."""
    corners, normal = quad_corners(lamp)
    middle = corners.mean(axis=0)
    for wall in quads:
        if wall is lamp or wall["material"]["kind"] == "light":
            continue
        corner, wall_normal = quad_corners(wall)[0][0], quad_corners(wall)[1]
        along = -normal @ wall_normal
        if abs(along) < 0.9:
            continue
        distance = (corner - middle) @ wall_normal / along
        if 0 <= distance <= near:
            return True
    return False
