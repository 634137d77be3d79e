#include "limn/scene/texture/image_texture.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "bsdf/image_lookup.h"
#include "catch.h"
#include "limn/math/error.h"
#include "limn/math/math.h"
#include "property.h"

namespace limn::image_texture_test {

using pattern::lookup_image;

namespace {

const double kNaN = std::nan("");
constexpr Filter kFilters[] = {Filter::nearest, Filter::bilinear};
constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror};

// Texel (x, y) says where it is; all values are exact in float32.
Image numbered(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.set(x, y, {static_cast<double>(x), static_cast<double>(y), 1});
    return image;
}

Uv center(const Image& image, int x, int y) { return {(x + 0.5) / image.width(), 1 - (y + 0.5) / image.height()}; }

// Up to 5 x 5 texels.
Image random_image(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Image image(1 + static_cast<int>(random() % 5), 1 + static_cast<int>(random() % 5));
    for (float& v : image.values()) v = static_cast<float>(random() % 1000) / 1000;
    return image;
}

// In [-2, 2), multiples of 2^-20.
Uv random_uv(std::mt19937_64& random) {
    const auto next = [&] { return std::ldexp(static_cast<double>(random() % (1 << 22)), -20) - 2; };
    const double u = next();
    return {u, next()};
}

double column(const Image& image, double u, Wrap wrap) {
    return lookup_image(image, {u, 0.5}, Filter::nearest, wrap).r;
}

}  // namespace

TEST_CASE("Image look-up: a texel's centre gives the texel, whatever the filter and size", "[texture][image]") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 5), std::pair(7, 2), std::pair(1, 65536),
                                        std::pair(65536, 1), std::pair(1000, 3)}) {
        const Image image = numbered(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (const Filter filter : kFilters)
                    for (const Wrap wrap : kWraps)
                        if (lookup_image(image, center(image, x, y), filter, wrap) != image.at(x, y))
                            FAIL(width << 'x' << height << ": texel " << x << ' ' << y);
    }
}

TEST_CASE("Image look-up: the corners of the unit square are the corners of the image", "[texture][image]") {
    const Image image = numbered(4, 3);
    for (const Wrap wrap : kWraps) {
        const auto at = [&](double u, double v) { return lookup_image(image, {u, v}, Filter::nearest, wrap); };
        CHECK(at(0, 0) == image.at(0, 2));
        CHECK(at(-0.0, -0.0) == image.at(0, 2));
        CHECK(at(1, 0) == image.at(3, 2));
        CHECK(at(0, 1) == image.at(0, 0));
        CHECK(at(1, 1) == image.at(3, 0));
        CHECK(at(1 - 0x1p-24, 0x1p-24) == image.at(3, 2));
    }
}

TEST_CASE("Image look-up: nearest changes where the next texel begins", "[texture][image]") {
    const Image image = numbered(4, 4);
    CHECK(lookup_image(image, {std::nextafter(.25, 0), .9}, Filter::nearest, Wrap::clamp).r == 0);
    CHECK(lookup_image(image, {.25, .9}, Filter::nearest, Wrap::clamp).r == 1);
    CHECK(lookup_image(image, {.1, std::nextafter(.75, 1)}, Filter::nearest, Wrap::clamp).g == 0);
    CHECK(lookup_image(image, {.1, .75}, Filter::nearest, Wrap::clamp).g == 1);
}

TEST_CASE("Image look-up: beyond the unit square the image repeats, stays or is mirrored", "[texture][image]") {
    const Image image = numbered(4, 1);
    CHECK(column(image, 1.3, Wrap::repeat) == 1);
    CHECK(column(image, -0.1, Wrap::repeat) == 3);
    CHECK(column(image, -7.9, Wrap::repeat) == 0);
    CHECK(column(image, 1.3, Wrap::clamp) == 3);
    CHECK(column(image, -0.1, Wrap::clamp) == 0);
    CHECK(column(image, 1.3, Wrap::mirror) == 2);
    CHECK(column(image, -0.1, Wrap::mirror) == 0);
    CHECK(column(image, -1.1, Wrap::mirror) == 3);
    CHECK(column(image, 2.3, Wrap::mirror) == 1);
    CHECK(column(image, 3.9, Wrap::mirror) == 0);
    const Image tall = numbered(1, 4);
    CHECK(lookup_image(tall, {0, 1.1}, Filter::nearest, Wrap::repeat).g == 3);
    CHECK(lookup_image(tall, {0, 1.1}, Filter::nearest, Wrap::mirror).g == 0);
    CHECK(lookup_image(tall, {0, -0.1}, Filter::nearest, Wrap::clamp).g == 3);
}

TEST_CASE("Image look-up: bilinear is linear between centres", "[texture][image]") {
    const Image image = numbered(4, 4);
    const Color c = lookup_image(image, {0.5, 0.4375}, Filter::bilinear, Wrap::clamp);  // x 1.5, y 1.75
    CHECK(c.r == 1.5);
    CHECK(c.g == 1.75);
    CHECK(c.b == 1);
}

TEST_CASE("Image look-up: bilinear is continuous across the seam", "[texture][image]") {
    const Image image = numbered(4, 1);
    const auto at = [&](double u, Wrap wrap) { return lookup_image(image, {u, .5}, Filter::bilinear, wrap).r; };
    CHECK(at(0, Wrap::repeat) == 1.5);  // halfway between the first and the last
    CHECK(at(1, Wrap::repeat) == 1.5);
    CHECK(at(2, Wrap::repeat) == 1.5);
    CHECK(at(0, Wrap::clamp) == 0);
    CHECK(at(1, Wrap::clamp) == 3);
    CHECK(at(1, Wrap::mirror) == 3);
    CHECK(at(0x1p-40, Wrap::repeat) == Approx(at(-0x1p-40, Wrap::repeat)).epsilon(1e-10));
}

TEST_CASE("Image look-up: no coordinate reads outside the image", "[texture][image]") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 2), std::pair(1, 65536)}) {
        const Image image = numbered(width, height);
        for (const double u : {0.0, -0.0, 1.0, 1 - 0x1p-24, 1 - 0x1p-53, -1e-30, 1 + 0x1p-52, 1e30, -1e30, 1e308, kNaN,
                               kInfinity, -kInfinity})
            for (const Filter filter : kFilters)
                for (const Wrap wrap : kWraps) {
                    const Color c = lookup_image(image, {u, u}, filter, wrap);
                    CAPTURE(width, height, u);
                    CHECK(c.b == 1);
                    CHECK((c.r >= 0 && c.r <= width - 1 && c.g >= 0 && c.g <= height - 1));
                }
    }
}

TEST_CASE("Image look-up: NaN reads as 0", "[texture][image]") {
    const Image image = numbered(3, 3);
    for (const Filter filter : kFilters)
        for (const Wrap wrap : kWraps) {
            const Color at_zero = lookup_image(image, {0, 0}, filter, wrap);
            CHECK(lookup_image(image, {kNaN, kNaN}, filter, wrap) == at_zero);
        }
}

TEST_CASE("Image look-up: nothing is darker or brighter than the texels, and nearest gives one of them",
          "[texture][image]") {
    test::holds([](std::uint64_t seed) {
        const Image image = random_image(seed);
        std::mt19937_64 random(seed);
        const Uv uv = random_uv(random);
        float least = 1, most = 0;
        for (const float v : image.values()) least = std::min(least, v), most = std::max(most, v);
        for (const Wrap wrap : kWraps) {
            const Color blend = lookup_image(image, uv, Filter::bilinear, wrap);
            for (const double v : {blend.r, blend.g, blend.b})
                RC_ASSERT(v >= least * (1 - gamma(8)) && v <= most * (1 + gamma(8)));
            const Color one = lookup_image(image, uv, Filter::nearest, wrap);
            bool found = false;
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x) found = found || image.at(x, y) == one;
            RC_ASSERT(found);
        }
    });
}

TEST_CASE("Image look-up: repeat has period 1, mirror period 2 and is even, in u and in v", "[texture][image]") {
    test::holds([](std::uint64_t seed, std::int8_t i, std::int8_t j) {
        const Image image = random_image(seed);
        std::mt19937_64 random(seed);
        const Uv uv = random_uv(random);  // a multiple of 2^-20, so that every sum here is exact
        for (const Filter filter : kFilters) {
            const auto at = [&](double u, double v, Wrap wrap) { return lookup_image(image, {u, v}, filter, wrap); };
            if (uv.u != std::floor(uv.u) && uv.v != std::floor(uv.v))  // a whole number may be either border
                RC_ASSERT(at(uv.u + i, uv.v + j, Wrap::repeat) == at(uv.u, uv.v, Wrap::repeat));
            RC_ASSERT(at(uv.u + 2 * i, uv.v + 2 * j, Wrap::mirror) == at(uv.u, uv.v, Wrap::mirror));
            RC_ASSERT(at(-uv.u, uv.v, Wrap::mirror) == at(uv.u, uv.v, Wrap::mirror));
            RC_ASSERT(at(uv.u, -uv.v, Wrap::mirror) == at(uv.u, uv.v, Wrap::mirror));
            RC_ASSERT(at(uv.u, uv.v, Wrap::clamp) ==
                          at(std::clamp(uv.u, 0.0, 1.0), std::clamp(uv.v, 0.0, 1.0), Wrap::repeat) ||
                      filter == Filter::bilinear);
        }
    });
}

TEST_CASE("ImageTexture: reads at the surface's texture coordinates with its own options", "[texture][image]") {
    const auto image = std::make_shared<const Image>(numbered(4, 4));
    Surface s;
    s.uv = {1.3, .9};
    for (const Filter filter : kFilters)
        for (const Wrap wrap : kWraps)
            CHECK(ImageTexture(image, {filter, wrap}).value(s) == lookup_image(*image, s.uv, filter, wrap));
    CHECK(ImageTexture(*image).value(s) == lookup_image(*image, s.uv, Filter::bilinear, Wrap::repeat));
}

TEST_CASE("ImageTexture: an empty image is refused", "[texture][image]") {
    CHECK_THROWS_AS(ImageTexture(Image()), ArgumentError);
    CHECK_THROWS_AS(ImageTexture(std::shared_ptr<const Image>()), ArgumentError);
}

}  // namespace limn::image_texture_test
