// One sphere in front of a camera, where the picture is known in closed form.
#include <cmath>
#include <numbers>

#include "catch.h"
#include "scene_parts.h"
#include "support.h"

namespace limn::test_analytic_sphere {

using namespace test;

namespace {

const Camera kCamera{.look_from = {0, 0, 10}, .vertical_fov = 20};
const Background kWhite = Background::constant({1, 1, 1});

std::shared_ptr<const Hittable> unit_sphere(std::shared_ptr<const Material> material) {
    return std::make_shared<Sphere>(Point3{0, 0, 0}, 1.0, std::move(material));
}

CompiledScene lone_sphere(const Background& background, std::shared_ptr<const Material> material) {
    return compile(scene_of(background, {unit_sphere(std::move(material))}));
}

CompiledScene emitter() { return lone_sphere(Background::black(), std::make_shared<DiffuseLight>(Color{1, 1, 1})); }

// Of the outline in a picture of `size` pixels: the tangent cone from distance 10 has sine 1/10.
double outline_radius(int size) { return size / 2.0 * std::tan(std::asin(0.1)) / std::tan(radians(10)); }

double distance_from_centre(int size, double x, double y) { return std::hypot(x - size / 2.0, y - size / 2.0); }

// Pixels without anti-aliasing: `on` where the centre of the pixel lies in the outline, `off` elsewhere.
void check_disc(const CompiledScene& scene, const Color& on, const Color& off) {
    const int size = 100;
    const Image image =
        render(scene, kCamera, {.width = size, .height = size, .samples_per_pixel = 16, .antialias = false}).image;
    int wrong = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const bool inside = distance_from_centre(size, x + .5, y + .5) < outline_radius(size);
            wrong += !same_float(image.at(x, y), inside ? on : off);
        }
    CHECK(wrong == 0);
}

// Share of pixel (x, y) that the outline covers, by the midpoint rule over 1000 lines, each exact.
double coverage(int size, int x, int y) {
    const double r = outline_radius(size);
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
        const double v = y + (i + .5) / 1000 - size / 2.0;
        if (std::abs(v) >= r) continue;
        const double half = std::sqrt(r * r - v * v), u = x - size / 2.0;
        sum += std::max(0.0, std::min(u + 1, half) - std::max(u, -half));
    }
    return sum / 1000;
}

}  // namespace

TEST_CASE("T1: under a white sky a lone sphere shows exactly its albedo", "[figures]") {
    const Color albedo{.3, .5, .7};
    check_disc(lone_sphere(kWhite, figures::matte(albedo)), albedo, {1, 1, 1});
    check_disc(lone_sphere(kWhite, std::make_shared<Metal>(albedo)), albedo, {1, 1, 1});
    check_disc(lone_sphere(kWhite, std::make_shared<Dielectric>(1.5, Fresnel::schlick)), {1, 1, 1}, {1, 1, 1});
}

TEST_CASE("T1: hollow glass under a white sky loses only what the depth limit cuts off", "[figures]") {
    const auto glass = std::make_shared<Dielectric>(1.5, Fresnel::schlick);
    const CompiledScene scene = compile(scene_of(kWhite, {std::make_shared<Sphere>(Point3{0, 0, 0}, .5, glass),
                                                          std::make_shared<Sphere>(Point3{0, 0, 0}, -.4, glass)}));
    Camera camera = kCamera;
    camera.vertical_fov = 10;
    const auto images = replicates(scene, camera, {.width = 100, .height = 100, .samples_per_pixel = 8});
    const Estimate mean = measure(images, [](const Image& image) { return mean_over(image, 0); });
    CAPTURE(mean.mean, mean.error);
    CHECK(agrees(mean, .99936, 5e-6));
}

TEST_CASE("T2: without anti-aliasing an emitter on black is a disc of ones, whatever the seed", "[figures]") {
    RenderSettings settings{.width = 400, .height = 400, .samples_per_pixel = 1, .antialias = false};
    const Image image = render(emitter(), kCamera, settings).image;
    settings.seed = 99;
    CHECK(render(emitter(), kCamera, settings).image == image);
    int ones = 0, wrong = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const Color expected =
                distance_from_centre(400, x + .5, y + .5) < outline_radius(400) ? Color{1, 1, 1} : Color{};
            ones += expected.r == 1;
            wrong += image.at(x, y) != expected;
        }
    CHECK(outline_radius(400) == Approx(113.997).margin(5e-4));
    CHECK(wrong == 0);
    CHECK(std::abs(ones - 40860) <= 60);
}

TEST_CASE("T2: the box filter gives each pixel the share of it that is covered", "[figures]") {
    const int spp = 128;
    const Image image = render(emitter(), kCamera, {.width = 400, .height = 400, .samples_per_pixel = spp}).image;
    int partial = 0, wrong = 0, between = 0;
    double squares = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const double value = image.at(x, y).r;
            between += value > 0 && value < 1;
            double nearest =
                std::hypot(std::clamp(200.0, double(x), x + 1.0) - 200, std::clamp(200.0, double(y), y + 1.0) - 200);
            double farthest = std::hypot(std::max(std::abs(x - 200.0), std::abs(x - 199.0)),
                                         std::max(std::abs(y - 200.0), std::abs(y - 199.0)));
            if (nearest >= outline_radius(400)) {
                wrong += value != 0;
            } else if (farthest <= outline_radius(400)) {
                wrong += value != 1;
            } else if (const double p = coverage(400, x, y); p > 0.05 && p < 0.95) {
                ++partial;
                squares += (value - p) * (value - p) / (p * (1 - p) / spp);
            }
        }
    CHECK(wrong == 0);
    // A circle of radius r crosses at most 8 r pixels.
    CHECK(between <= 8 * outline_radius(400));
    CHECK(partial > 600);
    // Independent samples have mean 1 and standard deviation sqrt(2 / partial); stratified ones have less.
    CHECK(squares / partial < 1 + kSigmas * std::sqrt(2.0 / partial));
    CHECK(squares > 0);
}

TEST_CASE("T2: the mean of the picture is the share of the frame that the emitter covers", "[figures]") {
    const double truth = std::numbers::pi * std::pow(outline_radius(400) / 400, 2);
    CHECK(truth == Approx(0.2551627).margin(5e-8));
    const auto images = replicates(emitter(), kCamera, {.samples_per_pixel = 2}, 16);
    const Estimate mean = measure(images, [](const Image& image) { return mean_over(image, 0); });
    CAPTURE(mean.mean, mean.error);
    CHECK(agrees(mean, truth));
}

TEST_CASE("T3: an absorbing medium lets exp(-density length) through", "[figures]") {
    const auto medium = std::make_shared<ConstantMedium>(unit_sphere(figures::matte({})), 1.0, Color{});
    const CompiledScene scene = compile(scene_of(kWhite, {medium}));
    for (const double x : {0.0, 0.3, 0.6, 0.9, 0.99}) {
        const double impact = 10 * x / std::hypot(10, x);
        const Radiance seen = radiance(scene, {0, 0, 10}, {x, 0, 0}, {.samples_per_pixel = 4000});
        CAPTURE(x, seen.g.mean, seen.g.error);
        // What is absorbed is not left to chance: only the picture's float rounds.
        const double truth = std::exp(-2 * std::sqrt(1 - impact * impact));
        CHECK(agrees(seen.g, truth, 1e-7 * truth));
    }
    const auto images = replicates(scene, kCamera, {.width = 200, .height = 200, .samples_per_pixel = 4});
    const Estimate mean = measure(images, [](const Image& image) { return mean_over(image, 1); });
    CAPTURE(mean.mean, mean.error);
    CHECK(agrees(mean, .820832, 5e-7));
    const double disc = 0.2551627;
    CHECK(agrees({1 - (1 - mean.mean) / disc, mean.error / disc}, .29783, 5e-6));
}

TEST_CASE("T8: a medium absorbs the same alone, in a list, and in a Bvh of one to four objects", "[figures]") {
    std::vector<std::shared_ptr<const Hittable>> objects{
        std::make_shared<ConstantMedium>(unit_sphere(figures::matte({})), 1.0, Color{})};
    const auto check = [](const std::shared_ptr<const Hittable>& object) {
        const CompiledScene scene = compile(scene_of(kWhite, {object}));
        const Radiance seen = radiance(scene, {0, 0, 10}, {0, 0, 0}, {.samples_per_pixel = 2000});
        CAPTURE(seen.r.mean, seen.r.error);
        CHECK(agrees(seen.r, std::exp(-2.0), 1e-7));
    };
    check(objects[0]);
    for (int count = 1; count <= 4; ++count) {
        check(std::make_shared<Bvh>(objects));
        check(std::make_shared<HittableList>(objects));
        objects.push_back(std::make_shared<Sphere>(Point3{5.0 * count, 0, 0}, 1.0, figures::matte({.5, .5, .5})));
    }
}

}  // namespace limn::test_analytic_sphere
