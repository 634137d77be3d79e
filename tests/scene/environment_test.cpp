// Environment maps and skies as they are described.
#include "limn/scene/environment.h"

#include <limits>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/sky.h"
#include "support/random_geometry.h"

namespace limn::environment_test {

using namespace test;

namespace {

// Red counts columns, green rows.
Image numbered(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.set(x, y, {static_cast<double>(x), static_cast<double>(y), 1});
    return image;
}

bool near(const Color& a, const Color& b) { return length(Vec3{a.r - b.r, a.g - b.g, a.b - b.b}) < 1e-6; }

}  // namespace

TEST_CASE("Environment: the middle of the map is -z, its upper edge +y, and +x to the right", "[scene][environment]") {
    const EnvironmentMap map(numbered(8, 4));
    CHECK(near(map.radiance({0, 0, -1}), {3.5, 1.5, 1}));
    CHECK(near(map.radiance({5, 0, 0}), {5.5, 1.5, 1}));
    CHECK(near(map.radiance({-1e-9, 0, 0}), {1.5, 1.5, 1}));
    CHECK(near(map.radiance({0, 0, 1e300}), {3.5, 1.5, 1}));  // the seam: between columns 7 and 0
    CHECK(map.radiance({0, 1, 0}).g == 0);
    CHECK(map.radiance({0, -1, 0}).g == 3);
    // The centre of the pixel in column 6, row 1.
    const double turn = 2 * kPi * (6.5 / 8 - 0.5), down = kPi * 1.5 / 4;
    CHECK(near(map.radiance({std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)}),
               {6, 1, 1}));
}

TEST_CASE("Environment: it is turned, mirrored and scaled", "[scene][environment]") {
    const auto image = std::make_shared<const Image>(numbered(16, 8));
    const EnvironmentMap plain(image);
    Random random(3);
    for (const Transform& m : {Transform::rotate_y(30), Transform::rotate({1, 2, 3}, 77), Transform::scale(-1, 1, 1)}) {
        const EnvironmentMap turned(image, m, 0.5);
        for (int i = 0; i < 100; ++i) {
            const Vec3 d = random.unit();
            CHECK(near(turned.radiance(transform_vector(m, d)), 0.5 * plain.radiance(d)));
        }
    }
}

TEST_CASE("Environment: what cannot be is refused by its name", "[scene][environment]") {
    const float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    for (const auto& [value, word] : {std::pair{kNan, "not a number"}, {-1e-30f, "negative"}, {kInf, "infinite"}}) {
        Image image(5, 3, {1, 1, 1});
        image.values()[3 * (1 * 5 + 4) + 2] = value;
        CHECK_THROWS_WITH(EnvironmentMap(image), Catch::Contains("column 4, row 1") && Catch::Contains(word));
    }
    CHECK_THROWS_AS(EnvironmentMap(Image{}), ArgumentError);
    CHECK_THROWS_AS(EnvironmentMap(std::shared_ptr<const Image>{}), ArgumentError);
    const Image image(2, 1);
    for (const Transform& m : {Transform::scale(2, 2, 2), Transform::translate({1, 0, 0}), Transform::scale(1, 1, 0)})
        CHECK_THROWS_WITH(EnvironmentMap(image, m), Catch::Contains("world_from_map"));
    for (const double scale : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_WITH(EnvironmentMap(image, {}, scale), Catch::Contains("scale"));
}

TEST_CASE("Environment: a single pixel is the same in all directions", "[scene][environment]") {
    const EnvironmentMap map(Image(1, 1, {0.25, 0.5, 2}));
    Random random(4);
    for (int i = 0; i < 100; ++i) CHECK(map.radiance(random.unit()) == Color{0.25, 0.5, 2});
}

TEST_CASE("Sky: the zenith has the luminance of the model, and the brightest of the map is at the Sun",
          "[scene][environment]") {
    const Vec3 to_sun = normalize({0.3, 0.8, -0.5});
    const Sky sky = make_sky({.to_sun = to_sun, .turbidity = 4, .scale = 683, .height = 512});
    // Zenith luminance in kcd / m^2: (4.0453 T - 4.9710) tan((4/9 - T/120)(pi - 2 s)) - 0.2155 T + 2.4192.
    const double s = std::acos(to_sun.y);
    const double zenith = (4.0453 * 4 - 4.9710) * std::tan((4.0 / 9 - 4.0 / 120) * (kPi - 2 * s)) - 0.2155 * 4 + 2.4192;
    CHECK(luminance(sky.environment->radiance({0, 1, 0})) == Approx(1000 * zenith).epsilon(0.01));
    Random random(5);
    const double at_sun = luminance(sky.environment->radiance(to_sun));
    for (int i = 0; i < 1000; ++i) {
        Vec3 d = random.unit();
        d.y = std::abs(d.y);
        if (d.y > 0.3) CHECK(luminance(sky.environment->radiance(d)) <= 1.01 * at_sun);
    }
    const Color zenith_color = sky.environment->radiance({0, 1, 0});
    CHECK(zenith_color.b > zenith_color.r);
    CHECK(sky.sun.irradiance.r > sky.sun.irradiance.b);
    CHECK(length(sky.sun.direction + to_sun) < 1e-12);
    // A plane under the noon's Sun gets some 100 klx.
    const double irradiance = luminance(make_sky({.to_sun = {0, 1, 0}, .scale = 683}).sun.irradiance);
    CHECK(irradiance > 80e3);
    CHECK(irradiance < 128e3);
    const double low = luminance(make_sky({.to_sun = {1, 0.05, 0}, .scale = 683}).sun.irradiance);
    CHECK(low < 0.2 * irradiance);
}

TEST_CASE("Sky: what cannot be is refused by its name", "[scene][environment]") {
    CHECK_THROWS_WITH(make_sky({.to_sun = {1, 0, 0}}), Catch::Contains("to_sun"));
    CHECK_THROWS_WITH(make_sky({.to_sun = {0, 0, 0}}), Catch::Contains("to_sun"));
    CHECK_THROWS_WITH(make_sky({.turbidity = 1}), Catch::Contains("turbidity"));
    CHECK_THROWS_WITH(make_sky({.ground = {2, 0, 0}}), Catch::Contains("ground"));
    CHECK_THROWS_WITH(make_sky({.scale = -1}), Catch::Contains("scale"));
    CHECK_THROWS_WITH(make_sky({.height = 1}), Catch::Contains("height"));
}

}  // namespace limn::environment_test
