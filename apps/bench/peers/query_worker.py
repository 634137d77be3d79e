"""query_worker.py LIBRARY THREADS INPUT OUTPUT: answers the rays of a file with one library, or says how long it takes.

INPUT has vertices, faces and rays, float32. OUTPUT has t, inf for a miss, and counts. Where INPUT has `timed`, the name
of a method of the library's class below, OUTPUT has the seconds of that alone; `contains` is asked about the origins.
"""

import sys
import time

import numpy as np

ROUNDS, LONG = 3, 10  # the least of some rounds, none of which begins after so many seconds


class Limn:
    dtype = np.float64

    def __init__(self, vertices, faces, threads):
        import limn
        scene = limn.Scene()
        scene.add_triangles(vertices, faces)
        self.scene, self.threads = scene.compile(), threads

    def prepare(self, rays):
        return rays.astype(self.dtype)

    def cast(self, rays):
        return self.scene.cast_rays(rays, self.threads)["t_hit"]

    nearest = cast

    def count(self, rays):
        return self.scene.count_intersections(rays, self.threads)


class RaycastingScene(Limn):
    """Open3D's, or limn's of the same interface."""

    dtype = np.float32

    def __init__(self, vertices, faces, threads, module="open3d"):
        import importlib
        self.scene, self.threads = importlib.import_module(module).t.geometry.RaycastingScene(threads), threads
        self.scene.add_triangles(vertices, faces)

    def cast(self, rays):
        return super().cast(rays).numpy()

    nearest = cast

    def count(self, rays):
        return super().count(rays).numpy()


class RayMeshIntersector:
    """One of trimesh's: its own, or with embreex; or limn's of the same interface."""

    def __init__(self, vertices, faces, threads, module):
        import importlib
        import trimesh
        mesh = trimesh.Trimesh(vertices.astype(np.float64), faces, process=False)
        own = {"threads": threads} if module.startswith("limn") else {}
        self.ray = importlib.import_module(module).RayMeshIntersector(mesh, **own)

    def prepare(self, rays):
        return np.ascontiguousarray(rays[:, :3], np.float64), np.ascontiguousarray(rays[:, 3:], np.float64)

    def location(self, rays):
        return self.ray.intersects_location(*rays, multiple_hits=False)

    def first(self, rays):
        return self.ray.intersects_first(*rays)

    def contains(self, rays):
        return self.ray.contains_points(rays[0])

    def nearest(self, rays):
        origins, ways = rays
        locations, index, _ = self.location(rays)
        t = np.full(len(origins), np.inf)
        t[index] = ((locations - origins[index]) * ways[index]).sum(axis=1) / (ways[index] ** 2).sum(axis=1)
        return t

    def count(self, rays):
        _, index = self.ray.intersects_id(*rays, multiple_hits=True)
        return np.bincount(index, minlength=len(rays[0]))


LIBRARIES = {"limn": (Limn,), "limn.open3d": (RaycastingScene, "limn.open3d"), "open3d": (RaycastingScene, "open3d"),
             "limn.trimesh": (RayMeshIntersector, "limn.trimesh"),
             "embreex": (RayMeshIntersector, "trimesh.ray.ray_pyembree"),
             "trimesh": (RayMeshIntersector, "trimesh.ray.ray_triangle")}


def least_seconds(ask, rays):
    seconds, started = [], time.perf_counter()
    while len(seconds) < ROUNDS and time.perf_counter() - started < LONG:
        begin = time.perf_counter()
        ask(rays)
        seconds.append(time.perf_counter() - begin)
    return min(seconds)


def main(library, threads, source, target):
    given = np.load(source)
    kind, *module = LIBRARIES[library]
    tracer = kind(given["vertices"], given["faces"], int(threads), *module)
    rays = tracer.prepare(given["rays"])
    if "timed" in given:
        ask = getattr(tracer, str(given["timed"]))
        ask(tracer.prepare(given["rays"][:100]))  # so that what is built on demand is built
        np.savez(target, seconds=least_seconds(ask, rays))
    else:
        np.savez(target, t=tracer.nearest(rays), counts=tracer.count(rays))


if __name__ == "__main__":
    main(*sys.argv[1:])
