"""Exact ray queries, and path tracing.

    scene = limn.Scene()
    scene.add_triangles(vertices, faces)         # (n, 3) float32, (m, 3) uint32
    hits = scene.compile().cast_rays(rays)       # (..., 6) float64: origin and direction

`limn.open3d` has the interface of Open3D's RaycastingScene. `limn.trimesh` has the interface of trimesh's
RayMeshIntersector. Arrays must be C-contiguous. Arrays of rays and points are read in place; a mesh copies its arrays.
A wrong argument raises a TypeError or a ValueError that names the argument.
"""

from . import _limn
from ._limn import (INVALID_ID, AlphaMask, Background, Camera, Checker, CompiledScene, ConstantMedium, Dielectric,
                    DiffuseLight, DirectionalLight, Disk, EnvironmentMap, Hittable, HittableList, ImageTexture,
                    Instance, Isotropic, Lambertian, Marble, Material, Mesh, Metal, MetallicRoughness, Noise, NormalMap,
                    OrenNayar, Plastic, PointLight, Progress, Quad, RoughConductor, RoughDielectric, Scene, Sky,
                    SolidColor, Sphere, SpotLight, SunLight, Texture, Triangle, Turbulence, make_box, make_sky, to_srgb)
from ._render import FirstHits, RenderResult, first_hits, render, render_with_report

__version__: str = getattr(_limn, "__version__")

__all__ = ["INVALID_ID", "AlphaMask", "Background", "Camera", "Checker", "CompiledScene", "ConstantMedium",
           "Dielectric", "DiffuseLight", "DirectionalLight", "Disk", "EnvironmentMap", "FirstHits", "Hittable",
           "HittableList", "ImageTexture", "Instance", "Isotropic", "Lambertian", "Marble", "Material", "Mesh", "Metal",
           "MetallicRoughness", "Noise", "NormalMap", "OrenNayar", "Plastic", "PointLight", "Progress", "Quad",
           "RenderResult", "RoughConductor", "RoughDielectric", "Scene", "Sky", "SolidColor", "Sphere", "SpotLight",
           "SunLight", "Texture", "Triangle", "Turbulence", "__version__", "first_hits", "make_box", "make_sky",
           "render", "render_with_report", "to_srgb"]
