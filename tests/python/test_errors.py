"""What cannot be used raises a TypeError or a ValueError that names the argument."""

import unittest

import numpy as np

import limn
from meshes import box

VERTICES, FACES = box()
RAYS = np.tile(np.array([0.5, 0.5, 5, 0, 0, -1]), (10, 1))
POINTS = np.zeros((10, 3))
WHITE = (1, 1, 1)
MATTE = limn.Lambertian(WHITE)


class Errors(unittest.TestCase):
    def setUp(self):
        scene = limn.Scene()
        scene.add_triangles(VERTICES, FACES)
        self.scene = scene.compile()

    def refuses(self, name, kind, call, *arguments, **named):
        with self.assertRaises(kind) as caught:
            call(*arguments, **named)
        self.assertRegex(str(caught.exception), rf"^{name}\b")

    def test_rays_of_a_wrong_shape_or_type_are_refused(self):
        for query in ("cast_rays", "test_occlusions", "count_intersections", "list_intersections"):
            ask = getattr(self.scene, query)
            for bad in (np.ascontiguousarray(RAYS.T), RAYS[0, :5].copy(), RAYS[:, :5].copy(), np.zeros((0, 6)),
                        np.zeros((4, 0, 6)), RAYS[::2], RAYS[:, ::-1], np.asfortranarray(RAYS), np.array(3.0),
                        np.zeros((6, 4))):
                self.refuses("rays", ValueError, ask, bad)
            for bad in (None, "rays", 3, RAYS.tolist(), RAYS.astype(int), RAYS.astype(np.float16), RAYS.astype(complex),
                        RAYS.astype(">f8"), RAYS.astype(object), RAYS.astype(bool)):
                self.refuses("rays", TypeError, ask, bad)
            self.refuses("threads", ValueError, ask, RAYS, -1)
            self.refuses("threads", ValueError, ask, RAYS, 1025)
            self.refuses("threads", TypeError, ask, RAYS, 1.5)
            self.refuses("threads", TypeError, ask, RAYS, "all")
            self.refuses("t_min", ValueError, ask, RAYS, t_min=np.nan)
            self.refuses("t_max", ValueError, ask, RAYS, t_min=2, t_max=1)
            self.refuses("t_max", TypeError, ask, RAYS, t_max="far")
        self.refuses("dtype", ValueError, self.scene.cast_rays, RAYS, dtype="float16")
        self.refuses("dtype", TypeError, self.scene.cast_rays, RAYS, dtype=32)

    def test_an_array_that_is_not_aligned(self):
        odd = np.frombuffer(bytes(6 * 8 + 1), np.uint8)[1:].view(np.float64).reshape(1, 6)
        if odd.flags.aligned:  # the buffer itself happened to lie at an odd place
            odd = np.frombuffer(bytes(6 * 8 + 2), np.uint8)[2:].view(np.float64).reshape(1, 6)
        self.refuses("rays", ValueError, self.scene.cast_rays, odd)

    def test_rays_in_two_arrays_are_as_many(self):
        for query in (self.scene._nearest, self.scene._any):
            self.refuses("ray_directions", ValueError, query, np.zeros((3, 3)), np.ones((2, 3)), 0)

    def test_scene_attributes_of_a_wrong_type_are_refused(self):
        for name, bad in (("background", None), ("background", 3), ("name", 3), ("name", None)):
            self.refuses(name, TypeError, setattr, limn.Scene(), name, bad)

    def test_points_of_a_wrong_shape_or_type_are_refused(self):
        for query in ("contains", "winding_number", "compute_distance", "compute_signed_distance",
                      "compute_closest_points"):
            ask = getattr(self.scene, query)
            for bad in (np.ascontiguousarray(POINTS.T), RAYS, np.zeros((0, 3)), POINTS[::2], np.zeros((3, 4))):
                self.refuses("points", ValueError, ask, bad)
            for bad in (None, [[0, 0, 0]], POINTS.astype(np.int32)):
                self.refuses("points", TypeError, ask, bad)

    def test_invalid_mesh_arrays_are_refused_and_any_whole_number_type_is_taken(self):
        for make in (limn.Scene().add_triangles, limn.Mesh):
            for bad in (VERTICES.T.copy(), VERTICES[:0], VERTICES[::2], VERTICES[None], np.zeros((3, 4), np.float32)):
                self.refuses("vertices", ValueError, make, bad, FACES)
            for bad in (VERTICES.astype(np.float64), None, VERTICES.tolist(), VERTICES.astype(int)):
                self.refuses("vertices", TypeError, make, bad, FACES)
            for value in (np.nan, np.inf):
                bad = VERTICES.copy()
                bad[3, 1] = value
                self.refuses("vertices", ValueError, make, bad, FACES)
            for bad in (FACES.T.copy(), FACES[:0], FACES[::2], FACES + np.uint32(1), FACES.astype(np.int32) - 1,
                        np.zeros((2, 3), np.uint32)):
                self.refuses("faces", ValueError, make, VERTICES, bad)
            for bad in (FACES.astype(np.float32), None, FACES.tolist(), FACES.astype(bool)):
                self.refuses("faces", TypeError, make, VERTICES, bad)
            self.refuses("material", TypeError, make, VERTICES, FACES, "red")
        for kind in (np.int8, np.int16, np.int32, np.int64, np.uint8, np.uint16, np.uint32, np.uint64):
            self.assertEqual(limn.Scene().add_triangles(VERTICES, FACES.astype(kind)), 0)
        self.refuses("normals", ValueError, limn.Mesh, VERTICES, FACES, normals=VERTICES[:2])
        self.refuses("uvs", ValueError, limn.Mesh, VERTICES, FACES, uvs=VERTICES)
        self.refuses("material_slots", ValueError, limn.Mesh, VERTICES, FACES, material_slots=np.ones(12, int))

    def test_shapes_materials_and_textures(self):
        for name, kind, call, arguments in (
                ("center", TypeError, limn.Sphere, ("here", 1)), ("center", ValueError, limn.Sphere, ((0, 0), 1)),
                ("center", TypeError, limn.Sphere, ((0, 0, None), 1)), ("radius", TypeError, limn.Sphere, ((0, 0, 0), "1")),
                ("material", TypeError, limn.Sphere, ((0, 0, 0), 1, (1, 0, 0))),
                ("edge_u", TypeError, limn.Quad, ((0, 0, 0), 1, (0, 1, 0))),
                ("world_from_object", ValueError, limn.Instance, (limn.Sphere((0, 0, 0), 1), np.eye(3))),
                ("world_from_object", ValueError, limn.Instance, (limn.Sphere((0, 0, 0), 1), 2 * np.eye(4))),
                ("object", TypeError, limn.Instance, (limn.Scene(), np.eye(4))),
                ("objects", TypeError, limn.HittableList, ([limn.Sphere((0, 0, 0), 1), 3],)),
                ("density", TypeError, limn.ConstantMedium, (limn.Sphere((0, 0, 0), 1), None, (1, 1, 1))),
                ("albedo", ValueError, limn.Lambertian, ((1, 1),)), ("albedo", TypeError, limn.Metal, (None, 1)),
                ("fresnel", ValueError, limn.Dielectric, (1.5, "rough")), ("index", TypeError, limn.Dielectric, ("glass",)),
                ("even", TypeError, limn.Checker, (1, "white", (0, 0, 0))),
                ("image", ValueError, limn.ImageTexture, (np.zeros((4, 4), np.float32),)),
                ("image", TypeError, limn.ImageTexture, (np.zeros((4, 4, 3), int),)),
                ("image", ValueError, limn.ImageTexture, (np.full((4, 4, 3), np.nan),)),
                ("wrap", ValueError, limn.ImageTexture, (np.zeros((4, 4, 3)), "bilinear", "tile")),
                *self.of_materials(), *self.of_lights(),
                ("object", TypeError, limn.Scene().add, (3,))):
            with self.subTest(call=call, arguments=arguments):
                self.refuses(name, kind, call, *arguments)
        for call, arguments in ((limn.Sphere, ((0, 0, 0), 0)), (limn.Sphere, ((0, np.nan, 0), 1)),
                                (limn.Lambertian, ((2, 0, 0),)), (limn.Disk, ((0, 0, 0), (0, 0, 0), 1)),
                                (limn.Instance, (limn.Sphere((0, 0, 0), 1), np.zeros((3, 4)))),
                                (limn.RoughConductor, (WHITE, 1.5)), (limn.RoughConductor, ((1, 2, 1), 0.5)),
                                (limn.RoughConductor, (WHITE, 0.5, (0, 0, 2))),
                                (limn.RoughConductor.from_index, ((0, 1, 1), WHITE, 0)),
                                (limn.RoughConductor.from_index, (WHITE, (0, -1, 0), 0)),
                                (limn.RoughDielectric, (0, 0.5)), (limn.RoughDielectric, (1.5, -0.5)),
                                (limn.Plastic, (WHITE, 0.5, 0.9)), (limn.Plastic, (WHITE, 0.5, 1.5, (1, 1, 2))),
                                (limn.AlphaMask, (MATTE, 1.5)), (limn.AlphaMask, (MATTE, limn.SolidColor(WHITE), 2)),
                                (limn.EnvironmentMap, (np.ones((1, 1, 3)), 2 * np.eye(4)[:3])),
                                (limn.EnvironmentMap, (np.ones((1, 1, 3)), None, -1))):
            with self.subTest(call=call, arguments=arguments), self.assertRaises(ValueError):
                call(*arguments)

    def of_materials(self):
        return (("roughness", TypeError, limn.RoughConductor, (WHITE, "rough")),
                ("roughness", TypeError, limn.RoughConductor, (WHITE, None)),
                ("roughness", ValueError, limn.RoughConductor, (WHITE, (0.1, 0.2, 0.3))),
                ("roughness", TypeError, limn.RoughDielectric, (1.5, (0.1, None))),
                ("edge_tint", ValueError, limn.RoughConductor, (WHITE, 0, (1, 1))),
                ("reflectance", TypeError, limn.RoughConductor, (None, 0)),
                ("eta", TypeError, limn.RoughConductor.from_index, (1.5, WHITE, 0)),
                ("k", ValueError, limn.RoughConductor.from_index, (WHITE, (1,), 0)),
                ("index", TypeError, limn.RoughDielectric, ("ice", 0)),
                ("albedo", ValueError, limn.Plastic, ((2, 0, 0), 0, 1.5, limn.SolidColor(WHITE))),
                ("specular", TypeError, limn.Plastic, (WHITE, 0, 1.5, 1)),
                ("base_color", TypeError, limn.MetallicRoughness, ("gold", 1, 0)),
                ("metallic", TypeError, limn.MetallicRoughness, (WHITE, None, 0)),
                ("roughness", TypeError, limn.MetallicRoughness, (WHITE, 1, (0.1, 0.2))),
                ("metallic_roughness", TypeError, limn.MetallicRoughness.from_textures, (limn.SolidColor(WHITE), None)),
                ("material", TypeError, limn.NormalMap, (None, limn.SolidColor(WHITE))),
                ("normals", TypeError, limn.NormalMap, (MATTE, WHITE)),
                ("material", TypeError, limn.AlphaMask, ("leaf", 0.5)),
                ("opacity", TypeError, limn.AlphaMask, (MATTE, WHITE)),
                ("cutoff", ValueError, limn.AlphaMask, (MATTE, 0.5, 0.5)),
                ("sides", ValueError, limn.DiffuseLight, (WHITE, "top")))

    def of_lights(self):
        def added(make, *arguments):
            return lambda: limn.Scene().add(make(*arguments))

        def surround(value):
            limn.Scene().environment = value

        return (("position", TypeError, limn.PointLight, (1, WHITE)), ("intensity", ValueError, limn.PointLight, ((0, 0, 0), ())),
                ("direction", TypeError, limn.SpotLight, ((0, 0, 0), None, WHITE)),
                ("outer_cone_angle", TypeError, limn.SpotLight, ((0, 0, 0), (1, 0, 0), WHITE, 0, "wide")),
                ("irradiance", TypeError, limn.DirectionalLight, ((1, 0, 0), 3)),
                ("angular_radius", TypeError, limn.SunLight, ((1, 0, 0), WHITE, None)),
                ("PointLight: .*intensity", ValueError, added(limn.PointLight, (0, 0, 0), (-1, 0, 0)), ()),
                ("SpotLight: .*cone", ValueError, added(limn.SpotLight, (0, 0, 0), (1, 0, 0), WHITE, 40, 30), ()),
                ("DirectionalLight: .*direction", ValueError, added(limn.DirectionalLight, (0, 0, 0), WHITE), ()),
                ("SunLight: .*angular_radius", ValueError, added(limn.SunLight, (1, 0, 0), WHITE, 100), ()),
                ("image", ValueError, limn.EnvironmentMap, (np.ones((2, 2)),)),
                ("image", ValueError, limn.EnvironmentMap, (-np.ones((2, 2, 3)),)),
                ("image", TypeError, limn.EnvironmentMap, (None,)),
                ("world_from_map", ValueError, limn.EnvironmentMap, (np.ones((1, 1, 3)), np.eye(3))),
                ("scale", TypeError, limn.EnvironmentMap, (np.ones((1, 1, 3)), None, "bright")),
                ("environment", TypeError, surround, (np.ones((1, 1, 3)),)))

    def test_impossible_skies_are_refused(self):
        for name, kind, value in (("to_sun", ValueError, (0, -1, 0)), ("turbidity", ValueError, 99),
                                  ("turbidity", TypeError, "hazy"), ("ground", ValueError, (2, 0, 0)),
                                  ("scale", ValueError, -1), ("height", ValueError, 1), ("height", TypeError, 2.5)):
            with self.subTest(name=name), self.assertRaisesRegex(kind, name):
                limn.make_sky(**{name: value})

    def test_render_names_the_invalid_argument(self):
        camera = limn.Camera(look_from=(0, 0, 5))
        small = {"width": 8, "height": 8, "samples_per_pixel": 1}
        self.refuses("scene", TypeError, limn.render, None, camera)
        self.refuses("camera", TypeError, limn.render, self.scene, None)
        for name, value, kind in (("width", 0, ValueError), ("height", 2.5, TypeError), ("samples_per_pixel", 0, ValueError),
                                  ("seed", -1, ValueError), ("error", "small", TypeError), ("uniform", 1, TypeError),
                                  ("estimator", "bidirectional", ValueError), ("sampler", 3, TypeError),
                                  ("transparent", 1, TypeError), ("crop", (0, 0, 1), ValueError),
                                  ("progress", "bar", TypeError), ("threads", -1, ValueError)):
            self.refuses(name, kind, limn.render, self.scene, camera, **(small | {name: value}))
        self.refuses("look_from", ValueError, limn.Camera, look_from=(1, 2))
        self.refuses("vertical_fov", TypeError, limn.Camera, vertical_fov="wide")
        with self.assertRaises(ValueError):
            limn.render(limn.Scene(), limn.Camera(vertical_fov=190), **small)
        with self.assertRaisesRegex(RuntimeError, "material"):
            limn.render(self.scene, camera, **small)


if __name__ == "__main__":
    unittest.main()
