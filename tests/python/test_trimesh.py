"""limn.trimesh.RayMeshIntersector beside trimesh's own, on rays through the insides of triangles."""

import copy
import dataclasses
import pickle
import unittest

import numpy as np
import trimesh
from trimesh.ray.ray_triangle import RayMeshIntersector as Theirs

from limn.trimesh import RayMeshIntersector
from meshes import MeshObject, box, directions, icosphere


class Trimesh(unittest.TestCase):
    def setUp(self):
        mesh = icosphere(2)
        self.mesh = trimesh.Trimesh(mesh[0].astype(np.float64), mesh[1], process=False)
        self.ours, self.theirs = RayMeshIntersector(self.mesh), Theirs(self.mesh)
        rng = np.random.default_rng(5)
        self.origins = 2 * directions(rng, 300)
        self.ways = rng.uniform(-0.8, 0.8, (300, 3)) - self.origins

    def test_intersects_location(self):
        for multiple in (True, False):
            ours = self.ours.intersects_location(self.origins, self.ways, multiple_hits=multiple)
            theirs = self.theirs.intersects_location(self.origins, self.ways, multiple_hits=multiple)
            for one, other in zip(self._sorted(*ours), self._sorted(*theirs)):
                np.testing.assert_allclose(one, other, atol=1e-9)
            self.assertEqual([part.dtype for part in ours], [part.dtype for part in theirs])

    @staticmethod
    def _sorted(locations, index_ray, index_tri):
        order = np.lexsort((index_tri, index_ray))
        return locations[order], index_ray[order], index_tri[order]

    def test_intersects_id(self):
        tri, ray = self.ours.intersects_id(self.origins, self.ways)
        their_tri, their_ray = self.theirs.intersects_id(self.origins, self.ways)
        self.assertEqual(sorted(zip(ray, tri)), sorted(zip(their_ray, their_tri)))
        tri, ray, locations = self.ours.intersects_id(self.origins, self.ways, max_hits=1, return_locations=True)
        self.assertEqual((len(np.unique(ray)), locations.shape), (len(ray), (len(ray), 3)))

    def test_intersects_first_and_any(self):
        first = self.ours.intersects_first(self.origins, self.ways)
        np.testing.assert_array_equal(first, self.theirs.intersects_first(self.origins, self.ways))
        np.testing.assert_array_equal(self.ours.intersects_any(self.origins, self.ways), first != -1)

    def test_contains_points_is_true_inside_the_ball_and_false_outside(self):
        points = np.random.default_rng(6).uniform(-1.1, 1.1, (500, 3))
        sure = np.abs(np.linalg.norm(points, axis=1) - 0.975) > 0.03
        np.testing.assert_array_equal(self.ours.contains_points(points)[sure],
                                      (np.linalg.norm(points, axis=1) < 1)[sure])

    def test_lists_and_empty_arrays_are_taken(self):
        self.assertEqual(self.ours.intersects_first([[0, 0, 5]], [[0, 0, -1]]).shape, (1,))
        locations, ray, tri = self.ours.intersects_location(np.zeros((0, 3)), np.zeros((0, 3)))
        self.assertEqual((locations.shape, ray.shape, tri.shape), ((0, 3), (0,), (0,)))
        self.assertEqual(self.ours.contains_points(np.zeros((0, 3))).shape, (0,))

    def test_a_mesh_that_is_changed_is_asked_as_it_is_now(self):
        self.assertTrue(self.ours.contains_points([[0, 0, 0]])[0])
        self.mesh.apply_translation([9, 0, 0])
        self.assertFalse(self.ours.contains_points([[0, 0, 0]])[0])

    def test_it_takes_the_place_of_mesh_ray(self):
        self.mesh.ray = self.ours
        self.assertTrue(self.mesh.contains([[0, 0, 0]])[0])

    def test_copies_and_pickles_answer_alike(self):
        for other in (copy.copy(self.ours), copy.deepcopy(self.ours), pickle.loads(pickle.dumps(self.ours))):
            np.testing.assert_array_equal(other.intersects_first(self.origins, self.ways),
                                          self.ours.intersects_first(self.origins, self.ways))

    def test_a_mesh_need_not_be_trimeshs(self):
        self.assertEqual(RayMeshIntersector(MeshObject(box())).intersects_any([[.2, .3, 5]], [[0, 0, -1]]).tolist(), [True])

    def test_a_mesh_without_a_hash_of_its_own_is_asked_as_it_is_now(self):
        @dataclasses.dataclass
        class Unhashable:
            vertices: np.ndarray
            faces: np.ndarray

        class ByIdentity:
            pass

        plain = ByIdentity()
        plain.vertices, plain.faces = box()
        for mesh in (Unhashable(*box()), plain):
            ours, inside = RayMeshIntersector(mesh), box()[0].mean(axis=0, keepdims=True)
            self.assertTrue(ours.contains_points(inside)[0])
            mesh.vertices = mesh.vertices + np.float32(9)
            self.assertFalse(ours.contains_points(inside)[0])

    def test_errors_name_the_argument(self):
        for name, kind, call in (
                ("ray_origins", ValueError, lambda: self.ours.intersects_any(np.zeros((3, 4)), np.zeros((3, 4)))),
                ("ray_origins", TypeError, lambda: self.ours.intersects_any("here", [[0, 0, 1]])),
                ("ray_directions", ValueError, lambda: self.ours.intersects_id([[0, 0, 0]], np.ones((2, 3)))),
                ("points", ValueError, lambda: self.ours.contains_points([0, 0, 0]))):
            with self.assertRaises(kind) as caught:
                call()
            self.assertRegex(str(caught.exception), rf"^{name}\b")


if __name__ == "__main__":
    unittest.main()
