"""LuxCore: path tracing on the processor, independent samples.

It knows triangles alone: balls are meshes with exact normals. Its lamps shine to one side. In its sky z is up. Maps, suns
and materials that few scenes need are not written for it.
"""

import time

import numpy as np
import pyluxcore

from geometry import is_checker, sphere_mesh

Y_UP = [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1]  # columns: the sky's z becomes the scene's y
FEW_BALLS = 16  # up to here their meshes may be fine


def floats(values):
    return [float(value) for value in values]


def tuples(array):
    return None if array is None else [tuple(row) for row in array.tolist()]


class Peer:
    about = f"LuxCore {pyluxcore.Version()}, PATHCPU, random sampler"

    def __init__(self):
        pyluxcore.Init(lambda message: None)

    def open(self, scene):
        if scene.has_map or scene.suns:
            raise ValueError("no maps and suns are written for LuxCore")
        self.scene, self.properties, self.count = pyluxcore.Scene(), pyluxcore.Properties(), 0
        self.camera, self.depth = scene.camera, scene.max_depth
        self.add_sky(scene.sky)
        rings = 128 if len(scene.spheres) <= FEW_BALLS else 32
        for sphere in scene.spheres:
            self.add(sphere_mesh(sphere, rings), self.material(sphere["material"]))
        for mesh in scene.meshes:
            self.add(mesh, self.material(mesh["material"]))
        for back, share in scene.backs():
            self.add(back, self.material(back["material"], {"emission.importance": share}))
        for medium in scene.media:
            self.add(medium["boundary"], self.medium(medium))

    def tell(self, prefix, settings):
        for name, value in settings.items():
            self.properties.Set(pyluxcore.Property(f"{prefix}.{name}", value))

    def define(self, kind, settings):
        """Defines a light, material, object, texture or volume, and returns its name."""
        self.count += 1
        name = f"{kind}{self.count}"
        self.tell(f"scene.{kind}.{name}", settings)
        return name

    def add(self, mesh, material):
        arrays = (tuples(mesh[part]) for part in ("vertices", "triangles", "normals"))
        shape = f"mesh{self.count}"
        self.scene.DefineMesh(shape, *arrays, None, None, None)
        self.define("objects", {"material": material, "shape": shape})

    def add_sky(self, sky):
        told = {"visibilitymapcache.enable": False}
        if np.ndim(sky) == 3:
            height, width, channels = sky.shape
            self.scene.DefineImageMap("sky", sky[::-1].ravel().tolist(), 1.0, channels, width, height)
            self.define("lights", {**told, "type": "infinite", "file": "sky", "gamma": 1.0,
                                   "transformation": floats(Y_UP)})
        elif sky is not None:
            self.define("lights", {**told, "type": "constantinfinite", "color": floats(sky)})

    def texture(self, color):
        if not is_checker(color):
            return floats(color)
        return self.define("textures", {
            "type": "checkerboard3d", "texture1": floats(color["even"]), "texture2": floats(color["odd"]),
            "mapping.type": "globalmapping3d",
            "mapping.transformation": floats(np.diag([1 / color["cell"]] * 3 + [1]).ravel())})

    def material(self, told, settings={}):
        kind = told["kind"]
        if kind not in ("lambertian", "mirror", "glass", "light") or "normal_map" in told or "opacity" in told:
            raise ValueError(f"no {kind} with its settings is written for LuxCore")
        if kind == "lambertian":
            made = {"type": "matte", "kd": self.texture(told["color"])}
        elif kind == "mirror":
            made = {"type": "mirror", "kr": self.texture(told["color"])}
        elif kind == "glass":
            made = {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3, "interiorior": told["index"], "exteriorior": 1.0}
        else:
            made = {"type": "matte", "kd": [0.0] * 3, "emission": self.texture(told["color"])}
        return self.define("materials", {**made, **settings})

    def medium(self, told):
        albedo = np.array(told["albedo"])
        volume = self.define("volumes", {
            "type": "homogeneous", "asymmetry": [0.0] * 3, "multiscattering": True,
            "absorption": floats((1 - albedo) * told["density"]), "scattering": floats(albedo * told["density"])})
        return self.define("materials", {"type": "null", "volume.interior": volume})

    def aim(self, size):
        c, low = self.camera, 2 / size  # LuxCore's pixel (x, y) is the (x, y + 1) of others
        self.tell("scene.camera", {
            "type": "perspective", "lookat.orig": floats(c["look_from"]), "lookat.target": floats(c["look_at"]),
            "up": floats(c["up"]), "fieldofview": float(c["vertical_fov"]), "lensradius": float(c["lens_radius"]),
            "screenwindow": [-1.0, 1.0, -1.0 - low, 1.0 - low], "focaldistance": float(c["focus_distance"]),
            "autofocus.enable": False, "cliphither": 1e-3, "clipyon": 1e5})

    def render(self, path, size, spp, seed, threads):
        self.aim(size)
        self.scene.Parse(self.properties)
        self.properties = pyluxcore.Properties()
        self.tell("film", {"width": size, "height": size, "filter.type": "NONE", "outputs.0.type": "RGB",
                           "outputs.0.filename": path})
        self.tell("path", {**{f"pathdepth.{kind}": self.depth for kind in ("total", "diffuse", "glossy", "specular")},
                           "clamping.variance.maxvalue": 0.0, "hybridbackforward.enable": False,
                           "forceblackbackground.enable": False})
        self.tell("sampler", {"type": "RANDOM", "random.adaptive.strength": 0.0})
        self.tell("renderengine", {"type": "PATHCPU", "seed": 1000 * seed})  # thread i has seed + i
        self.tell("native", {"threads.count": threads})
        self.tell("batch", {"haltspp": spp})
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(self.properties, self.scene))
        self.properties = pyluxcore.Properties()
        session.Start()
        start = time.perf_counter()
        while not session.HasDone():
            time.sleep(0.005)
            session.UpdateStats()
        seconds = time.perf_counter() - start
        session.Stop()
        samples = session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat()
        session.GetFilm().SaveOutput(path, pyluxcore.FilmOutputType.RGB, pyluxcore.Properties())
        return seconds, samples / size**2
