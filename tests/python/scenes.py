"""Scenes that the tests of pictures share."""

import limn

CAMERA = limn.Camera(look_from=(0, 0, 4), vertical_fov=40)
SMALL = {"width": 24, "height": 16, "samples_per_pixel": 16}


def furnace(material, shape=None):
    """A white object in a white world."""
    scene = limn.Scene()
    scene.background = limn.Background.constant((1, 1, 1))
    scene.add(shape(material) if shape else limn.Sphere((0, 0, 0), 1, material))
    return scene


def wall(material, size=2):
    """A square around the origin that faces +z; u goes along +x, v along +y."""
    return limn.Quad((-size, -size, 0), (2 * size, 0, 0), (0, 2 * size, 0), material)
