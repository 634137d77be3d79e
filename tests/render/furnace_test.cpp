// Furnaces: in a uniform field of radiance 1 whatever absorbs nothing is invisible. Those whose every path is exact, of
// every size and shape, are in tests/hard/energy_test.cpp.
#include "catch.h"
#include "limn/scene/environment.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/material/metallic_roughness.h"
#include "limn/scene/material/normal_map.h"
#include "limn/scene/material/oren_nayar.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/material/rough_dielectric.h"
#include "limn/scene/texture/image_texture.h"
#include "support/pictures.h"

namespace limn::furnace_test {

using namespace test;

namespace {

constexpr int kDeep =
    1000;  // no path that matters is cut, and none ends by roulette: what is lossless is so to the bit

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

}  // namespace

TEST_CASE("White furnace: a ball of each material vanishes, before a background and under environment maps",
          "[render][furnace]") {
    const Color white{1, 1, 1};
    Image bumps(2, 2, Color{.8, .3, .8});
    bumps.set(0, 0, {.2, .5, .7});
    const auto bumpy = [&](MaterialPtr material) {
        return std::make_shared<NormalMap>(std::move(material), std::make_shared<ImageTexture>(bumps));
    };
    struct Row {
        const char* name;
        MaterialPtr material;
        double gain, loss;  // of a ball's light, at most
    };
    // Fuzz f sends light into metal only at angles whose cosine is below f, which are f^2 of a ball as it is seen. The
    // tables that make good what facets scatter more than once are right to 1e-3 (tests/material). Glass so smooth
    // loses at most 3e-3 each time that light meets it (there too), and light meets a ball of glass twice in the mean:
    // it enters with probability T, and then meets the inside 1 / T times, as the angle there is that of the way in.
    const Row rows[] = {{"Lambertian", std::make_shared<Lambertian>(white), 0, 0},
                        {"mirror", std::make_shared<Metal>(white, 0), 0, 0},
                        {"metal", std::make_shared<Metal>(white, 0.1), 0, 0.01},
                        {"glass", std::make_shared<Dielectric>(1.5), 0, 0},
                        {"rough diffuse", std::make_shared<OrenNayar>(white, 0.8), 0, 0},
                        {"roughest diffuse", std::make_shared<OrenNayar>(white, 1), 0, 0},
                        {"rough conductor", std::make_shared<RoughConductor>(white, 0.6), 1e-3, 1e-3},
                        {"roughest conductor", std::make_shared<RoughConductor>(white, 1), 1e-3, 1e-3},
                        {"brushed conductor", std::make_shared<RoughConductor>(white, Roughness(0.3, 0.8)), 1e-3, 1e-3},
                        {"rough glass", std::make_shared<RoughDielectric>(1.5, 0.1), 0, 6e-3},
                        {"smooth plastic", std::make_shared<Plastic>(white, 0), 1e-3, 1e-3},
                        {"rough plastic", std::make_shared<Plastic>(white, 0.4), 1e-3, 1e-3},
                        {"metal by glTF", std::make_shared<MetallicRoughness>(white, 0.5, 1), 1e-3, 1e-3},
                        {"rough metal by glTF", std::make_shared<MetallicRoughness>(white, 0.5, 0.4), 1e-3, 1e-3},
                        {"lacquer by glTF", std::make_shared<MetallicRoughness>(white, 0.2, 0.3), 1e-3, 1e-3},
                        {"bumpy Lambertian", bumpy(std::make_shared<Lambertian>(white)), 0, 0},
                        {"bumpy plastic", bumpy(std::make_shared<Plastic>(white, 0)), 1e-3, 1e-3},
                        {"bumpy mirror", bumpy(std::make_shared<Metal>(white)), 0, 0}};
    const auto map = [&](int width) {
        return std::make_shared<EnvironmentMap>(Image(width, width, white), Transform::rotate({1, 2, 0.5}, 40));
    };
    const auto check = [](const Scene& scene, const std::string& name, double gain, double loss) {
        const Measured m = measure(compile(scene), camera_at({0, 0, 6}, {0, 0, 0}, 20), square(8, 64, 100), 8);
        INFO(name << ": " << m.mean << " of sigma " << m.sigma);
        CHECK(m.mean - 1 <= 4.5 * m.sigma + gain + 1e-6);
        CHECK(1 - m.mean <= 4.5 * m.sigma + loss + 1e-6);
        CHECK(m.sigma < 0.002);
    };
    for (const auto& environment : {std::shared_ptr<EnvironmentMap>(), map(1), map(32)}) {
        CAPTURE(environment ? environment->image()->width() : 0);
        Scene empty;
        empty.background = Background::gradient(white, white);
        empty.environment = environment;
        for (const auto& [name, material, gain, loss] : rows) {
            Scene scene = empty;
            scene.add(sphere({0, 0, 0}, 1, material));
            check(scene, name, gain, loss);
        }
        Scene fog = empty;
        fog.add(std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 1, nullptr), 2, white));
        check(fog, "fog", 0, 0);
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
