// The tree of lights: that each node holds what is under it.
#include "flat/compile.h"
#include "limn/scene/material/diffuse_light.h"
#include "property.h"
#include "support/light_of.h"
#include "support/random_geometry.h"
#include "support/scene_zoo.h"

namespace limn::light_tree_test {

using namespace test;
using flat::Light;
using flat::LightNode;

namespace {

std::shared_ptr<const Material> lamp(double radiance) {
    return std::make_shared<DiffuseLight>(Color{radiance, radiance, radiance});
}

flat::Scene random_lights(Random& random) {
    std::vector<Object> objects;
    for (std::size_t i = 0; i < 1 + random.index(30); ++i) {
        const Point3 p = Point3{} + random.in_cube(8);
        const double size = random.log_uniform(0.01, 4);
        const auto m = lamp(random.log_uniform(0.1, 10));
        const Object flat_one = std::make_shared<Quad>(p, size * random.unit(), size * random.unit(), m);
        const auto pose = [&] {
            return Transform::translate(random.in_cube(5)) * Transform::rotate(random.unit(), random.uniform(0, 360));
        };
        switch (random.index(5)) {
            case 0: objects.push_back(std::make_shared<Sphere>(p, size, m)); break;
            case 1: objects.push_back(flat_one); break;
            case 2: objects.push_back(std::make_shared<Sphere>(p, p + random.in_cube(5), size, m)); break;
            case 3: objects.push_back(std::make_shared<Instance>(flat_one, pose(), pose())); break;
            default:
                objects.push_back(std::make_shared<Instance>(
                    std::make_shared<Instance>(std::make_shared<Mesh>(cube_mesh(), m), pose(), pose()), pose(),
                    pose()));
        }
    }
    return compiler::flatten(zoo_of("lamps", objects).scene);
}

// visit(node, first rank) of every node under one; returns where its lights end.
template <class Visit>
void for_each_node(const flat::LightTable& lights, std::size_t node, std::size_t begin, const Visit& visit) {
    const LightNode& n = lights.nodes[node];
    visit(n, begin);
    if (n.right == 0) return;
    for_each_node(lights, node + 1, begin, visit);
    RC_ASSERT(lights.nodes[n.right].end == n.end);
    for_each_node(lights, n.right, lights.nodes[node + 1].end, visit);
}

}  // namespace

TEST_CASE("Light tree: a node's box holds its lights at all times, its cone their normals, its strength their sum",
          "[compile][lights]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const flat::Scene scene = random_lights(random);
        const flat::LightTable& lights = scene.lights;
        RC_ASSERT(lights.nodes.empty() == (lights.size() == 1));
        if (lights.nodes.empty()) return;
        RC_ASSERT(lights.nodes[0].end == lights.size());
        for_each_node(lights, 0, 0, [&](const LightNode& node, std::size_t begin) {
            RC_ASSERT(begin < node.end);
            const double strength = lights.strength_before[node.end] - lights.strength_before[begin];
            RC_ASSERT(std::abs(node.strength - strength) <= 1e-6);
            const auto holds_point = [&](const Point3& p) {
                for (std::size_t a = 0; a < 3; ++a)
                    if (!(std::abs(p[a] - double{node.center[a]}) <= double{node.half[a]})) return false;
                return true;
            };
            const Vec3 axis{node.axis[0], node.axis[1], node.axis[2]};
            for (std::size_t rank = begin; rank < node.end; ++rank) {
                const double time = random.uniform();
                const Light light = light_of(scene, rank, time);
                if (const auto* sphere = std::get_if<flat::SphereLight>(&light)) {
                    const Point3& c = sphere->center;
                    const Vec3 reach{sphere->radius, sphere->radius, sphere->radius};
                    RC_ASSERT(holds_point(c + reach) && holds_point(c - reach));
                    RC_ASSERT(node.cos_spread == flat::kNoNormals || node.cos_spread == 0);
                    continue;
                }
                RC_ASSERT(node.cos_spread != flat::kNoNormals);
                const auto& planar = std::get<flat::PlanarLight>(light);
                const Vec3 u = planar.edge_u, v = planar.edge_v;
                for (const Vec3& corner : {Vec3{}, u, v, planar.shape == flat::PlanarShape::triangle ? u : u + v})
                    RC_ASSERT(holds_point(planar.corner + corner));
                // The cosine is a float.
                RC_ASSERT(std::abs(dot(normalize(cross(u, v)), axis)) >= node.cos_spread - 1e-7 ||
                          node.cos_spread == 0);
            }
        });
    });
}

TEST_CASE("Light tree: each light has one rank, and its number leads to it", "[compile][lights]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const flat::Scene scene = random_lights(random);
        std::vector<bool> seen(scene.lights.size());
        std::uint64_t last = 0;
        for (const flat::LightNumber& n : scene.lights.by_number) {
            RC_ASSERT(!seen[n.rank] && n.number + 1 > last);
            seen[n.rank] = true, last = n.number + 1;
            RC_ASSERT(surface_of(light_of(scene, n.rank, 0))->number == n.number);
        }
        RC_ASSERT(std::count(seen.begin(), seen.end(), false) == 0);
    });
}

TEST_CASE("Light tree: a large mesh that shines takes less than 100 bytes a triangle more than one that does not",
          "[compile][lights]") {
    MeshData grid;
    constexpr std::uint32_t kSide = 100;
    for (std::uint32_t j = 0; j <= kSide; ++j)
        for (std::uint32_t i = 0; i <= kSide; ++i)
            grid.vertices.push_back(
                {static_cast<float>(i), std::sin(0.1F * static_cast<float>(i * j % 60)), static_cast<float>(j)});
    for (std::uint32_t j = 0; j < kSide; ++j)
        for (std::uint32_t i = 0; i < kSide; ++i) {
            const std::uint32_t a = j * (kSide + 1) + i, c = a + kSide + 1;
            grid.triangles.push_back({a, a + 1, c + 1});
            grid.triangles.push_back({a, c + 1, c});
        }
    const auto flattened = [&](const std::shared_ptr<const Material>& m) {
        return compiler::flatten(zoo_of("mesh", {std::make_shared<Mesh>(grid, m)}).scene);
    };
    const flat::Scene lit = flattened(lamp(1)), dark = flattened(std::make_shared<Lambertian>(Color{}));
    CHECK(static_cast<double>(lit.memory_bytes - dark.memory_bytes) / (2 * kSide * kSide) < 100);

    REQUIRE(lit.lights.size() == grid.triangles.size());
    for (std::size_t rank = 0; rank < lit.lights.size(); rank += 97) {
        const auto light = std::get<flat::PlanarLight>(light_of(lit, rank, 0));
        const Index3 t = grid.triangles[light.number];
        const auto at = [&](std::uint32_t i) {
            return Point3{grid.vertices[i].x, grid.vertices[i].y, grid.vertices[i].z};
        };
        REQUIRE(light.shape == flat::PlanarShape::triangle);
        REQUIRE((light.corner == at(t.a) && light.edge_u == at(t.b) - at(t.a) && light.edge_v == at(t.c) - at(t.a)));
    }
}

TEST_CASE("Light tree: lights all in one place, or in one line, make no endless tree", "[compile][lights]") {
    for (const double step : {0.0, 1.0}) {
        std::vector<Object> objects;
        for (int i = 0; i < 1000; ++i)
            objects.push_back(std::make_shared<Sphere>(Point3{step * i, 0, 0}, 0.5, lamp(1)));
        const flat::Scene scene = compiler::flatten(zoo_of("lamps", objects).scene);
        CHECK(scene.lights.size() == 1000);
        CHECK(scene.lights.nodes.size() == 1999);
    }
}

}  // namespace limn::light_tree_test
