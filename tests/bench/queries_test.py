"""The meshes that the report on queries makes itself."""

import importlib.util
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "apps/bench"))


@unittest.skipUnless(importlib.util.find_spec("numpy"), "numpy is not installed")
class Meshes(unittest.TestCase):
    def test_those_of_solids_are_closed_and_their_normals_point_outward(self):
        import queries_rays
        for name, vertices, faces in queries_rays.meshes([]):
            self.assertEqual(queries_rays.is_closed(vertices, faces), name != "soup", name)
            if name != "soup":
                a, b, c = (vertices[faces[:, k]].astype(float) for k in range(3))
                volumes = queries_rays.np.einsum("ij,ij->i", queries_rays.np.cross(a, b), c)
                self.assertGreater(volumes.sum(), 0, name)

    def test_the_knot_is_its_own_whatever_its_size_and_no_triangle_is_flat(self):
        import queries_rays
        for along, around in ((60, 20), (300, 117)):
            points, faces = queries_rays.knot(along, around)
            vertices = queries_rays.on_grid(points)
            self.assertEqual(len(faces), 2 * along * around)
            self.assertTrue(queries_rays.is_closed(vertices, faces))
            a, b, c = (vertices[faces[:, k]] for k in range(3))
            self.assertTrue(queries_rays.np.cross(b - a, c - a).any(axis=1).all())

    def test_a_start_on_a_face_is_neither_inside_nor_outside_and_no_hit(self):
        import queries_rays
        from meshes import box  # in tests/python, which queries_rays knows
        vertices, faces = box()
        rays = queries_rays.np.array([[4, 1, 2, 1, 0, 0], [1, 4, 2, 5, 3, 2], [1, 2, 3, 1, 0, 0], [-1, 2, 3, 1, 0, 0],
                                      [0, 0, 1, 1, 1, 0]])
        nearest, inside = queries_rays.truth(vertices.astype(int) * 4, faces.astype(int), rays, True)
        self.assertEqual(inside.tolist(), [-1, -1, 1, 0, -1])
        self.assertEqual(nearest.tolist(), [float("inf")] * 2 + [3, 1, 4])


if __name__ == "__main__":
    unittest.main()
