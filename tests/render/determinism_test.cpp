// Pixels depend on scene, camera and settings alone, and different seeds, pixels and samples are independent.
#include "catch.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/texture/perlin.h"
#include "render/path.h"
#include "support/pictures.h"

namespace limn::determinism_test {

using namespace test;

namespace {

// A little of everything.
CompiledScene busy_scene() {
    const Object ball = sphere({0, 0, 0}, 1, std::make_shared<Dielectric>(1.5));
    return compile_with(Background::gradient({1, 1, 1}, {0.5, 0.7, 1}),
                        {sphere({0, -1000, 0}, 1000, std::make_shared<Lambertian>(std::make_shared<Marble>(4.0, 7))),
                         std::make_shared<Instance>(ball, Transform::translate({0, 1, 0}),
                                                    Transform::translate({0, 1.5, 0}) * Transform::rotate_x(20)),
                         sphere({-2, 1, 0}, 1, std::make_shared<Metal>(Color{0.8, 0.6, 0.2}, 0.3)),
                         std::make_shared<Mesh>(icosphere(1, 1, {2, 1, 0}), grey(0.7)),
                         quad({-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, lamp(5)),
                         std::make_shared<ConstantMedium>(sphere({0, 1, 2}, 0.8, grey(1)), 1, Color{0.5, 0.8, 0.9}),
                         std::make_shared<Stranger>(sphere({1, 0.4, 2}, 0.4, grey(0.3)))});
}

const Camera kView = camera_at({0, 2, 8}, {0, 1, 0}, 40);

RenderSettings settings_of(std::uint64_t seed, int threads) {
    RenderSettings s = square(37, 9, 8);
    s.height = 29;
    s.seed = seed;
    s.threads = threads;
    return s;
}

// A sky seen through fog that scatters one half away, for good: every sample is a coin, every pixel the mean of
// `samples` of them.
std::vector<double> coins(std::uint64_t seed, int side, int samples) {
    static const CompiledScene scene = compile_with(
        sky(1),
        {std::make_shared<ConstantMedium>(make_box({-9, -9, 0}, {9, 9, 1}, grey(1)), std::log(2.0), Color{1, 1, 1})});
    RenderSettings s = square(side, samples, 1);
    s.seed = seed;
    const Image image = render(scene, camera_at({0, 0, 1000}, {0, 0, 0}, 1e-3), s).image;
    std::vector<double> values;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) values.push_back(image.at(x, y).r);
    return values;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sa += a[i], sb += b[i], saa += a[i] * a[i], sbb += b[i] * b[i], sab += a[i] * b[i];
    return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

std::vector<double> shifted(const std::vector<double>& a, std::size_t by) {
    std::vector<double> b(a.begin() + static_cast<std::ptrdiff_t>(by), a.end());
    b.insert(b.end(), a.begin(), a.begin() + static_cast<std::ptrdiff_t>(by));
    return b;
}

}  // namespace

TEST_CASE("Determinism: a path is the same alone and among any number of others", "[render][determinism]") {
    const CompiledScene scene = busy_scene();
    const CameraRays camera(kView, 40, 40);
    // Paths first, first + 1, ...
    const auto traced = [&](transport::PathTracer& tracer, std::size_t first, std::size_t count) {
        std::vector<transport::Path> paths;
        for (std::size_t i = first; i < first + count; ++i) {
            const double x = static_cast<double>(i % 40) + 0.3, y = static_cast<double>(i / 40) + 0.6;
            tracer.camera_rays().set_ray(paths.size(), camera.ray(x, y, 0, 0, 0.4));
            paths.push_back({transport::Sampler(3, i, 1)});
        }
        tracer.trace(paths);
        return paths;
    };
    std::vector<Color> alone;
    for (std::size_t i = 0; i < 1600; ++i) {
        transport::PathTracer tracer(scene.flat(), 8, Estimator::path);
        alone.push_back(traced(tracer, i, 1)[0].radiance);
    }
    for (const std::size_t together : {std::size_t{2}, std::size_t{17}, std::size_t{300}, sampling::kBatch}) {
        transport::PathTracer tracer(scene.flat(), 8, Estimator::path);
        std::size_t differing = 0;
        for (std::size_t first = 0; first < alone.size(); first += together) {
            const auto paths = traced(tracer, first, std::min(together, alone.size() - first));
            for (std::size_t i = 0; i < paths.size(); ++i) differing += paths[i].radiance != alone[first + i];
        }
        CHECK(differing == 0);
    }
}

TEST_CASE("Determinism: the pixels are the same on 1, 2, 3 and 7 threads, in every run", "[render][determinism]") {
    const CompiledScene scene = busy_scene();
    const RenderResult once = render(scene, kView, settings_of(5, 1));
    for (const int threads : {1, 2, 3, 7, 0}) {
        const RenderResult again = render(scene, kView, settings_of(5, threads));
        CHECK(again.image == once.image);
        CHECK(again.error.estimate == once.error.estimate);
        CHECK(again.error.max_sample_share == once.error.max_sample_share);
        CHECK(again.report.rays == once.report.rays);
        CHECK(again.report.threads >= 1);
        if (threads > 0) CHECK(again.report.threads == threads);
    }
    CHECK(render(busy_scene(), kView, settings_of(5, 2)).image == once.image);  // compiled anew
}

TEST_CASE("Determinism: watching the progress changes no pixel", "[render][determinism]") {
    const CompiledScene scene = busy_scene();
    RenderSettings watched = settings_of(5, 2);
    watched.progress = [](const Progress&) { return true; };
    CHECK(render(scene, kView, watched).image == render(scene, kView, settings_of(5, 2)).image);
}

TEST_CASE("Determinism: another seed gives another picture", "[render][determinism]") {
    const CompiledScene scene = busy_scene();
    const Image first = render(scene, kView, settings_of(1, 2)).image;
    for (const std::uint64_t seed :
         {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{1} << 32, std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
        const Image other = render(scene, kView, settings_of(seed, 2)).image;
        int equal = 0;
        for (int y = 0; y < first.height(); ++y)
            for (int x = 0; x < first.width(); ++x) equal += first.at(x, y) == other.at(x, y);
        CHECK(equal < first.width() * first.height() / 20);
    }
}

TEST_CASE("Independence: the mean of n samples has one n-th of the variance", "[render][determinism]") {
    const int side = 128;
    for (const int samples : {1, 2, 4, 16, 64}) {
        const std::vector<double> values = coins(11, side, samples);
        double sum = 0, squares = 0;
        for (const double v : values) sum += v, squares += v * v;
        const double n = side * side, average = sum / n, variance = squares / n - average * average;
        const double expected = 0.25 / samples;
        INFO(samples << " samples");
        CHECK(std::abs(average - 0.5) <= 4.5 * std::sqrt(expected / n));
        // At most so (stratified samples may do better), within 4.5 standard errors of a variance, sqrt(2 / n).
        CHECK(variance <= expected * (1 + 4.5 * std::sqrt(2 / n)));
        if (samples == 1) CHECK(variance >= expected * (1 - 4.5 * std::sqrt(2 / n)));
    }
}

TEST_CASE("Independence: neighbouring pixels, seeds and samples are not correlated", "[render][determinism]") {
    const int side = 128;
    const double bound = 4.5 / side;  // 4.5 / sqrt(number of pixels)
    const std::vector<double> a = coins(20, side, 1);
    for (const std::size_t by : {1u, 2u, 3u, 8u, 16u, 17u, 127u, 128u, 129u, 256u, 2048u}) {
        INFO("pixels " << by << " apart");
        CHECK(std::abs(correlation(a, shifted(a, by))) <= bound);
    }
    for (const std::uint64_t seed : {std::uint64_t{21}, std::uint64_t{22}, std::uint64_t{84},
                                     std::uint64_t{20} + (std::uint64_t{1} << 32), ~std::uint64_t{20}}) {
        const std::vector<double> b = coins(seed, side, 1);
        INFO("seeds 20 and " << seed);
        CHECK(std::abs(correlation(a, b)) <= bound);
        CHECK(std::abs(correlation(a, shifted(b, 1))) <= bound);
        CHECK(std::abs(correlation(shifted(a, 1), b)) <= bound);
        CHECK(std::abs(correlation(a, shifted(b, 128))) <= bound);
    }
    // The second sample alone: two of two, less the first.
    std::vector<double> second = coins(20, side, 2);
    for (std::size_t i = 0; i < second.size(); ++i) second[i] = 2 * second[i] - a[i];
    CHECK(std::abs(correlation(a, second)) <= bound);
    CHECK(std::abs(correlation(a, shifted(second, 1))) <= bound);
    CHECK(std::abs(correlation(shifted(a, 1), second)) <= bound);
    CHECK(std::abs(correlation(coins(21, side, 1), second)) <= bound);
}

}  // namespace limn::determinism_test
