// Rays that are hard for a walk: they start or end at vertices, edges and hits, go through them, lie in planes or along
// axes. Both walks must answer with the same bits: that of ordinary rays, and the general one, which is the only one on
// processors without vectors of eight floats.
#include <bit>
#include <cstdint>

#include "flat/scene.h"
#include "hard/hard.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "support/meshes.h"
#include "support/random_geometry.h"
#include "trace/targets.h"

namespace limn::walk_test {

using namespace test;

namespace {

using Object = std::shared_ptr<const Hittable>;

struct HardScene {
    std::string name;
    std::vector<Object> objects;
    std::vector<Point3> points;  // on surfaces: vertices, edges, centroids
    std::vector<Vec3> edges;
};

void add_points_of(HardScene& scene, const MeshData& mesh, const Transform& world_from_object = {}) {
    for (const auto& triangle : mesh.triangles) {
        const Point3 a = transform_point(world_from_object, vertex(mesh, triangle.a));
        const Point3 b = transform_point(world_from_object, vertex(mesh, triangle.b));
        const Point3 c = transform_point(world_from_object, vertex(mesh, triangle.c));
        scene.points.push_back(a);
        scene.points.push_back(a + 0.5 * (b - a));
        scene.points.push_back(a + (1 / 3.0) * ((b - a) + (c - a)));
        scene.edges.push_back(b - a);
    }
}

HardScene with_mesh() {
    HardScene scene{"a mesh", {}, {}, {}};
    for (const MeshData& data : {icosphere(3), cube_mesh(0.5, {1, 0, 0}), icosphere(2, 0.01, {1, 1, 1})}) {
        scene.objects.push_back(std::make_shared<Mesh>(data, nullptr));
        add_points_of(scene, data);
    }
    return scene;
}

HardScene with_quads() {
    HardScene scene = with_mesh();
    scene.name = "a mesh and quads";
    Random random(1);
    for (int i = 0; i < 80; ++i) {
        const Point3 corner = Point3{} + random.in_cube(2);
        const Vec3 u = 0.3 * random.unit(), v = 0.3 * random.unit();
        scene.objects.push_back(std::make_shared<Quad>(corner, u, v, nullptr));
        scene.points.push_back(corner);
        scene.points.push_back(corner + 0.5 * u);
        scene.edges.push_back(u);
    }
    return scene;
}

HardScene with_spheres(bool moving) {
    HardScene scene{moving ? "moving spheres" : "spheres", {}, {}, {}};
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Point3 center = Point3{} + random.in_cube(2);
        const double radius = i == 0 ? 100 : random.log_uniform(0.01, 0.4);
        const Point3 from = i == 0 ? Point3{0.1, -102, 0} : center;
        if (moving && i % 3 != 0)
            scene.objects.push_back(std::make_shared<Sphere>(from, from + random.in_cube(0.2), radius, nullptr));
        else
            scene.objects.push_back(std::make_shared<Sphere>(from, radius, nullptr));
        const Vec3 out = random.unit();
        scene.points.push_back(from + radius * out);
        scene.points.push_back(from);
        scene.edges.push_back(cross(out, random.unit()));
    }
    return scene;
}

HardScene with_instances(bool moving) {
    HardScene scene{moving ? "moving instances of a mesh" : "instances of a mesh", {}, {}, {}};
    Random random(3);
    const MeshData data = icosphere(2, 0.3);
    const Object mesh = std::make_shared<Mesh>(data, nullptr);
    for (int i = 0; i < 70; ++i) {
        const Transform m = Transform::translate(random.in_cube(2)) *
                            Transform::rotate(random.unit(), random.uniform(0, 360)) *
                            Transform::scale(1, random.log_uniform(0.2, 2), 1);
        if (moving && i % 3 != 0)
            scene.objects.push_back(std::make_shared<Instance>(mesh, m, Transform::translate(random.in_cube(0.2)) * m));
        else
            scene.objects.push_back(std::make_shared<Instance>(mesh, m));
        if (i < 8) add_points_of(scene, data, m);
    }
    return scene;
}

Ray hard_ray(const HardScene& scene, Random& random) {
    const auto point = [&] { return scene.points[random.index(scene.points.size())]; };
    const auto axis = [&] {
        Vec3 d;
        d[random.index(3)] = random.sign();
        return d;
    };
    Ray ray{.origin = random.chance(0.5) ? point() : Point3{} + random.in_cube(4), .direction = random.unit()};
    if (random.chance(0.3))
        for (std::size_t a = 0; a < 3; ++a) ray.origin[a] = static_cast<double>(static_cast<float>(ray.origin[a]));
    switch (random.index(5)) {
        case 0: ray.direction = point() - ray.origin; break;
        case 1: ray.direction = scene.edges[random.index(scene.edges.size())]; break;
        case 2: ray.direction = axis(); break;
        case 3: ray.direction = axis() + 1e-9 * random.in_cube(); break;
        default: break;
    }
    if (ray.direction == Vec3{}) ray.direction = random.unit();
    // A few rays are long, short, from far away or have a negative t_min, so that they are not ordinary.
    if (random.chance(0.1)) ray.direction = random.log_uniform(1e-4, 1e4) * ray.direction;
    if (random.chance(0.1)) ray.origin = ray.origin - random.log_uniform(1, 1e4) * ray.direction;
    if (random.chance(0.05)) ray.t_min = random.uniform(-2, 0);
    ray.time = random.uniform();
    if (random.chance(0.1)) ray.t_max = 1;
    return ray;
}

// The bits of an answer.
std::array<std::uint64_t, 4> bits_of(const RayHit& hit) {
    return {hit.primitive, std::bit_cast<std::uint64_t>(hit.t), std::bit_cast<std::uint64_t>(hit.u),
            std::bit_cast<std::uint64_t>(hit.v)};
}

// Traces the rays one by one and in a batch, which must agree.
std::vector<RayHit> traced(const CompiledScene& scene, const std::vector<Ray>& rays, Tally& tally) {
    std::vector<RayHit> hits(rays.size());
    std::vector<std::uint8_t> occluded(rays.size());
    scene.closest_hit(rays, hits);
    scene.any_hit(rays, occluded);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayHit alone = scene.closest_hit(rays[i]).value_or(RayHit{});
        if (bits_of(alone) != bits_of(hits[i])) tally.fault(rays[i], "batch");
        const bool is_hit = alone.t < kInfinity;
        if (scene.any_hit(rays[i]) != is_hit || (occluded[i] != 0) != is_hit) tally.fault(rays[i], "any hit");
    }
    return hits;
}

}  // namespace

TEST_CASE("Walks: hard rays have the same answers on both walks, alone and in batches, as the described objects",
          "[hard][walk]") {
    const std::vector<std::string> targets = trace::targets();
    for (const HardScene& scene : {with_mesh(), with_quads(), with_spheres(false), with_spheres(true),
                                   with_instances(false), with_instances(true)}) {
        Scene described;
        for (const Object& object : scene.objects) described.add(object);
        const CompiledScene compiled = compile(described);
        REQUIRE_FALSE(compiled.flat().list.is_all);
        Random random(4);
        Tally tally;
        const std::size_t part = 1000, parts = static_cast<std::size_t>(count(2e5)) / part;
        for (std::size_t i = 0; i < parts; ++i) {
            std::vector<Ray> rays;
            for (std::size_t k = 0; k < part; ++k) rays.push_back(hard_ray(scene, random));
            // Let some rays start or end at a hit.
            std::vector<RayHit> hits = traced(compiled, rays, tally);
            for (std::size_t k = 0; k < part; ++k) {
                if (k % 4 == 1 && hits[k].t < kInfinity) rays[k].t_min = hits[k].t;
                if (k % 4 == 2 && hits[k].t < kInfinity) rays[k].t_max = hits[k].t;
            }
            hits = traced(compiled, rays, tally);
            trace::force_target(targets.back());
            const std::vector<RayHit> general = traced(compiled, rays, tally);
            trace::force_target(targets.front());
            for (std::size_t k = 0; k < part; ++k) {
                ++tally.rays;
                ++tally.judged;
                if (bits_of(hits[k]) != bits_of(general[k])) tally.fault(rays[k], "the walks differ");
                // The described objects take longer: a share is compared with them.
                if (k % 20 != 0) continue;
                double t = kInfinity;
                for (const Object& object : scene.objects)
                    if (const auto hit = object->hit(rays[k])) t = std::min(t, hit->t);
                if (t != hits[k].t) tally.fault(rays[k], "the described objects differ");
            }
        }
        check(tally, scene.name);
    }
}

}  // namespace limn::walk_test
