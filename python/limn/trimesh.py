"""The interface of trimesh's `RayMeshIntersector`, with exact answers.

    from limn.trimesh import RayMeshIntersector   # in place of trimesh.ray.ray_pyembree

Rays and points may be lists or arrays of any type, of shape (n, 3). They are converted to float64. Vertices are rounded
to float32 once, and the answers are exact for the rounded mesh. Trimesh need not be installed: a mesh may be any object
with the attributes `vertices` and `faces`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._limn import CompiledScene, Scene

Locations = tuple[npt.NDArray[np.float64], npt.NDArray[np.int64], npt.NDArray[np.int64]]
Rays = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


def _rows(values: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]:
    """Returns the values as a contiguous array: shape (n, 3), float64."""
    try:
        rows = np.ascontiguousarray(values, np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: must be an array of numbers, shape (n, 3)") from None
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise ValueError(f"{name}: must have shape (n, 3), not {rows.shape}")
    return rows


def _rays(origins: npt.ArrayLike, directions: npt.ArrayLike) -> Rays:
    """Returns origins and directions, both (n, 3) float64."""
    starts, ways = _rows(origins, "ray_origins"), _rows(directions, "ray_directions")
    if starts.shape != ways.shape:
        raise ValueError(f"ray_directions: must have shape {starts.shape} as ray_origins, not {ways.shape}")
    return starts, ways


class RayMeshIntersector:
    """Answers queries of rays and points for one mesh.

    A mesh that changes is compiled again for the next query.

    Args:
        geometry: a trimesh.Trimesh, or another object with vertices (n, 3) and faces (m, 3).
        scale_to_box: accepted for compatibility, but not used. Answers do not depend on the size of a mesh.
        threads: number of threads for each query, up to 1024. 0 uses all threads of the machine.
    """

    def __init__(self, geometry: Any, scale_to_box: bool = True, threads: int = 0) -> None:
        self.mesh = geometry
        self.threads = threads
        self._compiled: tuple[Any, CompiledScene] | None = None

    def _scene(self) -> CompiledScene:
        """Returns the compiled mesh. Compiles it again if it has changed.

        A mesh of trimesh has changed if its hash has. Of other meshes the arrays are compared.
        """
        is_trimeshs = type(self.mesh).__module__.startswith("trimesh.")
        key: Any = hash(self.mesh) if is_trimeshs else tuple(array.tobytes() for array in self._arrays())
        if self._compiled is None or self._compiled[0] != key:
            scene = Scene()
            scene.add_triangles(*self._arrays())
            self._compiled = key, scene.compile()
        return self._compiled[1]

    def _arrays(self) -> tuple[npt.NDArray[np.float32], npt.NDArray[Any]]:
        """Returns vertices and faces."""
        return np.ascontiguousarray(self.mesh.vertices, np.float32), np.ascontiguousarray(self.mesh.faces)

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_compiled": None}

    def intersects_location(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike,
                            multiple_hits: bool = True) -> Locations:
        """Returns the hit points: locations (m, 3), index_ray (m,), index_tri (m,).

        With multiple_hits the order and the number of the hits are those of `intersects_id`. Without it there is one
        hit for each ray that hits.
        """
        index_tri, index_ray, locations = self.intersects_id(ray_origins, ray_directions, multiple_hits,
                                                             return_locations=True)
        return locations, index_ray, index_tri

    def intersects_id(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike, multiple_hits: bool = True,
                      max_hits: int = 100, return_locations: bool = False) -> Any:
        """Returns the triangles that the rays hit: index_tri (m,), index_ray (m,), and with return_locations the hit
        points, locations (m, 3).

        The hits are in the order of the rays, and those of a ray in the order of their distance. A ray that passes
        through an edge or a vertex hits each of the triangles there. With multiple_hits each ray has at most its
        max_hits nearest hits, and without it only the nearest one.
        """
        rays = _rays(ray_origins, ray_directions)
        if multiple_hits:
            index_ray, index_tri, t = self._all(rays, max_hits)
        else:
            triangles, t_hit = self._nearest(rays)
            index_ray = np.flatnonzero(triangles >= 0)
            index_tri, t = triangles[index_ray], t_hit[index_ray]
        if not return_locations:
            return index_tri, index_ray
        locations = rays[1][index_ray]
        locations *= t[:, None]
        locations += rays[0][index_ray]
        return index_tri, index_ray, locations

    def intersects_first(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Returns the triangle that each ray hits first, or -1 if it misses: shape (n,)."""
        return self._nearest(_rays(ray_origins, ray_directions))[0]

    def intersects_any(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Returns True for each ray that hits the mesh: shape (n,)."""
        rays = _rays(ray_origins, ray_directions)
        return self._scene()._any(*rays, self.threads) if len(rays[0]) else np.zeros(0, bool)

    def contains_points(self, points: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Returns True for each point that is inside the mesh or exactly on it: shape (n,)."""
        rows = _rows(points, "points")
        return self._scene().contains(rows, self.threads) if len(rows) else np.zeros(0, bool)

    def _all(self, rays: Rays, max_hits: int) -> tuple[Any, Any, Any]:
        if not len(rays[0]):
            return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0)
        hits = self._scene().list_intersections(np.concatenate(rays, axis=1), self.threads)
        ray_ids = hits["ray_ids"]
        kept = np.arange(len(ray_ids)) - hits["ray_splits"][ray_ids] < max_hits
        return ray_ids[kept], hits["primitive_ids"][kept].astype(np.int64), hits["t_hit"][kept]

    def _nearest(self, rays: Rays) -> tuple[Any, Any]:
        """Returns for each ray the triangle that it hits first, or -1 if it misses, and t."""
        if not len(rays[0]):
            return np.zeros(0, np.int64), np.zeros(0)
        return self._scene()._nearest(*rays, self.threads)
