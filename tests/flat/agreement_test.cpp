// The compiled scene finds what the described objects find: the same object, element, t, u and v, bit for bit.
#include "catch.h"
#include "limn/query/compiled_scene.h"
#include "support/scene_zoo.h"
#include "support/tally.h"

namespace limn::agreement_test {

using namespace test;

namespace {

struct Found {
    Hit hit;
    std::size_t object = 0;
};

// The definition: every object by its virtual hit(), the nearest, of equally near ones the first.
std::optional<Found> brute_force(const Scene& scene, Ray ray) {
    std::optional<Found> nearest;
    for (std::size_t i = 0; i < scene.objects().size(); ++i) {
        const auto hit = scene.objects()[i]->hit(ray);
        if (!hit || (nearest && hit->t >= nearest->hit.t)) continue;
        nearest = Found{*hit, i};
        ray.t_max = hit->t;
    }
    return nearest;
}

void compare(const Scene& scene, const CompiledScene& compiled, const Ray& ray, Tally& tally) {
    ++tally.rays;
    const auto expected = brute_force(scene, ray);
    const auto found = compiled.closest_hit(ray);
    if ((expected && is_at_origin(ray, expected->hit.t)) || (found && is_at_origin(ray, found->t))) return;
    ++tally.judged;
    if (expected.has_value() != found.has_value()) return tally.fault(ray, expected ? "missed" : "false hit");
    if (compiled.any_hit(ray) != found.has_value()) return tally.fault(ray, "any_hit");
    if (!found) return;
    ++tally.hits;
    const Hit& e = expected->hit;
    if (found->t != e.t) return tally.fault(ray, "t");
    if (found->object != expected->object) return tally.fault(ray, "object");
    if (found->element != e.element) return tally.fault(ray, "element");
    if (found->index_matched != e.index_matched) return tally.fault(ray, "index_matched");
    // Of a sphere RayHit has no u and v; of everything else they are hit()'s.
    const bool has_uv = found->u != 0 || found->v != 0;
    if (has_uv && (found->u != e.u || found->v != e.v)) return tally.fault(ray, "u, v");

    const Surface s = compiled.surface_at(ray, *found);
    const Uv uv = e.uv.value_or(Uv{e.u, e.v});
    const bool front = dot(e.normal, ray.direction) < 0;
    if (s.front_face != front && std::abs(dot(e.normal, normalize(ray.direction))) > 1e-12)
        return tally.fault(ray, "front_face");
    if (length(Vec3(s.front_face ? s.normal : -s.normal) - Vec3(e.normal)) > 1e-12) return tally.fault(ray, "normal");
    // A sphere's u jumps at its seam and means nothing at its poles.
    const double around = std::abs(s.uv.u - uv.u),
                 du = std::min(around, std::abs(1 - around)) * std::sin(kPi * std::clamp(uv.v, 0.0, 1.0));
    if (std::min(du, around) > 1e-6 || std::abs(s.uv.v - uv.v) > 1e-6) return tally.fault(ray, "uv");
    // t is right to a float ulp, and a ray that grazes the surface fixes the point along itself only so well.
    const double magnitude = length(s.position - Point3{}) + std::abs(found->t) * length(ray.direction);
    const double grazing = std::abs(dot(s.normal, normalize(ray.direction)));
    const double apart = length(s.position - ray.at(found->t)) * grazing;
    if (!(apart <= 0x1p-22 * magnitude + length(s.position_error))) return tally.fault(ray, "position");
}

void compare(const ZooScene& zoo, int rays, std::uint64_t seed, double least_hits = 0.05) {
    const CompiledScene compiled = compile(zoo.scene);
    Random random(seed);
    Tally tally;
    for (int i = 0; i < rays; ++i) compare(zoo.scene, compiled, random_ray(random, zoo.targets), tally);
    INFO(zoo.name << ": " << tally.first);
    CHECK(tally.wrong == 0);
    CHECK(tally.judged >= tally.rays * 95 / 100);
    CHECK(static_cast<double>(tally.hits) >= least_hits * rays);
}

}  // namespace

TEST_CASE("compile: spheres are hit as the described ones", "[compile]") {
    compare(zoo_of_kind("spheres", 0, 40, 200), 100000, 300);
}
TEST_CASE("compile: moving spheres are hit as the described ones", "[compile]") {
    compare(zoo_of_kind("moving", 1, 40, 201), 100000, 301);
}
TEST_CASE("compile: triangles are hit as the described ones", "[compile]") {
    compare(zoo_of_kind("triangles", 2, 40, 202), 100000, 302);
}
TEST_CASE("compile: quads are hit as the described ones", "[compile]") {
    compare(zoo_of_kind("quads", 3, 40, 203), 100000, 303);
}
TEST_CASE("compile: mesh triangles are hit as the described ones", "[compile]") { compare(zoo_mesh(), 100000, 304); }
TEST_CASE("compile: instances, nested, moving and mirrored, are hit as the described ones", "[compile]") {
    compare(zoo_instances(), 100000, 305);
}
TEST_CASE("compile: boundaries of media are hit as the described ones", "[compile]") {
    compare(zoo_media(), 100000, 306);
}
TEST_CASE("compile: a user's own shapes are hit as the described ones", "[compile]") {
    compare(zoo_strangers(), 100000, 307);
}
TEST_CASE("compile: sizes from 1e-4 to 1e6 at 1e5 are hit as the described ones", "[compile]") {
    compare(zoo_scales(), 20000, 308);
}

TEST_CASE("compile: mixed scenes of nested everything are hit as the described ones", "[compile]") {
    for (std::uint64_t i = 0; i < 40; ++i) compare(zoo_mixed(400 + i), 3000, 500 + i, 0.005);
}

TEST_CASE("compile: scenes of 0, 1, 2, 3 and 2^k +- 1 primitives are hit as the described ones", "[compile]") {
    for (const std::size_t count : {0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 15u, 16u, 17u, 31u, 33u, 63u, 65u, 127u, 129u})
        compare(zoo_of_kind("count " + std::to_string(count), count % 5, count, 600 + count), 2000, 700 + count, 0);
}

TEST_CASE("compile: empty and unbounded objects are hit as the described ones", "[compile]") {
    class Nothing final : public Hittable {
    public:
        Box bounds() const override { return {}; }
        std::optional<Hit> hit(const Ray&) const override { return std::nullopt; }
    };
    compare(zoo_of("nothing", {std::make_shared<Nothing>(), std::make_shared<HittableList>(),
                               std::make_shared<Bvh>(std::vector<Object>{}),
                               std::make_shared<Instance>(std::make_shared<HittableList>(), Transform{})}),
            1000, 309, 0);
    compare(zoo_of("floor",
                   {std::make_shared<Floor>(), ball({0, 1, 0}, 1), ball({3, 1, 0}, 1), std::make_shared<Nothing>()}),
            10000, 310);
    compare(zoo_of("instanced floor",
                   {std::make_shared<Instance>(std::make_shared<Floor>(), Transform::translate({0, -1, 0})),
                    ball({0, 1, 0}, 1)}),
            10000, 311);
}

TEST_CASE("compile: ten thousand small balls and a mesh are hit as the described ones", "[compile]") {
    Random random(312);
    std::vector<Object> objects{ball({0, -1000, 0}, 1000),
                                std::make_shared<Mesh>(icosphere(2, 0.5, {1, 1, 0}), nullptr)};
    for (int i = 0; i < 10000; ++i)
        objects.push_back(ball(Point3{} + random.in_cube(20), random.log_uniform(1e-3, 0.5)));
    compare(zoo_of("many", objects), 1500, 313);
}

TEST_CASE("compile: rays that start close beside large tilted shapes are answered as by the described ones",
          "[compile]") {
    // Where the origin is all but in the plane, float has to tell on which side, and to say when it cannot.
    Random random(323);
    Tally tally;
    for (int shape = 0; shape < 300; ++shape) {
        const double size = std::pow(10, random.uniform(-2, 3)), tilt = std::pow(10, random.uniform(-3, 0));
        const auto edge = [&] {  // mostly along two axes, a little along the third
            const Vec3 v = size * random.in_cube(1);
            return shape % 3 == 0 ? Vec3{v.x, v.y, tilt * v.z} : shape % 3 == 1 ? Vec3{tilt * v.x, v.y, v.z} : v;
        };
        const auto to_float = [](const Vec3& v) {
            return Vec3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        };
        const Point3 corner = Point3{} + to_float(size * random.in_cube(1));
        Vec3 u = to_float(edge());
        const Vec3 v = to_float(edge());
        if (shape % 5 < 2)
            u = to_float({u.x, 1e-5 * u.y, 1e-5 * u.z});  // all but along an axis: most products are small
        const Point3 b = corner + u, c = corner + v;
        Scene scene;
        if (shape % 2 == 0) {
            scene.add(std::make_shared<Quad>(corner, u, v, nullptr));
        } else {
            const auto vertex = [](const Point3& p) {
                return Float3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
            };
            MeshData data;
            data.vertices = {vertex(corner), vertex(b), vertex(c)};
            data.triangles = {{0, 1, 2}};
            scene.add(std::make_shared<Mesh>(data, nullptr));
        }
        const CompiledScene compiled = compile(scene);
        for (int i = 0; i < 200; ++i) {
            const double s = random.uniform(0, 0.6),
                         t = i % 2 ? random.uniform(0, 1 - s) : random.log_uniform(1e-4, 0.3);
            const Vec3 off =
                random.in_cube(size * std::pow(10, i % 3 ? random.uniform(-9, -6) : random.uniform(-12, -2)));
            const Point3 origin = corner + s * u + t * v + off;
            compare(scene, compiled, {.origin = origin, .direction = random.in_cube(1)}, tally);
            compare(scene, compiled, {.origin = origin, .direction = -1 * off + 1e-3 * random.in_cube(max_abs(off))},
                    tally);
        }
    }
    INFO(tally.first);
    CHECK(tally.wrong == 0);
    CHECK(tally.hits > 20000);
}

}  // namespace limn::agreement_test
