"""query_worker.py LIBRARY THREADS INPUT OUTPUT: answers the rays of a file with one library, and says how long it took.

INPUT has vertices, faces and rays, float32. OUTPUT has t, inf for a miss, and counts; or `seconds` where INPUT has `timed`.
"""

import sys
import time

import numpy as np


class Limn:
    def __init__(self, vertices, faces, threads):
        import limn
        scene = limn.Scene()
        scene.add_triangles(vertices, faces)
        self.scene, self.threads = scene.compile(), threads

    def prepare(self, rays):
        return rays.astype(np.float64)

    def nearest(self, rays):
        return self.scene.cast_rays(rays, self.threads)["t_hit"]

    def count(self, rays):
        return self.scene.count_intersections(rays, self.threads)


class Open3d:
    def __init__(self, vertices, faces, threads):
        import open3d
        self.scene, self.threads = open3d.t.geometry.RaycastingScene(threads), threads
        self.scene.add_triangles(vertices, faces)

    def prepare(self, rays):
        return rays

    def nearest(self, rays):
        return self.scene.cast_rays(rays, self.threads)["t_hit"].numpy()

    def count(self, rays):
        return self.scene.count_intersections(rays, self.threads).numpy()


class Trimesh:
    """With trimesh's own intersector, or with embreex."""

    def __init__(self, vertices, faces, _, module="trimesh.ray.ray_triangle"):
        import importlib
        import trimesh
        mesh = trimesh.Trimesh(vertices.astype(np.float64), faces, process=False)
        self.ray = importlib.import_module(module).RayMeshIntersector(mesh)

    def prepare(self, rays):
        return np.ascontiguousarray(rays[:, :3], np.float64), np.ascontiguousarray(rays[:, 3:], np.float64)

    def nearest(self, rays):
        origins, ways = rays
        locations, index, _ = self.ray.intersects_location(origins, ways, multiple_hits=False)
        t = np.full(len(origins), np.inf)
        t[index] = ((locations - origins[index]) * ways[index]).sum(axis=1) / (ways[index] ** 2).sum(axis=1)
        return t

    def count(self, rays):
        _, index = self.ray.intersects_id(*rays, multiple_hits=True)
        return np.bincount(index, minlength=len(rays[0]))


def embreex(vertices, faces, threads):
    return Trimesh(vertices, faces, threads, "trimesh.ray.ray_pyembree")


LIBRARIES = {"limn": Limn, "open3d": Open3d, "trimesh": Trimesh, "embreex": embreex}


def main(library, threads, source, target):
    given = np.load(source)
    tracer = LIBRARIES[library](given["vertices"], given["faces"], int(threads))
    rays = tracer.prepare(given["rays"])
    tracer.nearest(tracer.prepare(given["rays"][:100]))  # so that what is built on demand is built
    if "timed" in given:
        seconds = []
        for _ in range(3):
            begin = time.perf_counter()
            tracer.nearest(rays)
            seconds.append(time.perf_counter() - begin)
        np.savez(target, seconds=min(seconds))
    else:
        np.savez(target, t=tracer.nearest(rays), counts=tracer.count(rays))


if __name__ == "__main__":
    main(*sys.argv[1:])
