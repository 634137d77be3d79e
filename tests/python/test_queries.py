"""limn.CompiledScene: keys, shapes and types, truth, threads, memory."""

import gc
import threading
import time
import unittest

import numpy as np

import limn
from meshes import box, directions, icosphere, inverted, joined, resident


def compiled(*meshes):
    scene = limn.Scene()
    for mesh in meshes:
        scene.add_triangles(*mesh)
    return scene.compile()


class Answers(unittest.TestCase):
    def test_hits_have_open3ds_keys_shapes_and_types(self):
        scene = compiled(box(), box((5, 0, 0), (6, 1, 1)))
        rays = np.array([[[.25, .5, 9, 0, 0, -1], [5.25, .5, 9, 0, 0, -2]], [[.25, .5, 9, 0, 0, 1], [3, 3, 3, 1, 0, 0]]])
        hits = scene.cast_rays(rays)
        self.assertEqual(list(hits), ["t_hit", "geometry_ids", "primitive_ids", "primitive_uvs", "primitive_normals"])
        for name, shape, dtype in (("t_hit", (2, 2), "float64"), ("geometry_ids", (2, 2), "uint32"),
                                   ("primitive_ids", (2, 2), "uint32"), ("primitive_uvs", (2, 2, 2), "float64"),
                                   ("primitive_normals", (2, 2, 3), "float64")):
            self.assertIs(type(hits[name]), np.ndarray)
            self.assertEqual((hits[name].shape, hits[name].dtype), (shape, dtype), name)
        np.testing.assert_array_equal(hits["t_hit"], [[8, 4], [np.inf, np.inf]])
        np.testing.assert_array_equal(hits["geometry_ids"], [[0, 1], [limn.INVALID_ID] * 2])
        np.testing.assert_array_equal(hits["primitive_normals"], [[[0, 0, 1]] * 2, [[0, 0, 0]] * 2])
        single = scene.cast_rays(rays.astype(np.float32), dtype="float32")
        self.assertEqual(single["t_hit"].dtype, "float32")
        np.testing.assert_array_equal(single["t_hit"], hits["t_hit"])

    def test_uvs_are_the_weights_of_the_second_and_third_vertex(self):
        mesh = icosphere(3)
        rng = np.random.default_rng(3)
        rays = np.concatenate([np.zeros((500, 3)), directions(rng, 500)], 1)
        hits = compiled(mesh).cast_rays(rays)
        a, b, c = (mesh[0][mesh[1][hits["primitive_ids"], k]].astype(np.float64) for k in range(3))
        u, v = hits["primitive_uvs"].T[:, :, None]
        np.testing.assert_allclose((1 - u - v) * a + u * b + v * c, rays[:, 3:] * hits["t_hit"][:, None], atol=1e-12)
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        np.testing.assert_allclose(hits["primitive_normals"], normals, atol=1e-12)  # outward, though met from inside

    def test_rays_at_vertices_and_edges_of_a_closed_mesh_never_miss_and_cross_it_once(self):
        vertices, faces = icosphere(5)
        ends = vertices[faces].astype(np.float64)
        targets = np.concatenate([vertices.astype(np.float64), ends[:, :2].mean(axis=1)])
        rays = np.concatenate([np.full_like(targets, 0.1), targets - 0.1], axis=1)
        scene = compiled((vertices, faces))
        self.assertTrue(np.isfinite(scene.cast_rays(rays)["t_hit"]).all())
        self.assertTrue(scene.test_occlusions(rays).all())
        self.assertTrue((scene.count_intersections(rays) == 1).all())
        lists = scene.list_intersections(rays)
        self.assertTrue((np.diff(lists["ray_splits"]) >= 1).all())
        self.assertEqual(lists["ray_splits"][-1], len(lists["t_hit"]))

    def test_lists_go_ray_after_ray_by_distance(self):
        scene = compiled(box(), box((0, 0, 2), (1, 1, 3)))
        rays = np.array([[.25, .5, 9, 0, 0, -1], [9, 9, 9, 1, 0, 0], [.25, .5, 2.5, 0, 0, -1]])
        lists = scene.list_intersections(rays)
        np.testing.assert_array_equal(lists["ray_splits"], [0, 4, 4, 7])
        np.testing.assert_array_equal(lists["ray_ids"], [0, 0, 0, 0, 2, 2, 2])
        np.testing.assert_array_equal(lists["t_hit"], [6, 7, 8, 9, .5, 1.5, 2.5])
        np.testing.assert_array_equal(lists["geometry_ids"], [1, 1, 0, 0, 1, 0, 0])
        np.testing.assert_array_equal(scene.count_intersections(rays), [4, 0, 3])

    def test_ends_of_rays_count(self):
        scene = compiled(box())
        ray = np.array([[.25, .5, 2, 0, 0, -1.0]])
        self.assertTrue(scene.test_occlusions(ray, t_max=1.0)[0])
        self.assertFalse(scene.test_occlusions(ray, t_max=0.99)[0])
        self.assertEqual(scene.cast_rays(ray, t_min=1.0)["t_hit"][0], 2)  # t_min itself is out
        self.assertEqual(scene.count_intersections(ray, t_min=0.5, t_max=1.5)[0], 1)

    def test_inside_distance_and_nearest_point_agree_in_a_hollow_box(self):
        scene = compiled(box((-2, -2, -2), (2, 2, 2)), inverted(box((-1, -1, -1), (1, 1, 1))))
        points = np.array([[0, 0, 0], [1.5, 0, 0], [3, 0, 0], [2, 0, 0], [1, 1, 1]], float)
        np.testing.assert_array_equal(scene.contains(points), [False, True, False, True, True])
        np.testing.assert_array_equal(scene.winding_number(points[:3]), [0, 1, 0])
        np.testing.assert_array_equal(scene.compute_distance(points), [1, .5, 1, 0, 0])
        np.testing.assert_array_equal(scene.compute_signed_distance(points), [1, -.5, 1, 0, 0])
        nearest = scene.compute_closest_points(points[1:3])
        self.assertEqual(list(nearest), ["points", "geometry_ids", "primitive_ids", "primitive_uvs", "primitive_normals"])
        np.testing.assert_array_equal(nearest["points"][1], [2, 0, 0])
        np.testing.assert_array_equal(nearest["geometry_ids"][1], 0)
        np.testing.assert_array_equal(nearest["primitive_normals"][1], [1, 0, 0])
        np.testing.assert_array_equal(scene.compute_closest_points(np.array([[2., 0, 0]]))["primitive_normals"], [[1, 0, 0]])
        self.assertEqual(scene.open_edges(), 0)
        vertices, faces = box()
        self.assertEqual(compiled((vertices, faces[:-1].copy())).open_edges(), 3)

    def test_other_shapes_answer_too(self):
        scene = limn.Scene()
        scene.add(limn.Sphere((0, 0, 0), 2))
        scene.add(limn.Instance(limn.make_box((0, 0, 0), (1, 1, 1)), [[2, 0, 0, 5], [0, 2, 0, 0], [0, 0, 2, 0]]))
        scene = scene.compile()
        rays = np.array([[0, 0, 9, 0, 0, -1], [6.5, .5, 9, 0, 0, -1]], float)
        hits = scene.cast_rays(rays)
        np.testing.assert_array_equal(hits["t_hit"], [7, 7])
        np.testing.assert_array_equal(hits["primitive_normals"], [[0, 0, 1]] * 2)
        np.testing.assert_array_equal(scene.contains(np.array([[0, 0, 1.5], [6, 1, 1], [4, 0, 0]])), [True, True, False])
        nearest = scene.compute_closest_points(np.array([[0, 0, 5.0]]))
        np.testing.assert_array_equal(nearest["points"], [[0, 0, 2]])
        np.testing.assert_array_equal(nearest["primitive_normals"], [[0, 0, 1]])

    def test_an_empty_scene_has_nothing(self):
        scene = limn.Scene().compile()
        self.assertEqual(scene.cast_rays(np.array([[0, 0, 0, 1, 0, 0.0]]))["t_hit"][0], np.inf)
        self.assertEqual(scene.compute_distance(np.zeros((1, 3)))[0], np.inf)
        nearest = scene.compute_closest_points(np.zeros((1, 3)))
        self.assertTrue(np.isnan(nearest["points"]).all())
        self.assertEqual(nearest["geometry_ids"][0], limn.INVALID_ID)

    def test_rays_that_cannot_be_used_miss(self):
        scene = compiled(box((-1, -1, -1), (1, 1, 1)))
        rays = np.zeros((3, 6))
        rays[:, 3] = [1, np.nan, 0]
        np.testing.assert_array_equal(np.isfinite(scene.cast_rays(rays)["t_hit"]), [True, False, False])
        np.testing.assert_array_equal(scene.test_occlusions(rays), [True, False, False])
        np.testing.assert_array_equal(scene.count_intersections(rays), [1, 0, 0])
        self.assertFalse(scene.contains(np.array([[np.nan, 0, 0]]))[0])
        self.assertEqual(scene.compute_distance(np.array([[np.nan, 0, 0]]))[0], np.inf)


class Behaviour(unittest.TestCase):
    def setUp(self):
        self.scene = compiled(icosphere(4))
        rng = np.random.default_rng(1)
        self.rays = np.concatenate([3 * directions(rng, 20000), rng.normal(size=(20000, 3))], 1)
        self.points = rng.uniform(-1.2, 1.2, (20000, 3))

    def test_answers_do_not_depend_on_threads(self):
        for name, rows in (("cast_rays", self.rays), ("test_occlusions", self.rays), ("count_intersections", self.rays),
                           ("list_intersections", self.rays), ("contains", self.points),
                           ("compute_signed_distance", self.points), ("compute_closest_points", self.points)):
            ask = getattr(self.scene, name)
            one = ask(rows, threads=1)
            for threads in (0, 2, 5):
                other = ask(rows, threads=threads)
                for key in one if isinstance(one, dict) else [...]:
                    np.testing.assert_array_equal(one[key], other[key], f"{name}, {threads} threads")

    def test_input_is_not_copied(self):
        rays = np.tile(self.rays, (100, 1))  # 96 MB
        self.scene.test_occlusions(self.rays)
        before, most, done = resident(), 0, threading.Event()

        def ask():
            self.scene.test_occlusions(rays)
            done.set()

        thread = threading.Thread(target=ask)
        thread.start()
        while not done.wait(0.002):
            most = max(most, resident())
        thread.join()
        self.assertLess(most - before, 24e6)

    def test_the_interpreters_lock_is_let_go(self):
        rays = np.tile(self.rays, (100, 1))
        span = []

        def ask():
            begin = time.perf_counter()
            self.scene.cast_rays(rays)
            span.extend((begin, time.perf_counter()))

        thread = threading.Thread(target=ask)
        thread.start()
        times = []
        while thread.is_alive():
            times.append(time.perf_counter())
            time.sleep(0.001)
        first, last = span[0] + 0.2 * (span[1] - span[0]), span[0] + 0.8 * (span[1] - span[0])
        self.assertTrue(any(first < t < last for t in times))

    def test_many_threads_may_ask_at_once(self):
        truth = self.scene.cast_rays(self.rays, 1)["t_hit"]
        wrong = []

        def ask():
            for _ in range(5):
                if not np.array_equal(self.scene.cast_rays(self.rays)["t_hit"], truth):
                    wrong.append(1)

        threads = [threading.Thread(target=ask) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_memory_stays_flat(self):
        rays, points = self.rays[:50].copy(), self.points[:50].copy()
        mesh = box()

        def some(count):
            for _ in range(count):
                self.scene.cast_rays(rays)
                self.scene.list_intersections(rays)
                self.scene.compute_closest_points(points)
                with self.assertRaises(ValueError):
                    self.scene.cast_rays(points)
            for _ in range(count // 10):
                compiled(mesh).contains(points)

        some(1000)
        gc.collect()
        before = resident()
        some(10000)
        gc.collect()
        self.assertLess(resident() - before, 3e6)

    def test_large_answers_keep_their_memory_until_they_go(self):
        scene = compiled(box())
        at = lambda x: np.tile([x, .5, 9, 0, 0, -1.0], (300_000, 1))
        first = scene.cast_rays(at(.5))
        kept = {name: array.copy() for name, array in first.items()}
        second = scene.cast_rays(at(9))
        for name, array in first.items():
            self.assertTrue(np.array_equal(array, kept[name]), name)
        part = first["primitive_normals"][7:9]
        del first
        gc.collect()
        for _ in range(4):  # these may get what has gone, but not what is still seen
            third = scene.cast_rays(at(.25))
            self.assertTrue(np.array_equal(part, kept["primitive_normals"][7:9]))
            self.assertTrue((third["t_hit"] == 8).all())
            del third
        self.assertTrue(np.isinf(second["t_hit"]).all())

    def test_the_description_may_go_and_change(self):
        scene = limn.Scene()
        number = scene.add_triangles(*box())
        first = scene.compile()
        self.assertEqual((number, scene.add_triangles(*box((0, 0, 2), (1, 1, 3)))), (0, 1))
        second = scene.compile()
        del scene
        gc.collect()
        ray = np.array([[.25, .5, 9, 0, 0, -1.0]])
        self.assertEqual((first.cast_rays(ray)["t_hit"][0], second.cast_rays(ray)["t_hit"][0]), (8, 6))

    def test_meshes_may_touch(self):
        scene = compiled(joined(box(), box((1, 0, 0), (2, 1, 1))))
        self.assertEqual(scene.count_intersections(np.array([[-1, .5, .5, 1, 0, 0.0]]))[0], 4)


if __name__ == "__main__":
    unittest.main()
