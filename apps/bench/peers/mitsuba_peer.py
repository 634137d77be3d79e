"""Scenes of the report in Mitsuba 3.

Path tracing (`path`, `volpath` with media) with the multijitter sampler. Its area lights shine to one side: the other
side is a second rectangle, chosen rarely where it only lights the wall behind. Textures of its own that are solid do
not exist: the checker is a plug-in, which the LLVM variant compiles into its kernel.
"""

import os
import re
import time
from pathlib import Path

OLDEST_LLVM = 17  # 15 and 16 crash on some processors


def find_llvm():
    """The newest LLVM of Debian's packages libllvm17, libllvm18, ..."""
    found = {}
    for folder, pattern in (("/usr/lib", "*/libLLVM*.so*"), ("/usr/lib", "llvm-*/lib/libLLVM*.so*")):
        for path in Path(folder).glob(pattern):
            version = re.search(r"libLLVM(?:-|\.so\.)(\d+)", path.name)
            if version and int(version[1]) >= OLDEST_LLVM:
                found[int(version[1])] = path
    return str(found[max(found)]) if found else None


LLVM = os.environ.get("DRJIT_LIBLLVM_PATH") or find_llvm()
if LLVM:
    os.environ["DRJIT_LIBLLVM_PATH"] = LLVM

import drjit as dr
import mitsuba as mi
import numpy as np

from geometry import (RARELY, has_wall_behind, is_checker, is_picture, lifted, pixels, quad_corners, quads_mesh,
                      sky_image)

LANES = 1 << 24  # paths at once: more take more memory, and are not faster
FAR = 1e4  # suns, in units of the scene: discs that their angular radius makes large
LIFT = 0.2  # of media: rays set out 0.05 beyond where they are at such coordinates, and miss what lies within


def choose_variant():
    if LLVM:
        try:
            mi.set_variant("llvm_ad_rgb")
            dr.eval(mi.Float(1) + dr.opaque(mi.Float, 1))
            return "llvm_ad_rgb"
        except Exception as problem:
            print(problem)
    mi.set_variant("scalar_rgb")
    return "scalar_rgb"


def rgb(color):
    return {"type": "rgb", "value": [float(c) for c in color]}


def define_checker():
    class SolidChecker(mi.Texture):
        def __init__(self, props):
            super().__init__(props)
            self.cell = props["cell"]
            self.even, self.odd = (mi.Color3f(*[props[f"{name}_{c}"] for c in "rgb"]) for name in ("even", "odd"))

        def eval(self, si, active=True):
            cells = mi.Vector3i(dr.floor(si.p / self.cell))
            parity = (cells.x + cells.y + cells.z) & 1
            return dr.select(parity == 0, self.even, self.odd)

        def mean(self):
            return mi.Float(0.5)

        def is_spatially_varying(self):
            return True

    mi.register_texture("solid_checker", SolidChecker)


def texture(color, raw=False):
    if is_picture(color):
        return {"type": "bitmap", "bitmap": mi.Bitmap(pixels(color["picture"])), "raw": raw}
    if not is_checker(color):
        return rgb(color)
    told = {"type": "solid_checker", "cell": color["cell"]}
    for name in ("even", "odd"):
        told.update({f"{name}_{c}": float(v) for c, v in zip("rgb", color[name])})
    return told


def bsdf(material):
    told = lobe(material)
    if "normal_map" in material:
        told = {"type": "normalmap", "normalmap": texture(material["normal_map"], raw=True), "nested": told}
    if material["kind"] == "lambertian":
        told = {"type": "twosided", "nested": told}
    if "opacity" in material:
        told = {"type": "mask", "opacity": texture(material["opacity"], raw=True), "nested": told}
    return told


def lobe(material):
    kind = material["kind"]
    if kind == "lambertian":
        return {"type": "diffuse", "reflectance": texture(material["color"])}
    if kind == "mirror":
        return {"type": "conductor", "material": "none", "specular_reflectance": rgb(material["color"])}
    if kind == "glass":
        return {"type": "dielectric", "int_ior": float(material["index"]), "ext_ior": 1.0}
    if kind == "rough-conductor":
        return {"type": "roughconductor", "distribution": "ggx", "alpha": float(material["alpha"]),
                "eta": rgb(material["eta"]), "k": rgb(material["k"])}
    if kind == "rough-glass":
        return {"type": "roughdielectric", "distribution": "ggx", "alpha": float(material["alpha"]),
                "int_ior": float(material["index"]), "ext_ior": 1.0}
    return {"type": "diffuse", "reflectance": rgb([0, 0, 0])}  # lamps


def emitter(material, weight=1.0):
    return {"type": "area", "radiance": rgb(material["color"]), "sampling_weight": weight}


def rectangle(quad, turned=False, lift=0.0):
    _, normal = quad_corners(quad)
    u, v = np.array(quad["edge_u"]) / 2, np.array(quad["edge_v"]) / 2
    center = np.array(quad["corner"]) + u + v
    if turned:
        u, normal, center = -u, -normal, center - lift * normal
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = u, v, normal, center
    return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix)}


def mesh(vertices, triangles, properties, normals=None, uvs=None):
    props = mi.Properties()
    for name, value in properties.items():
        props[name] = value
    made = mi.Mesh("mesh", len(vertices), len(triangles), props=props, has_vertex_normals=normals is not None,
                   has_vertex_texcoords=uvs is not None)
    parameters = mi.traverse(made)
    parameters["vertex_positions"] = vertices.ravel()
    parameters["faces"] = triangles.ravel()
    if normals is not None:
        parameters["vertex_normals"] = normals.ravel()
    if uvs is not None:
        parameters["vertex_texcoords"] = (uvs * [1, -1] + [0, 1]).ravel()  # its rows begin at the top
    parameters.update()
    return made


def sun_disc(sun):
    to_sun = -np.array(sun["direction"]) / np.linalg.norm(sun["direction"])
    radius = np.radians(sun["angular_radius"])
    up = [0, 1, 0] if abs(to_sun[1]) < 0.9 else [1, 0, 0]
    place = mi.ScalarTransform4f().look_at((FAR * to_sun).tolist(), [0, 0, 0], up)
    return {"type": "disk", "to_world": place @ mi.ScalarTransform4f().scale(float(FAR * np.tan(radius))),
            "bsdf": bsdf({"kind": "light"}),
            "emitter": {"type": "area", "radiance": rgb(np.array(sun["irradiance"]) / (np.pi * np.sin(radius) ** 2))}}


class Peer:
    name = "Mitsuba 3"
    version = mi.__version__

    def __init__(self):
        self.variant = choose_variant()
        mi.set_log_level(mi.LogLevel.Error)
        self.settings = f"{self.variant}, path or volpath, multijitter"
        if self.variant == "scalar_rgb":
            self.settings += " (no LLVM of at least version 17 found: Debian's libllvm19)"
        else:
            dr.set_flag(dr.JitFlag.KernelHistory, True)
            define_checker()

    def open(self, scene):
        if self.variant == "scalar_rgb" and any(is_checker(s["material"].get("color")) for s in scene.spheres):
            raise ValueError("no solid checker in the scalar variant")
        told = {"type": "scene"}
        for i, sphere in enumerate(scene.spheres):
            shape = {"type": "sphere", "center": sphere["center"], "radius": abs(sphere["radius"]),
                     "flip_normals": sphere["radius"] < 0, "bsdf": bsdf(sphere["material"])}
            if sphere["material"]["kind"] == "light":
                shape["emitter"] = emitter(sphere["material"])
            told[f"sphere{i}"] = shape
        for i, quad in enumerate(scene.quads):
            shape = {**rectangle(quad), "bsdf": bsdf(quad["material"])}
            if quad["material"]["kind"] == "light":
                behind = has_wall_behind(quad, scene.quads)
                shape["emitter"] = emitter(quad["material"])
                told[f"quad{i}b"] = {**rectangle(quad, turned=True, lift=1e-3), "bsdf": bsdf(quad["material"]),
                                     "emitter": emitter(quad["material"], RARELY if behind else 1.0)}
            told[f"quad{i}"] = shape
        for i, m in enumerate(scene.meshes):
            properties = {"bsdf": mi.load_dict(bsdf(m["material"]))}
            if m["material"]["kind"] == "light":
                if m["normals"] is None:
                    raise ValueError("meshes of light without normals")
                properties["emitter"] = mi.load_dict(emitter(m["material"]))
                behind = (m["vertices"] - 1e-3 * m["normals"]).astype(np.float32)
                told[f"mesh{i}b"] = mesh(behind, np.ascontiguousarray(m["triangles"][:, ::-1]), {
                    "bsdf": properties["bsdf"], "emitter": mi.load_dict(emitter(m["material"]))})
            told[f"mesh{i}"] = mesh(m["vertices"], m["triangles"], properties, m["normals"], m["uvs"])
        for i, medium in enumerate(scene.media):
            inside = mi.load_dict({"type": "homogeneous", "albedo": rgb(medium["albedo"]),
                                   "sigma_t": float(medium["density"]), "phase": {"type": "isotropic"}})
            boundary = quads_mesh(lifted(medium["boundary"]["quads"], LIFT))
            told[f"medium{i}"] = mesh(*boundary, {"bsdf": mi.load_dict({"type": "null"}), "interior": inside})
        told.update({f"sun{i}": sun_disc(sun) for i, sun in enumerate(scene.suns)})
        if scene.environment is not None:
            # Its left edge is -z, ours +z.
            turned = np.ascontiguousarray(np.roll(scene.environment, scene.environment.shape[1] // 2, axis=1))
            told["sky"] = {"type": "envmap", "bitmap": mi.Bitmap(turned)}
        elif scene.has_gradient():
            told["sky"] = {"type": "envmap", "bitmap": mi.Bitmap(sky_image(scene.background))}
        elif not scene.is_dark():
            told["sky"] = {"type": "constant", "radiance": rgb(scene.background["top"])}
        self.scene = mi.load_dict(told)
        self.camera = scene.camera
        # Roulette pays but where light has to pass glass.
        self.integrator = {"type": "volpath" if scene.media else "path", "max_depth": scene.max_depth,
                           "rr_depth": 100 if scene.has("glass") or scene.has("rough-glass") else 5}

    def sensor(self, size):
        c = self.camera
        told = {"type": "thinlens" if c["lens_radius"] > 0 else "perspective", "fov": c["vertical_fov"],
                "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e5,
                "to_world": mi.ScalarTransform4f().look_at(c["look_from"], c["look_at"], c["up"]),
                "film": {"type": "hdrfilm", "width": size, "height": size, "pixel_format": "rgb",
                         "component_format": "float32", "rfilter": {"type": "box"}},
                "sampler": {"type": "multijitter"}}
        if c["lens_radius"] > 0:
            told.update(aperture_radius=c["lens_radius"], focus_distance=c["focus_distance"])
        return mi.load_dict(told)

    def render(self, size, spp, seed, threads):
        sensor, told = self.sensor(size), dict(self.integrator)
        dr.set_thread_count(threads)
        sensor.sampler().set_sample_count(spp)
        spp = sensor.sampler().sample_count()  # rounded up to rows times columns of strata
        passes = 1
        while self.variant != "scalar_rgb" and (spp % passes or spp // passes * size**2 > LANES):
            passes += 1
        if passes > 1:
            told["samples_per_pass"] = spp // passes
        return self.measured(mi.load_dict(told), sensor, spp, seed)

    def measured(self, integrator, sensor, spp, seed):
        """Seconds of the LLVM variant are those of its kernels: recording and compiling them is apart."""
        start = time.perf_counter()
        if self.variant != "scalar_rgb":
            dr.kernel_history_clear()
        picture = mi.render(self.scene, sensor=sensor, integrator=integrator, spp=spp, seed=seed)
        if self.variant == "scalar_rgb":
            seconds = time.perf_counter() - start
        else:
            dr.eval(picture)
            dr.sync_thread()
            seconds = 1e-3 * sum(kernel["execution_time"] for kernel in dr.kernel_history())
        return np.array(picture).reshape(sensor.film().size()[1], -1, 3), seconds, spp
