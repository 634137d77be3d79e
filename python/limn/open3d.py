"""The interface of Open3D's `RaycastingScene`, with exact answers.

    import limn.open3d as o3d                      # in place of `import open3d as o3d`
    from limn.open3d import RaycastingScene        # works without Open3D

Only `t.geometry.RaycastingScene` is limn's. All other names of `limn.open3d` are Open3D's, if Open3D is installed. A
query with a tensor of Open3D returns tensors of Open3D. A query with a list, a numpy array or another array that
supports DLPack returns `Tensor`, a numpy array that has `.numpy()`. As in Open3D, numbers are float32 and ids are
uint32.
"""

from __future__ import annotations

import contextlib
import importlib
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from ._limn import INVALID_ID, CompiledScene, Scene

__all__ = ["RaycastingScene", "Tensor", "t"]


class Tensor(np.ndarray):
    """A numpy array with the methods of Open3D's tensors that programs use most."""

    def numpy(self) -> np.ndarray:
        """Returns a plain numpy array that shares the memory."""
        return self.view(np.ndarray)

    def cpu(self) -> Tensor:
        return self

    def clone(self) -> Tensor:
        return self.copy()

    def isfinite(self) -> Tensor:
        return np.isfinite(self)

    def isnan(self) -> Tensor:
        return np.isnan(self)

    def isinf(self) -> Tensor:
        return np.isinf(self)


def _is_open3d(value: Any) -> bool:
    return type(value).__module__.startswith("open3d.") and hasattr(value, "numpy")


def _array(value: Any, name: str, types: tuple[type, ...], otherwise: type) -> np.ndarray:
    """Returns the value as a contiguous array.

    An array must have one of the `types`. A list becomes an array of the type `otherwise`.
    """
    if _is_open3d(value):
        array = value.cpu().numpy()
    elif isinstance(value, np.ndarray):
        array = value
    elif hasattr(value, "__dlpack__"):
        array = np.from_dlpack(value)
    elif isinstance(value, (list, tuple)):
        try:
            array = np.asarray(value, otherwise)
            kind = np.asarray(value).dtype.kind
        except (TypeError, ValueError, OverflowError) as error:
            raise TypeError(f"{name}: {error}") from None
        if np.issubdtype(otherwise, np.integer) and array.size and kind not in "iu":
            raise TypeError(f"{name}: must be whole numbers")
    else:
        raise TypeError(f"{name}: must be an array or a tensor, not {type(value).__name__}")
    if array.dtype not in types:
        wanted = " or ".join(np.dtype(one).name for one in types)
        raise TypeError(f"{name}: must be of {wanted}, not {array.dtype}")
    return np.ascontiguousarray(array)


def _numbers(value: Any, name: str, width: int) -> np.ndarray:
    """Returns the value as an array whose last axis has `width` numbers."""
    array = _array(value, name, (np.float32, np.float64), np.float32)
    if array.ndim < 2 or array.shape[-1] != width:
        raise ValueError(f"{name}: must have shape (..., {width}) with at least two axes, not {array.shape}")
    return array


def _like(value: Any, array: np.ndarray) -> Any:
    """Returns the array as a tensor of Open3D if `value` is one, or else as a Tensor."""
    return type(value).from_numpy(np.ascontiguousarray(array)) if _is_open3d(value) else array.view(Tensor)


@contextlib.contextmanager
def _renamed(*names: tuple[str, str]) -> Iterator[None]:
    """Replaces limn's names of arguments with Open3D's in the messages of errors."""
    try:
        yield
    except (TypeError, ValueError) as error:
        text = str(error)
        for own, theirs in names:
            text = text.replace(own, theirs)
        raise type(error)(text) from None


def _odd(nsamples: int) -> None:
    """Raises a ValueError unless nsamples is odd. limn does not use the number."""
    if nsamples < 1 or nsamples % 2 == 0:
        raise ValueError(f"nsamples: must be an odd number, not {nsamples}")


def _mesh_arrays(mesh: Any) -> tuple[np.ndarray, np.ndarray]:
    """Returns vertices and triangles of Open3D's tensor mesh, or of its legacy mesh.

    The vertices of a legacy mesh are rounded from float64 to float32.
    """
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):
        return mesh.vertex["positions"], mesh.triangle["indices"]
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
        return np.asarray(mesh.vertices).astype(np.float32), np.asarray(mesh.triangles)
    raise TypeError(f"mesh: must be a TriangleMesh, not {type(mesh).__name__}")


class RaycastingScene:
    """A scene of triangle meshes with the methods of Open3D's RaycastingScene.

    Open3D's documentation describes the methods. There is no compile step: the first query after a change builds the
    scene. The differences from Open3D are:

    - A hit counts if 0 < t. A ray that starts exactly on a triangle does not hit it.
    - count_intersections counts how often a ray passes through a surface. A passage through an edge or a vertex counts
      once. The count is even if the ray starts outside of all closed meshes. list_intersections, however, lists each of
      the triangles at the edge or vertex, ordered by t.
    - compute_occupancy and the sign of compute_signed_distance use winding numbers, which are exact for overlapping
      meshes too. A point exactly on a surface is inside. nsamples is checked but not used.
    - Rays and points may be float32 or float64. A ray with a NaN misses.
    - A wrong argument raises a TypeError or a ValueError that names the argument.
    """

    INVALID_ID = INVALID_ID

    def __init__(self, nthreads: int = 0, device: Any = None) -> None:
        """Makes an empty scene.

        Args:
            nthreads: not used. Building a scene uses all threads.
            device: the CPU, or None. Another device raises a ValueError.
        """
        if device is not None and not str(device).upper().startswith("CPU"):
            raise ValueError(f"device: must be the CPU, not {device}")
        self._scene = Scene()
        self._compiled: CompiledScene | None = None

    def add_triangles(self, vertex_positions: Any = None, triangle_indices: Any = None, *, mesh: Any = None,
                      vertices: Any = None, triangles: Any = None) -> int:
        """Adds a mesh and returns its geometry id.

        Call it as add_triangles(vertex_positions, triangle_indices), shapes (n, 3) float32 and (m, 3) integers, or as
        add_triangles(mesh) with a mesh of Open3D. The arrays are copied.
        """
        positions = vertex_positions if vertex_positions is not None else vertices
        indices = triangle_indices if triangle_indices is not None else triangles
        if indices is None:
            positions, indices = _mesh_arrays(positions if mesh is None else mesh)
        vertices_of, triangles_of = (
            _array(positions, "vertex_positions", (np.float32,), np.float32),
            _array(indices, "triangle_indices", (np.uint32, np.int32, np.int64, np.uint64), np.int64))
        with _renamed(("faces:", "triangle_indices:"), ("vertices:", "vertex_positions:")):
            number = self._scene.add_triangles(vertices_of, triangles_of)
        self._compiled = None
        return number

    def cast_rays(self, rays: Any, nthreads: int = 0) -> dict[str, Any]:
        """Returns the nearest hit of each ray.

        The dict has t_hit (inf if the ray misses), geometry_ids and primitive_ids (INVALID_ID if the ray misses),
        primitive_uvs and primitive_normals.
        """
        array = _numbers(rays, "rays", 6)
        shape = array.shape[:-1]
        if not array.size:
            return {name: _like(rays, np.zeros(shape + columns, kind)) for name, columns, kind in (
                ("t_hit", (), np.float32), ("geometry_ids", (), np.uint32), ("primitive_ids", (), np.uint32),
                ("primitive_uvs", (2,), np.float32), ("primitive_normals", (3,), np.float32))}
        return self._answers(rays, self._ready().cast_rays(array, nthreads, dtype="float32"))

    def test_occlusions(self, rays: Any, tnear: float = 0.0, tfar: float = math.inf, nthreads: int = 0) -> Any:
        """Returns True for each ray that hits anything with tnear < t <= tfar."""
        array = _numbers(rays, "rays", 6)
        if not array.size:
            return _like(rays, np.zeros(array.shape[:-1], bool))
        with _renamed(("t_min", "tnear"), ("t_max", "tfar")):
            return _like(rays, self._ready().test_occlusions(array, nthreads, t_min=tnear, t_max=tfar))

    def count_intersections(self, rays: Any, nthreads: int = 0) -> Any:
        """Returns how many surfaces each ray passes through: int32."""
        array = _numbers(rays, "rays", 6)
        if not array.size:
            return _like(rays, np.zeros(array.shape[:-1], np.int32))
        return _like(rays, self._ready().count_intersections(array, nthreads).astype(np.int32))

    def list_intersections(self, rays: Any, nthreads: int = 0) -> dict[str, Any]:
        """Returns all hits of all rays: ray_splits, ray_ids, t_hit, geometry_ids, primitive_ids, primitive_uvs.

        The hits of ray i are those from ray_splits[i] to ray_splits[i + 1], the last one not included.
        """
        array = _numbers(rays, "rays", 6)
        if not array.size:
            empty = {name: np.zeros(0, np.uint32) for name in ("ray_ids", "geometry_ids", "primitive_ids")}
            answer = {"ray_splits": np.zeros(1, np.uint32), "t_hit": np.zeros(0, np.float32),
                      "primitive_uvs": np.zeros((0, 2), np.float32)} | empty
        else:
            answer = self._ready().list_intersections(array, nthreads, dtype="float32")
            for name in ("ray_splits", "ray_ids"):
                answer[name] = answer[name].astype(np.uint32)
        return self._answers(rays, answer)

    def compute_closest_points(self, query_points: Any, nthreads: int = 0) -> dict[str, Any]:
        """Returns the point of the surfaces that is nearest to each query point.

        The dict has points, geometry_ids, primitive_ids, primitive_uvs and primitive_normals.
        """
        array = _numbers(query_points, "query_points", 3)
        shape = array.shape[:-1]
        if not array.size:
            return {name: _like(query_points, np.zeros(shape + columns, kind)) for name, columns, kind in (
                ("points", (3,), np.float32), ("geometry_ids", (), np.uint32), ("primitive_ids", (), np.uint32),
                ("primitive_uvs", (2,), np.float32), ("primitive_normals", (3,), np.float32))}
        return self._answers(query_points, self._ready().compute_closest_points(array, nthreads, dtype="float32"))

    def compute_distance(self, query_points: Any, nthreads: int = 0) -> Any:
        """Returns the distance of each point from the nearest surface: float32."""
        array = _numbers(query_points, "query_points", 3)
        if not array.size:
            return _like(query_points, np.zeros(array.shape[:-1], np.float32))
        return _like(query_points, self._ready().compute_distance(array, nthreads, dtype="float32"))

    def compute_signed_distance(self, query_points: Any, nthreads: int = 0, nsamples: int = 1) -> Any:
        """Returns the distance of each point from the nearest surface, negative if the point is inside: float32."""
        _odd(nsamples)
        array = _numbers(query_points, "query_points", 3)
        if not array.size:
            return _like(query_points, np.zeros(array.shape[:-1], np.float32))
        return _like(query_points, self._ready().compute_signed_distance(array, nthreads, dtype="float32"))

    def compute_occupancy(self, query_points: Any, nthreads: int = 0, nsamples: int = 1) -> Any:
        """Returns 1 for each point that is inside or exactly on a surface, and 0 for others: float32."""
        _odd(nsamples)
        array = _numbers(query_points, "query_points", 3)
        if not array.size:
            return _like(query_points, np.zeros(array.shape[:-1], np.float32))
        return _like(query_points, self._ready().contains(array, nthreads).astype(np.float32))

    @staticmethod
    def create_rays_pinhole(*args: Any, **kwargs: Any) -> Any:
        """Returns the rays of a pinhole camera: shape (height_px, width_px, 6), float32.

        Call it as create_rays_pinhole(intrinsic_matrix, extrinsic_matrix, width_px, height_px), or as
        create_rays_pinhole(fov_deg, center, eye, up, width_px, height_px), where fov_deg is the horizontal field of
        view. The second form turns the picture by 180 degrees, as Open3D does. The rays go through the centres of the
        pixels. A direction reaches from the eye to the plane at depth 1.
        """
        if len(args) + len(kwargs) == 4:
            return _rays_of_matrices(*args, **kwargs)
        return _rays_of_view(*args, **kwargs)

    def _ready(self) -> CompiledScene:
        if self._compiled is None:
            self._compiled = self._scene.compile()
        return self._compiled

    @staticmethod
    def _answers(asked: Any, answer: dict[str, np.ndarray]) -> dict[str, Any]:
        return {name: _like(asked, array) for name, array in answer.items()}


def _double(value: Any, name: str, shape: tuple[int, ...]) -> np.ndarray:
    array = np.asarray(value.cpu().numpy() if _is_open3d(value) else value, np.float64)
    if array.shape != shape:
        raise ValueError(f"{name}: must have shape {shape}, not {array.shape}")
    return array


def _pinhole(intrinsic: np.ndarray, rotation: np.ndarray, eye: np.ndarray, width: int, height: int) -> np.ndarray:
    for name, side in (("width_px", width), ("height_px", height)):
        if side < 1:
            raise ValueError(f"{name}: must be at least 1, not {side}")
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    pixels = np.stack([x, y, np.ones_like(x)], axis=-1)
    directions = pixels @ np.linalg.inv(intrinsic).T @ rotation
    return np.concatenate([np.broadcast_to(eye, directions.shape), directions], axis=-1).astype(np.float32)


def _rays_of_matrices(intrinsic_matrix: Any, extrinsic_matrix: Any, width_px: int, height_px: int) -> Any:
    intrinsic = _double(intrinsic_matrix, "intrinsic_matrix", (3, 3))
    extrinsic = _double(extrinsic_matrix, "extrinsic_matrix", (4, 4))
    if not (np.isfinite(intrinsic).all() and np.linalg.matrix_rank(intrinsic) == 3):
        raise ValueError("intrinsic_matrix: must be finite and have an inverse")
    rotation = extrinsic[:3, :3]
    return _like(intrinsic_matrix, _pinhole(intrinsic, rotation, -rotation.T @ extrinsic[:3, 3], width_px, height_px))


def _rays_of_view(fov_deg: float, center: Any, eye: Any, up: Any, width_px: int, height_px: int) -> Any:
    if not 0 < fov_deg < 180:
        raise ValueError(f"fov_deg: must be between 0 and 180, not {fov_deg}")
    start = _double(eye, "eye", (3,))
    forward = _double(center, "center", (3,)) - start
    right = np.cross(forward, _double(up, "up", (3,)))
    if not (np.linalg.norm(forward) > 0 and np.linalg.norm(right) > 0):
        raise ValueError("up: must not be along the view, nor center equal to eye")
    forward, right = forward / np.linalg.norm(forward), right / np.linalg.norm(right)
    focal = 0.5 * width_px / math.tan(0.5 * math.radians(fov_deg))
    intrinsic = np.array([[focal, 0, 0.5 * width_px], [0, focal, 0.5 * height_px], [0, 0, 1]])
    rotation = np.stack([-right, np.cross(right, forward), forward])  # turned by 180 degrees, as in Open3D
    return _like(center, _pinhole(intrinsic, rotation, start, width_px, height_px))


class _Namespace:
    """A module of Open3D in which some names are replaced by limn's."""

    def __init__(self, module: str, **own: Any) -> None:
        self.__dict__ |= {"_module": module} | own

    def __getattr__(self, name: str) -> Any:
        return getattr(importlib.import_module(self._module), name)


t = _Namespace("open3d.t", geometry=_Namespace("open3d.t.geometry", RaycastingScene=RaycastingScene))


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    try:
        return getattr(importlib.import_module("open3d"), name)
    except ModuleNotFoundError:
        raise AttributeError(f"limn.open3d has no '{name}', and Open3D, which may have it, is not installed") from None
