// Sampling lights finds what scattering alone finds: by the means of pictures and of single rays over many seeds.
#include <cstdlib>

#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/shape/disk.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/image_texture.h"
#include "render/single_ray.h"

namespace limn::estimators_test {

using namespace test;

namespace {

// How a scene is pictured, and what the relative standard error of the difference may be at most.
struct View {
    Camera camera;
    int side, samples, depth;
    int naive_factor;  // how many times as many samples the naive estimator gets
    double power;
};

void check_agree(const std::string& name, const std::vector<Object>& objects, const View& v) {
    INFO(name);
    const CompiledScene scene = compile_with(sky(0), objects);
    check_same(measure(scene, v.camera, square(v.side, v.samples, v.depth)),
               measure(scene, v.camera, square(v.side, v.samples * v.naive_factor, v.depth, Estimator::naive)),
               v.power);
}

void check_agree(const std::string& name, const std::vector<Object>& objects, const Ray& ray, int depth, int samples,
                 int naive_factor, double power) {
    INFO(name << ", time " << ray.time << ", depth " << depth);
    const CompiledScene scene = compile_with(sky(0), objects);
    const auto number = static_cast<std::uint64_t>(samples);
    check_same(along(scene, ray, depth, Estimator::path, number),
               along(scene, ray, depth, Estimator::naive, number * static_cast<std::uint64_t>(naive_factor)), power);
}

View stage(double power, int naive_factor = 4) {
    return {camera_at({0, 2, 7}, {0, 0.7, 0}, 40), 32, 16, 6, naive_factor, power};
}

Object fog_in(Object boundary, double density, const Color& albedo = {0.9, 0.9, 0.9}) {
    return std::make_shared<ConstantMedium>(std::move(boundary), density, albedo);
}

// Half of the ball is lit, so that light read from the wrong texel shows.
MaterialPtr half_lamp() {
    Image image(2, 1);
    image.set(0, 0, {8, 8, 8});
    return std::make_shared<DiffuseLight>(std::make_shared<ImageTexture>(image, ImageTextureOptions{Filter::nearest}));
}

MaterialPtr checkered_lamp(double dark) {
    return std::make_shared<DiffuseLight>(std::make_shared<Checker>(0.3, Color{dark, dark, dark}, Color{9, 9, 9}));
}

}  // namespace

TEST_CASE("Estimators: light sampling and naive paths agree on glossy, glassy and diffuse scenes",
          "[render][estimators]") {
    const Object light = quad({-2, 4, -2}, {4, 0, 0}, {0, 0, 4}, lamp(3));
    const auto metal = [](double fuzz) { return std::make_shared<Metal>(Color{0.9, 0.9, 0.9}, fuzz); };
    const struct {
        const char* name;
        MaterialPtr material;
        double power;
    } rows[] = {{"diffuse", grey(0.8), 5e-3},
                {"mirror", metal(0), 5e-3},
                {"almost smooth metal", metal(0.01), 5e-3},
                {"rough metal", metal(0.3), 5e-3},
                {"very rough metal", metal(1), 5e-3},
                {"glass", std::make_shared<Dielectric>(1.5), 8e-3},
                {"isotropic surface", std::make_shared<Isotropic>(Color{0.9, 0.9, 0.9}), 5e-3}};
    for (const auto& [name, material, power] : rows)
        check_agree(name, {floor_of(grey(0.5)), sphere({0, 1, 0}, 1, material), light}, stage(power));
    MeshData smooth = icosphere(1, 1, {0, 1, 0});
    for (const Float3& p : smooth.vertices) smooth.normals.push_back({p.x, p.y - 1, p.z});
    check_agree("smooth normals", {floor_of(grey(0.5)), std::make_shared<Mesh>(smooth, grey(0.8)), light}, stage(5e-3));
}

TEST_CASE("Estimators: agree for lamps of every kind: moving, textured, touching, from outside classes",
          "[render][estimators]") {
    const MaterialPtr bright = lamp(6);
    const auto check = [](const char* name, Object light, double power, int naive_factor = 4) {
        check_agree(name, {floor_of(grey(0.6)), sphere({-1, 1, 0}, 1, grey(0.8)), std::move(light)},
                    stage(power, naive_factor));
    };
    check("moving sphere", std::make_shared<Sphere>(Point3{1, 2, 1}, Point3{2, 3, -1}, 0.7, bright), 8e-3);
    check("moving instance",
          std::make_shared<Instance>(quad({-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, bright), Transform::translate({1, 3, 0}),
                                     Transform::translate({2, 2, 0}) * Transform::rotate_z(40)),
          1.5e-2);
    check("checkered quad", quad({0, 3.1, -1}, {2, 0, 0}, {0, 0, 2}, checkered_lamp(0.5)), 8e-3);
    check("sphere that stands on the floor", sphere({1.5, 0.5, 0}, 0.5, bright), 8e-3);
    check("sphere half sunk in the floor", sphere({1.5, 0, 0}, 0.7, bright), 8e-3);
    check("quad that stands on the floor", quad({2, 0, -1}, {0, 0, 2}, {0, 1.5, 0}, bright), 8e-3);
    check("needle of a triangle",
          std::make_shared<Triangle>(Point3{0, 3, -2}, Point3{0.1, 3, 2}, Point3{0.2, 3.1, -2}, lamp(60)), 2e-2, 16);
    check("a user's own shape, which light sampling does not know",
          std::make_shared<Stranger>(sphere({1.5, 3, 0}, 0.9, bright)), 2e-2);
    check_agree("a lamp of which one copy is sampled and one is not",
                {floor_of(grey(0.6)), sphere({1.5, 3, 0}, 0.5, bright),
                 std::make_shared<Stranger>(sphere({-1.5, 3, 0}, 0.5, bright))},
                stage(1e-2));
    check_agree("stretched sphere",
                {floor_of(grey(0.5)),
                 std::make_shared<Instance>(sphere({0, 0, 0}, 1, lamp(5)),
                                            Transform::translate({0, 2, 0}) * Transform::scale(0.5, 1, 0.75))},
                {camera_at({0, 1, 6}, {0, 0.5, 0}, 40), 32, 16, 6, 4, 1e-2});

    const View beside_ball{camera_at({1, 0.5, 0}, {1, 0, 0}, 20), 4, 256, 2, 4, 0.02};
    const auto half_ball = [](double r) { return sphere({0, 1, 0}, r, half_lamp()); };
    for (const Object& light : {half_ball(0.5), half_ball(-0.5),
                                Object(std::make_shared<Instance>(half_ball(0.5), Transform::rotate_y(180)))})
        check_agree("textured ball", {quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, grey(0.5)), light}, beside_ball);

    const View beside_disk{camera_at({1, 0.5, 0}, {0.5, 0, 0}, 20), 4, 64, 2, 8, 0.02};
    const Vec3 down{0, -1, 0.4};
    const Object round = std::make_shared<Disk>(Point3{0, 1, 0}, down, 0.5, lamp(4));
    for (const Object& disk :
         {round, Object(std::make_shared<Disk>(Point3{0, 1, 0}, down, 0.5, checkered_lamp(1))),
          Object(std::make_shared<Instance>(round, Transform::translate({0.3, 0, 0}) * Transform::scale(2, 1, 1))),
          Object(std::make_shared<Instance>(round, Transform{}, Transform::translate({0.5, 0, 0})))}) {
        CHECK(compile_with(sky(0), {disk}).stats().lights == 1);
        check_agree("disk", {floor_of(grey(0.5)), disk}, beside_disk);
    }
}

TEST_CASE("Estimators: agree where many lamps are close to a wall", "[render][estimators]") {
    // So close that solid angles, areas and the way down the tree all matter.
    Random random(12);
    std::vector<Object> objects{floor_of(grey(0.6)), sphere({0, 0.4, 0}, 0.4, grey(0.7))};
    for (int i = 0; i < 40; ++i) {
        const Point3 p{random.uniform(-2, 2), random.log_uniform(0.01, 1.5), random.uniform(-2, 2)};
        const Vec3 u = 0.3 * random.unit(), v = 0.3 * random.unit();
        const MaterialPtr m = lamp(random.uniform(1, 5));
        if (i % 3 == 0)
            objects.push_back(quad(p, u, v, m));
        else if (i % 3 == 1)
            objects.push_back(std::make_shared<Triangle>(p, p + u, p + v, m));
        else
            objects.push_back(sphere(p, 0.1, m));
    }
    check_agree("many", objects, {camera_at({0, 3, 6}, {0, 0.3, 0}, 35), 16, 16, 4, 4, 1.5e-2});
}

TEST_CASE("Estimators: agree in thin and thick fog, around lamps of every kind", "[render][estimators][media]") {
    const Object floor = floor_of(grey(0.5)), above = quad({-2, 4, -2}, {4, 0, 0}, {0, 0, 4}, lamp(3));
    const View whole{camera_at({0, 2, 7}, {0, 1, 0}, 40), 16, 16, 6, 4, 8e-3};
    const MaterialPtr unseen = lamp(100);  // boundaries do not shine
    const Object globe = sphere({0, 1, 0}, 1, unseen);
    check_agree("fog beside the lamp", {floor, above, fog_in(globe, 1)}, whole);
    check_agree("all of it in fog", {floor, above, fog_in(make_box({-9, -1, -9}, {9, 9, 9}, unseen), 0.1)}, whole);
    check_agree("fog between", {floor, above, fog_in(make_box({-3, 2, -3}, {3, 3, 3}, unseen), 1)}, whole);
    check_agree("fog in fog", {floor, above, fog_in(globe, 1), fog_in(make_box({-2, 0, -2}, {2, 1.5, 2}, unseen), 0.5)},
                whole);

    const int samples = std::getenv("LIMN_FULL") ? 128 : 16;
    View near{camera_at({0, 1, 5}, {0, 1, 0}, 40), 12, samples, 3, 4, 4e-2};
    const Object room = make_box({-9, -1, -9}, {9, 9, 9}, nullptr), ball = sphere({0, 1, 0}, 0.5, lamp(9)),
                 small = make_box({-1.5, 0.2, -1.5}, {1.5, 2, 1.5}, nullptr);
    check_agree("thin", {floor, ball, fog_in(room, 0.05)}, near);
    check_agree("thick", {floor, ball, fog_in(room, 0.5)}, near);
    check_agree("deeper than is asked along the way", {floor, ball, fog_in(small, 2.5)}, near);
    check_agree("media across each other",
                {floor, ball, fog_in(small, 1, {0.9, 0.5, 0.1}), fog_in(room, 0.2, {0.1, 0.2, 0.8})}, near);
    check_agree("smoke in fog",
                {floor, ball, fog_in(make_box({-1.5, 0, 1}, {0, 2, 1.5}, nullptr), 4), fog_in(room, 0.2)}, near);
    check_agree("two balls", {floor, ball, sphere({1, 2, 0}, 0.4, lamp(5)), fog_in(room, 0.3)}, near);
    check_agree("a mesh", {floor, std::make_shared<Mesh>(cube_mesh(1, {-0.5, 0.5, -0.5}), lamp(4)), fog_in(room, 0.3)},
                near);
    check_agree("a moving ball",
                {floor, std::make_shared<Sphere>(Point3{-1, 1, 0}, Point3{1, 1.5, 0}, 0.5, lamp(9)), fog_in(room, 0.3)},
                near);
    check_agree("behind glass", {ball, fog_in(small, 1), sphere({0, 1, 0}, 2.5, std::make_shared<Dielectric>(1.3))},
                near);
    near.depth = 5;
    check_agree("a quad, more often", {floor, quad({-1, 2.5, -1}, {2, 0, 0}, {0, 0, 2}, lamp(5)), fog_in(room, 0.3)},
                near);
}

TEST_CASE("Estimators: agree along single rays of one time, after two and three scatterings", "[render][estimators]") {
    const Object light = quad({-1, 1, 0}, {2, 0, 0}, {0, 0.5, 1}, lamp(2));
    for (const int depth : {3, 4}) {
        check_agree("corner", {floor_of(grey(0.9)), light, quad({-3, 0, -0.5}, {6, 0, 0}, {0, 6, 0}, grey(0.9))},
                    at_floor(), depth, 30'000, 2, 1.5e-2);
        check_agree("fog", {floor_of(grey(0.9)), light, fog_in(make_box({-2, -1, -2}, {2, 3, 2}, nullptr), 0.5)},
                    at_floor(), depth, 30'000, 2, 1.5e-2);
    }

    // A quad, a mesh and a ball that nested instances move.
    const Transform still = Transform::translate({-1.2, 2, 0}) * Transform::scale(1.5, 1.5, 1.5),
                    turned = Transform::translate({1, 2, 0.5}) * Transform::rotate({1, 2, 3}, 70) *
                             Transform::scale(1, 2, 0.7);
    const Vec3 u{0.8, 0.1, 0}, v{0.2, 0, 0.7};
    const struct {
        const char* name;
        Object object;
        Transform end;
        std::size_t lights;
    } rows[] = {{"moved quad", quad({-0.4, 0, -0.3}, 2 * u, 2 * v, lamp(4)), turned, 1},
                {"moved mesh", std::make_shared<Mesh>(cube_mesh(), lamp(2)), turned, 12},
                {"moved ball", sphere({0.3, 0.2, 0}, 0.7, lamp(5)), Transform::translate({2, 0.5, 0}) * still, 1}};
    for (const auto& [name, object, end, lights] : rows) {
        const Object moved = std::make_shared<Instance>(object, still, end);
        const Object twice = std::make_shared<Instance>(moved, Transform{}, Transform::translate({0, 0.5, 1}));
        const std::vector<Object> objects{floor_of(grey(0.7)), twice,
                                          quad({-3, 0, -2}, {6, 0, 0}, {0, 4, 0}, grey(0.5))};
        REQUIRE(compile_with(sky(0), objects).stats().lights == lights);
        for (const double time : {0.2, 1.0}) check_agree(name, objects, at_floor(time), 4, 20'000, 5, 3e-2);
    }
}

}  // namespace limn::estimators_test
