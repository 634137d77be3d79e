"""Renders scenes with Mitsuba 3, by path tracing with the multijitter sampler, compiled by LLVM.

Its area lights emit on one side only. It has no solid textures, so that the checkerboard is a plug-in."""

import os
from pathlib import Path

# Find the LLVM of Debian's packages libllvm18 and newer, which have this name. LLVM 15 and 16 crash on some processors.
os.environ.setdefault("DRJIT_LIBLLVM_PATH", str(max(Path("/usr/lib").glob("*/libLLVM.so.*"), default="none installed")))

import drjit as dr
import mitsuba as mi
import numpy as np

from geometry import index_of, pixels

LANES = 1 << 24  # number of paths at once; more would take more memory and not be faster
FAR = 1e4  # distance of the discs that replace suns

mi.set_variant("llvm_ad_rgb")


class SolidChecker(mi.Texture):
    def __init__(self, props):
        super().__init__(props)
        self.cell = props["cell"]
        self.even, self.odd = (mi.Color3f(*[props[f"{name}_{c}"] for c in "rgb"]) for name in ("even", "odd"))

    def eval(self, si, active=True):
        cells = mi.Vector3i(dr.floor(si.p / self.cell))
        return dr.select((cells.x + cells.y + cells.z) & 1 == 0, self.even, self.odd)

    def mean(self):
        return mi.Float(0.5)

    def is_spatially_varying(self):
        return True


def rgb(color):
    return {"type": "rgb", "value": [float(c) for c in color]}


def texture(color, raw=False):
    if "picture" in color:
        return {"type": "bitmap", "bitmap": mi.Bitmap(pixels(color["picture"])), "raw": raw}
    if "cell" not in color:
        return rgb(color)
    return {"type": "solid_checker", "cell": color["cell"],
            **{f"{name}_{c}": float(v) for name in ("even", "odd") for c, v in zip("rgb", color[name])}}


def bsdf(material):
    glass = {"int_ior": float(material.get("index", 1)), "ext_ior": 1.0}
    rough = {"distribution": "ggx", "alpha": float(material.get("alpha", 0))}
    kinds = {
        "lambertian": lambda: {"type": "diffuse", "reflectance": texture(material["color"])},
        "mirror": lambda: {"type": "conductor", "material": "none", "specular_reflectance": rgb(material["color"])},
        "glass": lambda: {"type": "dielectric", **glass},
        "rough-conductor": lambda: {"type": "roughconductor", **rough,
                                    **dict(zip(("eta", "k"), map(rgb, index_of(material))))},
        "rough-glass": lambda: {"type": "roughdielectric", **rough, **glass},
        "light": lambda: {"type": "diffuse", "reflectance": rgb([0, 0, 0])}}
    told = kinds[material["kind"]]()
    if "normal_map" in material:
        told = {"type": "normalmap", "normalmap": texture(material["normal_map"], raw=True), "nested": told}
    if material["kind"] == "lambertian":
        told = {"type": "twosided", "nested": told}
    if "opacity" in material:
        told = {"type": "mask", "opacity": texture(material["opacity"], raw=True), "nested": told}
    return told


def surface(material, share=1.0):
    """Returns the properties of a shape that depend on its material. `share` is the sampling weight of a lamp."""
    told = {"bsdf": bsdf(material)}
    if material["kind"] == "light":
        told["emitter"] = {"type": "area", "radiance": rgb(material["color"]), "sampling_weight": share}
    return told


def shapes(told, share=1.0):
    """Returns a mesh, or the rectangles that it consists of. Mitsuba samples rectangles faster."""
    properties = surface(told["material"], share)
    if told["normals"] is not None or len(told["vertices"]) != 2 * len(told["triangles"]):
        return [mesh(told, properties)]
    rectangles = []
    for a, b, c in told["vertices"][told["triangles"][::2]].astype(float):
        u, v, matrix = (b - a) / 2, (c - b) / 2, np.eye(4)
        normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
        matrix[:3] = np.stack([u, v, normal, (a + c) / 2], axis=-1)
        rectangles.append({"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix), **properties})
    return rectangles


def mesh(told, properties):
    props = mi.Properties()
    for name, value in properties.items():
        props[name] = mi.load_dict(value)
    made = mi.Mesh("mesh", len(told["vertices"]), len(told["triangles"]), props=props,
                   has_vertex_normals=told["normals"] is not None, has_vertex_texcoords=told["uvs"] is not None)
    parameters = mi.traverse(made)
    for name, values in (("vertex_positions", "vertices"), ("faces", "triangles"), ("vertex_normals", "normals")):
        if told[values] is not None:
            parameters[name] = told[values].ravel()
    if told["uvs"] is not None:
        parameters["vertex_texcoords"] = (told["uvs"] * [1, -1] + [0, 1]).ravel()  # v is downward in its images
    parameters.update()
    return made


def sun_disc(sun):
    """Returns a distant lamp with the irradiance and the angular radius of a sun."""
    to_sun = -np.array(sun["direction"]) / np.linalg.norm(sun["direction"])
    radius = np.radians(sun["angular_radius"])
    up = [0, 1, 0] if abs(to_sun[1]) < 0.9 else [1, 0, 0]
    place = mi.ScalarTransform4f().look_at((FAR * to_sun).tolist(), [0, 0, 0], up)
    return {"type": "disk", "to_world": place @ mi.ScalarTransform4f().scale(float(FAR * np.tan(radius))),
            **surface({"kind": "light", "color": np.array(sun["irradiance"]) / (np.pi * np.sin(radius) ** 2)})}


class Peer:
    about = f"Mitsuba {mi.__version__}, llvm_ad_rgb, path or volpath, multijitter"

    def __init__(self):
        mi.set_log_level(mi.LogLevel.Error)
        dr.set_flag(dr.JitFlag.KernelHistory, True)
        mi.register_texture("solid_checker", SolidChecker)

    def open(self, scene):
        parts = [{"type": "sphere", "center": s["center"], "radius": abs(s["radius"]),
                  "flip_normals": s["radius"] < 0, **surface(s["material"])} for s in scene.spheres]
        for m, share in [*((m, 1.0) for m in scene.meshes), *scene.backs()]:
            parts += shapes(m, share)
        parts += [mesh(medium["boundary"], {"bsdf": {"type": "null"}, "interior": {
            "type": "homogeneous", "albedo": rgb(medium["albedo"]), "sigma_t": float(medium["density"]),
            "phase": {"type": "isotropic"}}}) for medium in scene.media]
        parts += [sun_disc(sun) for sun in scene.suns]
        if np.ndim(scene.sky) == 3:
            # Turn the map: the left edge of Mitsuba's maps is -z, of limn's +z.
            turned = np.ascontiguousarray(np.roll(scene.sky, scene.sky.shape[1] // 2, axis=1))
            parts.append({"type": "envmap", "bitmap": mi.Bitmap(turned)})
        elif scene.sky is not None:
            parts.append({"type": "constant", "radiance": rgb(scene.sky)})
        self.scene = mi.load_dict({"type": "scene", **{f"part{i}": part for i, part in enumerate(parts)}})
        self.camera = scene.camera
        # Use Russian roulette unless light has to pass through glass.
        glass = any("glass" in shape["material"]["kind"] for shape in scene.spheres + scene.meshes)
        self.integrator = {"type": "volpath" if scene.media else "path", "max_depth": scene.max_depth,
                           "rr_depth": 100 if glass else 5}

    def render(self, path, size, spp, seed, threads):
        """Returns the seconds that the kernels take, without those of recording and compiling them."""
        c = self.camera
        told = {"type": "perspective", "fov": c["vertical_fov"], "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e5,
                "to_world": mi.ScalarTransform4f().look_at(c["look_from"], c["look_at"], c["up"]),
                "film": {"type": "hdrfilm", "width": size, "height": size, "pixel_format": "rgb",
                         "component_format": "float32", "rfilter": {"type": "box"}}, "sampler": {"type": "multijitter"}}
        if c["lens_radius"] > 0:
            told.update(type="thinlens", aperture_radius=c["lens_radius"], focus_distance=c["focus_distance"])
        sensor = mi.load_dict(told)
        dr.set_thread_count(threads)
        sensor.sampler().set_sample_count(spp)
        spp = sensor.sampler().sample_count()  # rounded up to a product of rows and columns of strata
        passes = next(n for n in range(1, spp + 1) if spp % n == 0 and spp // n * size**2 <= LANES)
        integrator = mi.load_dict({**self.integrator, "samples_per_pass": spp // passes})
        dr.kernel_history_clear()
        picture = mi.render(self.scene, sensor=sensor, integrator=integrator, spp=spp, seed=seed)
        dr.eval(picture)
        dr.sync_thread()
        seconds = 1e-3 * sum(kernel["execution_time"] for kernel in dr.kernel_history())
        dr.set_thread_count(2)  # with one thread Mitsuba never finishes writing
        mi.Bitmap(picture).write(path)
        return seconds, spp
