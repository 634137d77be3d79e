// The table of emitters that can be sampled: which, where they stand, and how often each is picked.
#include "catch.h"
#include "flat/compile.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/image_texture.h"
#include "limn/scene/texture/perlin.h"
#include "limn/scene/texture/solid.h"
#include "support/light_of.h"
#include "support/real.h"
#include "support/scene_zoo.h"
#include "support/tally.h"

namespace limn::lights_test {

using namespace test;
using flat::Light;
using flat::PlanarShape;

namespace {

using MaterialPtr = std::shared_ptr<const Material>;
using TexturePtr = std::shared_ptr<const Texture>;

MaterialPtr lamp(const Color& radiance) { return std::make_shared<DiffuseLight>(radiance); }
MaterialPtr lamp(const TexturePtr& radiance) { return std::make_shared<DiffuseLight>(radiance); }
MaterialPtr white_lamp() { return lamp(Color{1, 1, 1}); }
MaterialPtr grey() { return std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5}); }

Object unit_quad(const MaterialPtr& m) {
    return std::make_shared<Quad>(Point3{1, 2, 3}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, m);
}
Object seen(const Object& object, const Transform& m) { return std::make_shared<Instance>(object, m); }

// In the order of their primitives' numbers, as they are at a time.
std::vector<Light> lights_of(const std::vector<Object>& objects, double time = 0) {
    const flat::Scene scene = compiler::flatten(zoo_of("lamps", objects).scene);
    std::vector<Light> lights;
    for (const flat::LightNumber& n : scene.lights.by_number) {
        lights.push_back(light_of(scene, n.rank, time));
        CHECK(surface_of(lights.back())->number == n.number);
    }
    return lights;
}

const flat::PlanarLight& planar(const Light& light) { return std::get<flat::PlanarLight>(light); }
const flat::SphereLight& ball(const Light& light) { return std::get<flat::SphereLight>(light); }

TexturePtr solid(double value) { return std::make_shared<SolidColor>(Color{value, value, value}); }

// Somebody else's texture.
class Strange final : public Texture {
public:
    Color value(const Surface& s) const override { return s.front_face ? Color{3, 3, 3} : Color{}; }
};

}  // namespace

TEST_CASE("Lights: each emitting shape is one, with its primitive's number, in the order of numbers",
          "[compile][lights]") {
    MeshData data = cube_mesh();
    data.triangles.push_back({1, 1, 2});  // has no area, cannot be sampled
    data.material_slots.assign(13, 0);
    data.material_slots[4] = data.material_slots[12] = 1;
    const Object mesh = std::make_shared<Mesh>(data, std::vector<MaterialPtr>{grey(), white_lamp()});
    const Object moving = std::make_shared<Sphere>(Point3{7, 8, 9}, Point3{8, 10, 8}, 0.5, white_lamp());
    const std::vector<Object> objects{
        unit_quad(grey()),
        unit_quad(white_lamp()),
        mesh,
        std::make_shared<Triangle>(Point3{0, 0, 0}, Point3{0, 0, 2}, Point3{3, 0, 0}, white_lamp()),
        std::make_shared<Sphere>(Point3{4, 5, 6}, -2.0, white_lamp()),
        moving,
        unit_quad(nullptr)};
    const auto lights = lights_of(objects);
    REQUIRE(lights.size() == 5);
    const std::uint64_t numbers[] = {1, 2 + 4, 15, 16, 17};
    for (std::size_t i = 0; i < 5; ++i) CHECK(surface_of(lights[i])->number == numbers[i]);
    const flat::PlanarLight &quad = planar(lights[0]), &of_mesh = planar(lights[1]), &triangle = planar(lights[2]);
    CHECK(quad.shape == PlanarShape::rectangle);
    CHECK((quad.corner == Point3{1, 2, 3} && quad.edge_u == Vec3{1, 0, 0} && quad.edge_v == Vec3{0, 1, 0}));
    const Index3 t = data.triangles[4];
    CHECK(of_mesh.shape == PlanarShape::triangle);
    CHECK(of_mesh.corner == vertex(data, t.a));
    CHECK(of_mesh.edge_u == vertex(data, t.b) - vertex(data, t.a));
    CHECK(of_mesh.edge_v == vertex(data, t.c) - vertex(data, t.a));
    CHECK(triangle.shape == PlanarShape::triangle);
    CHECK((triangle.corner == Point3{} && triangle.edge_u == Vec3{0, 0, 2} && triangle.edge_v == Vec3{3, 0, 0}));
    CHECK((ball(lights[3]).center == Point3{4, 5, 6} && ball(lights[3]).radius == 2));
    CHECK((ball(lights[4]).center == Point3{7, 8, 9} && ball(lights[4]).radius == 0.5));
    CHECK(ball(lights_of(objects, 1)[4]).center == Point3{8, 10, 8});
}

TEST_CASE("Lights: a quad is a rectangle where its corners are right angles, sheared it is a parallelogram",
          "[compile][lights]") {
    const auto shape = [](const Vec3& u, const Vec3& v, const Transform& m = {}) {
        return planar(lights_of({seen(std::make_shared<Quad>(Point3{}, u, v, white_lamp()), m)}).at(0)).shape;
    };
    CHECK(shape({3, 0, 0}, {0, 0, -5}) == PlanarShape::rectangle);
    CHECK(shape({3, 0, 0}, {1e-9, 0, -5}) == PlanarShape::parallelogram);
    CHECK(shape({3, 0, 0}, {-1e-9, 0, -5}) == PlanarShape::parallelogram);
    CHECK(shape({1, 1, 0}, {-1, 1, 0}, Transform::rotate({1, 2, 3}, 40)) == PlanarShape::rectangle);
    CHECK(shape({1, 1, 0}, {-1, 1, 0}, Transform::scale(2, 1, 1)) == PlanarShape::parallelogram);
    CHECK(shape({2, 1, 0}, {-2, 1, 0}, Transform::scale(1, 2, 1)) == PlanarShape::rectangle);
}

TEST_CASE("Lights: seen through instances they stand where the instances put them", "[compile][lights]") {
    const Transform outer = Transform::translate({10, 20, 30}),
                    inner = Transform::rotate_z(90) * Transform::scale(2, 2, 2);
    const Object blas = std::make_shared<HittableList>(
        std::vector<Object>{unit_quad(grey()), unit_quad(white_lamp()),
                            std::make_shared<Sphere>(Point3{1, 0, 0}, Point3{1, 1, 0}, 3.0, white_lamp())});
    const std::vector<Object> objects{unit_quad(grey()), seen(seen(blas, inner), outer)};
    const auto lights = lights_of(objects);
    REQUIRE(lights.size() == 2);
    // A quarter turn around z takes x to y and y to -x.
    const flat::PlanarLight& quad = planar(lights[0]);
    CHECK(quad.number == 2);
    CHECK(quad.corner == Point3{10 - 4, 20 + 2, 30 + 6});
    CHECK((quad.edge_u == Vec3{0, 2, 0} && quad.edge_v == Vec3{-2, 0, 0}));
    const flat::SphereLight& sphere = ball(lights[1]);
    CHECK(sphere.number == 3);
    CHECK(sphere.center == Point3{10, 22, 30});
    CHECK(ball(lights_of(objects, 1)[1]).center == Point3{8, 22, 30});
    CHECK(sphere.radius == Approx(6).epsilon(1e-15));
}

TEST_CASE("Lights: a BLAS that was described before the one that holds it is found there as well",
          "[compile][lights]") {
    const Object quad = unit_quad(white_lamp());
    const Object plain = seen(quad, Transform::translate({1, 0, 0})),
                 around = seen(plain, Transform::translate({0, 5, 0}));
    CHECK(lights_of({plain, around, seen(around, Transform::translate({0, 0, 7}))}).size() == 3);
    CHECK(lights_of({seen(around, Transform::translate({0, 0, 7})), around, plain}).size() == 3);
}

TEST_CASE("Lights: under moving instances they are where the matrices of each time put them", "[compile][lights]") {
    const Transform turned = Transform::rotate({1, 2, 3}, 70) * Transform::scale(1, 2, 0.5);
    MeshData cube = cube_mesh();
    const Object moved = std::make_shared<Instance>(
        std::make_shared<HittableList>(std::vector<Object>{
            unit_quad(white_lamp()), std::make_shared<Mesh>(cube, white_lamp()),
            std::make_shared<Triangle>(Point3{0, 0, 0}, Point3{0, 0, 2}, Point3{3, 0, 0}, white_lamp())}),
        Transform::translate({1, 0, 0}), turned);
    const Object outer =
        std::make_shared<Instance>(seen(moved, Transform::rotate_y(30)), Transform{}, Transform::translate({0, 7, 0}));
    for (const double time : {0.0, 0.25, 1.0}) {
        const Transform m = Transform::translate({0, 7 * time, 0}) * Transform::rotate_y(30) *
                            interpolate(Transform::translate({1, 0, 0}), turned, time);
        const auto lights = lights_of({outer}, time);
        REQUIRE(lights.size() == 14);
        const auto check = [&](const Light& found, const Point3& a, const Vec3& u, const Vec3& v) {
            const flat::PlanarLight& light = planar(found);
            CHECK(length(light.corner - transform_point(m, a)) <= 1e-13);
            CHECK(length(light.edge_u - transform_vector(m, u)) <= 1e-13);
            CHECK(length(light.edge_v - transform_vector(m, v)) <= 1e-13);
        };
        check(lights[0], {1, 2, 3}, {1, 0, 0}, {0, 1, 0});
        const Index3 t = cube.triangles[7];
        const Point3 a = vertex(cube, t.a);
        check(lights[8], a, vertex(cube, t.b) - a, vertex(cube, t.c) - a);
        check(lights[13], {0, 0, 0}, {0, 0, 2}, {3, 0, 0});
    }
}

TEST_CASE("Lights: a ball that instances only push about is one, moving in a straight line", "[compile][lights]") {
    const Object sphere = std::make_shared<Sphere>(Point3{1, 2, 3}, Point3{2, 2, 3}, 2.0, white_lamp());
    const Transform still = Transform::rotate_z(90) * Transform::scale(3, 3, 3),
                    later = Transform::translate({5, 0, 0}) * still;
    const Object moved = std::make_shared<Instance>(sphere, still, later);
    const std::vector<Object> objects{std::make_shared<Instance>(moved, Transform{}, Transform::translate({0, 0, 4}))};
    const auto lights = lights_of(objects);
    REQUIRE(lights.size() == 1);
    CHECK(length(ball(lights[0]).center - Point3{-6, 3, 9}) <= 1e-14);
    CHECK(length(ball(lights_of(objects, 1)[0]).center - Point3{-1, 6, 13}) <= 1e-14);
    CHECK(ball(lights[0]).radius == Approx(6).epsilon(1e-15));
}

TEST_CASE("Lights: a ball that an instance bends, or turns or stretches as it moves, is left to scattering",
          "[compile][lights]") {
    const Object quad = unit_quad(white_lamp()), ball = std::make_shared<Sphere>(Point3{}, 1.0, white_lamp());
    CHECK(lights_of({std::make_shared<Instance>(ball, Transform{}, Transform::rotate_y(10))}).empty());
    CHECK(lights_of({std::make_shared<Instance>(ball, Transform{}, Transform::scale(2, 2, 2))}).empty());
    Transform sheared;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            if (i == j) continue;
            sheared = {};
            sheared.rows[i][j] = 1e-3;
            CHECK(lights_of({seen(ball, sheared)}).empty());
            CHECK(lights_of({seen(quad, sheared)}).size() == 1);
        }
    for (const Vec3 s : {Vec3{2, 1, 1}, Vec3{1, 2, 1}, Vec3{1, 1, 2}})
        CHECK(lights_of({seen(ball, Transform::scale(s.x, s.y, s.z))}).empty());
    const auto mirrored = lights_of({seen(ball, Transform::rotate({1, 2, 3}, 50) * Transform::scale(-3, 3, 3))});
    REQUIRE(mirrored.size() == 1);
    CHECK(std::get<flat::SphereLight>(mirrored[0]).radius == Approx(3).epsilon(1e-12));
}

TEST_CASE("Lights: a textured ball is sampled on its own axes alone, its texture coordinates follow no instance",
          "[compile][lights]") {
    const auto ball = [](double radius) {
        return std::make_shared<Sphere>(Point3{}, radius, lamp(std::make_shared<Checker>(1, solid(1), solid(2))));
    };
    CHECK(lights_of({ball(1)}).size() == 1);
    CHECK(lights_of({seen(ball(1), Transform{})}).size() == 1);
    CHECK(lights_of({ball(-1)}).empty());
    CHECK(lights_of({seen(ball(1), Transform::rotate_y(90))}).empty());
    CHECK(lights_of({seen(std::make_shared<Sphere>(Point3{}, -1.0, white_lamp()), Transform::rotate_y(90))}).size() ==
          1);
}

TEST_CASE("Lights: black lamps, the inside of media and what a user's own class emits are not sampled",
          "[compile][lights]") {
    const TexturePtr strange = std::make_shared<Strange>(), black = solid(0);
    const auto checker = [](const TexturePtr& even, const TexturePtr& odd) {
        return lamp(std::make_shared<Checker>(1, even, odd));
    };
    for (const MaterialPtr& dark :
         {lamp(Color{}), checker(black, black), lamp(std::make_shared<ImageTexture>(Image(2, 2))), lamp(strange),
          checker(strange, solid(1)), checker(solid(1), strange),
          checker(std::make_shared<Checker>(1, solid(1), strange), solid(1))})
        CHECK(lights_of({unit_quad(dark)}).empty());
    for (const MaterialPtr& bright : {lamp(Color{0, 0, 1e-9}), checker(black, solid(1)), checker(solid(1), black)})
        CHECK(lights_of({unit_quad(bright)}).size() == 1);
    // So small that its area squared is not a number beside zero.
    CHECK(lights_of({std::make_shared<Quad>(Point3{}, Vec3{1e-90, 0, 0}, Vec3{0, 1e-90, 0}, white_lamp())}).empty());
    CHECK(lights_of({std::make_shared<ConstantMedium>(unit_quad(white_lamp()), 1, Color{})}).empty());
    CHECK(lights_of({std::make_shared<Stranger>(unit_quad(white_lamp()))}).empty());
}

TEST_CASE("Lights: one is as strong as its radiance times its area, or the disc that a ball is seen as, of all",
          "[compile][lights]") {
    const auto quad = [](double side, const MaterialPtr& m) {
        return std::make_shared<Quad>(Point3{}, Vec3{side, 0, 0}, Vec3{0, 1, 0}, m);
    };
    // By number.
    const auto strengths = [](const std::vector<Object>& objects) {
        const flat::LightTable lights = compiler::flatten(zoo_of("lamps", objects).scene).lights;
        const std::vector<double>& before = lights.strength_before;
        REQUIRE(before.size() == objects.size() + 1);
        CHECK(before.front() == 0);
        CHECK(before.back() == Approx(1));
        std::vector<double> shares;
        for (const flat::LightNumber& n : lights.by_number) shares.push_back(before[n.rank + 1] - before[n.rank]);
        return shares;
    };
    const auto share = [&](const Object& of, const Object& against) { return strengths({of, against}).at(0); };
    CHECK(strengths({quad(1, white_lamp())}) == std::vector<double>{1});
    CHECK(share(quad(1, white_lamp()), quad(3, white_lamp())) == Approx(0.25));
    CHECK(share(quad(1, lamp(Color{1, 3, 2})), quad(1, white_lamp())) == Approx(0.75));
    const Object half = std::make_shared<Triangle>(Point3{}, Point3{2, 0, 0}, Point3{0, 3, 0}, white_lamp());
    CHECK(share(half, quad(1, white_lamp())) == Approx(0.75));
    const Object ball = std::make_shared<Sphere>(Point3{}, 2.0, white_lamp());
    CHECK(share(ball, quad(4 * kPi / 3, white_lamp())) == Approx(0.75));
    CHECK(share(std::make_shared<Quad>(Point3{}, Vec3{1, 0, 0}, Vec3{5, 3, 0}, white_lamp()), quad(1, white_lamp())) ==
          Approx(0.75));
    // Textures count by what they show on average.
    Image image(2, 1);
    image.set(0, 0, {0, 4, 2});
    CHECK(share(quad(1, lamp(std::make_shared<ImageTexture>(image))), quad(1, white_lamp())) == Approx(0.75));
    CHECK(share(quad(1, lamp(std::make_shared<Checker>(1, solid(2), solid(4)))), quad(1, white_lamp())) ==
          Approx(0.75));
    for (const TexturePtr& noise : {TexturePtr(std::make_shared<Noise>(1, 1, Color{6, 1, 2})),
                                    TexturePtr(std::make_shared<Turbulence>(1, 1, Color{1, 6, 2})),
                                    TexturePtr(std::make_shared<Marble>(1, 1, Color{1, 2, 6}))})
        CHECK(share(quad(1, lamp(noise)), quad(1, white_lamp())) == Approx(0.75));
    // Strengths beyond what double holds leave every lamp an even part, and the weakest one is not forgotten.
    const std::vector<double> beyond = strengths({quad(1e200, lamp(Color{1e200, 0, 0})), quad(1, white_lamp())});
    CHECK((beyond.at(0) == Approx(0.5) && beyond.at(1) == Approx(0.5)));
    CHECK(share(quad(1, lamp(Color{1e-30, 0, 0})), quad(1, white_lamp())) == Approx(5e-7));
}

TEST_CASE("Lights: points computed on one lie within its error bound of the true emitter", "[compile][lights]") {
    Random random(380);
    Tally tally;
    for (int i = 0; i < 2000; ++i) {
        const Transform outer = Transform::translate(random.in_cube(random.log_uniform(1, 1e6))),
                        inner = random_pose(random, random.log_uniform(1, 1e4));
        const Point3 a = Point3{} + random.in_cube(random.log_uniform(1, 1e4));
        const Vec3 e = random.in_cube(3), f = random.in_cube(3);
        const auto lights = lights_of({seen(seen(std::make_shared<Quad>(a, e, f, white_lamp()), inner), outer)});
        REQUIRE(lights.size() == 1);
        const flat::PlanarLight& light = planar(lights[0]);
        const double u = random.uniform(), v = random.uniform();
        const Real3 p(light.corner + (u * light.edge_u + v * light.edge_v));
        const auto world = [&](const Vec3& edge) {
            return transform_point(outer, transform_point(inner, Real3(a) + Real3(edge)));
        };
        const Real3 origin = world({}), n = cross(world(e) - origin, world(f) - origin);
        const Real off = absolute(dot(n, p - origin)) / length(n);
        const Real largest = Real(max_abs(light.position_error));
        if (!(off <= largest)) tally.fault({}, "outside");
        // ... and the bound is no more than some hundred roundings of the coordinates that went into it.
        const double scale = max_abs(outer.translation()) + max_abs(inner.translation()) + 12 * max_abs(a) + 12;
        if (!(largest <= Real(1e-12 * scale))) tally.fault({}, "bound too wide");
    }
    INFO(tally.first);
    CHECK(tally.wrong == 0);
}

TEST_CASE("Lights: a ball's error bound covers its whole way, its radius and what its instance adds",
          "[compile][lights]") {
    const auto bound = [](const Point3& from, const Point3& to, double radius, const Transform& m = {}) {
        const auto lights = lights_of({seen(std::make_shared<Sphere>(from, to, radius, white_lamp()), m)});
        REQUIRE(lights.size() == 1);
        return surface_of(lights[0])->position_error;
    };
    const Point3 near{0, 0, 0}, far{0, -1024, 0};
    for (const Vec3& e : {bound(near, far, 1), bound(far, near, 1), bound(far, far, 1), bound(near, near, 1024),
                          bound(near, near, 1, Transform::translate({0, 0, 1024})),
                          bound(near, near, 4, Transform::scale(256, 256, 256))}) {
        CHECK((e.x == e.y && e.y == e.z));
        CHECK(e.x >= 3 * 1024 * gamma(16));  // of its own, of the way out, and of the next ray's way in
        CHECK(e.x <= 8 * 1026 * gamma(256));
    }
    CHECK(bound(near, near, 1).x <= 8 * gamma(256));
    // Far out in the object's own space the rounding is as large, wherever the instance puts it.
    CHECK(bound(far, far, 1, Transform::translate({0, 1024, 0})).x >= 1024 * gamma(16));
}

}  // namespace limn::lights_test
