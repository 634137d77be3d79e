// Which of many lights is sampled: that the probabilities are what they are said to be, and leave no light out.
#include "property.h"
#include "support/light_of.h"
#include "support/pictures.h"
#include "support/single_shading.h"

namespace limn::light_choice_test {

using namespace test;

namespace {

// A mesh whose triangles lie anywhere, of any size.
Object loose_triangles(Random& random, int count, const MaterialPtr& m) {
    MeshData mesh;
    for (int i = 0; i < count; ++i) {
        const Point3 p = Point3{} + random.in_cube(8);
        const double size = random.log_uniform(0.01, 3);
        for (int k = 0; k < 3; ++k) mesh.vertices.push_back(to_float3(p + random.in_cube(size) - Point3{}));
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return std::make_shared<Mesh>(mesh, m);
}

// Lamps of all kinds and strengths among each other.
CompiledScene random_lights(Random& random) {
    std::vector<Object> objects;
    for (std::size_t i = 0; i < 2 + random.index(40); ++i) {
        const MaterialPtr m = lamp(random.log_uniform(1e-3, 1e3));
        const Point3 p = Point3{} + random.in_cube(8);
        const double size = random.log_uniform(0.01, 4);
        switch (random.index(5)) {
            case 0: objects.push_back(sphere(p, size, m)); break;
            case 1: objects.push_back(quad(p, size * random.unit(), size * random.unit(), m)); break;
            case 2: objects.push_back(std::make_shared<Sphere>(p, p + random.in_cube(3), size, m)); break;
            case 3: objects.push_back(loose_triangles(random, 1 + static_cast<int>(random.index(30)), m)); break;
            default:
                objects.push_back(std::make_shared<Instance>(quad({}, size * random.unit(), random.unit(), m),
                                                             Transform::translate(random.in_cube(8)),
                                                             Transform::rotate(random.unit(), 200)));
        }
    }
    return compile_with(sky(0), objects);
}

Receiver random_receiver(Random& random) {
    const Point3 from = Point3{} + random.in_cube(random.log_uniform(1, 100));
    return {from, random.chance(0.3) ? Vec3{} : random.unit()};
}

// A point on a light.
Point3 point_on(const flat::Light& light, Random& random) {
    if (const auto* sphere = std::get_if<flat::SphereLight>(&light))
        return sphere->center + sphere->radius * random.unit();
    const auto& planar = std::get<flat::PlanarLight>(light);
    double u = random.uniform(), v = random.uniform();
    if (planar.shape == flat::PlanarShape::triangle && u + v > 1) u = 1 - u, v = 1 - v;
    return planar.corner + (u * planar.edge_u + v * planar.edge_v);
}

}  // namespace

TEST_CASE("Light choice: each light is chosen with its probability, and else there is none to choose",
          "[render][lights]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const CompiledScene scene = random_lights(random);
        const flat::LightTable& lights = scene.flat().lights;
        const Receiver receiver = random_receiver(random);
        constexpr int kPicks = 2000;
        std::vector<int> counts(lights.size());
        double sum = 0;
        for (int i = 0; i < kPicks; ++i) {
            const std::optional<LightChoice> choice = choose_light(lights, receiver, (i + 0.5) / kPicks);
            if (!choice) {
                sum += 1.0 / kPicks;
                continue;
            }
            ++counts[choice->rank];
            const double p = probability_of(lights, receiver, choice->rank);
            RC_ASSERT(std::abs(choice->probability - p) <= 1e-12 * p);
        }
        // The picks of one light are one interval, and those that find nothing as many as there are nodes at most.
        for (std::size_t rank = 0; rank < lights.size(); ++rank) {
            const double p = probability_of(lights, receiver, rank);
            RC_ASSERT(std::abs(counts[rank] - kPicks * p) <= 1 + 1e-9);
            sum += p;
        }
        RC_ASSERT(std::abs(sum - 1) <= (sum == 1 ? 0 : static_cast<double>(lights.size()) / kPicks));
    });
}

TEST_CASE("Light choice: where light counts from everywhere the probabilities add up to 1", "[render][lights]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const CompiledScene scene = random_lights(random);
        const flat::LightTable& lights = scene.flat().lights;
        const Receiver receiver{random_receiver(random).position, {}};
        double sum = 0;
        for (std::size_t rank = 0; rank < lights.size(); ++rank) sum += probability_of(lights, receiver, rank);
        RC_ASSERT(std::abs(sum - 1) <= 1e-12);
        for (const double pick : {0.0, random.uniform(), 1 - 0x1p-53})
            RC_ASSERT(choose_light(lights, receiver, pick)->probability > 0);
    });
}

TEST_CASE("Light choice: every light of which a point is before the receiver may be chosen", "[render][lights]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const CompiledScene scene = random_lights(random);
        const flat::LightTable& lights = scene.flat().lights;
        const Receiver receiver = random_receiver(random);
        for (std::size_t rank = 0; rank < lights.size(); ++rank) {
            const double time = random.uniform();
            const Vec3 way = point_on(light_of(scene.flat(), rank, time), random) - receiver.position;
            if (receiver.normal == Vec3{} || dot(receiver.normal, way) > 0)
                RC_ASSERT(probability_of(lights, receiver, rank) > 0);
        }
    });
}

TEST_CASE("Light choice: a single light takes no tree", "[render][lights]") {
    const CompiledScene scene = compile_with(sky(0), {sphere({0, 2, 0}, 1, lamp(1))});
    const flat::LightTable& lights = scene.flat().lights;
    CHECK(lights.nodes.empty());
    CHECK(choose_light(lights, {{0, 0, 0}, {0, -1, 0}}, 0.5)->probability == 1);
    CHECK(probability_of(lights, {{0, 0, 0}, {0, -1, 0}}, 0) == 1);
}

TEST_CASE("Light choice: of small lights alike the odds go with strength, cosines and 1 / distance^2",
          "[render][lights]") {
    // A quad's first corner is at p; all are small against their distances.
    const auto small = [](const Point3& p, const Vec3& u, const Vec3& v, double radiance) {
        return quad(p, 1e-4 * u, 1e-4 * v, lamp(radiance));
    };
    const Vec3 x{1, 0, 0}, z{0, 0, 1};
    const Receiver receiver{{0, 0, 0}, {0, 1, 0}};
    const auto odds = [&](const Object& a, const Object& b, const Receiver& at) {
        const CompiledScene scene = compile_with(sky(0), {a, b});
        const flat::LightTable& lights = scene.flat().lights;
        const auto rank = [&](std::size_t i) { return lights.by_number[i].rank; };
        return probability_of(lights, at, rank(0)) / probability_of(lights, at, rank(1));
    };
    // So far from each other that they are not taken for alike.
    const Object above = small({0, 4, 0}, x, z, 1);
    CHECK(odds(small({0, 1, 0}, x, z, 1), above, receiver) == Approx(16).epsilon(1e-3));
    CHECK(odds(small({0, 1, 0}, x, z, 7), above, receiver) == Approx(112).epsilon(1e-3));
    CHECK(odds(small({0, 1, 0}, 3 * x, z, 1), above, receiver) == Approx(48).epsilon(1e-3));
    // Seen under 60 degrees from the receiver's normal, and turned to it; then turned up.
    const Point3 aside{std::sqrt(0.75), 0.5, 0};
    CHECK(odds(small(aside, {0.5, -std::sqrt(0.75), 0}, z, 1), above, receiver) == Approx(8).epsilon(2e-3));
    CHECK(odds(small(aside, x, z, 1), above, receiver) == Approx(4).epsilon(2e-3));
    CHECK(odds(small(aside, x, z, 1), above, {receiver.position, {}}) == Approx(8).epsilon(2e-3));
    // A ball is as strong as the disc that it is seen as, from everywhere.
    CHECK(odds(sphere({0.6, 0.8, 0}, 1e-4, lamp(1)), above, receiver) == Approx(16 * kPi * 0.8).epsilon(2e-3));
    CHECK(odds(small({0, -2, 0}, x, z, 1), above, receiver) == 0);
}

TEST_CASE("Light choice: lights far away are chosen by their strengths alone", "[render][lights]") {
    std::vector<Object> objects;
    for (int i = 0; i < 60; ++i)
        objects.push_back(quad({0.1 * i, 0, 0}, {0.05, 0, 0}, {0, 0, 0.05}, lamp(i % 10 == 0 ? 100 : 1)));
    const CompiledScene scene = compile_with(sky(0), objects);
    const flat::LightTable& lights = scene.flat().lights;
    const double all = 6 * 100 + 54;
    for (std::size_t i = 0; i < 60; ++i) {
        const double p = probability_of(lights, {{0, -60, 0}, {0, 1, 0}}, lights.by_number[i].rank);
        CHECK(p == Approx((i % 10 == 0 ? 100 : 1) / all).epsilon(1e-12));
    }
}

TEST_CASE("Light choice: lights of extreme sizes and places are still chosen among", "[render][lights]") {
    for (const double scale : {1e-150, 1e-30, 1e30, 1e100}) {
        std::vector<Object> objects;
        for (int i = 0; i < 9; ++i)
            objects.push_back(quad({scale * i, scale, 0}, {0.5 * scale, 0, 0}, {0, 0, 0.5 * scale}, lamp(1)));
        const CompiledScene scene = compile_with(sky(0), objects);
        const flat::LightTable& lights = scene.flat().lights;
        CAPTURE(scale, lights.size());
        if (lights.empty()) continue;
        for (const Vec3& normal : {Vec3{}, Vec3{0, 1, 0}}) {
            double sum = 0;
            for (std::size_t rank = 0; rank < lights.size(); ++rank) {
                const double p = probability_of(lights, {{}, normal}, rank);
                CHECK(p > 0);
                sum += p;
            }
            CHECK(sum == Approx(1));
        }
    }
}

}  // namespace limn::light_choice_test
