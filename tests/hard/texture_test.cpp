// Textures wherever they are asked.
#include <bit>

#include "bsdf/checker.h"
#include "bsdf/image_lookup.h"
#include "bsdf/perlin.h"
#include "hard/hard.h"
#include "limn/math/color.h"
#include "support/random_geometry.h"
#include "support/real.h"

namespace limn::texture_test {

using namespace test;

namespace {

// A finite number of any magnitude, or a whole one, or one beside it.
double any_number(Random& random) {
    const double x = random.sign() * std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.index(2098)) - 1073);
    const double near = random.uniform(-1e6, 1e6), whole = std::floor(near);
    switch (random.index(5)) {
        case 0: return near;
        case 1: return whole;
        case 2: return std::nextafter(whole, random.sign() * kInfinity);
        case 3: return std::floor(x);
        default: return x;
    }
}

Point3 any_point(Random& random) {
    const double x = any_number(random), y = any_number(random);
    return {x, y, any_number(random)};
}

// Fowler, Noll and Vo's hash of 64 bits, of the numbers' bits.
struct Digest {
    std::uint64_t value = 0xcbf29ce484222325;
    void add(double x) {
        for (auto bits = std::bit_cast<std::uint64_t>(x); const int shift : {0, 8, 16, 24, 32, 40, 48, 56})
            value = (value ^ ((bits >> shift) & 0xff)) * 0x100000001b3;
    }
};

}  // namespace

TEST_CASE("Checker: its parity is that of the exact floor, for every double", "[hard][texture]") {
    CHECK_FALSE(pattern::is_odd_cell(0x1p53));
    CHECK(pattern::is_odd_cell(0x1p53 - 1));
    CHECK_FALSE(pattern::is_odd_cell(1e20));
    for (const double x : {0.0, 5e-324, 0x1p31 + 0.5}) CHECK_FALSE(pattern::is_odd_cell(x));
    for (const double x : {-5e-324, -1e-30, -1.0}) CHECK(pattern::is_odd_cell(x));
    CHECK_FALSE(pattern::is_odd_cell(-1 - 0x1p-52));
    Random random(72);
    int wrong = 0;
    for (int i = 0; i < count(1e8); ++i) {
        const double x = any_number(random);
        // Floor by whole numbers of 64 bits, where they hold it.
        bool odd = false;
        if (std::abs(x) < 0x1p53) {
            auto whole = static_cast<std::int64_t>(x);
            if (static_cast<double>(whole) > x) --whole;
            odd = (whole & 1) != 0;
        }
        wrong += pattern::is_odd_cell(x) != odd;
    }
    CHECK(wrong == 0);
}

TEST_CASE("Image look-up: what is read lies in the image, wherever it is asked, down to 1 x 1 and along 1 x 65536",
          "[hard][texture]") {
    Random random(73);
    int wrong = 0;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 65536}, {65536, 1}, {3, 5}}) {
        Image image(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) image.set(x, y, {static_cast<double>(x), static_cast<double>(y), 1});
        for (int i = 0; i < count(4e6); ++i) {
            const Uv uv{any_number(random), random.chance(0.1) ? std::nan("") : any_number(random)};
            for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
                for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
                    const Color c = pattern::lookup_image(image, uv, filter, wrap);
                    wrong += !(c.b == 1 && c.r >= 0 && c.r <= width - 1 && c.g >= 0 && c.g <= height - 1);
                }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("Perlin noise: between -1 and 1 near and far, 0 at the lattice, finite for every double", "[hard][texture]") {
    Random random(75);
    const PerlinLattice lattice = PerlinLattice::from_seed(75);
    int wrong = 0;
    double largest = 0;
    for (int i = 0; i < count(1e7); ++i) {
        const Point3 near = Point3{} + random.in_cube(1e6), anywhere = any_point(random);
        largest = std::max(largest, std::abs(pattern::noise(lattice, near)));
        const Point3 whole{std::floor(anywhere.x), std::floor(anywhere.y), std::floor(anywhere.z)};
        wrong += pattern::noise(lattice, whole) != 0;
        wrong += !(std::abs(pattern::noise(lattice, anywhere)) <= 1);
        const double turbulence = pattern::turbulence(lattice, anywhere),
                     marble = pattern::marble(lattice, 3, anywhere);
        wrong += !(turbulence >= 0 && turbulence < 2 && marble >= 0 && marble <= 1);
    }
    CHECK(wrong == 0);
    CHECK(largest <= std::sqrt(0.75) + 1e-15);
}

TEST_CASE("Perlin noise: a seed gives the same bits with every compiler", "[hard][texture]") {
    // Products, sums and floors alone: IEEE 754 decides every bit.
    Digest digest;
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{7}, ~std::uint64_t{0}}) {
        const PerlinLattice lattice = PerlinLattice::from_seed(seed);
        for (const Vec3& g : lattice.gradients) digest.add(g.x), digest.add(g.y), digest.add(g.z);
        for (int i = 0; i < 10'000; ++i) {
            const Point3 p{0.37 * i - 900, 1e-3 * i * i, 1e4 / (i + 1)};
            digest.add(pattern::noise(lattice, p));
            digest.add(pattern::turbulence(lattice, p));
        }
    }
    CHECK(digest.value == 0x968f22d126c351b);
}

TEST_CASE("sRGB: of every float between two stored values the nearer one is stored", "[hard][texture]") {
    // The 8 bits of a linear float are those whose own encoded value is nearest.
    int wrong = 0;
    for (int i = 0; i < 256; ++i) wrong += std::floor(255 * srgb_encode(srgb_decode(i / 255.0)) + 0.5) != i;
    for (int i = 0; i < 255; ++i) {
        const double border = srgb_decode((i + 0.5) / 255);
        const auto stored = [](double linear) { return std::floor(255 * srgb_encode(linear) + 0.5); };
        wrong += stored(border * (1 - 1e-6)) != i;
        wrong += stored(border * (1 + 1e-6)) != i + 1;
    }
    CHECK(wrong == 0);
}

}  // namespace limn::texture_test
