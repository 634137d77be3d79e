"""limn.open3d.RaycastingScene: three programs in the manner of Open3D's documentation, with another import.

A program names `o3d`, the module that it imports. LIMN_OPEN3D=1 runs the programs with Open3D's own module too, for meshes
and answers to compare; otherwise meshes come from what looks like Open3D's.
"""

import importlib.util
import os
import types
import unittest

import numpy as np

import limn.open3d
from meshes import box, icosphere, uv_sphere

WITH_OPEN3D = os.environ.get("LIMN_OPEN3D") == "1"


def tensor_mesh(mesh):
    """An open3d.t.geometry.TriangleMesh, or what looks like one."""
    if WITH_OPEN3D:
        import open3d
        made = open3d.t.geometry.TriangleMesh()
        made.vertex.positions = open3d.core.Tensor(mesh[0])
        made.triangle.indices = open3d.core.Tensor(mesh[1].astype(np.int32))
        return made
    return types.SimpleNamespace(vertex={"positions": mesh[0]}, triangle={"indices": mesh[1].astype(np.int32)})


def depth_image(o3d):
    """The depth of a cube, as a pinhole camera sees it."""
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(tensor_mesh(box()))
    rays = scene.create_rays_pinhole(fov_deg=60, center=[0.5, 0.5, 0.5], eye=[-1, -1, -1], up=[0, 0, 1],
                                     width_px=320, height_px=240)
    answer = scene.cast_rays(rays)
    hit = answer["t_hit"].isfinite()
    points = rays[hit][:, :3] + rays[hit][:, 3:] * answer["t_hit"][hit].reshape((-1, 1))
    return {name: value.numpy() for name, value in answer.items()} | {"points": points.numpy(), "rays": rays.numpy()}


def closest_geometry(o3d):
    """Distance and nearest object on a grid around a cube and a ball; the sign by counting."""
    scene = o3d.t.geometry.RaycastingScene()
    ball, moved = icosphere(2), np.array([0.7, 0.8, 0], np.float32)
    names = {scene.add_triangles(tensor_mesh(box((-1.2, -1.2, 0), (-0.2, -0.2, 1)))): "cube",
             scene.add_triangles(tensor_mesh((ball[0] / 2 + moved, ball[1]))): "ball"}
    grid = np.linspace([-2, -2, -2], [2, 2, 2], num=20)
    points = np.stack(np.meshgrid(*grid.T), axis=-1).astype(np.float32)
    closest = scene.compute_closest_points(points)
    distance = np.linalg.norm(points - closest["points"].numpy(), axis=-1)
    rays = np.concatenate([points, np.ones_like(points)], axis=-1)
    inside = scene.count_intersections(rays).numpy() % 2 == 1
    distance[inside] *= -1
    return {"names": names, "distance": distance, "ids": closest["geometry_ids"].numpy(), "inside": inside}


def listed(o3d):
    """All hits of a grid of rays, and where they are by the weights of the triangles' vertices."""
    scene = o3d.t.geometry.RaycastingScene()
    mesh = uv_sphere(1.0)
    scene.add_triangles(tensor_mesh(mesh))
    x, y = np.meshgrid(np.linspace(-1, 1, 10), np.linspace(-1, 1, 10))
    start = np.stack([x, y, np.full_like(x, -2)], axis=-1).reshape(-1, 3)
    rays = np.concatenate([start, np.full(start.shape, (0, 0, 4))], axis=-1).astype(np.float32)
    lists = {name: value.numpy() for name, value in scene.list_intersections(rays).items()}
    corners = mesh[0][mesh[1][lists["primitive_ids"]]]
    u, v = lists["primitive_uvs"].T[:, :, None]
    by_weights = corners[:, 1] * u + corners[:, 2] * v + corners[:, 0] * (1 - u - v)
    of_ray = rays[lists["ray_ids"]]
    return lists | {"by_weights": by_weights, "by_t": of_ray[:, :3] + of_ray[:, 3:] * lists["t_hit"][..., None]}


class Programs(unittest.TestCase):
    def test_a_depth_image_has_its_points_on_the_faces(self):
        answer = depth_image(limn.open3d)
        self.assertEqual(answer["t_hit"].shape, (240, 320))
        self.assertEqual(answer["t_hit"].dtype, np.float32)
        hit = np.isfinite(answer["t_hit"])
        self.assertTrue(0.05 < hit.mean() < 0.95)
        on_face = (np.abs(answer["points"] - np.rint(answer["points"])).min(axis=1) < 1e-6)
        self.assertTrue(on_face.all())
        np.testing.assert_array_equal(answer["primitive_ids"] == limn.INVALID_ID, ~hit)

    def test_closest_geometry_has_the_right_object_and_the_inside(self):
        answer = closest_geometry(limn.open3d)
        self.assertEqual(list(answer["names"].values()), ["cube", "ball"])
        grid = np.linspace([-2, -2, -2], [2, 2, 2], num=20)
        points = np.stack(np.meshgrid(*grid.T), axis=-1)
        in_cube = ((points > [-1.2, -1.2, 0]) & (points < [-.2, -.2, 1])).all(axis=-1)
        from_ball = np.linalg.norm(points - [0.7, 0.8, 0], axis=-1)
        sure = np.abs(from_ball - 0.5) > 0.05
        np.testing.assert_array_equal(answer["inside"][sure], (in_cube | (from_ball < 0.5))[sure])
        self.assertTrue((answer["ids"][in_cube] == 0).all() and (answer["ids"][from_ball < 0.5] == 1).all())

    def test_listed_hits_have_the_same_points_by_weights_and_by_t(self):
        answer = listed(limn.open3d)
        np.testing.assert_allclose(answer["by_weights"], answer["by_t"], atol=1e-6)
        self.assertEqual(answer["ray_splits"].dtype, np.uint32)
        self.assertEqual(answer["ray_splits"][-1], len(answer["ray_ids"]))

    @unittest.skipUnless(WITH_OPEN3D, "LIMN_OPEN3D=1 compares with Open3D")
    def test_open3d_itself_agrees(self):
        import open3d
        for program in (depth_image, closest_geometry, listed):
            ours, theirs = program(limn.open3d), program(open3d)
            self.assertEqual(list(ours["names"]) if "names" in ours else 0, list(theirs["names"]) if "names" in theirs else 0)
            for name in ("t_hit", "rays", "distance", "primitive_normals"):
                if name in ours and program is not listed:
                    np.testing.assert_allclose(ours[name], theirs[name], atol=2e-5, err_msg=name)
                    self.assertEqual(ours[name].dtype, theirs[name].dtype, name)


class Interface(unittest.TestCase):
    def setUp(self):
        self.scene = limn.open3d.RaycastingScene(nthreads=1)
        self.scene.add_triangles(*box())
        self.rays = np.array([[[.25, .5, 9, 0, 0, -1]], [[5, 5, 5, 1, 0, 0]]], np.float32)

    def test_types_and_ids_are_open3ds(self):
        hits = self.scene.cast_rays(self.rays, nthreads=1)
        for name, dtype in (("t_hit", "float32"), ("geometry_ids", "uint32"), ("primitive_ids", "uint32"),
                            ("primitive_uvs", "float32"), ("primitive_normals", "float32")):
            self.assertIs(type(hits[name].numpy()), np.ndarray)
            self.assertEqual(hits[name].numpy().dtype, dtype)
        self.assertEqual(self.scene.INVALID_ID, 4294967295)
        self.assertEqual(hits["geometry_ids"].numpy()[1, 0], limn.open3d.RaycastingScene.INVALID_ID)
        self.assertEqual(self.scene.test_occlusions(self.rays, tnear=0.0, tfar=5.0).numpy().tolist(), [[False], [False]])
        self.assertEqual(self.scene.count_intersections(self.rays).numpy().dtype, np.int32)
        points = np.array([[.5, .5, .5], [-1, -1, 0]], np.float32)
        self.assertEqual(self.scene.compute_occupancy(points, nsamples=3).numpy().tolist(), [1, 0])
        self.assertEqual(self.scene.compute_signed_distance(points).numpy().dtype, np.float32)

    def test_triangles_may_be_added_between_questions(self):
        self.assertEqual(self.scene.cast_rays(self.rays)["t_hit"].numpy()[0, 0], 8)
        self.assertEqual(self.scene.add_triangles(*box((0, 0, 4), (1, 1, 5))), 1)
        self.assertEqual(self.scene.cast_rays(self.rays)["t_hit"].numpy()[0, 0], 4)

    def test_lists_dlpack_and_empty_arrays_are_taken(self):
        class Speaker:
            def __init__(self, array):
                self.array = array

            def __dlpack__(self, **named):
                return self.array.__dlpack__(**named)

            def __dlpack_device__(self):
                return self.array.__dlpack_device__()

        truth = self.scene.cast_rays(self.rays)["t_hit"].numpy()
        for given in (self.rays.tolist(), Speaker(self.rays), self.rays.astype(np.float64), self.rays[::-1][::-1]):
            np.testing.assert_array_equal(self.scene.cast_rays(given)["t_hit"].numpy(), truth)
        self.assertEqual(self.scene.cast_rays(self.rays[:0])["primitive_uvs"].numpy().shape, (0, 1, 2))
        self.assertEqual(self.scene.list_intersections(np.zeros((0, 6), np.float32))["ray_splits"].numpy().tolist(), [0])
        self.assertEqual(self.scene.compute_closest_points(np.zeros((0, 3), np.float32))["points"].numpy().shape, (0, 3))
        other = limn.open3d.RaycastingScene()
        self.assertEqual(other.add_triangles(vertices=Speaker(box()[0]), triangles=box()[1].tolist()), 0)

    def test_older_meshes_are_taken(self):
        older = types.SimpleNamespace(vertices=box()[0].astype(np.float64), triangles=box()[1].astype(np.int32))
        scene = limn.open3d.RaycastingScene()
        self.assertEqual(scene.add_triangles(older), 0)
        self.assertEqual(scene.cast_rays(self.rays)["t_hit"].numpy()[0, 0], 8)

    def test_pinholes_of_matrices_and_of_views_agree(self):
        """Of an eye on the z axis, whose picture Open3D turns by half a turn."""
        intrinsic = [[160, 0, 160], [0, 160, 120], [0, 0, 1]]
        extrinsic = np.diag([-1.0, 1, -1, 1])  # x to the left, y upward, z away from the eye
        extrinsic[:3, 3] = -extrinsic[:3, :3] @ [0, 0, 5]
        pinhole = limn.open3d.RaycastingScene.create_rays_pinhole
        by_view = pinhole(90, [0, 0, 0], [0, 0, 5], [0, 1, 0], 320, 240).numpy()
        np.testing.assert_allclose(pinhole(intrinsic, extrinsic, 320, 240).numpy(), by_view, atol=1e-6)
        self.assertEqual(by_view.shape, (240, 320, 6))
        self.assertEqual(by_view.dtype, np.float32)

    def test_errors_name_the_argument(self):
        for name, kind, call in (
                ("rays", ValueError, lambda: self.scene.cast_rays(np.zeros((6, 4), np.float32))),
                ("rays", ValueError, lambda: self.scene.cast_rays(np.zeros(6, np.float32))),
                ("rays", TypeError, lambda: self.scene.cast_rays(np.zeros((2, 6), int))),
                ("rays", TypeError, lambda: self.scene.cast_rays("rays")),
                ("query_points", ValueError, lambda: self.scene.compute_distance(self.rays)),
                ("nsamples", ValueError, lambda: self.scene.compute_occupancy(np.zeros((1, 3), np.float32), 0, 2)),
                ("vertex_positions", TypeError, lambda: self.scene.add_triangles(box()[0].astype(np.float64), box()[1])),
                ("triangle_indices", ValueError, lambda: self.scene.add_triangles(box()[0], [[0, 1, 99]])),
                ("triangle_indices", TypeError, lambda: self.scene.add_triangles(box()[0], [[0.5, 1, 2]])),
                ("tfar", ValueError, lambda: self.scene.test_occlusions(self.rays, tnear=3.0, tfar=1.0)),
                ("fov_deg", ValueError, lambda: self.scene.create_rays_pinhole(0, [0, 0, 0], [0, 0, 1], [0, 1, 0], 5, 5)),
                ("fov_deg", ValueError, lambda: self.scene.create_rays_pinhole(np.nan, [0, 0, 0], [0, 0, 1], [0, 1, 0], 5, 5)),
                ("intrinsic_matrix", ValueError,
                 lambda: self.scene.create_rays_pinhole(np.zeros((3, 3)), np.eye(4), 5, 5)),
                ("mesh", TypeError, lambda: self.scene.add_triangles("mesh")),
                ("device", ValueError, lambda: limn.open3d.RaycastingScene(device="CUDA:0")),
                ("width_px", ValueError, lambda: self.scene.create_rays_pinhole(60, [0, 0, 0], [0, 0, 1], [0, 1, 0], 0, 5)),
                ("up", ValueError, lambda: self.scene.create_rays_pinhole(60, [0, 0, 0], [0, 0, 1], [0, 0, 1], 5, 5))):
            with self.assertRaises(kind) as caught:
                call()
            self.assertRegex(str(caught.exception), rf"^{name}\b")

    def test_names_that_are_not_limns_are_open3ds(self):
        if importlib.util.find_spec("open3d"):
            self.assertIs(limn.open3d.core, importlib.import_module("open3d").core)
        else:
            with self.assertRaisesRegex(AttributeError, "visualization.*not installed"):
                limn.open3d.visualization


if __name__ == "__main__":
    unittest.main()
