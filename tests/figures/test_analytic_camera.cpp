// Blur of the lens and of the shutter, known in closed form.
#include <cmath>
#include <numbers>

#include "catch.h"
#include "support.h"

namespace limn::test_analytic_camera {

using namespace test;

namespace {

std::shared_ptr<const Material> lamp() { return std::make_shared<DiffuseLight>(Color{1, 1, 1}); }

// ---- T4: an emitter in the half-plane x < 0 at depth d, seen through a lens ----------------------------------------

constexpr int kSize = 200;
const Camera kLens{
    .look_from = {0, 0, 0}, .look_at = {0, 0, -1}, .vertical_fov = 20, .aperture_angle = 10, .focus_distance = 3.4};

double circle_of_confusion(double d) {
    return kSize * std::tan(radians(5)) / std::tan(radians(10)) * std::abs(d - 3.4) / d;
}

// The share of a disc of diameter c that lies left of a line at distance s to the right of its centre.
double share_left_of(double s, double c) {
    const double r = c / 2;
    if (std::abs(s) >= r) return s > 0;
    return 0.5 + (s * std::sqrt(r * r - s * s) + r * r * std::asin(s / r)) / (std::numbers::pi * r * r);
}

// Mean brightness of the column of pixels [x, x + 1).
double column_truth(int x, double c) {
    double sum = 0;
    for (int i = 0; i < 100; ++i) sum += share_left_of(kSize / 2.0 - (x + (i + .5) / 100), c);
    return sum / 100;
}

// Where a falling profile of pixel means crosses `level`, interpolated between the centres of pixels.
double crossing(const std::vector<double>& profile, double level) {
    std::size_t x = 0;
    while (profile[x + 1] > level) ++x;
    return static_cast<double>(x) + .5 + (profile[x] - level) / (profile[x] - profile[x + 1]);
}

// ---- T5: an emitting ball that moves one up while the shutter is open ----------------------------------------------

const Camera kSide{.look_from = {0, .5, 10}, .look_at = {0, .5, 0}, .vertical_fov = 20};

CompiledScene rising_ball() {
    return compile(
        scene_of(Background::black(), {std::make_shared<Sphere>(Point3{0, 0, 0}, Point3{0, 1, 0}, .4, lamp())}));
}

}  // namespace

TEST_CASE("T4: the edge of a half-plane out of focus spreads as the lens's disc", "[figures]") {
    struct Row {
        double depth, width_10_90;
    };
    const Row row = GENERATE(Row{2.4, 28.41}, Row{2.9, 11.75}, Row{5, 21.82}, Row{10, 44.99});
    const double c = circle_of_confusion(row.depth);
    CHECK(.687 * c == Approx(row.width_10_90).epsilon(1e-3));  // three digits of .687

    const CompiledScene scene = compile(
        scene_of(Background::black(),
                 {std::make_shared<Quad>(Point3{-1e3, -1e3, -row.depth}, Vec3{1e3, 0, 0}, Vec3{0, 2e3, 0}, lamp())}));
    const int spp = 64;
    const Image image = render(scene, kLens, {.width = kSize, .height = kSize, .samples_per_pixel = spp}).image;
    const double samples = double(kSize) * spp;
    std::vector<double> profile;
    for (int x = 0; x < kSize; ++x) {
        const double seen = profile.emplace_back(mean_over(image, 0, x, 0, x + 1, kSize)), truth = column_truth(x, c);
        const double variance = truth * (1 - truth) / samples;
        CAPTURE(row.depth, x, seen, truth);
        if (variance == 0) CHECK(seen == truth);
        if (variance * samples * samples > 20)
            CHECK(std::abs(seen - truth) < kSigmas * std::sqrt(variance));  // else not normal
    }
    // The slope where the profile crosses 10 % and 90 % is .925 / c. The filter of one pixel widens the spread by less
    // than .05 pixel: it adds 1/12 to a variance of (c / 4)^2.
    const double noise = kSigmas * std::sqrt(2 * .1 * .9 / samples) * c / .925;
    CHECK(std::abs(crossing(profile, .1) - crossing(profile, .9) - row.width_10_90) < noise + .05);
}

TEST_CASE("T5: a ball that moves while the shutter is open shines where it is, as long as it is there", "[figures]") {
    const CompiledScene scene = rising_ball();
    const std::vector<double> heights{-.6, -.45, -.3, -.1, 0, .3, .5, .7, 1, 1.2, 1.35, 1.45, 1.6};
    for (const double y : heights) {
        // A sight line that meets the axis at y, at an angle, is in the ball while |y - centre| <= .4 / cos(angle).
        const double reach = .4 * std::hypot(1, (y - .5) / 10);
        const double truth = std::max(0.0, std::min(1.0, y + reach) - std::max(0.0, y - reach));
        const Radiance seen = radiance(scene, kSide.look_from, {0, y, 0}, {.samples_per_pixel = 500});
        CAPTURE(y, seen.r.mean, seen.r.error, truth);
        CHECK(agrees(seen.r, truth));
    }
}

TEST_CASE("T5: the streak of the moving ball holds as much light as the ball at rest", "[figures]") {
    // Solid angle does not change when the ball moves across by +-.5 at distance 10, up to the cosines of the frame;
    // these are in the integral: the outline is an ellipse of area pi a b on the plane at distance 1.
    double area = 0;
    for (int i = 0; i < 1000; ++i) {
        const double offset = (i + .5) / 1000 - .5, s2 = .16 / (100 + offset * offset);
        const double c2 = 100 / (100 + offset * offset);
        area += std::numbers::pi * s2 * std::sqrt(1 - s2) / std::pow(c2 - s2, 1.5) / 1000;
    }
    const double truth = area * std::pow(200 / std::tan(radians(10)), 2);
    CHECK(truth == Approx(6477).epsilon(1e-3));
    const auto images = replicates(rising_ball(), kSide, {.samples_per_pixel = 1});
    const Estimate sum = measure(images, [](const Image& image) { return 160000 * mean_over(image, 0); });
    CAPTURE(sum.mean, sum.error, truth);
    CHECK(agrees(sum, truth));
}

}  // namespace limn::test_analytic_camera
