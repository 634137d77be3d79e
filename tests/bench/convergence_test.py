"""The arithmetic of ./build.sh convergence: the seconds to an error, and what the peers read."""

import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "apps/bench"), str(ROOT / "apps/bench/peers")]

import convergence

try:
    import geometry
    import numpy as np
    from OpenImageIO import ROI, ImageBuf, ImageSpec
except ImportError:  # only whoever measures needs them
    np = None


class SecondsToAnError(unittest.TestCase):
    def curve(self, c, p):
        return [(s, c / s**p) for s in (0.1, 0.4, 1.6, 6.4)]

    def test_are_exact_on_a_power_law(self):
        for p in (0.8, 1.0, 1.5):
            for error in (1e-2, 1e-3, 1e-4):
                seconds, _ = convergence.seconds_to(error, self.curve(2e-3, p))
                self.assertAlmostEqual(seconds / (2e-3 / error) ** (1 / p), 1, places=9)

    def test_say_where_they_are_extrapolated(self):
        known = self.curve(1e-3, 1)  # from 1e-2 down to 1.6e-4
        self.assertEqual([convergence.seconds_to(e, known)[1] for e in (2e-2, 9e-3, 2e-4, 1e-4)],
                         [True, False, False, True])

    def test_follow_the_slope_that_is_near(self):
        bent = [(1, 1e-1), (2, 5e-2), (4, 2.5e-2), (8, 6.25e-3), (16, 1.5625e-3)]  # 1/s, then 1/s^2
        self.assertAlmostEqual(convergence.seconds_to(5e-2, bent)[0], 2)
        self.assertAlmostEqual(convergence.seconds_to(1e-4, [*bent, (32, 3.90625e-4)])[0], 63.246, places=3)

    def test_of_one_point_or_of_noise_are_those_of_independent_samples(self):
        self.assertAlmostEqual(convergence.seconds_to(1e-3, [(2, 1e-2)])[0], 20)
        rising = convergence.seconds_to(1e-3, [(1, 1e-2), (4, 2e-2)])[0]
        self.assertGreater(rising, 20)
        self.assertLess(rising, 80)

    def test_are_unknown_where_no_error_is_positive(self):
        self.assertEqual(convergence.seconds_to(1e-3, [(1, -1e-5), (2, 0)]), (math.inf, True))

    def test_are_the_median_over_the_seeds(self):
        rungs = [{"seconds": [s] * 3, "errors": [c / s for c in (1e-3, 7e-3, 2e-3)]} for s in (0.5, 1, 2)]
        for found, expected in zip(convergence.seconds_by_seed(1e-3, rungs), (1, 2, 7)):
            self.assertAlmostEqual(found[0], expected)
        self.assertEqual(convergence.seconds_cell({"rungs": rungs}), "2 (1..7)")
        self.assertEqual(convergence.seconds_cell({"rungs": rungs[:1]}), "~2 (1..7)")

    def test_are_compared_with_the_fastest_peer_that_solves_the_same_problem(self):
        def row(c, difference=0.0):
            return {"agreement": (difference, 1e-3), "rungs": [{"seconds": [s], "errors": [c / s]} for s in (1, 2)]}

        rows = {"limn": row(2e-3), "uniform": row(1e-3), "mitsuba": row(4e-3), "cycles": row(8e-3)}
        self.assertEqual(convergence.ratio_cell(rows), "0.50 of mitsuba")
        rows["mitsuba"] = row(4e-3, difference=0.05)
        self.assertEqual(convergence.ratio_cell(rows), "0.25 of cycles")
        rows["cycles"]["rungs"] = []
        self.assertEqual(convergence.ratio_cell(rows), "–")


@unittest.skipIf(np is None, "needs numpy and OpenImageIO")
class Blocks(unittest.TestCase):
    def test_are_means(self):
        values = np.random.default_rng(1).random((100, 100, 3)).astype(np.float32)
        image = ImageBuf(ImageSpec(100, 100, 3, "float"))
        image.set_pixels(ROI(0, 100, 0, 100), values)
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "a.exr"
            image.write(str(picture))
            means = ImageBuf(str(convergence.block_means(picture))).get_pixels("float")
        np.testing.assert_allclose(means, values.reshape(10, 10, 10, 10, 3).mean(axis=(1, 3)), rtol=1e-5)


@unittest.skipIf(np is None, "needs numpy and OpenImageIO")
class Described(unittest.TestCase):
    def quad(self, height, kind, x=1):
        """Looks down if x is positive."""
        return {"vertices": [[0, height, 0], [x, height, 0], [x, height, 1], [0, height, 1]],
                "triangles": [[0, 1, 2], [0, 2, 3]], "material": {"kind": kind}}

    def scene(self, *meshes, background=((0, 0, 0), (0, 0, 0))):
        bottom, top = background
        return geometry.Scene(json.dumps({
            "max_depth": 10, "camera": {}, "suns": [], "environment": None, "spheres": [], "media": [],
            "meshes": meshes, "background": {"bottom": bottom, "top": top}}))

    def test_the_back_of_a_lamp_is_sampled_rarely_where_it_hangs_under_the_ceiling(self):
        for lamp_height, x, share in ((9.9, 1, geometry.RARELY), (5, 1, 1), (9.9, -1, 1)):
            scene = self.scene(self.quad(lamp_height, "light", x), self.quad(10, "lambertian"))
            (back, found), = scene.backs()
            self.assertEqual(found, share)
            a, b, c = back["vertices"][back["triangles"][0]]
            self.assertEqual(np.sign(np.cross(b - a, c - a)[1]), x)
            self.assertEqual(np.sign(a[1] - np.float32(lamp_height)), x)

    def test_a_metal_has_the_index_that_it_was_made_of(self):
        # Copper, and the formulas of Gulbrandsen (Artist Friendly Metallic Fresnel, JCGT 3(4), 2014).
        eta, k = np.array([0.21, 1.04, 1.17]), np.array([3.67, 2.59, 2.36])
        r = ((eta - 1) ** 2 + k**2) / ((eta + 1) ** 2 + k**2)
        most, least = (1 + np.sqrt(r)) / (1 - np.sqrt(r)), (1 - r) / (1 + r)
        found = geometry.index_of({"reflectance": r, "edge_tint": (most - eta) / (most - least)})
        np.testing.assert_allclose(found, (eta, k), rtol=1e-9)

    def test_the_sky_is_above(self):
        self.assertIsNone(self.scene().sky)
        self.assertEqual(self.scene(background=((1, 1, 1), (1, 1, 1))).sky, [1, 1, 1])
        sky = self.scene(background=((1, 1, 1), (0.5, 0.7, 1))).sky
        self.assertEqual(sky.shape, (512, 1024, 3))
        self.assertLess(np.abs(sky[0, 0] - [0.5, 0.7, 1]).max(), 1e-4)
        self.assertLess(np.abs(sky[-1, 7] - 1).max(), 1e-4)
        self.assertLess(np.abs(sky[128, 3, 0] - (1 - (1 + np.cos(np.pi * 128.5 / 512)) / 4)).max(), 1e-6)


if __name__ == "__main__":
    unittest.main()
