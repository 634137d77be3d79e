// No light is made and none is lost: furnaces whose every path returns the same, so that a pixel is exact, and random
// ones beside them. Those of ordinary size are in tests/render/furnace_test.cpp.
#include "hard/hard.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "render/single_ray.h"

namespace limn::energy_test {

using namespace test;

namespace {

// Somebody else's diffuse reflector, which may glow: with radiance 1 it is the wall of a closed furnace.
class Glowing final : public Material {
public:
    explicit Glowing(double albedo, double radiance = 1)
        : diffuse_(Color{albedo, albedo, albedo}), radiance_{radiance, radiance, radiance} {}
    Color emitted(const Surface&) const override { return radiance_; }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override {
        return diffuse_.sample(s, out, random);
    }
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override {
        return diffuse_.value(s, out, in);
    }

private:
    Lambertian diffuse_;
    Color radiance_;
};

MeshData moved(MeshData mesh, double size, const Vec3& at) {
    for (Float3& v : mesh.vertices) v = to_float3(at + size * Vec3{v.x, v.y, v.z});
    return mesh;
}

// Convex bodies of about the given size and place, described there or brought there by an instance.
std::vector<std::pair<std::string, Object>> convex_bodies(double size, const Vec3& at, const MaterialPtr& m) {
    const Point3 c = Point3{} + at;
    const Vec3 half{0.6 * size, 0.7 * size, 0.5 * size};
    const Transform place = Transform::translate(at) * Transform::rotate({1, 2, 3}, 50);
    return {{"sphere", sphere(c, size, m)},
            {"inward sphere", sphere(c, -size, m)},
            {"moving sphere", std::make_shared<Sphere>(c, c + Vec3{0.1 * size, 0, 0}, size, m)},
            {"user's own shape", std::make_shared<Stranger>(sphere(c, size, m))},
            {"mesh", std::make_shared<Mesh>(moved(icosphere(1), size, at), m)},
            {"box", make_box(c - half, c + half, m)},
            {"turned box", std::make_shared<Instance>(make_box(Point3{} - half, Point3{} + half, m), place)},
            {"ellipsoid", std::make_shared<Instance>(sphere({0, 0, 0}, 1, m),
                                                     place * Transform::scale(size, 0.5 * size, -0.8 * size))},
            {"instance of an instance",
             std::make_shared<Instance>(std::make_shared<Instance>(std::make_shared<Mesh>(icosphere(1), m),
                                                                   Transform::scale(1e-3, 1e-3, 1e-3)),
                                        place * Transform::scale(1e3 * size, 1e3 * size, 1e3 * size))},
            {"moving instance",
             std::make_shared<Instance>(sphere({0, 0, 0}, size, m), Transform::translate(at),
                                        Transform::translate(at + Vec3{0.1 * size, 0, 0}) * Transform::rotate_y(40))}};
}

// How far a picture is from `truth` in its worst pixel.
double worst(const Image& image, double truth) {
    double largest = 0;
    for (const float v : image.values()) largest = std::max(largest, std::abs(static_cast<double>(v) - truth));
    return largest;
}

constexpr double kPixel = 0x1p-23;  // pixels are float32

// Nothing but the body in view.
Camera close_up(double size, const Vec3& at) {
    return camera_at(Point3{} + at + size * Vec3{1.5, 2, 4}, Point3{} + at, 3);
}

}  // namespace

TEST_CASE("Energy: a convex grey body shows its albedo exactly, at every size and place: no ray hits it again",
          "[hard][energy]") {
    for (const double size : {1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6})
        for (const double away : {0.0, 10.0, 1e3}) {
            const Vec3 at = away * size * Vec3{0.6, -0.48, 0.64};
            for (const auto& [name, body] : convex_bodies(size, at, grey(0.5))) {
                const Image image =
                    render(compile_with(sky(1), {body}), close_up(size, at), square(4, std::max(64, count(800)), 20))
                        .image;
                CAPTURE(name, size, away);
                // Instances are turned in place: at 1000 sizes a mesh of floats is convex to some 1e-4 only.
                if (name == "mesh" && away == 1e3) continue;
                CHECK(worst(image, 0.5) <= kPixel);
            }
        }
    for (const double albedo : {0.0, 0.18, 0.99})
        for (const auto& [name, body] : convex_bodies(1, {}, grey(albedo))) {
            const Image image =
                render(compile_with(sky(1), {body}), close_up(1, {}), square(4, std::max(64, count(800)), 20)).image;
            CAPTURE(name, albedo);
            CHECK(worst(image, albedo) <= kPixel);
        }
}

TEST_CASE("Energy: every lossless material and medium is invisible in a uniform field, at every size and place",
          "[hard][energy]") {
    const Color white{1, 1, 1};
    const std::pair<const char*, MaterialPtr> materials[] = {
        {"Lambertian", grey(1)},
        {"mirror", std::make_shared<Metal>(white)},
        {"glass", std::make_shared<Dielectric>(1.5)},
        {"index 1", std::make_shared<Dielectric>(1.0)},
        {"Schlick", std::make_shared<Dielectric>(1.5, Fresnel::schlick)},
        {"bubble", std::make_shared<Dielectric>(1 / 1.5)},
        {"diamond", std::make_shared<Dielectric>(2.4)},
        {"isotropic surface", std::make_shared<Isotropic>(white)},
        {"user's own diffuse", std::make_shared<Glowing>(1, 0)}};
    const auto check_invisible = [](const Object& body, double size, const Vec3& at, int side = 8, int samples = 64) {
        // No path of these is so long; none ends by roulette.
        const RenderSettings settings = square(side, samples, 100'000);
        const Image image = render(compile_with(sky(1), {body}), close_up(size, at), settings).image;
        CHECK(worst(image, 1) <= kPixel);
    };
    for (const double size : {1e-4, 1.0, 1e6})
        for (const double away : {0.0, 1e3}) {
            const Vec3 at = away * size * Vec3{0.6, -0.48, 0.64};
            for (const auto& [material_name, material] : materials)
                for (const auto& [name, body] : convex_bodies(size, at, material)) {
                    CAPTURE(material_name, name, size, away);
                    check_invisible(body, size, at);
                }
            // Of thousands of paths this glass holds some for much longer.
            for (const auto& [name, body] : convex_bodies(size, at, std::make_shared<Dielectric>(1e3))) {
                CAPTURE(name, size, away);
                check_invisible(body, size, at, 3, 4);
            }
            for (const auto& [name, body] : convex_bodies(size, at, lamp(100)))  // boundaries do not shine
                for (const double depth : {0.1, 1.0, 10.0}) {
                    CAPTURE(name, size, away, depth);
                    check_invisible(std::make_shared<ConstantMedium>(body, depth / (2 * size), white), size, at);
                }
        }
}

TEST_CASE("Energy: glass, mirrors, media and matte bodies together are invisible, with the eye inside a medium",
          "[hard][energy]") {
    const Color white{1, 1, 1};
    const MaterialPtr glass = std::make_shared<Dielectric>(1.5);
    const auto fog = [&](const Object& boundary, double density) {
        return std::make_shared<ConstantMedium>(boundary, density, white);
    };
    const CompiledScene scene = compile_with(
        sky(1), {sphere({-2, 0, 0}, 1, glass), sphere({-2, 0, 0}, -0.9, glass), sphere({-2, 0, 0}, 0.5, grey(1)),
                 std::make_shared<Mesh>(u_shape(), grey(1)), fog(std::make_shared<Mesh>(u_shape(), glass), 3),
                 make_box({-5, -1.5, -3}, {5, -1, 3}, std::make_shared<Metal>(white)), fog(ball({0, 0, 0}, 6), 0.1),
                 fog(ball({1, 1, 1}, 2), 2), sphere({0, 1.5, 3}, 0.7, std::make_shared<Dielectric>(1 / 1.5))});
    const Image image = render(scene, camera_at({0, 0.5, 5.5}, {0, 0, 0}, 60), square(16, count(1600), 100'000)).image;
    CHECK(worst(image, 1) <= kPixel);
}

TEST_CASE("Energy: rough metal loses what of its ball lies below the surface, and nothing else", "[hard][energy]") {
    // The cap of a ball of radius f whose plane is c from the centre, over the ball: (f - c)^2 (2 f + c) / (4 f^3).
    const int samples = count(1e6);
    for (const double fuzz : {0.05, 0.3, 0.7, 1.0})
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 88.0, 89.9}) {
            const double c = std::cos(radians(degrees)), height = std::max(0.0, fuzz - c);
            const double kept = 1 - height * height * (2 * fuzz + c) / (4 * fuzz * fuzz * fuzz);
            const CompiledScene scene = compile_with(sky(1), {floor_of(std::make_shared<Metal>(Color{1, 1, 1}, fuzz))});
            const double s = std::sin(radians(degrees));
            const Measured m = along(scene, {.origin = {-s, c, 0}, .direction = {s, -c, 0}}, 100, Estimator::path,
                                     static_cast<std::uint64_t>(samples));
            CAPTURE(fuzz, degrees, m.mean, kept);
            CHECK(std::abs(m.mean - kept) <= 4.5 * std::sqrt(kept * (1 - kept) / samples) + 1e-12);
        }
}

TEST_CASE("Energy: a closed furnace shows 1 + a + ... + a^(n - 1) after n segments, exactly: nothing leaks out of it",
          "[hard][energy]") {
    // By scattering alone, where no roulette ends a limited path.
    for (const double albedo : {0.5, 0.8, 0.9, 0.99}) {
        // So deep that what is left out is a millionth.
        const int depth = static_cast<int>(std::ceil(std::log(1e-6) / std::log(albedo)));
        const double truth = (1 - std::pow(albedo, depth)) / (1 - albedo);
        REQUIRE(truth == Approx(1 / (1 - albedo)).epsilon(1.01e-6));
        const MaterialPtr wall = std::make_shared<Glowing>(albedo);
        std::vector<std::pair<std::string, Object>> rooms = convex_bodies(3, {1, -1, 2}, wall);
        rooms.emplace_back("U", std::make_shared<Instance>(std::make_shared<Mesh>(u_shape(), wall),
                                                           Transform::translate({-0.5, -1.5, 1.5})));
        rooms.emplace_back("cube of triangles", std::make_shared<Mesh>(cube_mesh(6, {-2, -4, -1}), wall));
        for (const auto& [name, room] : rooms) {
            const Image image = render(compile_with(sky(1e6), {room}), camera_at({1, -1, 2}, {2, -0.7, 1}, 120),
                                       square(3, count(200), depth, Estimator::naive))
                                    .image;
            CAPTURE(name, albedo);
            CHECK(worst(image, truth) <= (1e-12 + kPixel) * truth);
        }
    }
}

TEST_CASE("Energy: with unlimited depth a closed furnace shows 1 / (1 - a) in the mean", "[hard][energy]") {
    // Were a path kept with probability a from the start and its weight at 1, its light would be geometric, with a
    // standard deviation of sqrt(a) / (1 - a). Roulette begins later and keeps more of them, at a lower weight. The
    // full form resolves .2 %, at .99 .5 %.
    for (const double albedo : {0.5, 0.8, 0.9, 0.99}) {
        const double truth = 1 / (1 - albedo), paths = count(albedo > 0.95 ? 1e6 : 5e6);
        const int side = static_cast<int>(std::ceil(std::sqrt(paths / 64)));
        const Object room = make_box({-1, -2, -3}, {3, 2, 1}, std::make_shared<Glowing>(albedo));
        const Image image = render(compile_with(sky(0), {room}), camera_at({0.2, 0.1, 0}, {1, 0.3, -1}, 90),
                                   square(side, 64, kUnlimitedDepth))
                                .image;
        CAPTURE(albedo, mean(image), truth);
        CHECK(std::abs(mean(image) - truth) <= 4.5 * truth * std::sqrt(albedo / (64.0 * side * side)));
    }
}

TEST_CASE("Energy: unlimited paths through white media and glass carry 1 in the mean", "[hard][energy]") {
    const Object fog = std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 1, grey(0.3)), 5, Color{1, 1, 1});
    const Object glass = std::make_shared<Mesh>(icosphere(1), std::make_shared<Dielectric>(1.5));
    const Camera camera = camera_at({0, 0, 6}, {0, 0, 0}, 15);
    for (const Object& body : {fog, glass})
        check_mean(measure(compile_with(sky(1), {body}), camera, square(16, count(3200), kUnlimitedDepth), 12), 1,
                   1e-3);
}

TEST_CASE("Lamps: from 1.5 to 1.5e7 radii away a ball lights a floor by its share of the sky", "[hard][energy]") {
    // Straight overhead: irradiance pi L sin^2 of its radius' angle, and albedo / pi of that comes back.
    for (const double distance : {1.5, 1.5e1, 1.5e2, 1.5e4, 1.5e6, 1.5e7}) {
        const double radiance = distance * distance;
        const CompiledScene scene =
            compile_with(sky(0), {floor_of(grey(kAlbedo)), sphere({0, distance, 0}, 1, lamp(radiance))});
        const Measured m = along(scene, at_floor(), 2, Estimator::path, static_cast<std::uint64_t>(count(4e6)));
        CAPTURE(distance);
        check_mean(m, kAlbedo, 1e-3);
    }
}

}  // namespace limn::energy_test
