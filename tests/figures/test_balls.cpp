// Figures 1 to 5: what stands where, exact colours, the box filter.
#include <cmath>
#include <map>
#include <numbers>

#include "catch.h"
#include "figure_data.h"
#include "scene_parts.h"
#include "support.h"

namespace limn::test_balls {

using namespace test;

namespace {

const Color kSky = figures::kSecondBookSky.top;
const Point3 kGlass{0, 1, 0}, kBrown{-4, 1, 0}, kMetal{4, 1, 0};  // the big balls of figures 1 and 2

}  // namespace

TEST_CASE("Figure 1: horizon and big balls are where the camera's geometry puts them", "[figures]") {
    const Figure figure = figures::fig01_bouncing_spheres();
    CHECK(close(horizon(figure, 200), 89.02, .005));
    CHECK(close(horizon(figure, 0), 90.15, .005));
    CHECK(close(horizon(figure, 400), 90.15, .005));
    CHECK(appears_at(figure.camera, kMetal, 307.5, 150.9));
    CHECK(appears_at(figure.camera, kGlass, 200.0, 115.9));
    CHECK(appears_at(figure.camera, kBrown, 140.7, 96.7));
    CHECK(close(project(figure.camera, 400, kMetal).depth, 9.49, .005));
    CHECK(close(project(figure.camera, 400, kGlass).depth, 13.34, .005));
    CHECK(close(project(figure.camera, 400, kBrown).depth, 17.20, .005));

    // All three are seen, each in a good part of the picture; the brown one mostly behind the glass.
    const CompiledScene scene = compile(figure.scene);
    std::map<std::uint32_t, int> pixels;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x)
            if (const auto hit = scene.closest_hit(picture_ray(figure.camera, 400, x + .5, y + .5)))
                ++pixels[hit->object];
    const auto spheres = figures::read_bouncing_spheres(figures::data_file("bounce_spheres.csv"));
    for (std::uint32_t i = 0; i < spheres.size(); ++i)
        if (spheres[i].radius == 1) CHECK(pixels[i + 1] > 1600);  // one in a hundred
}

TEST_CASE("Figure 1: the top rows show the bare sky", "[figures]") {
    Figure figure = figures::fig01_bouncing_spheres();
    figure.camera.aperture_angle = 0;
    const Image image = render_figure(figure, 2);
    int wrong = 0;
    for (int y = 0; y <= 28; ++y)
        for (int x = 0; x < 400; ++x) wrong += !same_float(image.at(x, y), kSky);
    CHECK(wrong == 0);
}

TEST_CASE("Figure 1: the balls are those of the file, in the shares that the book draws", "[figures]") {
    const auto spheres = figures::read_bouncing_spheres(figures::data_file("bounce_spheres.csv"));
    CHECK(figures::fig01_bouncing_spheres().scene.objects().size() == spheres.size() + 1);
    int matte = 0, metal = 0, glass = 0, big = 0, wrong = 0;
    std::vector<double> red, rises;
    for (const auto& s : spheres) {
        matte += s.material == "lambertian", metal += s.material == "metal", glass += s.material == "dielectric";
        const double rise = s.center1.y - s.center0.y;
        wrong += s.center1.x != s.center0.x || s.center1.z != s.center0.z;
        wrong += s.material == "lambertian" ? rise < 0 || rise >= .5 : rise != 0;
        if (s.radius == 1) {
            ++big;
            continue;
        }
        wrong += s.radius != .2;
        if (s.material == "lambertian") red.push_back(s.color.r), rises.push_back(rise);
        if (s.material == "metal") wrong += s.color.r < .5 || s.color.r >= 1 || s.parameter < 0 || s.parameter >= .5;
    }
    CHECK(wrong == 0);
    CHECK((matte == 376 && metal == 85 && glass == 23 && big == 3));
    CHECK(agrees(estimate(red), .25));
    CHECK(agrees(estimate(rises), .25));
}

TEST_CASE("Figure 2: from above no primary ray sees the sky", "[figures]") {
    const Figure figure = figures::fig02_from_above();
    const CompiledScene scene = compile(figure.scene);
    int sky = 0;
    for (int y = 0; y <= 400; ++y)
        for (int x = 0; x <= 400; ++x) sky += !scene.any_hit(picture_ray(figure.camera, 400, x, y));
    CHECK(sky == 0);
    CHECK(appears_at(figure.camera, kGlass, 200, 172.7));
    CHECK(appears_at(figure.camera, kBrown, 93.4, 343.9));
    CHECK(appears_at(figure.camera, kMetal, 274.4, 53.2));
    CHECK(close(project(figure.camera, 400, kBrown).depth, 9.22, .005));
    const Vec3 view = normalize(figure.camera.look_at - figure.camera.look_from);
    CHECK(close(std::asin(-view.y) * 180 / std::numbers::pi, 56, .5));
}

TEST_CASE("Figures 3 and 4: the filter changes only pixels that an outline crosses or noise is in", "[figures]") {
    const Figure before = figures::fig03_before_antialiasing(), after = figures::fig04_after_antialiasing();
    CHECK((before.settings.samples_per_pixel == 1 && !before.settings.antialias));
    CHECK((after.settings.samples_per_pixel >= 64 && after.settings.antialias));
    const Image hard = render_figure(before, 1), soft = render_figure(after, 4);
    const CompiledScene scene = compile(before.scene);
    const Color mirrored{.49, .48, .5};
    int sky = 0, mirror = 0, wrong = 0;
    for_each_pixel(before, [&](int x, int y, const Footprint& footprint) {
        if (all_see_sky(footprint)) {
            ++sky;
            wrong += !same_float(hard.at(x, y), kSky) || !same_float(soft.at(x, y), kSky);
        } else if (footprint[0] && footprint[0]->object == 1) {
            // Along the mirror direction: the sky, or the ground with its noise.
            const Ray ray = picture_ray(before.camera, 400, x + .5, y + .5);
            const Surface s = scene.surface_at(ray, *footprint[0]);
            const Vec3 n(s.normal), out = ray.direction - 2 * dot(ray.direction, n) * n;
            if (scene.any_hit(s.spawn_ray(out, 0))) return;
            ++mirror;
            wrong += !same_float(hard.at(x, y), mirrored);
        }
    });
    CHECK(wrong == 0);
    CHECK((sky > 10000 && mirror > 10000));
}

TEST_CASE("Figure 5: under the sky alone the sphere is exactly albedo times sky", "[figures]") {
    Figure figure = figures::fig05_purple_sphere();
    const double radius =
        boundary(200, 399,
                 [&](double x) {
                     return figure.scene.objects()[0]->hit(picture_ray(figure.camera, 400, x, 200)).has_value();
                 }) -
        200;
    CHECK(close(radius, 115.47, .005));
    CHECK(close(std::numbers::pi * radius * radius / 160000, .2618, 5e-5));

    const Image with_ground = render_figure(figure, 2);
    figure.scene = only(figure.scene, {0});
    const Image alone = render_figure(figure, 2);
    figure.settings.antialias = false;
    const Image sharp = render_figure(figure, 1);
    int on_sphere = 0, wrong = 0;
    for_each_pixel(figure, [&](int x, int y, const Footprint& footprint) {
        const bool inside = std::hypot(x + .5 - 200, y + .5 - 200) < radius;
        wrong += !same_float(sharp.at(x, y), inside ? Color{.35, 0, .5} : kSky);
        if (!all_see(footprint, 0)) return;
        ++on_sphere;
        wrong += !same_float(alone.at(x, y), {.35, 0, .5});
        wrong += with_ground.at(x, y).g != 0;
    });
    CHECK(wrong == 0);
    CHECK(on_sphere > 40000);
}

TEST_CASE("Figure 5: left and right are mirror images", "[figures]") {
    const Figure figure = figures::fig05_purple_sphere();
    const CompiledScene scene = compile(figure.scene);
    int wrong = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 200; ++x) {
            const auto left = scene.closest_hit(picture_ray(figure.camera, 400, x + .5, y + .5));
            const auto right = scene.closest_hit(picture_ray(figure.camera, 400, 399.5 - x, y + .5));
            wrong += left.has_value() != right.has_value() || (left && left->object != right->object);
        }
    CHECK(wrong == 0);
    const auto images = replicates(scene, figure.camera, {.width = 100, .height = 100, .samples_per_pixel = 4});
    const Estimate difference = measure(images, [](const Image& image) {
        return mean_over(image, 0, 0, 0, 50, 100) - mean_over(image, 0, 50, 0, 100, 100);
    });
    CAPTURE(difference.mean, difference.error);
    CHECK(agrees(difference, 0));
}

}  // namespace limn::test_balls
