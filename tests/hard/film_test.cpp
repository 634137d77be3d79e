// The film at a hundred million samples, and pictures that no number of threads changes.
#include "limn/render/film.h"

#include "hard/hard.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/texture/perlin.h"
#include "support/pictures.h"

namespace limn::film_test {

using namespace test;

namespace {

constexpr double kTenth = static_cast<double>(0.1F);

// Adds samples 0 to count - 1 to a pixel; its mean against theirs, summed in whole multiples of 2^-30.
template <class Sample>
void check_mean_of(double count, const Sample& sample) {
    Film film(1, 1);
    std::int64_t sum = 0;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        const double value = std::nearbyint(sample(i) * 0x1p30) * 0x1p-30;
        film.add(0, 0, {value, 2 * value, value / 4});
        sum += static_cast<std::int64_t>(value * 0x1p30);
    }
    const double truth = static_cast<double>(sum) * 0x1p-30 / count;
    CAPTURE(count, truth);
    const Color mean = film.image().at(0, 0);  // float32
    CHECK(std::abs(mean.r / truth - 1) <= 1e-6);
    CHECK(std::abs(mean.g / (2 * truth) - 1) <= 1e-6);
    CHECK(std::abs(mean.b / (truth / 4) - 1) <= 1e-6);
}

std::vector<CompiledScene> scenes() {
    const auto list = [](const std::vector<Object>& objects) {
        return compile_with(Background::gradient({1, 1, 1}, {0.5, 0.7, 1}), objects);
    };
    const MaterialPtr glass = std::make_shared<Dielectric>(1.5),
                      gold = std::make_shared<Metal>(Color{0.8, 0.6, 0.2}, 0.3),
                      marble = std::make_shared<Lambertian>(std::make_shared<Marble>(4.0, 7));
    const Object ground = sphere({0, -1000, 0}, 1000, marble),
                 mesh = std::make_shared<Mesh>(icosphere(2, 1, {0, 1, 0}), gold);
    const Object moving = std::make_shared<Sphere>(Point3{0, 1, 0}, Point3{0, 1.5, 0}, 0.6, glass);
    const Object fog = std::make_shared<ConstantMedium>(ball({0, 1, 0}, 2), 0.7, Color{0.5, 0.8, 0.9});
    std::vector<CompiledScene> all;
    all.push_back(list({ground, sphere({0, 1, 0}, 1, glass)}));
    all.push_back(list({ground, mesh}));
    all.push_back(
        list({ground, moving,
              std::make_shared<Instance>(mesh, Transform::translate({2, 0, 0}), Transform::translate({2, 1, 0}))}));
    all.push_back(list({ground, fog, sphere({0, 1, 0}, 0.5, gold), quad({-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, lamp(5))}));
    all.push_back(list({std::make_shared<Stranger>(ground), make_box({-2, 0, -2}, {2, 3, 2}, grey(0.9)),
                        std::make_shared<ConstantMedium>(mesh, 1, Color{1, 1, 1}),
                        quad({-1, 2.9, -1}, {2, 0, 0}, {0, 0, 2}, lamp(5))}));
    return all;
}

}  // namespace

TEST_CASE("Film: means of 1e6, 1.7e7 and 1e8 samples are right to 1e-6", "[hard][film]") {
    for (const double samples : {1e6, 1.7e7, 1e8}) {
        if (samples > 1e6 && count(samples) < samples / 10) continue;  // seconds each
        check_mean_of(samples, [](std::uint32_t) { return kTenth; });
        Random random(76);
        check_mean_of(samples, [&](std::uint32_t) { return random.uniform(); });
        check_mean_of(samples, [&](std::uint32_t) { return random.chance(1e-4) ? 1000 : kTenth; });
    }
}

TEST_CASE(
    "Pictures: the same bits on 1, 2, 3, 7 and 16 threads, in two runs, of every width from below a tile to above",
    "[hard][film]") {
    int differing = 0;
    for (const CompiledScene& scene : scenes())
        for (const auto& [width, height] : {std::pair{1, 64}, {8, 8}, {17, 17}, {64, 5}, {33, 16}}) {
            RenderSettings settings = square(1, 5, 6);
            settings.width = width, settings.height = height, settings.seed = 77;
            const Camera camera = camera_at({0, 2, 7}, {0, 1, 0}, 40);
            settings.threads = 1;
            const RenderResult once = render(scene, camera, settings);
            for (const int threads : {1, 2, 3, 7, 16}) {
                settings.threads = threads;
                const RenderResult again = render(scene, camera, settings);
                differing += !(again.image == once.image && again.report.rays == once.report.rays &&
                               again.error.max_sample_share == once.error.max_sample_share);
            }
        }
    CHECK(differing == 0);
}

}  // namespace limn::film_test
