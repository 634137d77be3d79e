// Prints the object that each ray hits, the distance, and whether a lamp lights the hit point.
#include <limn/limn.h>

#include <iostream>

using namespace limn;

int main() {
    Scene scene;
    scene.add(std::make_shared<Quad>(Point3{-9, 0, 9}, Vec3{18, 0, 0}, Vec3{0, 0, -18}, nullptr));  // object 0
    scene.add(std::make_shared<Sphere>(Point3{0, 1, 0}, 1.0, nullptr));                             // object 1
    const CompiledScene compiled = compile(scene);

    const Point3 lamp{3, 3, 3};
    for (const double x : {-2, -1, 0, 12}) {
        const Ray ray{.origin = {x, 3, 6}, .direction = {0, -3, -6}};
        const std::optional<RayHit> hit = compiled.closest_hit(ray);
        if (!hit) continue;  // the last ray misses
        const Surface surface = compiled.surface_at(ray, *hit);
        const bool is_lit = !compiled.any_hit(surface.spawn_ray_to(lamp, ray.time));
        std::cout << "object " << hit->object << " at t = " << hit->t << (is_lit ? ", lit" : ", in shadow") << '\n';
    }
}
