"""Lights that are no shapes, environment maps, the sky."""

import gc
import unittest

import numpy as np

import limn
from meshes import resident
from scenes import CAMERA, SMALL, furnace, wall

WHITE = (1, 1, 1)
FRONT = limn.Camera(look_from=(0, 0, 9), vertical_fov=0.01)  # looks at the origin
PI = (np.pi, np.pi, np.pi)


def lit(*lights):
    """The radiance of a white wall at the origin: irradiance / pi."""
    scene = limn.Scene()
    scene.add(wall(limn.Lambertian(WHITE)))
    for light in lights:
        scene.add(light)
    return limn.render(scene, FRONT, **SMALL).mean(axis=(0, 1))


class Punctual(unittest.TestCase):
    def test_a_point_gives_intensity_over_squared_distance_times_cosine(self):
        np.testing.assert_allclose(lit(limn.PointLight((0, 0, 2), (4 * np.pi, 0, np.pi))), (1, 0, 0.25), rtol=1e-4)
        np.testing.assert_allclose(lit(limn.PointLight((2, 0, 2), PI)), np.sqrt(0.5) / 8, rtol=1e-4)

    def test_a_spot_falls_off_as_the_square_of_a_ramp_in_the_cosine(self):
        """This is the falloff of KHR_lights_punctual."""
        inner, outer = 20, 40
        for angle in (0, 10, 30, 39, 41, 120):
            a, low, high = np.cos(np.radians((angle, outer, inner)))
            direction = (np.sin(np.radians(angle)), 0, -np.cos(np.radians(angle)))
            spot = limn.SpotLight((0, 0, 1), direction, PI, inner, outer)
            ramp = np.clip((a - low) / (high - low), 0, 1) ** 2
            np.testing.assert_allclose(lit(spot), ramp, rtol=1e-3, atol=1e-5)

    def test_the_light_of_directions_and_suns_adds_up_by_the_cosine(self):
        slanted = (3, 0, -4)  # a cosine of 0.8
        np.testing.assert_allclose(lit(limn.DirectionalLight(slanted, PI)), 0.8, rtol=1e-5)
        np.testing.assert_allclose(lit(limn.SunLight(slanted, PI)), 0.8, rtol=1e-3)
        np.testing.assert_allclose(lit(limn.SunLight((0, 0, -1), PI), limn.DirectionalLight((0, 0, -1), PI)), 2, rtol=1e-3)

    def test_a_sun_is_seen(self):
        scene = limn.Scene()
        scene.add(limn.SunLight((0, 0, 1), (1, 2, 3), angular_radius=5))
        radiance = np.array([1, 2, 3]) / (np.pi * np.sin(np.radians(5)) ** 2)
        np.testing.assert_allclose(limn.render(scene, FRONT, **SMALL).mean(axis=(0, 1)), radiance, rtol=1e-5)

    def test_lights_are_no_objects(self):
        scene = limn.Scene()
        self.assertIsNone(scene.add(limn.PointLight((0, 0, 2), PI)))
        self.assertEqual(len(scene), 0)
        self.assertEqual(scene.add(limn.Sphere((0, 0, 0), 1)), 0)


class Environments(unittest.TestCase):
    def test_a_white_one_hides_a_white_ball(self):
        scene = furnace(limn.Lambertian(WHITE))
        scene.background = limn.Background.black()
        scene.environment = limn.EnvironmentMap(np.full((2, 4, 3), 0.5, np.float32), scale=2)
        image = limn.render(scene, CAMERA, max_depth=None, **(SMALL | {"samples_per_pixel": 256}))
        np.testing.assert_allclose(image.mean(), 1, atol=1e-2)

    def test_the_middle_of_a_map_is_towards_minus_z_and_its_matrix_turns_it(self):
        """Red above, green towards -z, blue to the right of that, +x."""
        map_ = np.zeros((64, 128, 3))
        map_[:16] = (1, 0, 0)
        map_[28:36, 60:68] = (0, 1, 0)
        map_[28:36, 92:100] = (0, 0, 1)
        quarter = np.array([[0, 0, -1, 0], [0, 1, 0, 0], [1, 0, 0, 0]])  # what is at +x, to +z
        for world_from_map, blue in ((None, (1, 0, 0)), (quarter, (0, 0, 1))):
            scene = limn.Scene()
            scene.environment = limn.EnvironmentMap(map_, world_from_map)
            green = (0, 0, -1) if world_from_map is None else (1, 0, 0)
            for at, up, expected in (((0, 1, 0), (0, 0, 1), WHITE[:1] + (0, 0)), (green, (0, 1, 0), (0, 1, 0)),
                                     (blue, (0, 1, 0), (0, 0, 1))):
                camera = limn.Camera(look_from=(0, 0, 0), look_at=at, up=up, vertical_fov=2)
                np.testing.assert_allclose(limn.render(scene, camera, **SMALL).mean(axis=(0, 1)), expected, atol=1e-6)

    def test_it_can_be_taken_away(self):
        scene = limn.Scene()
        self.assertIsNone(scene.environment)
        scene.environment = limn.EnvironmentMap(np.ones((1, 1, 3)))
        self.assertIsInstance(scene.environment, limn.EnvironmentMap)
        np.testing.assert_allclose(limn.render(scene, CAMERA, **SMALL), 1, rtol=1e-6)
        scene.environment = None
        np.testing.assert_array_equal(limn.render(scene, CAMERA, **SMALL), 0)

    def test_the_sky_is_blue_above_and_its_sun_warm(self):
        sky = limn.make_sky(to_sun=(0, 0.5, 1), height=32)
        scene = limn.Scene()
        scene.environment = sky.environment
        up = limn.Camera(look_from=(0, 0, 0), look_at=(0, 1, 0), up=(0, 0, 1), vertical_fov=20)
        red, green, blue = limn.render(scene, up, **SMALL).mean(axis=(0, 1))
        self.assertLess(red, green)
        self.assertLess(green, blue)
        red, green, blue = lit(sky.sun)
        self.assertGreater(red, green)
        self.assertGreater(green, blue)
        self.assertGreater(blue, 0)
        brighter = limn.make_sky(to_sun=(0, 0.5, 1), height=32, scale=0.04)
        np.testing.assert_allclose(lit(brighter.sun), 2 * lit(sky.sun), rtol=1e-6)


class Memory(unittest.TestCase):
    def test_it_stays_flat(self):
        pixels = np.full((16, 32, 3), 0.5, np.float32)  # 6 KB: kept ten thousand times they would be 60 MB
        metal = limn.RoughConductor(WHITE, 0.2)

        def describe():
            texture = limn.ImageTexture(pixels)
            scene = limn.Scene()
            scene.environment = limn.EnvironmentMap(pixels)
            scene.add(limn.PointLight((0, 0, 2), PI))
            scene.add(wall(limn.AlphaMask(limn.NormalMap(metal, texture), texture)))
            return scene

        def some(count):
            for i in range(count):
                scene = describe().compile()
                if i % 100 == 0:
                    limn.render(scene, CAMERA, width=8, height=8, samples_per_pixel=1, threads=1)
                    limn.first_hits(scene, CAMERA, width=8, height=8, threads=1)

        some(1000)
        gc.collect()
        before = resident()
        some(10000)
        gc.collect()
        self.assertLess(resident() - before, 3e6)


if __name__ == "__main__":
    unittest.main()
