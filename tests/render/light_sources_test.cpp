// Lights that are no shapes, and lamps that shine on one side, against closed forms.
#include "limn/scene/lights.h"

#include <algorithm>
#include <set>

#include "limn/scene/model.h"
#include "limn/scene/shape/disk.h"
#include "render/single_ray.h"
#include "support/single_shading.h"

namespace limn::light_sources_test {

using namespace test;

namespace {

CompiledScene lit_by(const std::vector<LightSource>& lights, const std::vector<Object>& objects) {
    Scene scene;
    for (const Object& object : objects) scene.add(object);
    for (const LightSource& light : lights) scene.add(light);
    return compile(scene);
}

const Object kFloor = floor_of(grey(kAlbedo));
constexpr Color kWhite{1, 1, 1};

// What the floor's origin sends back, which does not depend on what light sampling draws: one light, without extent.
double at_origin(const CompiledScene& scene) {
    const Measured m = along(scene, at_floor(), 2, Estimator::path, 16);
    CHECK(m.sigma <= 1e-7 * m.mean);
    return m.mean;
}

// Of irradiance 1.
constexpr double kReflected = kAlbedo / kPi;

}  // namespace

TEST_CASE("Light sources: a point gives a plane intensity cos / d^2, and shadow behind what is in the way",
          "[render][lights]") {
    const Point3 at{1, 2, -0.5};
    const double d = length(at - Point3{});
    const CompiledScene scene = lit_by({PointLight{at, {3, 3, 3}}}, {kFloor});
    CHECK(scene.stats().lights == 1);
    CHECK(scene.features() == "quad light");
    CHECK(at_origin(scene) == Approx(kReflected * 3 * at.y / (d * d * d)));
    CHECK(at_origin(lit_by({PointLight{at, {3, 3, 3}}}, {kFloor, sphere({0.5, 1, -0.25}, 0.1, grey(0))})) == 0);
    CHECK(at_origin(lit_by({PointLight{{1, -2, 0}}}, {kFloor})) == 0);  // from below
    CHECK(at_origin(lit_by({PointLight{{0, 0, 0}}}, {kFloor})) == 0);   // in the plane
}

TEST_CASE("Light sources: a spot fades from its inner to its outer cone", "[render][lights]") {
    const Point3 at{0, 2, 0};
    for (const double angle : {0.0, 5.0, 10.0, 15.0, 20.0, 29.0, 30.5, 60.0}) {
        const Vec3 axis{std::sin(radians(angle)), -std::cos(radians(angle)), 0};
        const double inner = std::cos(radians(10.0)), outer = std::cos(radians(30.0));
        const double part = std::clamp((std::cos(radians(angle)) - outer) / (inner - outer), 0.0, 1.0);
        const CompiledScene scene = lit_by({SpotLight{at, 7.0 * axis, kWhite, 10, 30}}, {kFloor});
        CHECK(at_origin(scene) == Approx(kReflected * part * part / 4).margin(1e-12));
    }
    CHECK(at_origin(lit_by({SpotLight{at, {0.2, -1, 0}, kWhite, 20, 20}}, {kFloor})) == Approx(kReflected / 4));
    CHECK(at_origin(lit_by({SpotLight{at, {0.5, -1, 0}, kWhite, 20, 20}}, {kFloor})) == 0);
}

TEST_CASE("Light sources: light of one direction gives a plane irradiance cos, through any distance",
          "[render][lights]") {
    const Vec3 direction = normalize({0.5, -1, 0.25});
    const CompiledScene scene = lit_by({DirectionalLight{direction, {2, 2, 2}}}, {kFloor});
    CHECK(at_origin(scene) == Approx(kReflected * 2 * -direction.y));
    const Point3 far = Point3{} - 1e7 * direction;
    CHECK(at_origin(lit_by({DirectionalLight{direction}}, {kFloor, sphere(far, 1e-3, grey(0))})) == 0);
    CHECK(at_origin(lit_by({DirectionalLight{-direction}}, {kFloor})) == 0);
    CHECK(scene.stats().lights == 1);
}

TEST_CASE("Light sources: a sun gives its irradiance, is seen with its radiance, and scattering finds it too",
          "[render][lights]") {
    const Vec3 direction = normalize({0.5, -1, 0.25});
    const SunLight sun{direction, kWhite, 8};
    const CompiledScene scene = lit_by({sun}, {kFloor});
    check_both(scene, at_floor(), 2, kReflected * -direction.y, 2'000'000);
    transport::PathTracer tracer(scene.flat(), 2, Estimator::path);
    const double sine = std::sin(radians(8.0));
    const auto seen = [&](double degrees) {
        const Frame frame(-direction);
        const Vec3 d = frame.to_world({std::sin(radians(degrees)), 0, std::cos(radians(degrees))});
        return tracer.radiance(Ray{{0, 1, 0}, 3.0 * d}, transport::Sampler(1, 0, 0)).g;
    };
    CHECK(seen(0) == Approx(1 / (kPi * sine * sine)));
    CHECK(seen(7.99) == seen(0));
    CHECK(seen(8.01) == 0);
    // Half of it below the horizon: the irradiance of the half disc, by the midpoint rule.
    const CompiledScene rising = lit_by({SunLight{{-1, 0, 0}, kWhite, 8}}, {kFloor});
    double half = 0;
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double one_minus_cos = (i + 0.5) / kSteps * (1 - std::cos(radians(8.0)));
            const double y = std::sqrt(one_minus_cos * (2 - one_minus_cos)) * std::sin(kPi * (j + 0.5) / kSteps);
            half += y;
        }
    half *= kPi * (1 - std::cos(radians(8.0))) / kSteps / kSteps / (kPi * sine * sine);
    check_mean(along(rising, at_floor(), 2, Estimator::path, 100'000), kReflected * half, 0.02);
}

TEST_CASE("Light sources: many together add up, beside lamps and an environment", "[render][lights]") {
    const Vec3 slanted = normalize({1, -2, 0});
    Scene scene;
    scene.add(kFloor);
    scene.add(sphere({0, 3, -1}, 0.5, lamp(4)));
    scene.add(PointLight{{1, 1, 0}, kWhite});
    scene.add(PointLight{{-1, 1, 1}, kWhite});
    scene.add(SpotLight{{0, 2, 0}, {0, -1, 0}, kWhite, 5, 30});
    scene.add(DirectionalLight{slanted, {0.5, 0.5, 0.5}});
    scene.add(SunLight{{0, -1, 0}, {0.3, 0.3, 0.3}, 5});
    scene.environment = std::make_shared<EnvironmentMap>(Image(4, 2, {0.1, 0.1, 0.1}));
    const CompiledScene compiled = compile(scene);
    CHECK(compiled.stats().lights == 7);
    const double ball = std::sqrt(10.0), d1 = std::sqrt(2.0), d2 = std::sqrt(3.0);
    const double irradiance = 4 * kPi * 0.25 / 10 * (3 / ball) + 1 / (d1 * d1 * d1) + 1 / (d2 * d2 * d2) + 1.0 / 4 -
                              0.5 * slanted.y + 0.3 + 0.1 * kPi;
    check_mean(along(compiled, at_floor(), 2, Estimator::path, 100'000), kReflected * irradiance, 5e-3);
    // Each has a probability, and all together one.
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const Receiver receiver{Point3{} + random.in_cube(5), random.chance(0.5) ? Vec3{} : random.unit()};
        double sum = 0;
        const flat::LightTable& lights = compiled.flat().lights;
        for (std::size_t rank = 0; rank < 8; ++rank) sum += rank < 7 ? probability_of(lights, receiver, rank) : 0;
        CHECK(sum <= 1 + 1e-12);
        if (receiver.normal == Vec3{}) CHECK(sum == Approx(1));
        for (int k = 0; k < 20; ++k)
            if (const auto choice = choose_light(lights, receiver, (k + 0.5) / 20))
                CHECK(choice->probability == Approx(probability_of(lights, receiver, choice->rank)));
    }
}

TEST_CASE("Light sources: media scatter their light once as its integral says", "[render][lights]") {
    // Along z through fog that fills a large ball: sum of density e^(-density t) phase light e^(-density way).
    constexpr double kDensity = 0.2, kRadius = 20;
    const Object fog = std::make_shared<ConstantMedium>(sphere({0, 0, 0}, kRadius, nullptr), kDensity, Color{1, 1, 1});
    const Ray ray{.origin = {0, 0, 4}, .direction = {0, 0, -2}};
    const auto integral = [&](const auto& light_at) {
        double sum = 0;
        constexpr int kSteps = 100'000;
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + 0.5) / kSteps * (4 + kRadius);
            sum += kDensity * std::exp(-kDensity * t) * light_at(Point3{0, 0, 4 - t}) / (4 * kPi);
        }
        return sum * (4 + kRadius) / kSteps;
    };
    const Point3 at{0.3, 0.2, 0};
    const auto of_point = [&](const Point3& p) {
        const double d = length(at - p);
        return std::exp(-kDensity * d) / (d * d);
    };
    check_mean(along(lit_by({PointLight{at}}, {fog}), ray, 2, Estimator::path, 50'000), integral(of_point), 0.02);
    // Along x to the rim of the ball.
    const auto of_direction = [&](const Point3& p) {
        return std::exp(-kDensity * std::sqrt(std::max(0.0, kRadius * kRadius - p.z * p.z)));
    };
    check_mean(along(lit_by({DirectionalLight{{1, 0, 0}}}, {fog}), ray, 2, Estimator::path, 50'000),
               integral(of_direction), 0.02);
}

TEST_CASE("Light sources: impossible ones are refused by their field", "[render][lights]") {
    Scene scene;
    CHECK_THROWS_WITH(scene.add(PointLight{{kInfinity, 0, 0}}), Catch::Contains("PointLight: position"));
    CHECK_THROWS_WITH(scene.add(PointLight{{}, {-1, 0, 0}}), Catch::Contains("PointLight: intensity"));
    CHECK_THROWS_WITH(scene.add(SpotLight{{}, {0, 0, 0}}), Catch::Contains("SpotLight: direction"));
    CHECK_THROWS_WITH(scene.add(SpotLight{{}, {0, 0, 1}, kWhite, 50, 40}), Catch::Contains("inner_cone_angle"));
    CHECK_THROWS_WITH(scene.add(SpotLight{{}, {0, 0, 1}, kWhite, 0, 91}), Catch::Contains("outer_cone_angle"));
    CHECK_THROWS_WITH(scene.add(DirectionalLight{{0, kInfinity, 0}}), Catch::Contains("DirectionalLight: direction"));
    CHECK_THROWS_WITH(scene.add(DirectionalLight{{0, 1, 0}, {kInfinity, 0, 0}}), Catch::Contains("irradiance"));
    CHECK_THROWS_WITH(scene.add(SunLight{{0, 1, 0}, kWhite, 0}), Catch::Contains("SunLight: angular_radius"));
    CHECK(scene.lights().empty());
}

TEST_CASE("Light sources: each number of one changes the digest", "[render][lights]") {
    std::set<Hash128> digests{lit_by({}, {kFloor}).digest()};
    const LightSource all[] = {PointLight{},
                               PointLight{{1, 0, 0}},
                               PointLight{{}, {2, 1, 1}},
                               SpotLight{},
                               SpotLight{{}, {0, 1, 0}},
                               SpotLight{{}, {0, 0, -1}, kWhite, 1},
                               SpotLight{{}, {0, 0, -1}, kWhite, 0, 40},
                               DirectionalLight{},
                               SunLight{},
                               SunLight{{0, -1, 0}, kWhite, 1}};
    for (const LightSource& light : all) CHECK(digests.insert(lit_by({light}, {kFloor}).digest()).second);
    const auto lamp_of = [](Sides sides) {
        return lit_by({}, {sphere({0, 0, 0}, 1, std::make_shared<DiffuseLight>(kWhite, sides))}).digest();
    };
    for (const Sides sides : {Sides::both, Sides::front, Sides::back}) CHECK(digests.insert(lamp_of(sides)).second);
}

TEST_CASE("Light sources: a model's lumens are watts by 683", "[render][lights]") {
    Model model;
    model.lights = {{"", ModelLight::Kind::point, {683, 683, 683}, {0, 2, 0}},
                    {"", ModelLight::Kind::spot, {1366, 1366, 1366}, {0, 2, 0}, {0, -1, 0}, 10, 20},
                    {"", ModelLight::Kind::directional, {683, 683, 683}, {}, {0, -1, 0}}};
    Scene scene;
    scene.add(kFloor);
    scene.add(model);
    CHECK(scene.lights().size() == 3);
    check_mean(along(compile(scene), at_floor(), 2, Estimator::path, 10'000), kReflected * (0.25 + 0.5 + 1), 0.02);
}

TEST_CASE("Lamps: one side shines and the other does not, however it is turned", "[render][lights]") {
    const auto lamp_of = [](Sides sides) { return std::make_shared<DiffuseLight>(kWhite, sides); };
    const auto quad_up = [&](Sides sides) { return quad({-1, 2, 1}, {2, 0, 0}, {0, 0, -2}, lamp_of(sides)); };
    const auto reflected = [](const Object& object) {
        const CompiledScene scene = compile_with(sky(0), {kFloor, object});
        const Measured light = along(scene, at_floor(), 2, Estimator::path, 4000);
        const Measured naive = along(scene, at_floor(), 2, Estimator::naive, 40'000);
        CHECK(std::abs(light.mean - naive.mean) <= 4.5 * std::hypot(light.sigma, naive.sigma));
        return light.mean;
    };
    const double both = reflected(quad_up(Sides::both));
    CHECK(both > 0.05);
    CHECK(reflected(quad_up(Sides::front)) == 0);  // its normal goes up
    CHECK(reflected(quad_up(Sides::back)) == Approx(both));
    const auto mirrored = [&](Sides sides) {
        return std::make_shared<Instance>(quad_up(sides), Transform::scale(-1, 1, 1));
    };
    CHECK(reflected(mirrored(Sides::front)) == 0);
    CHECK(reflected(mirrored(Sides::back)) > 0.05);
    const auto upside_down = [&](Sides sides) {
        return std::make_shared<Instance>(quad_up(sides), Transform::translate({0, 4, 0}) * Transform::scale(1, -1, 1),
                                          Transform::translate({0, 4.01, 0}) * Transform::scale(1, -1, 1));
    };
    CHECK(reflected(upside_down(Sides::front)) > 0.05);
    CHECK(reflected(upside_down(Sides::back)) == 0);
    for (const double radius : {0.5, -0.5}) {
        CHECK(reflected(sphere({0, 2, 0}, radius, lamp_of(radius > 0 ? Sides::front : Sides::back))) > 0.01);
        CHECK(reflected(sphere({0, 2, 0}, radius, lamp_of(radius > 0 ? Sides::back : Sides::front))) == 0);
        CHECK(reflected(sphere({0, 0, 0}, 10 * radius, lamp_of(radius > 0 ? Sides::back : Sides::front))) > 0.5);
    }
    CHECK(reflected(std::make_shared<Disk>(Point3{0, 2, 0}, Vec3{0, -1, 0}, 1.0, lamp_of(Sides::front))) > 0.05);
    CHECK(reflected(std::make_shared<Disk>(Point3{0, 2, 0}, Vec3{0, 1, 0}, 1.0, lamp_of(Sides::front))) == 0);
}

}  // namespace limn::light_sources_test
