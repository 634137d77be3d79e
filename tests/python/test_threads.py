"""What people reported of others, with their own numbers: the threads of trimesh, Open3D, Embree and DAGMC."""

import itertools
import unittest
from fractions import Fraction

import numpy as np

import limn
import limn.open3d
from limn.trimesh import RayMeshIntersector
from meshes import MeshObject, box, icosphere, inverted, joined, subdivided, uv_sphere, voxels


def open3d_scene(mesh):
    scene = limn.open3d.RaycastingScene()
    scene.add_triangles(*mesh)
    return scene


class OfTrimesh(unittest.TestCase):
    def test_242_contains_of_a_mesh_of_voxels(self):
        """100,000 points in a cube of side 1; the reporter's file is gone, the voxels here are of a ball and a torus."""
        x, y, z = (np.indices((32, 32, 32)) + 0.5) / 32 - 0.5
        filled = (x * x + y * y + z * z < 0.16) ^ ((np.hypot(x, y) - 0.3) ** 2 + z * z < 0.01)
        vertices, faces = voxels(filled)
        mesh = MeshObject((vertices / np.float32(32) - np.float32(0.5), faces))
        points = np.random.default_rng(242).random((100000, 3)) - 0.5
        cells = np.floor((points + 0.5) * 32).astype(int)
        np.testing.assert_array_equal(RayMeshIntersector(mesh).contains_points(points), filled[tuple(cells.T)])

    def test_1180_every_ray_from_inside_hits(self):
        """An array of 1024 x 512 rays around, of which one was missing: 524,287 locations."""
        a, b = np.meshgrid(np.linspace(0, 2 * np.pi, 1024), np.linspace(0, np.pi, 512))
        ways = np.stack([np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)], axis=-1).reshape(-1, 3)
        for mesh in (icosphere(3), uv_sphere(1.0, 32), box((-1, -1, -1), (1, 1, 1))):
            ray = RayMeshIntersector(MeshObject(mesh))
            locations, _, _ = ray.intersects_location(np.zeros_like(ways), ways, multiple_hits=False)
            self.assertEqual(locations.shape, (524288, 3))

    def test_1496_any_and_id_agree_at_vertices_and_edges(self):
        """From the middle of a box of side 40 to the vertices of one of side 60, both cut to edges of at most 20."""
        small = subdivided(subdivided(box((-20, -20, -20), (20, 20, 20))))
        big = subdivided(subdivided(box((-30, -30, -30), (30, 30, 30))))
        ways = big[0].astype(np.float64)
        ray = RayMeshIntersector(MeshObject(small))
        index_tri, index_ray = ray.intersects_id(np.zeros_like(ways), ways, multiple_hits=False)
        self.assertTrue(ray.intersects_any(np.zeros_like(ways), ways).all())
        np.testing.assert_array_equal(index_ray, np.arange(len(ways)))
        np.testing.assert_array_equal(index_tri, ray.intersects_first(np.zeros_like(ways), ways))

    def test_1766_between_two_triangles(self):
        mesh = MeshObject((np.array([[-1, -1, 0], [-1, 1, 0], [1, 1, 0], [1, -1, 0]]), np.array([[0, 1, 2], [2, 3, 0]])))
        locations, _, _ = RayMeshIntersector(mesh).intersects_location([[0, 0, 1]], [[0, 0, -1]], multiple_hits=False)
        np.testing.assert_array_equal(locations, [[0, 0, 0]])

    def test_1919_306_all_rays_at_once_or_one_by_one(self):
        vertices, faces = icosphere(2)
        normals = vertices.astype(np.float64)
        origins = normals + 0.01 * normals
        ray = RayMeshIntersector(MeshObject((vertices, faces)))
        locations, index_ray, _ = ray.intersects_location(origins, -normals, multiple_hits=False)
        np.testing.assert_array_equal(index_ray, np.arange(len(vertices)))
        np.testing.assert_allclose(locations, vertices, atol=1e-6)
        for i in range(0, len(origins), 17):
            single, _, _ = ray.intersects_location(origins[i:i + 1], -normals[i:i + 1], multiple_hits=False)
            np.testing.assert_array_equal(single[0], locations[i])

    def test_2317_triangles_at_an_edge_and_a_vertex(self):
        """One hit within a triangle, two at an edge, as many as there are triangles at a vertex; one passage each."""
        mesh = icosphere(1)
        corner = mesh[0][mesh[1][0]].astype(np.float64)
        scene = limn.Scene()
        scene.add_triangles(*mesh)
        scene = scene.compile()
        for target, triangles in ((corner.mean(axis=0), 1), ((corner[0] + corner[1]) / 2, 2), (corner[0], 5)):
            ray = np.concatenate([np.zeros(3), target])[None]
            self.assertEqual(len(scene.list_intersections(ray)["t_hit"]), triangles)
            self.assertEqual(scene.count_intersections(ray)[0], 1)

    def test_2534_a_cavity_is_outside(self):
        shell = joined(box((-.5, -.5, -.5), (.5, .5, .5)), inverted(box((-.05, -.05, -.05), (.05, .05, .05))))
        inside = RayMeshIntersector(MeshObject(shell)).contains_points([[0, 0, 0], [.2, 0, 0]])
        np.testing.assert_array_equal(inside, [False, True])

    def test_1416_boxes_that_overlap(self):
        both = joined(box((-.5, -.5, -.5), (.5, .5, .5)), box((-.2, -.2, -.2), (.8, .8, .8)))
        points = np.random.default_rng(1416).uniform(-1, 1, (20000, 3))
        truth = (np.abs(points) < .5).all(axis=1) | ((points > np.float32(-.2)) & (points < np.float32(.8))).all(axis=1)
        np.testing.assert_array_equal(RayMeshIntersector(MeshObject(both)).contains_points(points), truth)

    def test_2504_no_hit_is_listed_twice(self):
        mesh = icosphere(2)
        far = MeshObject((mesh[0] * 1e-3 + np.float32(1000), mesh[1]))
        index_tri, index_ray = RayMeshIntersector(far).intersects_id([[1000.0003, 1000.0002, 999]], [[0, 0, 1]])
        self.assertEqual(len(set(index_tri)), len(index_tri))


class OfOpen3d(unittest.TestCase):
    def test_5669_signed_distance_of_a_ball_has_no_artifacts(self):
        """A ball of radius 0.8, on a grid of 64 x 64 x 64 points over 1.1 of its bounds."""
        mesh = uv_sphere(0.8)
        edge = 1.1 * np.abs(mesh[0]).max(axis=0)
        grid = np.linspace(-edge, edge, num=64)
        points = np.stack(np.meshgrid(*grid.T), axis=-1).astype(np.float32)
        distance = open3d_scene(mesh).compute_signed_distance(points).numpy()
        radius = np.linalg.norm(points, axis=-1)
        deepest = 0.8 * (1 - np.cos(np.pi / 20))  # that a chord of 1/20 of half a turn lies below the ball
        np.testing.assert_array_less(np.abs(distance - (radius - 0.8)), 2 * deepest + 1e-6)

    def test_5105_beside_a_cube_is_outside(self):
        scene = open3d_scene(box())
        distance = scene.compute_signed_distance([[-1, -1, 0], [-1, -1, -1], [0.5, 0.5, 0.5]]).numpy()
        np.testing.assert_allclose(distance, [1.41421, 1.73205, -0.5], atol=1e-5)

    def test_5777_hits_lie_in_the_plane(self):
        """Residuals were 3e-5; in float64 a hit lies in the plane to some units of the last place."""
        vertices = np.array([[-5, -5, 0], [5, -5, 1], [0, 5, 2]], np.float32)
        scene = limn.Scene()
        scene.add_triangles(vertices, np.array([[0, 1, 2]], np.uint32))
        rng = np.random.default_rng(5777)
        targets = rng.dirichlet([1, 1, 1], 10000) @ vertices.astype(np.float64)
        origins = rng.uniform(-5, 5, (10000, 3)) + [0, 0, 30]
        t = scene.compile().cast_rays(np.concatenate([origins, targets - origins], axis=1))["t_hit"]
        points = origins + t[:, None] * (targets - origins)
        normal = np.cross(vertices[1] - vertices[0], vertices[2] - vertices[0]).astype(np.float64)
        hit = np.isfinite(t)
        self.assertGreater(hit.mean(), 0.999)  # targets at the border may be rounded to the outside
        residual = np.abs((points[hit] - vertices[0]) @ (normal / np.linalg.norm(normal)))
        self.assertLess(residual.max(), 64 * 2.0 ** -52 * 30)

    def test_6188_rays_around_a_point_beside_a_cube(self):
        """From (2, 0.5, 0.5), in the plane z = 0.5, at a cube of side 1: those within atan(1/2) of its face hit."""
        angles = np.linspace(0, 2 * np.pi, 3600, endpoint=False)
        ways = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=-1)
        rays = np.concatenate([np.tile([2, 0.5, 0.5], (3600, 1)), ways], axis=-1)
        hit = open3d_scene(box()).cast_rays(rays)["t_hit"].isfinite().numpy()
        np.testing.assert_array_equal(hit, np.abs(angles - np.pi) < np.arctan(0.5))


def exact_t(triangle, ray):
    """Where a ray meets a triangle, a Fraction; None where it misses it, or lies in its plane."""
    a, b, c = ([Fraction(float(x)) - Fraction(float(o)) for x, o in zip(corner, ray[:3])] for corner in triangle)
    way = [Fraction(float(x)) for x in ray[3:]]
    cross = lambda p, q: [p[i - 2] * q[i - 1] - p[i - 1] * q[i - 2] for i in range(3)]
    dot = lambda p, q: sum(x * y for x, y in zip(p, q))
    weights = [dot(cross(p, q), way) for p, q in ((b, c), (c, a), (a, b))]
    if sum(weights) == 0 or min(weights) < 0 < max(weights):
        return None
    t = dot(cross(a, b), c) / sum(weights)
    return t if t > 0 else None


class OfEmbree(unittest.TestCase):
    def test_188_sections_inside_and_outside_through_edges_of_thick_and_of_thin_plates(self):
        """Two hits were gathered at an edge where there is one passage, and an epsilon between hits drops true ones."""
        along = np.arange(1, 64) / 64  # on the diagonal that cuts both the upper and the lower face
        for height in (1.0, 2.0 ** -20, 2.0 ** -60):
            scene = limn.Scene()
            scene.add_triangles(*box((0, 0, 0), (1, 1, height)))
            scene = scene.compile()
            rays = np.array([[x, x, 4, 0, 0, -1] for x in along])
            np.testing.assert_array_equal(scene.count_intersections(rays), 2)
            lists = scene.list_intersections(rays)
            self.assertEqual(len(lists["t_hit"]), 4 * len(rays))  # each triangle that the ray meets
            np.testing.assert_array_equal(scene.winding_number(rays[:, :3] - [0, 0, 4 - height / 2]), 1)

    def test_387_a_skinny_triangle_is_hit_only_where_it_is(self):
        """Edges of 11.2, 9.8 and 1.45, less than 600 away, 0.52 degrees between ray and plane: a hit at t = 12291.2."""
        rng = np.random.default_rng(387)
        hits = 0
        for _ in range(400):
            turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
            foot = rng.uniform(300, 550) * np.array([np.cos(np.radians(0.52)), 0, -np.sin(np.radians(0.52))])
            side = 9.8 * np.array([0.99748, 0.07095, 0])  # 1.45 from the end of the first
            triangle = ((foot + [[0, 0, 0], [11.2, 0, 0], side]) @ turn).astype(np.float32)
            weights = rng.dirichlet([1, 1, 1]) * 1.2 - rng.dirichlet([1, 1, 1]) * 0.2  # in it and beside it
            target = weights @ triangle.astype(np.float64)
            ray = np.concatenate([np.zeros(3), target / np.linalg.norm(target)]).astype(np.float32)
            scene = limn.Scene()
            scene.add_triangles(triangle, np.array([[0, 1, 2]], np.uint32))
            t, truth = scene.compile().cast_rays(ray[None].astype(np.float64))["t_hit"][0], exact_t(triangle, ray)
            self.assertEqual(np.isfinite(t), truth is not None)
            if truth is not None:
                hits += 1
                self.assertLess(t, 600)
                self.assertLessEqual(abs(Fraction(float(t)) - truth), truth / 2 ** 32)
        self.assertTrue(100 < hits < 300)  # both are tried


class OfDagmc(unittest.TestCase):
    """#986, lost particles: those that leave one cell and are in none, or in two. Cells: 3 x 3 x 3 boxes that touch."""

    CELLS = list(itertools.product(range(3), repeat=3))

    def setUp(self):
        scene = limn.Scene()
        for cell in self.CELLS:
            scene.add_triangles(*box(cell, np.add(cell, 1)))
        self.scene = scene.compile()

    def test_986_each_point_of_faces_edges_and_vertices_is_in_one_cell(self):
        points = np.array(list(itertools.product(np.arange(-1, 9) / 2, repeat=3)))
        # An end on a surface is on the side that (e, e^2, e^3) takes it to: a cell has its lower faces.
        inside = ((points >= 0) & (points < 3)).all(axis=1)
        np.testing.assert_array_equal(self.scene.winding_number(points), inside)

    def test_986_from_within_a_cell_its_border_is_met(self):
        for number, cell in enumerate(self.CELLS):
            ways = np.array([way for way in itertools.product((-.5, 0, .5), repeat=3) if any(way)])
            hits = self.scene.cast_rays(np.concatenate([np.tile(np.add(cell, .5), (26, 1)), ways], axis=1))
            np.testing.assert_array_equal(hits["t_hit"], 1)
            others = np.array(self.CELLS)[hits["geometry_ids"]]
            self.assertLessEqual(np.abs(others - cell).max(), 1)  # that share the point

    def test_986_a_particle_enters_and_leaves_each_cell_on_its_way(self):
        """Along edges, through vertices, in faces: as often as the ray does that is moved by (e, e^2, e^3)."""
        starts = itertools.product((-1, 0, 1, 2, 3), (-1, 1, 2), (-1, 0, 1))
        ways = [way for way in itertools.product((-1, 0, 1, 2), repeat=3) if any(way)]
        rays = np.array([start + way for start in starts for way in ways], np.float64)
        # Small enough: all that is compared are whole numbers up to 16 and their quotients.
        moved = [Fraction(1, 2 ** 10) ** k for k in (1, 2, 3)]
        expected = [self.passages(ray[:3], ray[3:], moved) for ray in rays.astype(int).tolist()]
        self.assertGreater(max(expected), 12)
        np.testing.assert_array_equal(self.scene.count_intersections(rays), expected)

    def passages(self, start, way, moved):
        count = 0
        for cell in self.CELLS:
            enter, leave = -np.inf, np.inf
            for lower, o, d, e in zip(cell, start, way, moved):
                if d:
                    ends = sorted(((lower - o - e) / d, (lower + 1 - o - e) / d))
                    enter, leave = max(enter, ends[0]), min(leave, ends[1])
                elif not lower < o + e < lower + 1:
                    enter, leave = 1, 0
            if enter < leave:
                count += (enter > 0) + (leave > 0)
        return count


if __name__ == "__main__":
    unittest.main()
