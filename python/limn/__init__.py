"""Exact ray queries, and path tracing.

    scene = limn.Scene()
    scene.add_triangles(vertices, faces)         # (n, 3) float32, (m, 3) uint32
    hits = scene.compile().cast_rays(rays)       # (..., 6) float64: origin and direction

`limn.open3d` and `limn.trimesh` have the interfaces of Open3D's RaycastingScene and of trimesh's RayMeshIntersector.
Arrays must be C-contiguous and are not copied. Errors are a TypeError or a ValueError that names the argument.
"""

from ._limn import (INVALID_ID, Background, Camera, Checker, CompiledScene, ConstantMedium, Dielectric, DiffuseLight,
                    Disk, Hittable, HittableList, ImageTexture, Instance, Isotropic, Lambertian, Marble, Material, Mesh,
                    Metal, Noise, OrenNayar, Progress, Quad, Scene, SolidColor, Sphere, Texture, Triangle, Turbulence,
                    __version__, make_box, to_srgb)
from ._render import RenderResult, render, render_with_report

__all__ = ["INVALID_ID", "Background", "Camera", "Checker", "CompiledScene", "ConstantMedium", "Dielectric",
           "DiffuseLight", "Disk", "Hittable", "HittableList", "ImageTexture", "Instance", "Isotropic", "Lambertian",
           "Marble", "Material", "Mesh", "Metal", "Noise", "OrenNayar", "Progress", "Quad", "RenderResult", "Scene",
           "SolidColor", "Sphere", "Texture", "Triangle", "Turbulence", "__version__", "make_box", "render",
           "render_with_report", "to_srgb"]
