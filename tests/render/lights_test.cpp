// Direct light against closed forms.
#include "catch.h"
#include "support/pictures.h"
#include "support/solid_angle.h"

namespace limn::lights_test {

using namespace test;

namespace {

constexpr double kAlbedo = 0.6, kRadiance = 7;

// Irradiance at the origin, normal +y, from a polygon of radiance 1 wholly above the floor.
double irradiance_of_polygon(const std::vector<Point3>& corners) { return std::abs(vector_irradiance(corners, {}).y); }

// The floor at the origin from half a unit above it.
const Camera kLow = camera_at({0, 0.5, 0}, {0, 0, 0}, 0.01);

void check_floor(const Object& light, double irradiance) {
    const CompiledScene scene = compile_with(sky(0), {floor_of(grey(kAlbedo)), light});
    const double truth = kAlbedo * kRadiance * irradiance / kPi;
    check_mean(measure(scene, kLow, square(8, 64, 2)), truth, 6e-3);
    check_mean(measure(scene, kLow, square(8, 512, 2, Estimator::naive)), truth, 2e-2);
}

}  // namespace

TEST_CASE("Direct light: a quad lights the floor as Lambert's formula says, from either side", "[render][lights]") {
    const Point3 q{-0.5, 2, -0.25};
    const Vec3 u{2, 0.25, 0}, v{0, -0.5, 1.5};
    const double truth = irradiance_of_polygon({q, q + u, q + u + v, q + v});
    check_floor(quad(q, u, v, lamp(kRadiance)), truth);
    check_floor(quad(q, v, u, lamp(kRadiance)), truth);  // its normal turned
}

TEST_CASE("Direct light: a triangle lights the floor as Lambert's formula says", "[render][lights]") {
    const Point3 a{-1, 1.5, 0}, b{1.5, 2, 0.5}, c{0, 2.5, 2};
    check_floor(std::make_shared<Triangle>(a, b, c, lamp(kRadiance)), irradiance_of_polygon({a, b, c}));
}

TEST_CASE("Direct light: a sphere wholly above the floor gives pi L (R / d)^2 cos", "[render][lights]") {
    const Point3 c{1, 2, -0.5};
    const double d = length(c - Point3{}), r = 0.75;
    check_floor(sphere(c, r, lamp(kRadiance)), kPi * r * r / (d * d) * (c.y / d));
    check_floor(sphere(c, -r, lamp(kRadiance)), kPi * r * r / (d * d) * (c.y / d));
}

TEST_CASE("Direct light: an emitting mesh lights as its triangles, a box as its faces", "[render][lights]") {
    // Convex bodies: only the faces that look at the origin count, and each wholly.
    const auto sum_of_faces = [](const MeshData& mesh) {
        double sum = 0;
        for (const Index3& t : mesh.triangles) {
            const Point3 a = vertex(mesh, t.a), b = vertex(mesh, t.b), c = vertex(mesh, t.c);
            if (dot(cross(b - a, c - a), Point3{} - a) > 0) sum += irradiance_of_polygon({a, b, c});
        }
        return sum;
    };
    const MeshData cube = cube_mesh(1, {-0.25, 1.5, 0.25}), ball = icosphere(1, 0.75, {1, 2, 0.5});
    check_floor(std::make_shared<Mesh>(cube, lamp(kRadiance)), sum_of_faces(cube));
    check_floor(make_box({-0.25, 1.5, 0.25}, {0.75, 2.5, 1.25}, lamp(kRadiance)), sum_of_faces(cube));
    check_floor(std::make_shared<Mesh>(ball, lamp(kRadiance)), sum_of_faces(ball));
}

TEST_CASE("Direct light: an instanced light radiates from where it stands, scaled and sheared", "[render][lights]") {
    Transform m =
        Transform::translate({0.5, 2, 0.25}) * Transform::rotate({1, 0, 2}, 25) * Transform::scale(1.5, -0.75, 1);
    m.rows[0][1] += 0.5;
    const Point3 q{-0.5, -0.5, 0};
    const Vec3 u{1, 0, 0}, v{0, 1, 0};
    const auto at = [&](const Point3& p) { return transform_point(m, p); };
    const double truth = irradiance_of_polygon({at(q), at(q + u), at(q + u + v), at(q + v)});
    const Object light = quad(q, u, v, lamp(kRadiance));
    check_floor(std::make_shared<Instance>(light, m), truth);
    check_floor(std::make_shared<Instance>(std::make_shared<Instance>(light, Transform::rotate_z(90)),
                                           m * Transform::rotate_z(-90)),
                truth);
    check_floor(std::make_shared<HittableList>(std::vector<Object>{
                    std::make_shared<Bvh>(std::vector<Object>{std::make_shared<Instance>(light, m)})}),
                truth);
}

TEST_CASE("Direct light: several lights add up", "[render][lights]") {
    const Point3 q{-0.5, 2, -0.25}, c{1.5, 2, -1.5};
    const Vec3 u{1, 0, 0}, v{0, 0, 1};
    const double d = length(c - Point3{}), r = 0.4;
    const double both = irradiance_of_polygon({q, q + u, q + u + v, q + v}) + 3 * kPi * r * r / (d * d) * (c.y / d);
    check_floor(std::make_shared<HittableList>(
                    std::vector<Object>{quad(q, u, v, lamp(kRadiance)), sphere(c, r, lamp(3 * kRadiance))}),
                both);
}

TEST_CASE("Direct light: a tiny distant sphere is not lost, down to 1e-5 of its distance", "[render][lights]") {
    for (const double ratio : {1e-2, 1e-3, 1e-4, 1e-5}) {
        const CompiledScene scene = compile_with(
            sky(0), {floor_of(grey(kAlbedo)), sphere({0, 1000, 0}, 1000 * ratio, lamp(1 / (ratio * ratio)))});
        INFO("R / d = " << ratio);
        check_mean(measure(scene, kLow, square(4, 16, 2)), kAlbedo, 1e-3);  // pi L (R/d)^2 = pi
    }
}

TEST_CASE("Direct light: inside a glowing sphere a convex body shows its albedo", "[render][lights]") {
    for (const double r : {10.0, -10.0}) {
        const CompiledScene scene =
            compile_with(sky(0), {sphere({0, 0, 0}, r, lamp(1)), sphere({3, 0, 0}, 1, grey(0.5))});
        const Camera camera = camera_at({3, 0, 5}, {3, 0, 0}, 10);
        check_mean(measure(scene, camera, square(8, 128, 10)), 0.5, 1e-2);
        check_mean(measure(scene, camera, square(8, 16, 10, Estimator::naive)), 0.5, 1e-6);
    }
}

TEST_CASE("Direct light: a lamp looks the same in both estimators: its radiance, to the bit", "[render][lights]") {
    for (const Estimator estimator : {Estimator::path, Estimator::naive}) {
        for (const Object& light : {sphere({0, 0, 0}, 1, lamp(4)), quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, lamp(4)),
                                    quad({-2, -2, 0}, {0, 4, 0}, {4, 0, 0}, lamp(4)),
                                    Object(std::make_shared<Mesh>(icosphere(1), lamp(4)))}) {
            const Image image =
                render(compile_with(sky(0.5), {light}), camera_at({0, 0, 5}, {0, 0, 0}, 1), square(4, 4, 3, estimator))
                    .image;
            for (const float v : image.values()) CHECK(v == 4.0f);
        }
    }
}

TEST_CASE("Direct light: what is shadowed gets nothing", "[render][lights]") {
    const Object roof = quad({-5, 1, -5}, {10, 0, 0}, {0, 0, 10}, grey(0));
    const CompiledScene scene = compile_with(
        sky(0),
        {floor_of(grey(1)), roof, quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, lamp(9)), sphere({0, 3, 0}, 0.5, lamp(9))});
    for (const Estimator estimator : {Estimator::path, Estimator::naive})
        CHECK(mean(render(scene, kLow, square(4, 64, 2, estimator)).image) == 0);
}

TEST_CASE("Estimators: a user's own index-matched boundary casts no shadow", "[render][lights]") {
    // It is a boundary of nothing: light passes straight through.
    const Object veil = std::make_shared<Stranger>(
        std::make_shared<ConstantMedium>(quad({-3, 1.5, -3}, {6, 0, 0}, {0, 0, 6}, nullptr), 0, Color{}));
    const Object light = quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, lamp(kRadiance));
    const double truth =
        kAlbedo * kRadiance * irradiance_of_polygon({{-1, 3, -1}, {1, 3, -1}, {1, 3, 1}, {-1, 3, 1}}) / kPi;
    const CompiledScene scene = compile_with(sky(0), {floor_of(grey(kAlbedo)), veil, light});
    check_mean(measure(scene, kLow, square(8, 512, 2, Estimator::naive)), truth, 1e-2);
    check_mean(measure(scene, kLow, square(4, 128, 2)), truth, 5e-3);
}

TEST_CASE("Motion: a ball that moves over the shutter is seen as long as it covers a place", "[render][motion]") {
    // Radius .4, (0,0,0) to (0,1,0): on the axis at height y it is seen for the length of [y-.4, y+.4] within [0, 1].
    const auto light = std::make_shared<Sphere>(Point3{0, 0, 0}, Point3{0, 1, 0}, 0.4, lamp(1));
    const auto still = sphere({0, 0, 0}, 0.4, lamp(1));
    const Object instance = std::make_shared<Instance>(still, Transform{}, Transform::translate({0, 1, 0}));
    for (const Object& ball : {Object(light), instance}) {
        const CompiledScene scene = compile_with(sky(0), {ball});
        for (const auto& [y, expected] :
             {std::pair{-0.41, 0.0}, {0.0, 0.4}, {0.2, 0.6}, {0.5, 0.8}, {1.0, 0.4}, {1.3, 0.1}, {1.41, 0.0}}) {
            const Camera camera = camera_at({0, y, 1000}, {0, y, 0}, 1e-5);
            const Measured m = measure(scene, camera, square(8, 64, 2), 16);
            const double sigma = std::sqrt(expected * (1 - expected) / (64 * 64 * 16));
            INFO("height " << y);
            CHECK(std::abs(m.mean - expected) <= 4.5 * sigma + 1e-6);
        }
        Camera closed = camera_at({0, 0.2, 1000}, {0, 0.2, 0}, 1e-5);
        closed.shutter_open = closed.shutter_close = 0.25;
        CHECK(mean(render(scene, closed, square(4, 16, 2)).image) == 1);
        closed.shutter_open = closed.shutter_close = 0.75;
        CHECK(mean(render(scene, closed, square(4, 16, 2)).image) == 0);
    }
}

}  // namespace limn::lights_test
