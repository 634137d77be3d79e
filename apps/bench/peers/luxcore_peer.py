"""Scenes of the report in LuxCore: path tracing on the processor, independent samples.

It knows triangles alone: balls are meshes with exact normals. Its lamps shine to one side: the other is a second
mesh, turned round, chosen rarely where it only lights the wall behind. Its sky is z up, and is turned.
"""

import tempfile
import time

import numpy as np
import pyluxcore

from geometry import RARELY, has_wall_behind, is_checker, lifted, quad_corners, quads_mesh, sky_image, sphere_mesh

LIFT = 0.02  # of media, off the floor
GAP = 1e-3  # between the two sides of a lamp
Y_UP = [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1]  # columns: what z is to LuxCore's skies is y to the scene


class Peer:
    name = "LuxCore"
    version = pyluxcore.Version()
    settings = "PATHCPU, random sampler"

    def __init__(self):
        pyluxcore.Init(lambda message: None)
        self.folder = tempfile.TemporaryDirectory()

    def open(self, scene):
        self.scene, self.told, self.count = pyluxcore.Scene(), {}, 0
        self.depth = scene.max_depth
        self.camera, self.size = scene.camera, None
        self.set_camera(1)
        self.set_sky(scene)
        rings = 128 if len(scene.spheres) < 16 else 32
        for sphere in scene.spheres:
            light = sphere["material"]["kind"] == "light"
            self.add(*sphere_mesh(sphere["center"], sphere["radius"], 48 if light else rings),
                     self.material(sphere["material"]))
        for quad in scene.quads:
            self.add(*quads_mesh([quad]), None, self.material(quad["material"]))
            if quad["material"]["kind"] == "light":
                self.add_other_side(quad, has_wall_behind(quad, scene.quads))
        for mesh in scene.meshes:
            self.add(mesh["vertices"], mesh["triangles"], None, self.material(mesh["material"]))
        for medium in scene.media:
            boundary = quads_mesh(lifted(medium["boundary"]["quads"], LIFT))
            self.add(*boundary, None, self.medium(medium))
        self.scene.Parse(self.properties())

    def properties(self):
        properties = pyluxcore.Properties()
        for name, value in self.told.items():
            properties.Set(pyluxcore.Property(name, value))
        self.told = {}
        return properties

    def name_of(self, kind):
        self.count += 1
        return f"{kind}{self.count}"

    def set_camera(self, size):
        c, low = self.camera, 2 / size  # it takes pixel (x, y) for (x, y + 1)
        self.told.update({
            "scene.camera.type": "perspective", "scene.camera.lookat.orig": list(map(float, c["look_from"])),
            "scene.camera.lookat.target": list(map(float, c["look_at"])), "scene.camera.up": list(map(float, c["up"])),
            "scene.camera.fieldofview": float(c["vertical_fov"]), "scene.camera.screenwindow": [-1.0, 1.0, -1.0 - low, 1.0 - low],
            "scene.camera.lensradius": float(c["lens_radius"]),
            "scene.camera.focaldistance": float(c["focus_distance"]), "scene.camera.autofocus.enable": False,
            "scene.camera.cliphither": 1e-3, "scene.camera.clipyon": 1e5})

    def set_sky(self, scene):
        if scene.environment is not None or scene.suns:
            raise ValueError("this report does not write maps and suns for LuxCore")
        if scene.is_dark():
            return
        if not scene.has_gradient():
            self.told.update({"scene.lights.sky.type": "constantinfinite",
                              "scene.lights.sky.color": scene.background["top"],
                              "scene.lights.sky.visibilitymapcache.enable": False})
            return
        path = f"{self.folder.name}/sky.pfm"
        write_pfm(path, sky_image(scene.background)[::-1])
        self.told.update({"scene.lights.sky.type": "infinite", "scene.lights.sky.file": path,
                          "scene.lights.sky.gamma": 1.0, "scene.lights.sky.transformation": list(map(float, Y_UP)),
                          "scene.lights.sky.visibilitymapcache.enable": False})

    def texture(self, color):
        if not is_checker(color):
            return [float(c) for c in color]
        name, cell = self.name_of("texture"), 1 / color["cell"]
        at = f"scene.textures.{name}"
        self.told.update({f"{at}.type": "checkerboard3d", f"{at}.texture1": color["even"],
                          f"{at}.texture2": color["odd"], f"{at}.mapping.type": "globalmapping3d",
                          f"{at}.mapping.transformation": [cell, 0., 0., 0., 0., cell, 0., 0., 0., 0., cell, 0.,
                                                           0., 0., 0., 1.]})
        return name

    def material(self, told):
        name = self.name_of("material")
        at, kind = f"scene.materials.{name}", told["kind"]
        if kind == "lambertian":
            self.told.update({f"{at}.type": "matte", f"{at}.kd": self.texture(told["color"])})
        elif kind == "mirror":
            self.told.update({f"{at}.type": "mirror", f"{at}.kr": self.texture(told["color"])})
        elif kind == "glass":
            self.told.update({f"{at}.type": "glass", f"{at}.kr": [1.0, 1.0, 1.0], f"{at}.kt": [1.0, 1.0, 1.0],
                              f"{at}.interiorior": float(told["index"]), f"{at}.exteriorior": 1.0})
        elif kind != "light" or "normal_map" in told or "opacity" in told:
            raise ValueError(f"this report does not write {kind} for LuxCore")
        else:
            self.told.update({f"{at}.type": "matte", f"{at}.kd": [0.0, 0.0, 0.0],
                              f"{at}.emission": self.texture(told["color"])})
        return name

    def medium(self, told):
        volume, name = self.name_of("volume"), self.name_of("material")
        at, albedo = f"scene.volumes.{volume}", np.array(told["albedo"])
        self.told.update({f"{at}.type": "homogeneous", f"{at}.asymmetry": [0.0, 0.0, 0.0],
                          f"{at}.absorption": list(map(float, (1 - albedo) * told["density"])),
                          f"{at}.scattering": list(map(float, albedo * told["density"])),
                          f"{at}.multiscattering": True,
                          f"scene.materials.{name}.type": "null",
                          f"scene.materials.{name}.volume.interior": volume})
        return name

    def add(self, vertices, triangles, normals, material):
        name = self.name_of("object")
        rows = lambda array, kind: None if array is None else [tuple(map(kind, row)) for row in array]
        self.scene.DefineMesh(name, rows(vertices, float), rows(triangles, int), rows(normals, float), None, None, None)
        self.told.update({f"scene.objects.{name}.shape": name, f"scene.objects.{name}.material": material})

    def add_other_side(self, lamp, has_wall):
        corners, normal = quad_corners(lamp)
        corners = corners - GAP * normal
        material = self.material(lamp["material"])
        if has_wall:
            self.told[f"scene.materials.{material}.emission.importance"] = RARELY
        self.add(corners, [[0, 2, 1], [0, 3, 2]], None, material)

    def render(self, size, spp, seed, threads):
        if size != self.size:
            self.set_camera(size)
            self.scene.Parse(self.properties())
            self.size = size
        self.told = {
            "renderengine.type": "PATHCPU", "sampler.type": "RANDOM",
            "sampler.random.adaptive.strength": 0.0, "native.threads.count": threads,
            "renderengine.seed": 1000 * seed,  # thread i has seed + i
            "film.width": size, "film.height": size, "batch.haltspp": spp,
            "film.filter.type": "NONE", "film.outputs.0.type": "RGB", "film.outputs.0.filename": "unused.exr",
            "path.pathdepth.total": self.depth, "path.pathdepth.diffuse": self.depth,
            "path.pathdepth.glossy": self.depth, "path.pathdepth.specular": self.depth,
            "path.clamping.variance.maxvalue": 0.0, "path.hybridbackforward.enable": False,
            "path.forceblackbackground.enable": False}
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(self.properties(), self.scene))
        session.Start()
        start = time.perf_counter()
        while not session.HasDone():
            time.sleep(0.005)
            session.UpdateStats()
        seconds = time.perf_counter() - start
        session.Stop()
        stats = session.GetStats()
        taken = stats.Get("stats.renderengine.total.samplecount").GetFloat() / size**2
        pixels = np.empty(3 * size * size, dtype=np.float32)
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels)
        return pixels.reshape(size, size, 3)[::-1], seconds, taken


def write_pfm(path, picture):
    with open(path, "wb") as file:
        file.write(f"PF\n{picture.shape[1]} {picture.shape[0]}\n-1.0\n".encode())
        file.write(picture[::-1].astype("<f4").tobytes())
