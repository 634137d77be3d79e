// Single rays through the path tracer: the radiance that comes back along them, against integrals.
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/texture/image_texture.h"
#include "property.h"
#include "render/single_ray.h"
#include "support/solid_angle.h"

namespace limn::path_test {

using namespace test;
using transport::PathTracer;
using transport::Sampler;

namespace {

// The integral over a quad lamp of radiance 1, seen from the floor's origin, of `weight` of the unit direction, by the
// midpoint rule.
template <class Weight>
double over_quad(const Point3& q, const Vec3& u, const Vec3& v, const Weight& weight) {
    constexpr int kSide = 300;
    const Vec3 n = cross(u, v);
    double sum = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const Vec3 way = q + (i + 0.5) / kSide * u + (j + 0.5) / kSide * v - Point3{};
            const double r2 = length_squared(way);
            sum += weight(way / std::sqrt(r2)) * std::abs(dot(n, way)) / (r2 * std::sqrt(r2));
        }
    return sum / (kSide * kSide);
}

// Reflects the more the nearer the eye is to +z: light does not go both ways alike.
class OneWay final : public Material {
public:
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override {
        const double z = std::sqrt(random.x), r = std::sqrt(1 - random.x), phi = 2 * kPi * random.y;
        const Vec3 in{r * std::cos(phi), z, r * std::sin(phi)};  // of a floor
        return ScatterSample{in, value(s, out, in).value / (z / kPi), z / kPi};
    }
    ScatterValue value(const Surface&, const Vec3& out, const Vec3& in) const override {
        const double f = std::max(in.y, 0.0) / kPi;
        return {(1 + out.z) / 2 * Color{f, f, f}, f};
    }
};

}  // namespace

TEST_CASE("Path: the light of several lamps of every kind adds up, each by its own integral", "[render][path]") {
    const Point3 q{-0.5, 1, -0.5}, p{2, 0.5, -1}, a{-2, 0.5, -1}, b{-2, 2, 0}, c{-2.5, 0.5, 1};
    const Vec3 u{1, 0, 0}, v{0, 0, 1.2}, e{0.5, 1.5, 0.2}, f{0, 0.3, 1.5};
    const Point3 ball{0.2, 1.5, -3};
    const CompiledScene scene =
        compile_with(sky(0), {floor_of(grey(kAlbedo)), quad(q, u, v, lamp(1)), quad(p, e, f, lamp(10)),
                              std::make_shared<Triangle>(a, b, c, lamp(4)), sphere(ball, 0.8, lamp(6))});
    REQUIRE(scene.stats().lights == 4);
    const auto of_polygon = [](const std::vector<Point3>& corners) {
        return std::abs(vector_irradiance(corners, {}).y);
    };
    const double d = length(ball - Point3{});
    const double irradiance = of_polygon({q, q + u, q + u + v, q + v}) + 10 * of_polygon({p, p + e, p + e + f, p + f}) +
                              4 * of_polygon({a, b, c}) + 6 * kPi * 0.64 / (d * d) * (ball.y / d);
    check_both(scene, at_floor(), 2, kAlbedo * irradiance / kPi, 100'000);
}

TEST_CASE("Path: a moving lamp lights from where it is at the ray's own time", "[render][path]") {
    const Point3 from{-2, 2, 0}, to{2, 3, 1};
    const CompiledScene scene =
        compile_with(sky(0), {floor_of(grey(kAlbedo)), std::make_shared<Sphere>(from, to, 0.8, lamp(5))});
    for (const double time : {0.0, 0.3, 1.0}) {
        INFO("time " << time);
        const Vec3 way = from + time * (to - from) - Point3{};
        const double d = length(way);
        check_both(scene, at_floor(time), 2, kAlbedo * 5 * 0.64 / (d * d) * (way.y / d), 200'000);
    }
}

TEST_CASE("Path: a moving roof keeps light off while it is there", "[render][path]") {
    const Point3 q{-0.5, 2, -0.5};
    const Vec3 u{1, 0, 0}, v{0, 0, 1};
    const Object roof = std::make_shared<Instance>(quad({-2, 1, -2}, {4, 0, 0}, {0, 0, 4}, grey(0)), Transform{},
                                                   Transform::translate({100, 0, 0}));
    const CompiledScene scene = compile_with(sky(0), {floor_of(grey(kAlbedo)), roof, quad(q, u, v, lamp(5))});
    for (const Estimator estimator : {Estimator::path, Estimator::naive})
        CHECK(along(scene, at_floor(0), 2, estimator, 2000).mean == 0);
    check_both(scene, at_floor(1), 2,
               kAlbedo * 5 * std::abs(vector_irradiance({q, q + u, q + u + v, q + v}, {}).y) / kPi, 100'000);
}

TEST_CASE("Path: a lamp does not shade itself, though its points are rounded as coarsely as its far-off coordinates",
          "[render][path]") {
    // Described some 1e8 units away and brought near by an instance: its points are off by some 1e-7.
    const Vec3 away{1e8, 2e8, -1e8};
    const Transform near = Transform::translate({0.3, 1.5, -0.2}) * Transform::rotate({1, 2, 0}, 20);
    const Vec3 u{1, 0, 0}, v{0, 0, 1};
    const Point3 q{-0.5, 0, -0.5};
    const Object light = std::make_shared<Instance>(quad(q + away, u, v, lamp(4)), near * Transform::translate(-away));
    const auto at = [&](const Point3& p) { return transform_point(near, p); };
    const double irradiance = std::abs(vector_irradiance({at(q), at(q + u), at(q + u + v), at(q + v)}, {}).y);
    check_both(compile_with(sky(0), {floor_of(grey(kAlbedo)), light}), at_floor(), 2, kAlbedo * 4 * irradiance / kPi,
               100'000);
}

TEST_CASE("Path: behind a boundary that is not there the ray goes on at its own time", "[render][path]") {
    const Object veil =
        std::make_shared<Stranger>(std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 1, nullptr), 0, Color{}));
    const CompiledScene scene =
        compile_with(sky(0), {veil, std::make_shared<Sphere>(Point3{0, 9, -5}, Point3{0, 0, -5}, 1.0, lamp(3))});
    const auto seen = [&](double time) {
        return along(scene, {.origin = {0, 0, 5}, .direction = {0, 0, -2}, .time = time}, 1, Estimator::path, 10).mean;
    };
    CHECK(seen(1) == 3);
    CHECK(seen(0) == 0);

    const Point3 q{-0.5, 2, -0.5};
    const Vec3 u{1, 0, 0}, v{0, 0, 1};
    const CompiledScene below = compile_with(sky(0), {floor_of(grey(kAlbedo)), veil, quad(q, u, v, lamp(5))});
    const double irradiance = std::abs(vector_irradiance({q, q + u, q + u + v, q + v}, {}).y);
    check_mean(along(below, at_floor(), 2, Estimator::path, 20'000), kAlbedo * 5 * irradiance / kPi, 8e-3);
}

TEST_CASE("Path: fog before a lamp dims each direction by its own way through it", "[render][path]") {
    const Point3 q{-1, 2, -0.5};
    const Vec3 u{3, 0, 0}, v{0, 0, 2};
    const Object slab = make_box({-60, 0.5, -60}, {60, 1, 60}, nullptr);
    const CompiledScene scene = compile_with(sky(0), {floor_of(grey(kAlbedo)), quad(q, u, v, lamp(4)),
                                                      std::make_shared<ConstantMedium>(slab, 1.5, Color{0, 0, 0})});
    const double irradiance = over_quad(q, u, v, [](const Vec3& w) { return w.y * std::exp(-1.5 * 0.5 / w.y); });
    check_both(scene, at_floor(), 2, kAlbedo * 4 * irradiance / kPi, 200'000);
}

TEST_CASE("Path: brushed metal shows a lamp as its density blurs it", "[render][path]") {
    const Point3 q{-0.7, 2, -3};
    const Vec3 u{1.2, 0, 0}, v{0, 0.5, 1};
    Surface floor;
    floor.normal = floor.shading_normal = {0, 1, 0};
    for (const double fuzz : {0.15, 0.5, 1.0}) {
        INFO("fuzz " << fuzz);
        const Color albedo{0.8, 0.8, 0.8};
        const CompiledScene scene =
            compile_with(sky(0), {floor_of(std::make_shared<Metal>(albedo, fuzz)), quad(q, u, v, lamp(4))});
        const double truth =
            4 * over_quad(q, u, v, [&](const Vec3& w) { return Metal(albedo, fuzz).value(floor, kOut, w).value.g; });
        check_both(scene, at_floor(), 2, truth, 100'000);
    }
}

TEST_CASE("Path: a material is asked for the light that goes from the lamp to the eye, not back", "[render][path]") {
    const Point3 q{-1, 2, -3};
    const Vec3 u{2, 0, 0}, v{0, 0, 1};
    const CompiledScene scene = compile_with(sky(0), {floor_of(std::make_shared<OneWay>()), quad(q, u, v, lamp(4))});
    const double irradiance = std::abs(vector_irradiance({q, q + u, q + u + v, q + v}, {}).y);
    check_both(scene, at_floor(), 2, (1 + kOut.z) / 2 * 4 * irradiance / kPi, 200'000);
}

TEST_CASE("Path: a mirror shows a second lamp to the floor before it", "[render][path]") {
    const Point3 q{-1.5, 1, -0.5}, image{3.5, 1, -0.5};
    const Vec3 u{1, 0.5, 0}, v{0, 0, 1}, image_u{-1, 0.5, 0};
    const CompiledScene scene = compile_with(
        sky(0), {floor_of(grey(kAlbedo)), quad(q, u, v, lamp(4)),
                 quad({1, 0, -50}, {0, 100, 0}, {0, 0, 100}, std::make_shared<Metal>(Color{0.9, 0.9, 0.9}))});
    const auto irradiance = [&](const Point3& at, const Vec3& edge) {
        return std::abs(vector_irradiance({at, at + edge, at + edge + v, at + v}, {}).y);
    };
    const double truth = kAlbedo * 4 / kPi * (irradiance(q, u) + 0.9 * irradiance(image, image_u));
    check_both(scene, at_floor(), 3, truth, 100'000);
}

TEST_CASE("Path: in a medium there are no texture coordinates, whatever the path met before", "[render][path]") {
    Image image(4, 4);
    image.set(0, 3, {1, 1, 1});  // at u = v = 0
    const auto texture = std::make_shared<ImageTexture>(image, ImageTextureOptions{Filter::nearest, Wrap::clamp});
    const CompiledScene scene =
        compile_with(sky(1), {quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, std::make_shared<Metal>(Color{1, 1, 1})),
                              std::make_shared<ConstantMedium>(sphere({0, 1.5, 0}, 1, nullptr), 5, texture)});
    const Measured m = along(scene, {.origin = {0, 3, 4}, .direction = {0, -1, -1}}, 1000, Estimator::path, 2000);
    CHECK(m.mean == 1);  // all is white
}

TEST_CASE("Path: how far light comes in overlapping media says nothing of which one scatters it", "[render][path]") {
    // Two media of extinction 1 in the slab 0 < x < 1, one black and one white: half of what is scattered at x leaves
    // the slab, in the direction of cosine m to either side, without another event.
    const Object slab = make_box({0, -1e3, -1e3}, {1, 1e3, 1e3}, nullptr);
    const auto escaping = [](double depth) {
        constexpr int kSteps = 1000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) sum += std::exp(-depth * kSteps / (i + 0.5)) / kSteps;
        return sum / 2;
    };
    constexpr int kSteps = 200;
    double truth = std::exp(-2);
    for (int i = 0; i < kSteps; ++i) {
        const double x = (i + 0.5) / kSteps;
        truth += 2 * std::exp(-2 * x) / kSteps * 0.5 * (escaping(2 * x) + escaping(2 - 2 * x));
    }
    for (const double first : {0.0, 1.0}) {
        const double second = 1 - first;
        const CompiledScene scene =
            compile_with(sky(1), {std::make_shared<ConstantMedium>(slab, 1, Color{first, first, first}),
                                  std::make_shared<ConstantMedium>(slab, 1, Color{second, second, second})});
        check_mean(along(scene, {.origin = {-1, 0, 0}, .direction = {1, 0, 0}}, 2, Estimator::path, 100'000), truth,
                   1e-2);
    }
}

TEST_CASE("Path: every ray that is traced is counted", "[render][path]") {
    const Object light = quad({-0.5, 1, -0.5}, {1, 0, 0}, {0, 0, 1}, lamp(1));
    const auto rays = [&](const std::vector<Object>& objects, int depth, Estimator estimator) {
        const CompiledScene scene = compile_with(sky(0), objects);
        PathTracer tracer(scene.flat(), depth, estimator);
        for (std::uint64_t i = 0; i < 100; ++i) {
            Sampler sampler(1, i, 0);
            tracer.radiance(at_floor(), sampler);
        }
        return tracer.rays();
    };
    CHECK(rays({}, 5, Estimator::path) == 100);
    CHECK(rays({floor_of(grey(1)), light}, 1, Estimator::path) == 100);
    CHECK(rays({floor_of(grey(1)), light}, 2, Estimator::naive) == 200);
    CHECK(rays({floor_of(grey(1)), light}, 2, Estimator::path) == 300);  // and one towards the lamp
    CHECK(rays({floor_of(std::make_shared<Metal>(Color{1, 1, 1})), light}, 2, Estimator::path) == 200);  // none to it
}

TEST_CASE("Path: a sample does not depend on those that came before it", "[render][path]") {
    const Object fog = std::make_shared<ConstantMedium>(sphere({0, 0.5, 0}, 2, nullptr), 0.7, Color{0.5, 0.8, 0.9});
    const CompiledScene scene =
        compile_with(sky(0.3), {floor_of(grey(0.7)), fog, sphere({1, 0.5, 0}, 0.5, std::make_shared<Dielectric>(1.5)),
                                quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, lamp(5)), sphere({-1, 1, 0}, 0.3, lamp(2))});
    PathTracer used(scene.flat(), 8, Estimator::path);
    holds([&](std::uint64_t seed, std::uint64_t pixel) {
        PathTracer fresh(scene.flat(), 8, Estimator::path);
        Sampler a(seed, pixel, 0), b(seed, pixel, 0);
        const Ray ray{.origin = {0, 1, 5}, .direction = Vec3{a.numbers_of(0)[0] - 0.5, -a.numbers_of(0)[1], -2}};
        RC_ASSERT(used.radiance(ray, a) == fresh.radiance(ray, b));
    });
}

}  // namespace limn::path_test
