"""The meshes and the truth by which queries are judged."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "apps/bench"))
try:
    import numpy as np
except ImportError:
    sys.exit(77)  # skipped

import queries
from meshes import box  # in tests/python, which queries knows


class Truth(unittest.TestCase):
    def test_solids_are_closed_and_their_normals_point_outward(self):
        for name, (vertices, faces) in queries.meshes([]).items():
            self.assertTrue(queries.is_closed(vertices, faces), name)
            a, b, c = (vertices[faces[:, k]].astype(float) for k in range(3))
            self.assertGreater(np.einsum("ij,ij->i", np.cross(a, b), c).sum(), 0, name)
            self.assertFalse(queries.is_closed(vertices, faces[1:]), name)

    def test_a_start_on_a_face_is_neither_inside_nor_outside_and_no_hit(self):
        vertices, faces = box()
        rays = np.array([[4, 1, 2, 1, 0, 0], [1, 4, 2, 5, 3, 2], [1, 2, 3, 1, 0, 0], [-1, 2, 3, 1, 0, 0],
                         [0, 0, 1, 1, 1, 0]])
        nearest, inside = queries.truth(vertices.astype(int) * 4, faces.astype(int), rays)
        self.assertEqual(inside.tolist(), [-1, -1, 1, 0, -1])
        self.assertEqual(nearest.tolist(), [float("inf")] * 2 + [3, 1, 4])


if __name__ == "__main__":
    unittest.main()
