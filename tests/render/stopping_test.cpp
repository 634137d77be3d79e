// What ends a render: samples, error, time.
#include "catch.h"
#include "limn/image/compare.h"
#include "limn/math/error.h"
#include "support/pictures.h"

namespace limn::stopping_test {

using namespace test;

namespace {

const Camera kEye = camera_at({0, 2, 6}, {0, 0, 0}, 35);

CompiledScene lit_floor() {
    return compile_with(sky(0),
                        {quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, grey(0.7)), sphere({0, 0.5, 0}, 0.5, grey(0.3)),
                         quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, lamp(8))});
}

RenderSettings to_error(double error, int side = 24) {
    RenderSettings s = square(side, 1, 3, Estimator::naive);
    s.error = error;
    return s;
}

}  // namespace

TEST_CASE("Stopping: a render to an error ends at the first check whose interval is under it", "[render][stopping]") {
    const CompiledScene scene = lit_floor();
    RenderSettings settings = to_error(0.05);
    settings.uniform = true;
    const RenderResult r = render(scene, kEye, settings);
    CHECK(r.report.stopped_by == StoppedBy::error);
    CHECK((r.report.complete && r.error.reached));
    CHECK(r.error.target == 0.05);
    CHECK(r.error.ci95_high <= 0.05);
    CHECK(r.error.ci95_high >= 0.05 / 1.3);
    const int samples = static_cast<int>(r.report.samples_per_pixel);
    CHECK((samples == r.report.samples_per_pixel && samples > 8 && samples % 2 == 0));
    // The same samples asked for by number are the same picture.
    RenderSettings counted = square(24, samples, 3, Estimator::naive);
    const RenderResult again = render(scene, kEye, counted);
    CHECK(again.image == r.image);
    CHECK(again.error.ci95_high == r.error.ci95_high);
    CHECK_FALSE(again.error.target.has_value());
    CHECK_FALSE(again.error.reached);
    CHECK(again.report.stopped_by == StoppedBy::samples);
}

TEST_CASE("Stopping: when an error is reached does not depend on threads", "[render][stopping]") {
    const CompiledScene scene = lit_floor();
    RenderSettings settings = to_error(0.08, 33);
    settings.sampler = GENERATE(SamplerKind::sobol, SamplerKind::independent);
    settings.threads = 1;
    const RenderResult once = render(scene, kEye, settings);
    for (const int threads : {2, 3, 7}) {
        settings.threads = threads;
        const RenderResult again = render(scene, kEye, settings);
        CHECK(again.image == once.image);
        CHECK(again.error.estimate == once.error.estimate);
        CHECK(again.error.ci95_high == once.error.ci95_high);
        CHECK(again.maps.error == once.maps.error);
    }
}

TEST_CASE("Stopping: nothing is believed before 8 samples, and an easy target is met there", "[render][stopping]") {
    const RenderResult r = render(lit_floor(), kEye, to_error(1e6));
    CHECK(r.report.samples_per_pixel == 8);
    CHECK(r.error.reached);
    const RenderResult black = render(compile_with(sky(0), {}), kEye, to_error(1e-12));
    CHECK(black.report.samples_per_pixel == 8);
    CHECK((black.error.reached && black.error.ci95_high == 0));
}

TEST_CASE("Stopping: the most samples end a render that has not reached its error", "[render][stopping]") {
    RenderSettings settings = to_error(1e-9);
    for (const int most : {3, 8, 9, 64, 150}) {
        settings.max_samples_per_pixel = most;
        const RenderResult r = render(lit_floor(), kEye, settings);
        CHECK(r.report.samples_per_pixel == most);
        CHECK(r.report.stopped_by == StoppedBy::samples);
        CHECK((r.report.complete && !r.error.reached));
    }
}

TEST_CASE("Stopping: a time limit ends a render soon after it, with an estimate, and is no interruption",
          "[render][stopping]") {
    RenderSettings settings = square(32, 1, 3);
    for (const double limit : {1e-9, 0.1}) {
        settings.time_limit = limit;
        settings.max_samples_per_pixel = 1 << 14;  // would take seconds
        const RenderResult r = render(lit_floor(), kEye, settings);
        CHECK(r.report.stopped_by == StoppedBy::time);
        CHECK(r.report.complete);
        CHECK(r.report.render_seconds >= limit);
        CHECK(r.report.render_seconds < 20);
        CHECK(r.report.samples_per_pixel >= 8);
        CHECK(std::isfinite(r.error.ci95_high));
        CHECK_FALSE(r.error.target.has_value());
        if (limit < 1e-6) CHECK(r.report.samples_per_pixel == 8);
    }
}

TEST_CASE("Stopping: of an error and a time the first to come ends the render", "[render][stopping]") {
    RenderSettings settings = to_error(1e6);
    settings.time_limit = 1000;
    CHECK(render(lit_floor(), kEye, settings).report.stopped_by == StoppedBy::error);
    settings.error = 1e-9;
    settings.time_limit = 0.05;
    const RenderResult r = render(lit_floor(), kEye, settings);
    CHECK(r.report.stopped_by == StoppedBy::time);
    CHECK((r.error.target == 1e-9 && !r.error.reached));
}

TEST_CASE("Stopping: the fraction never falls, and is 1 at the end and only there", "[render][stopping]") {
    for (const bool by_time : {false, true}) {
        RenderSettings settings = to_error(0.03);
        if (by_time) settings.error.reset(), settings.time_limit = 0.2;
        settings.threads = 2;
        std::vector<double> fractions;
        settings.progress = [&](const Progress& p) {
            fractions.push_back(p.fraction);
            return true;
        };
        render(lit_floor(), kEye, settings);
        REQUIRE(fractions.size() >= 2);
        CHECK(fractions.front() == 0);
        CHECK(fractions.back() == 1);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
    }
}

TEST_CASE("Stopping: a callback that says no is an interruption, whatever was asked for", "[render][stopping]") {
    RenderSettings settings = to_error(1e-9, 64);
    settings.progress = [](const Progress& p) { return p.seconds < 0.1; };
    const RenderResult r = render(lit_floor(), kEye, settings);
    CHECK(r.report.stopped_by == StoppedBy::callback);
    CHECK_FALSE(r.report.complete);
    CHECK((r.error.target == 1e-9 && !r.error.reached));
}

TEST_CASE("Stopping: impossible targets and limits are refused by name", "[render][stopping]") {
    const CompiledScene scene = compile_with(sky(1), {});
    for (const double bad : {0.0, -1.0, std::nan(""), double{kInfinity}}) {
        RenderSettings s = square(4, 4, 4);
        s.error = bad;
        CHECK_THROWS_WITH(render(scene, kEye, s), Catch::Contains("error"));
        s = square(4, 4, 4);
        s.time_limit = bad;
        CHECK_THROWS_WITH(render(scene, kEye, s), Catch::Contains("time limit"));
        CHECK_THROWS_AS(render(scene, kEye, s), ArgumentError);
    }
    RenderSettings s = to_error(1);
    s.max_samples_per_pixel = 0;
    CHECK_THROWS_WITH(render(scene, kEye, s), Catch::Contains("samples"));
}

TEST_CASE("Samplers: both converge to the same picture, Sobol points sooner", "[render][sampler]") {
    const CompiledScene scene = lit_floor();
    RenderSettings settings = square(32, 256, 3);
    const RenderResult sobol = render(scene, kEye, settings);
    settings.sampler = SamplerKind::independent;
    const RenderResult independent = render(scene, kEye, settings);
    CHECK(sobol.error.estimate < independent.error.estimate / 2);
    // They differ by both errors, which are chi-square with at least as many degrees of freedom as pixels.
    const double apart = compare_images(independent.image, sobol.image).relative_mse;
    const double expected = sobol.error.estimate + independent.error.estimate;
    CHECK(std::abs(apart / expected - 1) <= 4.5 * std::sqrt(8.0 / 3 / (32 * 32)) + 0.02);
}

}  // namespace limn::stopping_test
