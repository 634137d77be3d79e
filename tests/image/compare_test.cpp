#include "limn/image/compare.h"

#include <cmath>
#include <limits>
#include <random>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/math/math.h"
#include "property.h"

namespace limn::compare_test {

namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// Two pixels; one value, the green of the right one, is off.
Image reference_pair() {
    Image image(2, 1, Color{0.5, 0.5, 0.5});
    image.set(1, 0, Color{0.5, 2, 0});
    return image;
}

Image test_pair() {
    Image image = reference_pair();
    image.set(1, 0, Color{0.5, 1, 0});
    return image;
}

// 5 x 4 values of 64 between 0 and 1.
Image random_image(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Image image(5, 4);
    for (float& v : image.values()) v = static_cast<float>(random() % 64 + 1) / 65;
    return image;
}

Image doubled(Image image) {
    for (float& v : image.values()) v *= 2;
    return image;
}

}  // namespace

TEST_CASE("compare: one value that is off by 1 gives the metrics computed by hand", "[image][compare]") {
    const ImageMetrics m = compare_images(test_pair(), reference_pair());
    CHECK(m.relative_mse == Approx(1.0 / 4.01 / 6).epsilon(1e-14));
    CHECK(m.mse == Approx(1.0 / 6).epsilon(1e-14));
    CHECK(m.smape == Approx(2.0 / 3 / 6).epsilon(1e-14));
    CHECK(m.psnr_srgb == std::numeric_limits<double>::infinity());  // 1 and 2 are both white
    CHECK(m.largest_relative == Approx(1 / std::sqrt(4.01)).epsilon(1e-14));
    CHECK(m.largest_x == 1);
    CHECK(m.largest_y == 0);
    CHECK(m.worst_share == 1);
    CHECK(m.valid);
    CHECK_FALSE(m.has_reference_error);
}

TEST_CASE("compare: PSNR is that of the sRGB-encoded values", "[image][compare]") {
    const Image black(4, 4), white(4, 4, Color{1, 1, 1}),
        grey(4, 4, Color{0.21404114048223255, 0.21404114048223255, 0.21404114048223255});
    CHECK(compare_images(black, white).psnr_srgb == Approx(0).margin(1e-12));
    CHECK(compare_images(grey, black).psnr_srgb == Approx(-20 * std::log10(0.5)).epsilon(1e-6));
    CHECK(compare_images(Image(1, 1, Color{-3, 0, 0}), Image(1, 1)).psnr_srgb ==
          std::numeric_limits<double>::infinity());
}

TEST_CASE("compare: equal images have no error, and no worst part of it", "[image][compare]") {
    const ImageMetrics m = compare_images(test_pair(), test_pair());
    CHECK(m.relative_mse == 0);
    CHECK(m.mse == 0);
    CHECK(m.smape == 0);
    CHECK(m.psnr_srgb == std::numeric_limits<double>::infinity());
    CHECK(m.largest_relative == 0);
    CHECK(std::isnan(m.worst_share));
    CHECK(m.valid);
}

TEST_CASE("compare: the worst 0.1 % are a thousandth of all values, the largest errors among them",
          "[image][compare]") {
    // 3000 values; two are far off by 10 and 20, one by 30, the other 2997 by 1; black reference. The worst 3 carry
    // 100 + 400 + 900 of 1400 + 2997.
    Image test(1000, 1, Color{1, 1, 1});
    test.set(7, 0, Color{10, 1, 1});
    test.set(500, 0, Color{1, 30, 1});
    test.set(999, 0, Color{1, 1, 20});
    const ImageMetrics m = compare_images(test, Image(1000, 1));
    CHECK(m.worst_share == Approx(1400.0 / 4397).epsilon(1e-13));
    CHECK(m.largest_x == 500);
    CHECK(m.relative_mse == Approx(4397 / 0.01 / 3000).epsilon(1e-13));
}

TEST_CASE("compare: one value that is not finite, on either side, makes every metric invalid and is counted",
          "[image][compare]") {
    const float bad = GENERATE(as<float>{}, kNaN, kInf, -kInf);
    Image spoilt(5, 3, Color{1, 1, 1});
    spoilt.values()[3 * (5 * 2 + 4) + 1] = bad;
    const Image good(5, 3, Color{2, 2, 2});
    for (const bool in_test : {true, false}) {
        const ImageMetrics m = in_test ? compare_images(spoilt, good) : compare_images(good, spoilt);
        CHECK_FALSE(m.valid);
        CHECK(m.nonfinite_test == (in_test ? 1 : 0));
        CHECK(m.nonfinite_reference == (in_test ? 0 : 1));
        for (const double metric : {m.relative_mse, m.mse, m.smape, m.psnr_srgb, m.largest_relative, m.worst_share})
            CHECK(std::isnan(metric));
        CHECK(m.largest_x == 4);
        CHECK(m.largest_y == 2);
    }
}

TEST_CASE("compare: of several values that are not finite all are counted, and the first one is named",
          "[image][compare]") {
    Image spoilt(5, 3, Color{1, 1, 1}), reference(5, 3, Color{2, 2, 2});
    spoilt.set(1, 0, Color{1000, 1, 1});  // the largest finite error comes before
    spoilt.set(3, 1, Color{1, kNaN, kInf});
    spoilt.set(0, 2, Color{kNaN, 1, 1});
    reference.set(2, 2, Color{1, 1, kNaN});
    const ImageMetrics m = compare_images(spoilt, reference);
    CHECK(m.nonfinite_test == 3);
    CHECK(m.nonfinite_reference == 1);
    CHECK((m.largest_x == 3 && m.largest_y == 1));
}

TEST_CASE("compare: the same infinity on both sides is no agreement", "[image][compare]") {
    Image a(1, 1);
    a.values()[0] = kInf;
    const ImageMetrics m = compare_images(a, a);
    CHECK_FALSE(m.valid);
    CHECK(m.nonfinite_test == 1);
    CHECK(m.nonfinite_reference == 1);
}

TEST_CASE("compare: two halves of a reference give its own error, which is subtracted", "[image][compare]") {
    // Mean 1, half difference 0.25, test 2: relMSE (1)^2 / 1.01, reference's 0.0625 / 1.01.
    const Image test(2, 2, Color{2, 2, 2}), a(2, 2, Color{0.75, 0.75, 0.75}), b(2, 2, Color{1.25, 1.25, 1.25});
    const ImageMetrics m = compare_images(test, a, b);
    CHECK(m.has_reference_error);
    CHECK(m.relative_mse == Approx(1 / 1.01).epsilon(1e-14));
    CHECK(m.reference_relative_mse == Approx(0.0625 / 1.01).epsilon(1e-14));
    CHECK(m.corrected_relative_mse == Approx(0.9375 / 1.01).epsilon(1e-14));
    CHECK_FALSE(m.reference_too_noisy);
}

TEST_CASE("compare: a reference whose own error is over a tenth of what is measured is flagged", "[image][compare]") {
    const Image test(1, 1, Color{2, 2, 2});
    const auto noisy = [&test](double half_difference) {
        const double lo = 1 - half_difference, hi = 1 + half_difference;
        return compare_images(test, Image(1, 1, Color{lo, lo, lo}), Image(1, 1, Color{hi, hi, hi})).reference_too_noisy;
    };
    CHECK_FALSE(noisy(0.31));  // 0.31^2 < 0.1
    CHECK(noisy(0.32));
}

TEST_CASE("compare: a spoilt half of a reference spoils what is said of the reference too", "[image][compare]") {
    const Image test(2, 1, Color{2, 2, 2}), good(2, 1, Color{1, 1, 1});
    Image bad = good;
    bad.values()[5] = kNaN;
    for (const ImageMetrics& m : {compare_images(test, bad, good), compare_images(test, good, bad)}) {
        CHECK_FALSE(m.valid);
        CHECK(m.nonfinite_reference == 1);
        CHECK(std::isnan(m.relative_mse));
        CHECK(std::isnan(m.reference_relative_mse));
        CHECK(std::isnan(m.corrected_relative_mse));
        CHECK_FALSE(m.reference_too_noisy);
        CHECK(m.largest_x == 1);
    }
}

TEST_CASE("compare: mse, SMAPE and PSNR are symmetric, an image has no distance from itself", "[image][compare]") {
    test::holds([](std::uint64_t seed) {
        const Image a = random_image(seed), b = random_image(seed + 1);
        const ImageMetrics ab = compare_images(a, b), ba = compare_images(b, a), aa = compare_images(a, a);
        RC_ASSERT(ab.mse > 0 && ab.mse == ba.mse && ab.smape == ba.smape && ab.psnr_srgb == ba.psnr_srgb);
        RC_ASSERT(ab.smape <= 2 && ab.worst_share > 0 && ab.worst_share <= 1);
        RC_ASSERT(aa.relative_mse == 0 && aa.mse == 0 && aa.smape == 0 && aa.largest_relative == 0);
    });
}

TEST_CASE("compare: twice the values give four times the mse, the same SMAPE, and a relMSE nearer to scale-free",
          "[image][compare]") {
    test::holds([](std::uint64_t seed) {
        const Image a = random_image(seed), b = random_image(seed + 1);
        const ImageMetrics once = compare_images(a, b), twice = compare_images(doubled(a), doubled(b));
        RC_ASSERT(twice.mse == 4 * once.mse);
        RC_ASSERT(twice.smape == once.smape);
        // The 0.01 beside the squared reference counts for less.
        RC_ASSERT(twice.relative_mse > once.relative_mse && twice.relative_mse < 4 * once.relative_mse);
    });
}

TEST_CASE("compare: the halves of a reference may be swapped, and their mean is what is compared with",
          "[image][compare]") {
    test::holds([](std::uint64_t seed) {
        const Image test = random_image(seed), a = random_image(seed + 1), b = random_image(seed + 2);
        Image mean = a;
        for (std::size_t i = 0; i < mean.values().size(); ++i) mean.values()[i] = (a.values()[i] + b.values()[i]) / 2;
        const ImageMetrics ab = compare_images(test, a, b), ba = compare_images(test, b, a);
        RC_ASSERT(ab.relative_mse == ba.relative_mse && ab.reference_relative_mse == ba.reference_relative_mse);
        // The mean is rounded to float32 here, and not there.
        const double by_mean = compare_images(test, mean).relative_mse;
        RC_ASSERT(std::abs(ab.relative_mse - by_mean) <= 1e-5 * by_mean);
    });
}

TEST_CASE("compare: images of different sizes and empty ones are refused", "[image][compare]") {
    CHECK_THROWS_AS(compare_images(Image(2, 3), Image(3, 2)), ArgumentError);
    CHECK_THROWS_AS(compare_images(Image(2, 3), Image(2, 3), Image(2, 2)), ArgumentError);
    CHECK_THROWS_AS(compare_images(Image(2, 3), Image(2, 2), Image(2, 3)), ArgumentError);
    CHECK_THROWS_AS(compare_images(Image(), Image()), ArgumentError);
}

TEST_CASE("compare: sums are in double, so a million small errors are not lost beside a large one",
          "[image][compare]") {
    Image test(1000, 1000, Color{0.1, 0.1, 0.1});
    test.set(0, 0, Color{1e6, 0.1, 0.1});
    const double off = 0.1f;
    const double expected = (1e12 + 2'999'999 * off * off) / 3e6;
    // The bound on any order of summation; in float the small ones' share of 3e-8 would be lost.
    CHECK(compare_images(test, Image(1000, 1000)).mse == Approx(expected).epsilon(gamma(3'000'000)));
}

}  // namespace limn::compare_test
