#include "limn/scene/background.h"

#include "catch.h"
#include "support/random_geometry.h"

namespace limn::background_test {

using limn::test::Random;

TEST_CASE("Background: black is black and a constant is the same in every direction, to the bit",
          "[scene][background]") {
    Random random(90);
    const Color sky{0.7, 0.8, 1};
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.log_uniform(1e-100, 1e100) * random.unit();
        CHECK(is_black(Background::black().radiance(d)));
        CHECK(Background::constant(sky).radiance(d) == sky);
    }
    CHECK(is_black(Background{}.radiance({0, 1, 0})));
}

TEST_CASE("Background: a gradient is (1 - a) bottom + a top with a = (y + 1) / 2 of the unit direction",
          "[scene][background]") {
    const Color bottom{1, 1, 1}, top{0.5, 0.7, 1};
    const Background sky = Background::gradient(bottom, top);
    CHECK(sky.radiance({0, -3, 0}) == bottom);
    CHECK(sky.radiance({0, 1e-3, 0}) == top);
    CHECK(sky.radiance({5, 0, -1}).r == Approx(0.75));
    Random random(91);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 unit = random.unit();
        const Color c = sky.radiance(random.log_uniform(1e-100, 1e100) * unit);
        const double a = (unit.y + 1) / 2;
        CHECK(c.r == Approx(1 - 0.5 * a));
        CHECK(c.g == Approx(1 - 0.3 * a));
        CHECK(c.b == Approx(1));
    }
}

}  // namespace limn::background_test
