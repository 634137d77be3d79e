"""Reads scenes as `limn_transport SCENE --describe` writes them."""

import json

import numpy as np

RARELY = 0.02  # sampling weight of a lamp's back that a triangle of another mesh is close behind; otherwise 1
NEAR = 2  # largest depth of such a triangle behind the lamp's plane, in world units
GAP = 1e-3  # distance between the front and the back of a lamp, in world units
LARGE = 50  # radius from which a ball counts as the ground
LIFT = 0.2  # media are moved up by this, for all peers, because Mitsuba misses a boundary that touches the floor


class Scene:
    """A scene in world space. The vertices, triangles, normals and uvs of its meshes and boundaries are numpy arrays.
    Normals and uvs are None if the mesh has none.

    A colour is one of three: a list of red, green and blue; a dict {"cell", "even", "odd"} for a checkerboard of cubes
    with edges of length `cell` in world units; a dict {"picture"} for an image with rows from the top, which is
    interpolated bilinearly and repeated. `sky` is a colour, a latitude-longitude map, or None if there is no light
    around the scene."""

    def __init__(self, text):
        told = json.loads(text)
        self.max_depth, self.camera, self.suns = told["max_depth"], told["camera"], told["suns"]
        self.spheres, self.meshes, self.media = told["spheres"], told["meshes"], told["media"]
        for medium in self.media:
            (medium["boundary"],) = medium["boundary"]["meshes"]
        for mesh in self.meshes + [medium["boundary"] for medium in self.media]:
            mesh["vertices"] = np.array(mesh["vertices"], dtype=np.float32)
            mesh["triangles"] = np.array(mesh["triangles"], dtype=np.uint32)
            for name in ("normals", "uvs"):
                mesh[name] = np.array(mesh[name], dtype=np.float32) if mesh.get(name) else None
        for medium in self.media:
            medium["boundary"]["vertices"][:, 1] += LIFT
        bottom, top = told["background"]["bottom"], told["background"]["top"]
        self.has_map = told["environment"] is not None
        if self.has_map:
            self.sky = pixels(told["environment"])
        elif bottom != top:
            self.sky = sky_image(bottom, top)
        else:
            self.sky = top if any(top) else None

    def backs(self):
        """Yields, for each mesh that emits, a mesh for its back and the sampling weight of that back. Renderers whose
        lamps emit on one side only need them."""
        for lamp in self.meshes:
            if lamp["material"]["kind"] != "light":
                continue
            a, b, c = lamp["vertices"][lamp["triangles"][0]]
            normal = np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a))
            depths = [((wall["vertices"] - a) @ -normal)[wall["triangles"]] for wall in self.meshes if wall is not lamp]
            behind = any(np.any(np.all((0 <= d) & (d <= NEAR), axis=1)) for d in depths)
            offset = normal if lamp["normals"] is None else lamp["normals"]
            yield {**lamp, "vertices": lamp["vertices"] - np.float32(GAP) * offset, "normals": None,
                   "triangles": np.ascontiguousarray(lamp["triangles"][:, ::-1])}, RARELY if behind else 1.0


def sphere_mesh(sphere, rings):
    """Returns a ball as a mesh with exact normals, which point inward if the radius is negative. A ball of radius LARGE
    or more counts as the ground. It has 401 rows of vertices, closer together towards the top, whatever `rings` is."""
    segments, polar = 2 * rings, np.linspace(0, np.pi, rings + 1)
    if abs(sphere["radius"]) >= LARGE:
        segments, polar = 512, np.concatenate([[0], np.geomspace(1e-4, np.pi, 400)])
    around = 2 * np.pi * np.arange(segments) / segments
    sine, cosine = np.sin(polar)[:, None], np.cos(polar)[:, None]
    normals = np.stack(np.broadcast_arrays(sine * np.cos(around), cosine, -sine * np.sin(around)), -1).reshape(-1, 3)
    # Connect the rings. a and b are neighbours in a ring, c and d are below them. The first and
    # the last ring are the poles: their vertices coincide.
    rows, here = segments * np.arange(len(polar) - 1)[:, None], np.arange(segments)
    a, b = (rows + here).ravel(), (rows + np.roll(here, -1)).ravel()
    c, d = a + segments, b + segments
    triangles = np.concatenate([np.stack([a, c, d], axis=-1)[:-segments], np.stack([a, d, b], axis=-1)[segments:]])
    return {"vertices": (np.array(sphere["center"]) + sphere["radius"] * normals).astype(np.float32),
            "triangles": triangles.astype(np.uint32), "normals": normals.astype(np.float32), "uvs": None}


def pixels(picture):
    """Returns an image as an array of shape (height, width, 3)."""
    return np.array(picture["values"], dtype=np.float32).reshape(picture["height"], picture["width"], 3)


def index_of(metal):
    """Returns the index of refraction, eta and k, that RoughConductor computes from reflectance and edge tint."""
    r, tint = np.array(metal["reflectance"]), np.array(metal["edge_tint"])
    eta = tint * (1 - r) / (1 + r) + (1 - tint) * (1 + np.sqrt(r)) / (1 - np.sqrt(r))
    return eta, np.sqrt(np.maximum(0, (r * (eta + 1) ** 2 - (eta - 1) ** 2) / (1 - r)))


def sky_image(bottom, top, height=512):
    """Returns the vertical gradient from `bottom` to `top` as a latitude-longitude map. Its first row is straight up,
    its last row straight down."""
    upward = np.cos(np.pi * (np.arange(height) + 0.5) / height)[:, None, None]
    rows = (1 - upward) / 2 * np.array(bottom) + (1 + upward) / 2 * np.array(top)
    return np.ascontiguousarray(np.broadcast_to(rows, (height, 2 * height, 3)), dtype=np.float32)
