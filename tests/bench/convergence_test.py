"""The arithmetic of ./build.sh convergence: errors of pictures, the seconds to an error, what the peers read."""

import json
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "apps/bench"), str(ROOT / "apps/bench/peers")]

try:
    import numpy as np
except ImportError:
    sys.exit(print("numpy is not installed") or 0)

import convergence_numbers as numbers
import geometry


class SecondsToAnError(unittest.TestCase):
    def curve(self, c, p):
        return [(s, c / s**p) for s in (0.1, 0.4, 1.6, 6.4)]

    def test_are_exact_on_a_power_law(self):
        for p in (0.8, 1.0, 1.5):
            for error in (1e-2, 1e-3, 1e-4):
                seconds, _ = numbers.seconds_to(error, self.curve(2e-3, p))
                self.assertAlmostEqual(seconds / (2e-3 / error) ** (1 / p), 1, places=9)

    def test_say_where_they_are_extrapolated(self):
        known = self.curve(1e-3, 1)  # from 1e-2 down to 1.6e-4
        self.assertEqual([numbers.seconds_to(e, known)[1] for e in (2e-2, 9e-3, 2e-4, 1e-4)],
                         [True, False, False, True])

    def test_follow_the_slope_that_is_near(self):
        bent = [(1, 1e-1), (2, 5e-2), (4, 2.5e-2), (8, 6.25e-3), (16, 1.5625e-3)]  # 1/s, then 1/s^2
        self.assertAlmostEqual(numbers.seconds_to(5e-2, bent)[0], 2)
        self.assertAlmostEqual(numbers.seconds_to(1e-4, [*bent, (32, 3.90625e-4)])[0], 63.246, places=3)

    def test_of_one_point_or_of_noise_are_those_of_independent_samples(self):
        self.assertAlmostEqual(numbers.seconds_to(1e-3, [(2, 1e-2)])[0], 20)
        rising = numbers.seconds_to(1e-3, [(1, 1e-2), (4, 2e-2)])[0]
        self.assertGreater(rising, 20)
        self.assertLess(rising, 80)

    def test_are_unknown_where_no_error_is_positive(self):
        self.assertEqual(numbers.seconds_to(1e-3, [(1, -1e-5), (2, 0)]), (None, True))

    def test_are_the_median_over_the_seeds(self):
        rungs = [{"seconds": [s] * 3, "errors": [c / s for c in (1e-3, 2e-3, 7e-3)]} for s in (0.5, 1, 2)]
        middle, least, most, outside = numbers.median_seconds(1e-3, rungs)
        for found, expected in ((middle, 2), (least, 1), (most, 7)):
            self.assertAlmostEqual(found, expected)
        self.assertFalse(outside)
        self.assertTrue(numbers.median_seconds(1e-4, rungs)[3])
        self.assertIsNone(numbers.median_seconds(1e-3, [{"seconds": [1], "errors": [0]}]))


class Pictures(unittest.TestCase):
    def setUp(self):
        self.noise = np.random.default_rng(3)
        self.truth = np.linspace(1, 2, 100 * 100 * 3).reshape(100, 100, 3)

    def noisy(self, deviation):
        return self.truth + deviation * self.noise.standard_normal(self.truth.shape)

    def test_relmse_is_that_of_limn_compare(self):
        picture, reference = np.full((1, 1, 3), 0.5), np.full((1, 1, 3), 0.3)
        self.assertAlmostEqual(numbers.relmse(picture, reference), 0.04 / 0.1)

    def test_the_error_of_the_reference_is_subtracted(self):
        halves = [self.noisy(0.1), self.noisy(0.1)]  # their mean is as wrong as what it judges
        picture = self.noisy(0.07)
        true_error = numbers.relmse(picture, self.truth)
        self.assertLess(abs(numbers.corrected_relmse(picture, halves) / true_error - 1), 0.05)

    def test_pictures_of_the_same_agree_but_for_noise(self):
        difference, noise = numbers.agreement([self.noisy(0.1), self.noisy(0.1)], [self.noisy(0.2), self.noisy(0.2)])
        self.assertFalse(numbers.solves_another_problem(difference, noise))
        # The mean over 100 pixels of two halves: deviations of 0.1 and 0.2 over sqrt(200), weighed by the brightness.
        weight = np.mean(1 / (self.truth**2 + 0.01))
        self.assertLess(abs(noise / np.sqrt(0.05 / 200 * weight) - 1), 0.1)

    def test_pictures_of_something_else_do_not(self):
        agreed = numbers.agreement([self.noisy(0.1), self.noisy(0.1)],
                                   [1.05 * self.noisy(0.1), 1.05 * self.noisy(0.1)])
        self.assertTrue(numbers.solves_another_problem(*agreed))
        self.assertLess(abs(agreed[0] / 0.05 - 1), 0.15)

    def test_blocks_are_means(self):
        ramp = np.arange(12.0).reshape(2, 6, 1)
        self.assertEqual(numbers.block_means(ramp, 2).ravel().tolist(), [3.5, 5.5, 7.5])


class Described(unittest.TestCase):
    def quad(self, height, kind, x=1):
        """Looks down if x is positive."""
        return {"vertices": [[0, height, 0], [x, height, 0], [x, height, 1], [0, height, 1]],
                "triangles": [[0, 1, 2], [0, 2, 3]], "material": {"kind": kind}}

    def scene(self, *meshes, background=((0, 0, 0), (0, 0, 0))):
        bottom, top = background
        return geometry.Scene(json.dumps({
            "max_depth": 10, "camera": {}, "suns": [], "environment": None, "spheres": [], "media": [], "meshes": meshes,
            "background": {"bottom": bottom, "top": top}}))

    def test_the_back_of_a_lamp_is_sampled_rarely_where_it_hangs_under_the_ceiling(self):
        for lamp_height, x, share in ((9.9, 1, geometry.RARELY), (5, 1, 1), (9.9, -1, 1)):
            scene = self.scene(self.quad(lamp_height, "light", x), self.quad(10, "lambertian"))
            (back, found), = scene.backs()
            self.assertEqual(found, share)
            a, b, c = back["vertices"][back["triangles"][0]]
            self.assertEqual(np.sign(np.cross(b - a, c - a)[1]), x)
            self.assertEqual(np.sign(a[1] - np.float32(lamp_height)), x)

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
