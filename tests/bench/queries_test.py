"""The report on queries: its tables, and the meshes that it makes itself."""

import importlib.util
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "apps/bench"))
import queries_tables as tables


def cells(row):
    return [cell.strip() for cell in row.strip("|").split("|")]


class Rows(unittest.TestCase):
    def test_a_speed_is_bold_where_it_is_short_of_its_goal_as_printed(self):
        for ours, text in ((1.5, "1.50"), (1.496, "1.50"), (1.494, "**1.49**"), (150, "150"), (1e5, "100,000")):
            self.assertEqual(cells(tables.speed("x", ours, 1, 1.5))[3:], [text, "at least 1.5"])

    def test_a_time_is_bold_where_it_is_longer_than_its_goal(self):
        found = {"one_hit_rays": 1000, "one_hit_nearest": 1e-3, "one_hit_all": 1.3e-3, "one_hit_nearest_batch": 1e-3,
                 "one_hit_all_batch": 1.31e-3}
        rows = [cells(row) for row in tables.one_hit_rows("x", found)]
        self.assertEqual([row[1:4] for row in rows], [["1,300", "1,000", "1.30"], ["1,310", "1,000", "**1.31**"]])
        self.assertEqual(cells(tables.move_row("x", 4.99e-3))[1], "4.99")
        self.assertEqual(cells(tables.move_row("x", 5e-3))[1], "**5.00**")

    def test_what_has_no_threads_is_compared_on_its_one(self):
        rates = {("cast", "limn", 1): 3, ("cast", "open3d", 1): 2, ("cast", "limn", 0): 5, ("cast", "open3d", 0): 4,
                 ("first", "limn.trimesh", 1): 3, ("first", "limn.trimesh", 0): 6, ("first", "embreex", 1): 2}
        rows = {row[0]: row[1:] for row in map(cells, tables.python_rows("x", rates))}
        self.assertEqual(len(rows), 2 * len(tables.PAIRS))
        self.assertEqual(rows["x, `cast_rays`, all threads: limn, Open3D"][:3], ["5", "4", "**1.25**"])
        first = "x, `intersects_first`, {}: limn.trimesh, embreex (through trimesh)"
        self.assertEqual(rows[first.format("one thread")][:3], ["3", "2", "**1.50**"])
        self.assertEqual(rows[first.format("all threads") + " on its one"][:3], ["6", "2", "3.00"])

    def test_what_is_missing_leaves_a_dash(self):
        found = {"rays": 1e6, "nearest": 0.5, "nearest_batch": 0.4, "nearest_threads": 0.2}
        self.assertEqual([cells(row)[1:4] for row in tables.cpp_rows("x", found, None)],
                         [["2", "–", "–"], ["2.5", "–", "–"], ["5", "–", "–"]])
        self.assertEqual([cells(row)[3] for row in tables.cpp_rows("x", found, 10)], ["20.00", "25.00", "50.00"])
        self.assertEqual(cells(tables.wrong_answers(["limn", "cgal"], [("x", {"limn": [0, None], "cgal": None})])
                               .splitlines()[-1]), ["x", "0 / –", "failed"])


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
