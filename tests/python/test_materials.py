"""Materials of microfacets, normal maps, masks, lamps: each by a picture whose brightness is known."""

import unittest

import numpy as np

import limn
from scenes import CAMERA, SMALL, furnace, wall

WHITE = (1, 1, 1)
# A ball of radius 1 fills this picture, seen within a hundredth of a degree of its normal.
FRONT = limn.Camera(look_from=(0, 0, 4), vertical_fov=0.01)


def picture(scene, camera=CAMERA, **settings):
    return limn.render(scene, camera, max_depth=None, **(SMALL | settings))


def even(*value):
    """A texture of one linear value."""
    return limn.ImageTexture(np.full((1, 1, 3), value, np.float32))


class Microfacets(unittest.TestCase):
    def test_white_ones_vanish_in_a_white_world(self):
        """256 samples in 384 pixels: noise is below 1e-3 of the mean."""
        for material in (limn.RoughConductor(WHITE, 0), limn.RoughConductor(WHITE, 0.3), limn.RoughConductor(WHITE, 1.0),
                         limn.RoughConductor(even(1), (0.2, 0.8)), limn.Plastic(WHITE, 0.0), limn.Plastic(WHITE, 0.4),
                         limn.Plastic(even(1), 0.2, 1.3), limn.Plastic(WHITE, 0.2, specular=even(1)),
                         limn.MetallicRoughness(WHITE, 0.5, 0.4), limn.MetallicRoughness(even(1), 1, 0.7, 1.3),
                         limn.MetallicRoughness.from_textures(even(1), even(0, 0.5, 0.5)),
                         limn.RoughDielectric(1.5, 0.2), limn.RoughDielectric(0.75, (0.1, 0.2))):
            with self.subTest(material=material):
                self.assertAlmostEqual(picture(furnace(material), samples_per_pixel=256).mean(), 1, delta=1e-2)

    def test_a_conductor_shows_its_reflectance_at_normal_incidence(self):
        color = (0.9, 0.5, 0.25)
        for material in (limn.RoughConductor(color, 0), limn.RoughConductor(color, 0, (1, 0.5, 0)),
                         limn.RoughConductor(limn.SolidColor(color), 0)):
            np.testing.assert_allclose(picture(furnace(material), FRONT).mean(axis=(0, 1)), color, atol=1e-4)

    def test_metallic_roughness_takes_both_from_a_picture(self):
        """Green is the roughness, blue how much is metal."""
        told = limn.MetallicRoughness((0.75, 0.5, 0.125), 0.25, 0.5)
        shown = limn.MetallicRoughness.from_textures(even(0.75, 0.5, 0.125), even(0.9, 0.5, 0.25))
        np.testing.assert_array_equal(picture(furnace(shown)), picture(furnace(told)))

    def test_a_conductor_of_an_index_reflects_by_fresnels_equations(self):
        eta, k = np.array([0.2, 1, 2.5]), np.array([3, 0, 4.0])
        expected = ((eta - 1) ** 2 + k ** 2) / ((eta + 1) ** 2 + k ** 2)
        image = picture(furnace(limn.RoughConductor.from_index(eta, k, 0)), FRONT)
        np.testing.assert_allclose(image.mean(axis=(0, 1)), expected, atol=1e-4)

    def test_brushed_metal_is_rough_along_one_way(self):
        """Light from the right, seen where a ball is brushed along u or across it."""
        images = []
        for roughness in ((0.1, 0.6), (0.6, 0.1), (0.1, 0.1)):
            scene = limn.Scene()
            scene.add(limn.DirectionalLight((-1, 0, -1), WHITE))
            scene.add(limn.Sphere((0, 0, 0), 1, limn.RoughConductor(WHITE, roughness)))
            images.append(picture(scene))
        for a, b in ((0, 1), (1, 2), (0, 2)):
            self.assertFalse(np.allclose(images[a], images[b], rtol=0.1))

    def test_rough_glass_of_roughness_0_is_glass_bit_for_bit(self):
        np.testing.assert_array_equal(picture(furnace(limn.RoughDielectric(1.5, 0))), picture(furnace(limn.Dielectric(1.5))))

    def test_plastic_is_its_coat_and_what_is_below(self):
        """At normal incidence the coat reflects ((n - 1) / (n + 1))^2."""
        coat = picture(furnace(limn.Plastic((0, 0, 0), 0, 2.0)), FRONT)
        np.testing.assert_allclose(coat.mean(), 1 / 9, atol=1e-4)
        half = picture(furnace(limn.Plastic((0, 0, 0), 0, 2.0, (0.5, 0, 1))), FRONT)
        np.testing.assert_allclose(half.mean(axis=(0, 1)), np.array([0.5, 0, 1]) / 9, atol=1e-4)


class Wrappers(unittest.TestCase):
    def test_a_normal_map_bends_the_light(self):
        """A wall that the light meets straight on, with normals turned by 60 degrees: half as bright."""
        for material, brightness in ((limn.Lambertian(WHITE), 1),
                                     (limn.NormalMap(limn.Lambertian(WHITE), even(0.5, 0.5, 1)), 1),
                                     (limn.NormalMap(limn.Lambertian(WHITE), even((np.sqrt(0.75) + 1) / 2, 0.5, 0.75)), 0.5)):
            scene = limn.Scene()
            scene.add(limn.DirectionalLight((0, 0, -1), (np.pi, np.pi, np.pi)))
            scene.add(wall(material))
            camera = limn.Camera(look_from=(0, 0, 4), projection="orthographic", view_height=2)
            np.testing.assert_allclose(picture(scene, camera), brightness, rtol=1e-5)

    def test_holes_let_light_through(self):
        black, mean = limn.Lambertian((0, 0, 0)), lambda m: picture(furnace(m, wall), FRONT, samples_per_pixel=256).mean()
        self.assertAlmostEqual(mean(limn.AlphaMask(black, 0.25)), 0.75, delta=1e-2)
        self.assertAlmostEqual(mean(limn.AlphaMask(black, even(0.25))), 0.75, delta=1e-2)
        self.assertEqual(mean(limn.AlphaMask(black, even(0.25), 0.5)), 1)
        self.assertEqual(mean(limn.AlphaMask(black, even(0.5), 0.5)), 0)

    def test_holes_are_holes_for_shadows_too(self):
        scene = limn.Scene()
        scene.add(wall(limn.Lambertian(WHITE)))
        scene.add(limn.Quad((-1, -1, 1), (2, 0, 0), (0, 2, 0), limn.AlphaMask(limn.Lambertian(WHITE), 0)))
        scene.add(limn.DirectionalLight((0, 0, -1), (np.pi, np.pi, np.pi)))
        np.testing.assert_allclose(picture(scene, FRONT), 1, rtol=1e-5)

    def test_lamps_shine_on_the_sides_that_they_have(self):
        for sides, front, back in (("both", 1, 1), ("front", 1, 0), ("back", 0, 1)):
            scene = limn.Scene()
            scene.add(wall(limn.DiffuseLight(WHITE, sides)))
            np.testing.assert_array_equal(picture(scene, FRONT), front)
            np.testing.assert_array_equal(picture(scene, limn.Camera(look_from=(0, 0, -4), vertical_fov=0.01)), back)


if __name__ == "__main__":
    unittest.main()
