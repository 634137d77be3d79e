"""Meshes that the tests know the truth about: vertices float32, faces uint32."""

import itertools

import numpy as np

CUBE_FACES = np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3],
                       [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]], np.uint32)


def box(lower=(0, 0, 0), upper=(1, 1, 1)):
    corners = list(itertools.product(*zip(lower, upper)))
    vertices = np.array([corners[4 * (i & 1) + 2 * (i >> 1 & 1) + (i >> 2)] for i in range(8)], np.float32)
    return vertices, CUBE_FACES


def joined(*meshes):
    vertices, faces, count = [], [], 0
    for v, f in meshes:
        vertices.append(v)
        faces.append(f + np.uint32(count))
        count += len(v)
    return np.concatenate(vertices), np.concatenate(faces)


def inverted(mesh):
    return mesh[0], np.ascontiguousarray(mesh[1][:, ::-1])


def subdivided(mesh):
    """Every triangle in four, by the middles of its edges."""
    vertices, faces = mesh
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, index = np.unique(edges, axis=0, return_inverse=True)
    middles = (vertices[unique[:, 0]] + vertices[unique[:, 1]]) / 2
    m = (index.reshape(-1, 3) + len(vertices)).astype(np.uint32)
    a, b, c = faces.T
    parts = [(a, m[:, 0], m[:, 2]), (b, m[:, 1], m[:, 0]), (c, m[:, 2], m[:, 1]), tuple(m.T)]
    return np.concatenate([vertices, middles]).astype(np.float32), np.concatenate([np.stack(p, 1) for p in parts])


def icosphere(levels):
    g = (1 + 5 ** 0.5) / 2
    vertices = np.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g],
                         [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]])
    faces = np.array([[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2],
                      [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5],
                      [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]], np.uint32)
    mesh = vertices.astype(np.float32), faces
    for _ in range(levels + 1):
        v = mesh[0].astype(np.float64)
        mesh = (v / np.linalg.norm(v, axis=1)[:, None]).astype(np.float32), mesh[1]
        if _ < levels:
            mesh = subdivided(mesh)
    return mesh


def uv_sphere(radius, resolution=20):
    """Rings of latitude between two poles on the z axis, as most programs make spheres."""
    rings = [[0, 0, radius]]
    for i in range(1, resolution):
        a = np.pi * i / resolution
        for j in range(2 * resolution):
            b = np.pi * j / resolution
            rings.append([radius * np.sin(a) * np.cos(b), radius * np.sin(a) * np.sin(b), radius * np.cos(a)])
    rings.append([0, 0, -radius])
    around, last, faces = 2 * resolution, len(rings) - 1, []
    for j in range(around):
        k = (j + 1) % around
        faces.append([0, 1 + j, 1 + k])
        faces.append([last, last - around + k, last - around + j])
        for i in range(resolution - 2):
            a, b = 1 + i * around, 1 + (i + 1) * around
            faces += [[a + j, b + j, a + k], [a + k, b + j, b + k]]
    return np.array(rings, np.float32), np.array(faces, np.uint32)


def voxels(filled):
    """The faces between filled cells of a grid and others; cells have side 1."""
    padded = np.pad(filled, 1)
    quads = []
    for axis, sign in itertools.product(range(3), (0, 1)):
        for cell in np.argwhere(filled):
            beside = cell + 1
            beside[axis] += 1 if sign else -1
            if padded[tuple(beside)]:
                continue
            u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            corner = cell + sign * np.eye(3)[axis]
            quad = [corner, corner + u, corner + u + v, corner + v]
            quads.append(quad if sign else quad[::-1])
    vertices, index = np.unique(np.array(quads).reshape(-1, 3), axis=0, return_inverse=True)
    q = index.reshape(-1, 4).astype(np.uint32)
    return vertices.astype(np.float32), np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]]])


class MeshObject:
    """What limn.trimesh needs of a trimesh.Trimesh."""

    def __init__(self, mesh):
        self.vertices, self.faces = np.asarray(mesh[0], np.float64), np.asarray(mesh[1], np.int64)

    def __hash__(self):
        return hash((self.vertices.tobytes(), self.faces.tobytes()))


def directions(rng, count):
    d = rng.normal(size=(count, 3))
    return d / np.linalg.norm(d, axis=1)[:, None]


def resident():
    """Bytes of memory that the process has now."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096
