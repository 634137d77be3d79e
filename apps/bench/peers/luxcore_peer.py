"""Renders scenes with LuxCore, by path tracing on the processor with independent samples.

LuxCore has only triangles, so balls are meshes with exact normals. Its lamps emit on one side only."""

import time

import numpy as np
import pyluxcore

from geometry import sphere_mesh

Y_UP = [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1]  # a matrix by columns that turns the sky's z to the scene's y


def floats(values):
    return [float(value) for value in values]


class Peer:
    about = f"LuxCore {pyluxcore.Version()}, PATHCPU, random sampler"

    def __init__(self):
        pyluxcore.Init(lambda message: None)

    def open(self, scene):
        if scene.has_map or scene.suns:
            raise ValueError("no maps and suns are written for LuxCore")
        self.scene, self.told = pyluxcore.Scene(), {}
        self.camera, self.depth = scene.camera, scene.max_depth
        self.add_sky(scene.sky)
        rings = 128 if len(scene.spheres) <= 16 else 32
        for sphere in scene.spheres:
            self.add(sphere_mesh(sphere, rings), self.material(sphere["material"]))
        for mesh, share in [*((mesh, 1.0) for mesh in scene.meshes), *scene.backs()]:
            self.add(mesh, self.material(mesh["material"], {"emission.importance": share}))
        for medium in scene.media:
            self.add(medium["boundary"], self.medium(medium))

    def define(self, kind, settings):
        """Adds a definition and returns its name. `kind` is lights, materials, objects, textures or volumes."""
        name = f"{kind}{len(self.told)}"
        self.told.update({f"scene.{kind}.{name}.{key}": value for key, value in settings.items()})
        return name

    def properties(self, more):
        """Returns the definitions since the last call together with `more`."""
        properties = pyluxcore.Properties()
        for name, value in {**self.told, **more}.items():
            properties.Set(pyluxcore.Property(name, value))
        self.told = {}
        return properties

    def add(self, mesh, material):
        """Adds a mesh. `material` is the name of its material."""
        arrays = (None if mesh[part] is None else [*map(tuple, mesh[part].tolist())]
                  for part in ("vertices", "triangles", "normals"))
        self.scene.DefineMesh(f"mesh of {material}", *arrays, None, None, None)
        self.define("objects", {"material": material, "shape": f"mesh of {material}"})

    def add_sky(self, sky):
        if np.ndim(sky) == 3:
            height, width, channels = sky.shape
            self.scene.DefineImageMap("sky", np.ascontiguousarray(sky[::-1]), 1.0, channels, width, height)
            self.define("lights", {"type": "infinite", "file": "sky", "gamma": 1.0, "transformation": floats(Y_UP),
                                   "visibilitymapcache.enable": False})
        elif sky is not None:
            self.define("lights", {"type": "constantinfinite", "color": floats(sky)})

    def texture(self, color):
        if "cell" not in color:
            return floats(color)
        return self.define("textures", {
            "type": "checkerboard3d", "texture1": floats(color["even"]), "texture2": floats(color["odd"]),
            "mapping.type": "globalmapping3d",
            "mapping.transformation": floats(np.diag([1 / color["cell"]] * 3 + [1]).ravel())})

    def material(self, told, settings={}):
        kinds = {
            "lambertian": lambda: {"type": "matte", "kd": self.texture(told["color"])},
            "mirror": lambda: {"type": "mirror", "kr": self.texture(told["color"])},
            "glass": lambda: {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3, "interiorior": told["index"],
                              "exteriorior": 1.0},
            "light": lambda: {"type": "matte", "kd": [0.0] * 3, "emission": self.texture(told["color"])}}
        if told["kind"] not in kinds or "normal_map" in told or "opacity" in told:
            raise ValueError(f"no {told['kind']} with such settings is written for LuxCore")
        return self.define("materials", {**kinds[told["kind"]](), **settings})

    def medium(self, told):
        scattering = np.array(told["albedo"]) * told["density"]
        volume = self.define("volumes", {
            "type": "homogeneous", "asymmetry": [0.0] * 3, "multiscattering": True,
            "absorption": floats(told["density"] - scattering), "scattering": floats(scattering)})
        return self.define("materials", {"type": "null", "volume.interior": volume})

    def render(self, path, size, spp, seed, threads):
        # LuxCore's pixel (x, y) is the pixel (x, y + 1) of other renderers.
        c, low = self.camera, 2 / size
        camera = {"type": "perspective", "lookat.orig": floats(c["look_from"]), "lookat.target": floats(c["look_at"]),
                  "up": floats(c["up"]), "fieldofview": c["vertical_fov"], "lensradius": c["lens_radius"],
                  "focaldistance": c["focus_distance"], "screenwindow": [-1, 1, -1 - low, 1 - low],
                  "autofocus.enable": False, "cliphither": 1e-3, "clipyon": 1e5}
        self.scene.Parse(self.properties({f"scene.camera.{name}": value for name, value in camera.items()}))
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(self.properties({
            "renderengine.type": "PATHCPU", "sampler.type": "RANDOM", "sampler.random.adaptive.strength": 0.0,
            "renderengine.seed": 1000 * seed,  # thread i has seed + i
            "native.threads.count": threads, "batch.haltspp": spp, "film.width": size, "film.height": size,
            "film.filter.type": "NONE", "film.outputs.0.type": "RGB", "film.outputs.0.filename": path,
            **{f"path.pathdepth.{kind}": self.depth for kind in ("total", "diffuse", "glossy", "specular")},
            "path.clamping.variance.maxvalue": 0.0, "path.hybridbackforward.enable": False}), self.scene))
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
