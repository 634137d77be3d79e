"""limn.render: pictures as arrays, progress, Ctrl-C."""

import gc
import os
import signal
import threading
import time
import unittest

import numpy as np

import limn
from meshes import icosphere
from scenes import CAMERA, SMALL, furnace


class Pictures(unittest.TestCase):
    def test_a_picture_is_an_array_of_rows_from_the_top(self):
        scene = limn.Scene()
        scene.background = limn.Background.gradient((0, 0, 0), (1, 1, 1))
        image = limn.render(scene, CAMERA, **SMALL)
        self.assertEqual((image.shape, image.dtype), ((16, 24, 3), np.float32))
        self.assertTrue((image[0] > image[-1]).all())
        self.assertTrue(image.flags.c_contiguous and image.flags.writeable)

    def test_white_objects_vanish_in_a_white_world(self):
        white = (1, 1, 1)
        mesh = icosphere(1)
        for scene in (furnace(limn.Lambertian(white)), furnace(limn.Metal(white)), furnace(limn.Dielectric(1.5)),
                      furnace(limn.OrenNayar(white, 0.5)), furnace(limn.Lambertian(limn.SolidColor(white))),
                      furnace(limn.Lambertian(white), lambda m: limn.Mesh(*mesh, m)),
                      furnace(limn.Lambertian(white), lambda m: limn.Instance(limn.make_box((-1, -1, -1), (1, 1, 1), m),
                                                                              np.eye(4))),
                      furnace(None, lambda m: limn.ConstantMedium(limn.Sphere((0, 0, 0), 1), 2, white))):
            image = limn.render(scene, CAMERA, max_depth=None, **SMALL)
            np.testing.assert_allclose(image.mean(), 1, atol=0.03)

    def test_every_texture_is_seen_in_a_picture(self):
        pixels = np.zeros((2, 2, 3), np.uint8)
        pixels[0, 0] = 255
        quad = lambda texture: limn.Quad((-2, -2, 0), (4, 0, 0), (0, 4, 0), limn.DiffuseLight(texture))
        for texture, corner in ((limn.ImageTexture(pixels, "nearest", "clamp"), (1, 1, 1)),
                                (limn.Checker(1, (0, 0, 1), (0, 1, 0)), None), (limn.Noise(3, 7), None),
                                (limn.Turbulence(3), None), (limn.Marble(3, 2, (1, .5, 0)), None)):
            scene = limn.Scene()
            scene.add(quad(texture))
            image = limn.render(scene, CAMERA, **SMALL)
            self.assertTrue(np.isfinite(image).all() and image.max() > 0)
            if corner:
                np.testing.assert_allclose(image[1, 6], corner)
                np.testing.assert_array_equal(image[-2, 18], 0)

    def test_the_picture_depends_on_the_seed_and_not_on_threads(self):
        scene = furnace(limn.Lambertian((.5, .5, .5))).compile()
        images = [limn.render(scene, CAMERA, threads=n, seed=s, **SMALL) for n, s in ((1, 1), (3, 1), (0, 2))]
        np.testing.assert_array_equal(images[0], images[1])
        self.assertFalse(np.array_equal(images[0], images[2]))

    def test_a_report_says_what_it_cost(self):
        result = limn.render_with_report(furnace(limn.Lambertian((.5, .5, .5))), CAMERA, width=32, height=32, error=0.01)
        self.assertLessEqual(result.error["ci95_high"], 0.01)
        self.assertEqual((result.report["stopped_by"], result.report["complete"]), ("error", True))
        self.assertEqual(result.maps["samples"].shape, (32, 32))
        self.assertGreater(result.report["rays"], 0)

    def test_srgb_clamps_and_makes_a_nan_black(self):
        linear = np.array([[0, 1, 0.5, -1, 9, np.nan]], np.float32)
        np.testing.assert_array_equal(limn.to_srgb(linear), [[0, 255, 188, 0, 255, 0]])

    def test_a_picture_outlives_its_result(self):
        image = limn.render_with_report(limn.Scene(), CAMERA, **SMALL).image
        gc.collect()
        np.testing.assert_array_equal(image, 0)


class Progress(unittest.TestCase):
    LONG = {"width": 256, "height": 256, "samples_per_pixel": 1 << 20}

    def setUp(self):
        self.scene = furnace(limn.Lambertian((.9, .9, .9))).compile()

    def test_it_is_told_in_the_calling_thread(self):
        seen = []

        def show(progress):
            seen.append((threading.get_ident(), progress.fraction, progress.seconds))

        limn.render(self.scene, CAMERA, progress=show, **SMALL)
        self.assertEqual({ident for ident, _, _ in seen}, {threading.get_ident()})
        fractions = [fraction for _, fraction, _ in seen]
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(fractions[-1], 1)

    def test_false_ends_the_render_with_what_there_is(self):
        result = limn.render_with_report(self.scene, CAMERA, progress=lambda p: p.seconds < 0.2, **self.LONG)
        self.assertEqual((result.report["complete"], result.report["stopped_by"]), (False, "callback"))
        self.assertEqual(result.image.shape, (256, 256, 3))

    def test_an_exception_ends_the_render(self):
        def fail(progress):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            limn.render(self.scene, CAMERA, progress=fail, **self.LONG)

    def test_ctrl_c_ends_the_render(self):
        for progress in (None, lambda p: None):
            timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            begin = time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                limn.render(self.scene, CAMERA, progress=progress, **self.LONG)
            timer.join()
            self.assertLess(time.monotonic() - begin, 30)

    def test_other_threads_run_meanwhile(self):
        ended = threading.Event()
        counter = [0]

        def count():
            while not ended.is_set():
                counter[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = counter[0]
        limn.render(self.scene, CAMERA, width=256, height=256, samples_per_pixel=1 << 20, time_limit=0.3)
        self.assertGreater(counter[0], before)
        ended.set()
        thread.join()


if __name__ == "__main__":
    unittest.main()
