// What a render says of its own error.
#include <algorithm>
#include <cstdlib>

#include "catch.h"
#include "limn/image/compare.h"
#include "support/pictures.h"

namespace limn::estimate_test {

using namespace test;

namespace {

struct Subject {
    const char* name;
    CompiledScene scene;
    Camera camera;
    Image truth;
};

// Sky through a ball of smoke: pixels from bright to dark, and the truth of each is known to the quadrature's error.
Subject smoke_ball(int side, double albedo = 0) {
    const Camera camera = camera_at({0, 0, 10}, {0, 0, 0}, 12);
    CompiledScene scene = compile_with(
        sky(1), {std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 1, grey(1)), 0.75, Color{albedo, albedo, albedo})});
    Image truth(side, side);
    const CameraRays rays(camera, side, side);
    const int grid = 16;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            double sum = 0;
            for (int j = 0; j < grid; ++j) {
                for (int i = 0; i < grid; ++i) {
                    const Vec3 d = normalize(rays.ray(x + (i + 0.5) / grid, y + (j + 0.5) / grid, 0, 0, 0).direction);
                    const double b2 = 100 - std::pow(dot(Vec3{0, 0, -10}, d), 2);
                    sum += std::exp(-1.5 * std::sqrt(std::max(0.0, 1 - b2)));
                }
            }
            const double mean_of_pixel = sum / (grid * grid);
            truth.set(x, y, {mean_of_pixel, mean_of_pixel, mean_of_pixel});
        }
    }
    return {"smoke", std::move(scene), camera, std::move(truth)};
}

// A lamp-lit floor by scattering alone: rare bright samples. The truth is a long render by light sampling.
Subject lit_floor(int side) {
    CompiledScene scene = compile_with(sky(0), {quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, grey(0.7)),
                                                quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, lamp(8))});
    const Camera camera = camera_at({0, 2, 6}, {0, 0, 0}, 35);
    Image truth = render(scene, camera, square(side, 1024, 2)).image;
    return {"floor", std::move(scene), camera, std::move(truth)};
}

}  // namespace

TEST_CASE("Error estimate: over 20 seeds it is near the true relMSE, and does not miss it from below",
          "[render][estimate]") {
    const int side = 40;
    const Subject subjects[] = {smoke_ball(side), lit_floor(side)};
    for (const Subject& s : subjects) {
        for (const int samples : {16, 64}) {
            double estimates = 0, errors = 0;
            int covered = 0;
            for (std::uint64_t seed = 0; seed < 20; ++seed) {
                RenderSettings settings = square(side, samples, 2, Estimator::naive);
                settings.seed = seed;
                const RenderResult r = render(s.scene, s.camera, settings);
                const double error = compare_images(r.image, s.truth).relative_mse;
                estimates += r.error.estimate;
                errors += error;
                covered += error <= r.error.ci95_high;
                CHECK(r.error.reason.empty());
                CHECK(r.error.ci95_low <= r.error.estimate);
                CHECK(r.error.estimate <= r.error.ci95_high);
                CHECK(r.error.ci95_low >= 0);
            }
            INFO(s.name << ", " << samples << " samples: estimated " << estimates / 20 << ", true " << errors / 20);
            CHECK(estimates >= 0.8 * errors);
            CHECK(estimates <= 1.2 * errors);
            CHECK(covered >= 16);
        }
    }
}

TEST_CASE("Error estimate: four times as many independent samples give a quarter of it", "[render][estimate]") {
    const Subject s = smoke_ball(32);
    double last = 0;
    for (const int samples : {64, 256}) {
        double sum = 0;
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            RenderSettings settings = square(32, samples, 1);
            settings.sampler = SamplerKind::independent;
            settings.seed = seed;
            sum += render(s.scene, s.camera, settings).error.estimate;
        }
        if (last > 0) CHECK(last / sum == Approx(4).epsilon(0.15));
        last = sum;
    }
}

TEST_CASE("Error estimate: a picture without noise has none", "[render][estimate]") {
    const RenderResult r = render(compile_with(sky(0.7), {sphere({0, 0, 0}, 1, grey(0.5))}),
                                  camera_at({0, 0, 5}, {0, 0, 0}, 5), square(8, 16, 10));
    CHECK(r.error.estimate == Approx(0).margin(1e-12));
    CHECK(r.error.ci95_high == Approx(0).margin(1e-12));
    CHECK(r.error.max_sample_share == Approx(1.0 / 16).epsilon(1e-6));
    const RenderResult black = render(compile_with(sky(0), {}), camera_at({0, 0, 5}, {0, 0, 0}, 5), square(8, 16, 10));
    CHECK(black.error.estimate == 0);
    CHECK(black.error.max_sample_share == 0);
}

TEST_CASE("Error estimate: below eight samples a pixel there is none, and a reason says so", "[render][estimate]") {
    const Subject s = smoke_ball(8);
    for (const int samples : {1, 2, 7}) {
        const RenderResult r = render(s.scene, s.camera, square(8, samples, 1));
        CHECK(std::isnan(r.error.estimate));
        CHECK(std::isnan(r.error.ci95_low));
        CHECK(std::isnan(r.error.ci95_high));
        CHECK_FALSE(r.error.reason.empty());
    }
    const RenderResult eight = render(s.scene, s.camera, square(8, 8, 1));
    CHECK(std::isfinite(eight.error.estimate));
    CHECK(eight.error.reason.empty());
}

TEST_CASE("Error estimate: the largest share of a sample tells of rare bright light", "[render][estimate]") {
    // A tiny lamp found by chance alone: the one sample that hits it is all that its pixel has.
    const CompiledScene rare =
        compile_with(sky(0), {quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, grey(0.7)), sphere({0, 3, 0}, 0.1, lamp(1e4))});
    const Camera camera = camera_at({0, 2, 6}, {0, 0, 0}, 35);
    const RenderResult naive = render(rare, camera, square(32, 64, 2, Estimator::naive));
    const RenderResult path = render(rare, camera, square(32, 64, 2));
    CHECK(naive.error.max_sample_share > 0.9);
    CHECK(naive.error.max_sample_share <= 1);
    CHECK(path.error.max_sample_share < 0.1);
}

TEST_CASE("Error estimate: a render to an error keeps its promise 95 times in 100, and takes little more than it must",
          "[render][estimate]") {
    const int side = 24, stops = std::getenv("LIMN_FULL") ? 2000 : 30;
    const Subject subject = smoke_ball(side, 1);  // seen by paths of one segment: each is a coin
    for (const auto& [sampler, target] : {std::pair{SamplerKind::sobol, 6e-4}, {SamplerKind::independent, 8e-3}}) {
        int kept = 0;
        std::vector<double> margins;
        for (int seed = 0; seed < stops; ++seed) {
            RenderSettings settings = square(side, 1, 1);
            settings.error = target;
            settings.seed = static_cast<std::uint64_t>(seed);
            settings.sampler = sampler;
            const RenderResult r = render(subject.scene, subject.camera, settings);
            REQUIRE(r.report.samples_per_pixel > 8);
            const double error = compare_images(r.image, subject.truth).relative_mse;
            kept += error <= target;
            margins.push_back(target / error);
        }
        CAPTURE(kept);
        CHECK(kept >= stops * 0.95 - 4.5 * std::sqrt(stops * 0.95 * 0.05));
        // 576 pixels, whose noise is worth 340 equal ones, know their error to 24 %, at 95 %; checks are 3 % apart.
        // Even points make this scene's error fall in steps, at powers of two.
        if (sampler == SamplerKind::sobol) continue;
        std::nth_element(margins.begin(), margins.begin() + stops / 2, margins.end());
        CHECK(margins[static_cast<std::size_t>(stops / 2)] <= 1.35);
    }
}

}  // namespace limn::estimate_test
