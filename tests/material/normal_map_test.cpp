#include "limn/scene/material/normal_map.h"

#include <cmath>

#include "bsdf/lobe.h"
#include "catch.h"
#include "limn/limn.h"
#include "limn/math/error.h"
#include "material/lobe.h"
#include "material/microfacets.h"

namespace limn::normal_map_test {

using namespace test;

namespace {

const Color kWhite{1, 1, 1};

// A normal that leans by so much from z towards the azimuth, as a texture stores it.
std::shared_ptr<const Texture> leaning(double degrees, double azimuth) {
    const Vec3 n = at_angles(radians(degrees), radians(azimuth));
    return std::make_shared<SolidColor>(Color{(n.x + 1) / 2, (n.y + 1) / 2, (n.z + 1) / 2});
}

// At z = 0, with u along x and v along y.
Surface level() {
    Surface s = kUp;
    s.dp_du = {2, 0, 0}, s.dp_dv = {0, 3, 0};
    return s;
}

}  // namespace

TEST_CASE("NormalMap: a bent normal loses no light", "[material][normal-map]") {
    const std::shared_ptr<const Material> materials[] = {
        std::make_shared<Lambertian>(kWhite), std::make_shared<OrenNayar>(kWhite, 0.7),
        std::make_shared<RoughConductor>(kWhite, 0.5), std::make_shared<Plastic>(kWhite, 0.6)};
    for (std::size_t i = 0; i < 4; ++i)
        for (const double bend : {0.0, 30.0, 60.0})
            for (const double degrees : {0.0, 40.0, 75.0}) {
                CAPTURE(i, bend, degrees);
                const NormalMap bent(materials[i], leaning(bend, 130));
                CHECK(reflected(bent, at_angles(radians(degrees), 0.3), level(), 100) == Approx(1).epsilon(1e-3));
            }
    // What is lost without: what NormalMap states.
    const Lambertian white(kWhite);
    for (const double bend : {30.0, 60.0}) {
        Surface s = level();
        s.shading_normal = Normal3(at_angles(radians(bend), 0));
        CHECK(reflected(white, {0, 0, 1}, s, 300) == Approx((1 + std::cos(radians(bend))) / 2).epsilon(1e-3));
    }
}

TEST_CASE("NormalMap: samples follow the density, at every roughness", "[material][normal-map]") {
    for (const double roughness : kGridRoughness) {
        CAPTURE(roughness);
        const auto metal = std::make_shared<RoughConductor>(Color{1, .5, 1}, roughness);
        check_samples(NormalMap(metal, leaning(40, 200)));
    }
}

TEST_CASE("NormalMap: red leans along dp_du, green towards dp_dv, on both sides", "[material][normal-map]") {
    const auto white = std::make_shared<Lambertian>(kWhite);
    Surface front = level(), back = level();
    front.dp_dv = {1, 3, 0};  // not at right angles
    back.front_face = false, back.normal = back.shading_normal = {0, 0, -1};
    const auto brightness = [&](const Surface& s, double azimuth, const Vec3& in) {
        return NormalMap(white, leaning(45, azimuth)).value(s, Vec3(s.normal), normalize(in)).value.g;
    };
    for (const double sign : {1.0, -1.0}) {
        CHECK(brightness(front, 0, {sign, 0, 1}) == Approx(sign > 0 ? 1 / kPi : 0).margin(1e-12));
        CHECK(brightness(front, 90, {0, sign, 1}) == Approx(sign > 0 ? 1 / kPi : 0).margin(1e-12));
        // From behind a bump is a dent.
        CHECK(brightness(back, 0, {sign, 0, -1}) == Approx(sign < 0 ? 1 / kPi : 0).margin(1e-12));
        CHECK(brightness(back, 90, {0, sign, -1}) == Approx(sign < 0 ? 1 / kPi : 0).margin(1e-12));
    }
    // Mirrored texture coordinates.
    Surface mirrored = level();
    mirrored.dp_dv = {0, -1, 0};
    CHECK(brightness(mirrored, 90, {0, -1, 1}) == Approx(1 / kPi));
    Surface without = kUp;
    CHECK(brightness(without, 0, {1, 0, 1}) == Approx(std::sqrt(0.5) / kPi));
}

TEST_CASE("NormalMap: one that is flat changes nothing, and glass stays glass", "[material][normal-map]") {
    std::mt19937_64 random(4);
    const auto metal = std::make_shared<RoughConductor>(Color{1, .5, 1}, 0.6);
    const auto glass = std::make_shared<Dielectric>(1.5);
    const NormalMap flat_metal(metal, leaning(0, 0)), flat_glass(glass, leaning(0, 0));
    for (int i = 0; i < 300; ++i) {
        const Surface s = level();
        const Vec3 out = random_out(random, s), in = random_direction(random);
        if (out.z < 1e-2) continue;
        CHECK(flat_metal.value(s, out, in).value.g == Approx(metal->value(s, out, in).value.g).epsilon(1e-9));
        const Random3 numbers = random3(random);
        const auto a = flat_glass.sample(s, out, numbers), b = glass->sample(s, out, numbers);
        REQUIRE((a && b));
        CHECK(length(a->direction - b->direction) < 1e-12);
    }
}

TEST_CASE("NormalMap: nothing in it, and one of another, is refused", "[material][normal-map]") {
    const auto white = std::make_shared<Lambertian>(kWhite);
    CHECK_THROWS_AS(NormalMap(nullptr, leaning(0, 0)), ArgumentError);
    CHECK_THROWS_AS(NormalMap(white, nullptr), ArgumentError);
    RecordSink sink;
    const auto once = std::make_shared<NormalMap>(white, leaning(0, 0));
    CHECK_THROWS_AS(NormalMap(once, leaning(0, 0)).lower(sink), ArgumentError);
}

TEST_CASE("NormalMap: a direction that rounding leaves no density weighs nothing", "[material][normal-map]") {
    const bsdf::Lobe lobe{
        .one_sided = true,
        .numbers = 2,
        .sample =
            [](bsdf::Vertices& v) {
                v.direction.set(0, Vec3{1, 0, 0});  // along the surface
                v.weight.set(0, kWhite), v.pdf[0] = 1;
            },
        .value = [](bsdf::Vertices& v, const sampling::Rows3&) { v.value.set(0, Color{}), v.value_pdf[0] = 0; }};
    const auto v = std::make_unique<bsdf::Vertices>();
    v->count = 1, v->tangent_facets = 1;
    v->normal.set(0, Vec3{0, 0, 1}), v->shading_normal.set(0, normalize(Vec3{0.5, 0, 1}));
    bsdf::sample(lobe, *v);
    CHECK(v->weight.get<Color>(0) == Color{});
    CHECK(v->pdf[0] > 0);
}

}  // namespace limn::normal_map_test
