// Furnaces: in a uniform field of radiance 1 whatever absorbs nothing is invisible; in a closed room that glows with 1
// and reflects a, the radiance is 1 / (1 - a).
#include "catch.h"
#include "limn/material/dielectric.h"
#include "limn/material/metal.h"
#include "support/pictures.h"

namespace limn::furnace_test {

using namespace test;

namespace {

constexpr int kDeep =
    1000;  // no path that matters is cut, and none ends by roulette: what is lossless is so to the bit

// Somebody else's diffuse reflector, which may glow.
class GlowingDiffuse final : public Material {
public:
    GlowingDiffuse(double glow, double albedo) : glow_(glow), albedo_(albedo) {}
    Color emitted(const Surface&) const override { return {glow_, glow_, glow_}; }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3&, const Random3& random) const override {
        const double z = std::sqrt(random.x), r = std::sqrt(1 - random.x), phi = 2 * kPi * random.y;
        const Vec3 n(s.normal), x = normalize(std::abs(n.x) > 0.5 ? cross(n, Vec3{0, 1, 0}) : cross(n, Vec3{1, 0, 0}));
        const Vec3 d = normalize(r * std::cos(phi) * x + r * std::sin(phi) * cross(n, x) + z * n);
        return ScatterSample{d, Color{albedo_, albedo_, albedo_}, std::max(dot(n, d), 0.0) / kPi};
    }
    ScatterValue value(const Surface& s, const Vec3&, const Vec3& in) const override {
        const double c = std::max(dot(s.normal, in), 0.0) / kPi;
        return {Color{albedo_ * c, albedo_ * c, albedo_ * c}, c};
    }

private:
    double glow_, albedo_;
};

struct Extremes {
    double least = kInfinity, most = -kInfinity;
};

Extremes extremes(const Image& image) {
    Extremes e;
    for (const float v : image.values()) {
        e.least = std::min(e.least, static_cast<double>(v));
        e.most = std::max(e.most, static_cast<double>(v));
    }
    return e;
}

const Camera kEye = camera_at({0.3, 0.5, 6}, {0, 0, 0}, 30);

Extremes in_uniform_field(const Object& object) {
    return extremes(render(compile_with(sky(1), {object}), kEye, square(16, 64, kDeep)).image);
}

// Shapes around the origin, with a material.
std::vector<std::pair<std::string, Object>> bodies(const MaterialPtr& m) {
    const Object ball = sphere({0, 0, 0}, 1, m);
    return {{"sphere", ball},
            {"inward sphere", sphere({0, 0, 0}, -1, m)},
            {"moving sphere", std::make_shared<Sphere>(Point3{-0.5, 0, 0}, Point3{0.5, 0.2, 0}, 0.8, m)},
            {"mesh", std::make_shared<Mesh>(icosphere(2), m)},
            {"box", make_box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}, m)},
            {"mirrored instance",
             std::make_shared<Instance>(ball, Transform::rotate_z(20) * Transform::scale(-1, 0.7, 1.2))},
            {"moving instance",
             std::make_shared<Instance>(ball, Transform::scale(0.5, 1, 1), Transform::translate({0.2, 0, 0}))},
            {"user's own shape", std::make_shared<Stranger>(ball)}};
}

}  // namespace

TEST_CASE("White furnace: every lossless material on every shape is invisible, to the bit", "[render][furnace]") {
    const Color white{1, 1, 1};
    const std::pair<const char*, MaterialPtr> materials[] = {
        {"Lambertian", std::make_shared<Lambertian>(white)},
        {"mirror", std::make_shared<Metal>(white, 0)},
        {"glass", std::make_shared<Dielectric>(1.5)},
        {"glass by Schlick", std::make_shared<Dielectric>(1.5, Fresnel::schlick)},
        {"glass of index 1", std::make_shared<Dielectric>(1.0)},
        {"bubble", std::make_shared<Dielectric>(1 / 1.5)},
        {"diamond", std::make_shared<Dielectric>(2.4)},
        {"isotropic surface", std::make_shared<Isotropic>(white)},
        {"user's own diffuse", std::make_shared<GlowingDiffuse>(0, 1)}};
    for (const auto& [material_name, material] : materials) {
        for (const auto& [body_name, body] : bodies(material)) {
            const Extremes e = in_uniform_field(body);
            INFO(material_name << " " << body_name);
            CHECK(e.least >= 1 - 1e-6);
            CHECK(e.most <= 1 + 1e-6);
        }
    }
}

TEST_CASE("White furnace: rough metal may lose light but never makes any, and loses more the rougher",
          "[render][furnace]") {
    double last = 1;
    for (const double fuzz : {0.1, 0.5, 1.0}) {
        const Object ball = sphere({0, 0, 0}, 1, std::make_shared<Metal>(Color{1, 1, 1}, fuzz));
        const Image image = render(compile_with(sky(1), {ball}), kEye, square(16, 64, kDeep)).image;
        CHECK(extremes(image).most <= 1 + 1e-6);
        CHECK(mean(image) < last);
        last = mean(image);
    }
    CHECK(last > 0.8);
}

TEST_CASE("White furnace: a fraction of the light comes back from a convex body of that albedo, exactly",
          "[render][furnace]") {
    for (const double albedo : {0.0, 0.18, 0.5, 0.99}) {
        for (const auto& [name, body] : bodies(grey(albedo))) {
            const Camera close = camera_at({0, 0, 4}, {0, 0, 0}, 2);  // nothing but the body in view
            if (name.find("moving") != std::string::npos) continue;
            const Extremes e = extremes(render(compile_with(sky(1), {body}), close, square(4, 64, kDeep)).image);
            INFO(name << ", albedo " << albedo);
            CHECK(e.least == Approx(albedo).epsilon(1e-6));
            CHECK(e.most == Approx(albedo).epsilon(1e-6));
        }
    }
}

TEST_CASE("White furnace: smooth normals only ever lose light, at the terminator", "[render][furnace]") {
    MeshData data = icosphere(2);
    data.normals = data.vertices;
    for (const double albedo : {1.0, 0.5}) {
        const Object body = std::make_shared<Mesh>(data, grey(albedo));
        const Extremes e = extremes(
            render(compile_with(sky(1), {body}), camera_at({0, 0, 6}, {0, 0, 0}, 10), square(24, 64, kDeep)).image);
        CHECK(e.least >= 0);
        CHECK(e.most <= albedo + 1e-6);
        CHECK(e.least > 0.8 * albedo);
    }
}

TEST_CASE("White furnace: hollow glass, glass in glass and nested media are invisible", "[render][furnace]") {
    const MaterialPtr glass = std::make_shared<Dielectric>(1.5);
    const auto list = [](std::vector<Object> objects) { return std::make_shared<HittableList>(std::move(objects)); };
    const Color white{1, 1, 1};
    for (const Object& body :
         {Object(list({sphere({0, 0, 0}, 1, glass), sphere({0, 0, 0}, -0.8, glass)})),
          Object(list({sphere({0, 0, 0}, 1, glass), sphere({0, 0, 0}, 0.8, std::make_shared<Dielectric>(1 / 1.5))})),
          Object(list({sphere({0, 0, 0}, 1, glass),
                       std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 0.9, glass), 2, white)}))}) {
        const Extremes e = in_uniform_field(body);
        CHECK(e.least >= 1 - 1e-6);
        CHECK(e.most <= 1 + 1e-6);
    }
}

TEST_CASE("White furnace: a medium of albedo 1 is invisible at optical depths 0.1, 1 and 10", "[render][furnace]") {
    for (const double depth : {0.1, 1.0, 10.0}) {
        for (const auto& [name, body] : bodies(grey(0.3))) {
            const Object fog = std::make_shared<ConstantMedium>(body, depth / 2, Color{1, 1, 1});
            const Extremes e = in_uniform_field(fog);
            INFO(name << ", optical depth " << depth);
            CHECK(e.least >= 1 - 1e-6);
            CHECK(e.most <= 1 + 1e-6);
        }
    }
}

TEST_CASE("White furnace: with unlimited depth roulette changes no mean", "[render][furnace]") {
    const Object fog = std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 1, grey(0.3)), 5, Color{1, 1, 1});
    check_mean(
        measure(compile_with(sky(1), {fog}), camera_at({0, 0, 6}, {0, 0, 0}, 15), square(16, 64, kUnlimitedDepth)), 1,
        1e-3);
    const Object glass = std::make_shared<Mesh>(icosphere(1), std::make_shared<Dielectric>(1.5));
    check_mean(
        measure(compile_with(sky(1), {glass}), camera_at({0, 0, 6}, {0, 0, 0}, 15), square(16, 64, kUnlimitedDepth)), 1,
        1e-3);
}

TEST_CASE("Ground sphere: diffuse in a uniform field, it shows albedo times field at every radius",
          "[render][furnace]") {
    for (double r = 1e3; r <= 1e7; r *= 10) {
        const CompiledScene scene = compile_with(sky(1), {sphere({0, -r, 0}, r, grey(0.5))});
        const Extremes e = extremes(render(scene, camera_at({0, 1, 0}, {1, 0, 1}, 60), square(16, 64, 50)).image);
        INFO("radius " << r);
        CHECK(e.least == Approx(0.5).epsilon(1e-6));
        CHECK(e.most == Approx(0.5).epsilon(1e-6));
    }
}

TEST_CASE("Closed furnace: a glowing room of albedo a shows 1 / (1 - a)", "[render][furnace]") {
    const struct {
        double albedo;
        int samples;
        double power;
    } cases[] = {{0.5, 16, 1.5e-3}, {0.8, 24, 2.5e-3}, {0.9, 24, 3.5e-3}};
    for (const auto& c : cases) {
        const MaterialPtr wall = std::make_shared<GlowingDiffuse>(1, c.albedo);
        for (const Object& room : {sphere({0, 0, 0}, 3, wall), Object(make_box({-1, -2, -3}, {3, 2, 1}, wall)),
                                   Object(std::make_shared<Mesh>(icosphere(1, 3), wall))}) {
            INFO("albedo " << c.albedo);
            check_mean(measure(compile_with(sky(0), {room}), camera_at({0.2, 0.1, 0}, {1, 0.3, -1}, 90),
                               square(16, c.samples, kUnlimitedDepth)),
                       1 / (1 - c.albedo), c.power);
        }
    }
}

TEST_CASE("Integrating sphere: a small lamp in a white room gives the exact uniform radiance", "[render][furnace]") {
    // Wall radius 1, lamp radius r in its centre, k = r^2. The wall gets E = pi L k + a E (1 - k), for a fraction k of
    // what it reflects ends in the lamp (Hottel and Sarofim, Radiative Transfer, 1967, concentric spheres).
    const double k = 0.04, albedo = 0.8, radiance = 10;
    const CompiledScene scene =
        compile_with(sky(0), {sphere({0, 0, 0}, -1, grey(albedo)), sphere({0, 0, 0}, std::sqrt(k), lamp(radiance))});
    const double truth = albedo * radiance * k / (1 - albedo * (1 - k));
    const Camera at_wall = camera_at({0.6, 0, 0}, {1, 0, 0}, 60);
    check_mean(measure(scene, at_wall, square(16, 32, kUnlimitedDepth)), truth, 3e-3);
    check_mean(measure(scene, at_wall, square(16, 32, kUnlimitedDepth, Estimator::naive)), truth, 6e-3);
}

}  // namespace limn::furnace_test
