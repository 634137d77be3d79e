"""Projections, crop windows, alpha, and what a camera meets first."""

import unittest

import numpy as np

import limn
from scenes import CAMERA, SMALL, furnace, wall

WHITE = (1, 1, 1)


class Projections(unittest.TestCase):
    def test_an_orthographic_ball_is_as_large_near_and_far(self):
        """A ball of radius 1 in a picture of 4 by 4: pi / 16 of it."""
        for z in (0, -50):
            scene = limn.Scene()
            scene.add(limn.Sphere((0, 0, z), 1, limn.DiffuseLight(WHITE)))
            camera = limn.Camera(look_from=(0, 0, 4), projection="orthographic", view_height=4)
            image = limn.render(scene, camera, width=64, height=64, samples_per_pixel=64)
            self.assertAlmostEqual(image.mean(), np.pi / 16, delta=1e-3)

    def test_a_panorama_sees_to_all_sides(self):
        """A gradient, whose value is (y + 1) / 2; y is the sine of the latitude of a row's middle."""
        scene = limn.Scene()
        scene.background = limn.Background.gradient((0, 0, 0), WHITE)
        camera = limn.Camera(look_from=(3, 2, 1), look_at=(3, 2, 0), projection="panorama")
        image = limn.render(scene, camera, width=8, height=16, samples_per_pixel=1, antialias=False)
        expected = (np.sin(np.pi * (0.5 - (np.arange(16) + 0.5) / 16)) + 1) / 2
        np.testing.assert_allclose(image, np.broadcast_to(expected[:, None, None], image.shape), rtol=1e-5)

    def test_impossible_cameras_are_refused(self):
        for name, kind, value in (("projection", ValueError, "fisheye"), ("projection", TypeError, 1),
                                  ("view_height", TypeError, "high"), ("aspect_ratio", TypeError, "wide")):
            with self.assertRaisesRegex(kind, f"^{name}"):
                limn.Camera(**{name: value})
        for camera in (limn.Camera(projection="orthographic", view_height=0),
                       limn.Camera(projection="panorama", aperture_angle=1)):
            with self.assertRaises(ValueError):
                limn.render(limn.Scene(), camera, **SMALL)


class Windows(unittest.TestCase):
    def test_a_crop_has_the_pixels_of_the_whole(self):
        scene = furnace(limn.Lambertian((0.5, 0.25, 0.75))).compile()
        whole = limn.render_with_report(scene, CAMERA, **SMALL)
        part = limn.render_with_report(scene, CAMERA, crop=(5, 3, 17, 12), **SMALL)
        np.testing.assert_array_equal(part.image, whole.image[3:12, 5:17])
        np.testing.assert_array_equal(part.maps["samples"], whole.maps["samples"][3:12, 5:17])
        hits = limn.first_hits(scene, CAMERA, width=24, height=16)
        np.testing.assert_array_equal(limn.first_hits(scene, CAMERA, width=24, height=16, crop=[5, 3, 17, 12]).depth,
                                      hits.depth[3:12, 5:17])

    def test_a_crop_outside_the_picture_is_refused(self):
        for kind, crop in ((ValueError, (0, 0, 4)), (TypeError, "all!"), (TypeError, 4), (TypeError, (0, 0, 4.5, 4)),
                           (ValueError, (-1, 0, 4, 4)), (ValueError, (4, 4, 4, 8)), (ValueError, (0, 0, 25, 4))):
            for call in (limn.render, limn.first_hits):
                with self.subTest(crop=crop), self.assertRaisesRegex(kind, "crop"):
                    call(limn.Scene(), CAMERA, width=24, height=16, crop=crop)

    def test_a_transparent_render_has_alpha_and_no_background(self):
        scene = furnace(limn.Lambertian(WHITE))
        result = limn.render_with_report(scene, CAMERA, transparent=True, max_depth=None, **SMALL)
        alpha = result.maps["alpha"]
        self.assertEqual((alpha.shape, alpha.dtype), ((16, 24), np.float32))
        self.assertEqual((alpha[0, 0], alpha[8, 12]), (0, 1))
        np.testing.assert_array_equal(result.image[0, 0], 0)
        np.testing.assert_allclose(result.image[8, 12], 1, atol=0.05)  # the background is light all the same
        self.assertIsNone(limn.render_with_report(scene, CAMERA, **SMALL).maps["alpha"])


class FirstHits(unittest.TestCase):
    def test_first_hits_are_those_of_the_surface_behind_a_cut_out(self):
        scene = limn.Scene()
        scene.add(wall(limn.Lambertian((0.5, 0.25, 0.75)), 9))
        scene.add(limn.Sphere((0, 0, 0), 1, limn.Lambertian(WHITE)))
        scene.add(limn.Quad((-9, -9, 3), (18, 0, 0), (0, 18, 0), limn.AlphaMask(limn.Lambertian(WHITE), 0)))
        hits = limn.first_hits(scene, CAMERA, width=25, height=15)
        for name, shape, dtype in (("albedo", (15, 25, 3), np.float32), ("normal", (15, 25, 3), np.float32),
                                   ("position", (15, 25, 3), np.float32), ("depth", (15, 25), np.float32),
                                   ("object", (15, 25), np.int64), ("primitive", (15, 25), np.int64)):
            array = getattr(hits, name)
            self.assertEqual((array.shape, array.dtype), (shape, dtype), name)
        self.assertEqual((hits.object[0, 0], hits.object[7, 12], hits.primitive[7, 12]), (0, 1, 0))
        self.assertAlmostEqual(hits.depth[7, 12], 3, places=6)
        np.testing.assert_allclose(hits.position[7, 12], (0, 0, 1), atol=1e-6)
        np.testing.assert_allclose(hits.normal[7, 12], (0, 0, 1), atol=1e-2)
        np.testing.assert_allclose(hits.albedo[0, 0], (0.5, 0.25, 0.75), atol=1e-6)
        np.testing.assert_allclose(hits.albedo[7, 12], 1, atol=1e-6)

    def test_a_pixel_that_sees_no_surface_has_no_object_and_infinite_depth(self):
        hits = limn.first_hits(limn.Scene(), CAMERA, width=3, height=2)
        np.testing.assert_array_equal(hits.depth, np.inf)
        for array in (hits.object, hits.primitive):
            np.testing.assert_array_equal(array, -1)
        for array in (hits.albedo, hits.normal, hits.position):
            np.testing.assert_array_equal(array, 0)

    def test_the_picture_does_not_depend_on_threads(self):
        scene = furnace(limn.Lambertian(WHITE)).compile()
        a, b = (limn.first_hits(scene, CAMERA, threads=n, width=48, height=32).normal for n in (1, 3))
        np.testing.assert_array_equal(a, b)

    def test_refusals_name_the_argument(self):
        with self.assertRaisesRegex(TypeError, "^scene"):
            limn.first_hits(None, CAMERA)
        with self.assertRaisesRegex(TypeError, "^camera"):
            limn.first_hits(limn.Scene(), None)
        with self.assertRaisesRegex(ValueError, "^width"):
            limn.first_hits(limn.Scene(), CAMERA, width=0)


if __name__ == "__main__":
    unittest.main()
