# Intersects rays with a mesh, tests which points are inside it, and renders it.
import numpy as np

import limn

vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)
scene = limn.Scene()
scene.add_triangles(vertices, faces, limn.Lambertian((0.7, 0.2, 0.1)))
scene.background = limn.Background.gradient((1, 1, 1), (0.5, 0.7, 1))
compiled = scene.compile()

rays = np.array([[-1, -1, -1, 1, 1, 1], [5, 5, 5, 1, 0, 0]], float)  # origin, direction: one hits a vertex, one misses
hits = compiled.cast_rays(rays)
print(hits["t_hit"], hits["primitive_ids"], compiled.count_intersections(rays))
print(compiled.contains(np.array([[0.2, 0.2, 0.2], [0, 0, 0], [1, 1, 1]], float)))

camera = limn.Camera(look_from=(3, 2, 4), look_at=(0.3, 0.3, 0.3), vertical_fov=25)
image = limn.render(compiled, camera, width=160, height=120, samples_per_pixel=16)  # linear, float32
print(image.shape, limn.to_srgb(image).dtype)
