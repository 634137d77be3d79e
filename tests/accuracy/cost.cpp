#include "accuracy/cost.h"

#include <chrono>
#include <functional>

#include "limn/query/compiled_scene.h"
#include "limn/shape/quad.h"
#include "limn/shape/sphere.h"
#include "limn/shape/triangle.h"
#include "support/meshes.h"
#include "support/random_geometry.h"

namespace limn::accuracy {

namespace {

constexpr int kRays = 8192, kRounds = 25;

// Least of several rounds: what others take away from the machine only ever adds.
double nanoseconds_each(const std::vector<Ray>& rays, const std::function<std::size_t(const std::vector<Ray>&)>& ask) {
    double least = kInfinity;
    for (int round = 0; round < kRounds; ++round) {
        const auto start = std::chrono::steady_clock::now();
        std::size_t hits = 0;
        for (int i = 0; i < 8; ++i) hits += ask(rays);
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
        if (hits > 0) least = std::min(least, took.count() / (8.0 * static_cast<double>(rays.size())));
    }
    return least;
}

// From a shell of radius 5 around the origin to points up to `reach` from it, every second one beside a unit shape.
std::vector<Ray> inward_rays(double reach) {
    test::Random random(42);
    std::vector<Ray> rays;
    for (int i = 0; i < kRays; ++i) {
        const Point3 from = Point3{} + 5 * random.unit();
        rays.push_back({.origin = from, .direction = Point3{} + random.in_cube(reach) - from});
    }
    return rays;
}

double cost_of(const Hittable& shape) {
    return nanoseconds_each(inward_rays(1), [&](const std::vector<Ray>& rays) {
        std::size_t hits = 0;
        for (const Ray& ray : rays) hits += shape.hit(ray).has_value();
        return hits;
    });
}

double cost_of(const Scene& scene, double reach) {
    const CompiledScene compiled = compile(scene);
    return nanoseconds_each(inward_rays(reach), [&](const std::vector<Ray>& rays) {
        std::size_t hits = 0;
        for (const Ray& ray : rays) hits += compiled.closest_hit(ray).has_value();
        return hits;
    });
}

}  // namespace

nlohmann::ordered_json measure_cost() {
    nlohmann::ordered_json out;
    out["hit() of a sphere, ns"] = cost_of(Sphere({0, 0, 0}, 0.8, nullptr));
    out["hit() of a triangle, ns"] = cost_of(Triangle({-1, -1, 0.1}, {1, -1, -0.1}, {0.1, 1, 0.2}, nullptr));
    out["hit() of a quad, ns"] = cost_of(Quad({-0.7, -0.7, 0.1}, {1.4, 0.1, 0}, {0, 1.4, 0.2}, nullptr));

    Scene mesh;
    mesh.add(std::make_shared<Mesh>(test::icosphere(5), nullptr));
    out["compiled icosphere of 20480 triangles, ns"] = cost_of(mesh, 1);

    Scene spheres;
    test::Random random(7);
    for (int i = 0; i < 500; ++i) {
        const Point3 center = Point3{} + random.in_cube(2);
        spheres.add(std::make_shared<Sphere>(center, random.uniform(0.02, 0.2), nullptr));
    }
    out["compiled 500 spheres, ns"] = cost_of(spheres, 2);
    return out;
}

}  // namespace limn::accuracy
