// Figures 13, 14, 17 and 18: glass, shutter and lens.
#include <cmath>

#include "catch.h"
#include "support.h"

namespace limn::test_blur {

using namespace test;

namespace {

const Point3 kGlass{-1, 0, -1}, kBlue{0, 0, -1}, kGold{1, 0, -1};

// How far apart, in pixels, the point appears through the left and the right end of the lens.
double circle_of_confusion(const Camera& camera, const Point3& p) {
    const CameraRays rays(camera, 400, 400);
    const Vec3 w = normalize(camera.look_from - camera.look_at), u = normalize(cross(camera.up, w));
    const auto appears_through = [&](double lens_u) {
        // Where the ray through picture column x passes the point's plane is linear in x.
        const auto miss = [&](double x) {
            const Ray ray = rays.ray(x, 200, lens_u, .5, 0);
            return dot(ray.at(dot(p - ray.origin, w) / dot(ray.direction, w)) - p, u);
        };
        return 400 * miss(0) / (miss(0) - miss(400));
    };
    return std::abs(appears_through(0) - appears_through(std::nextafter(1.0, 0.0)));
}

}  // namespace

TEST_CASE("Figure 13: yellow ground has no blue, gold that mirrors the sky has its own", "[figures]") {
    const Figure figure = figures::fig13_dielectric();
    CHECK(appears_at(figure.camera, kGlass, 44.6, 289.7));
    CHECK(appears_at(figure.camera, kBlue, 200, 200));
    CHECK(appears_at(figure.camera, kGold, 311.0, 135.9));

    const auto images = replicates(compile(figure.scene), figure.camera, {.samples_per_pixel = 1}, 16);
    int ground = 0, wrong = 0;
    for_each_pixel(figure, [&](int x, int y, const Footprint& footprint) {
        if (!all_see(footprint, 0)) return;
        ++ground;
        wrong += images[0].at(x, y).b != 0;
    });
    for (int y = 90; y < 120; ++y)
        for (int x = 300; x < 330; ++x) wrong += !same_float(images[0].at(x, y).b, .2);
    CHECK(wrong == 0);
    CHECK(ground > 20000);
    const auto mean = [&](std::size_t c) {
        return measure(images, [&](const Image& image) { return mean_over(image, c, 300, 90, 330, 120); });
    };
    CAPTURE(mean(0).mean, mean(0).error, mean(1).mean, mean(1).error);
    CHECK(agrees(mean(0), .4198, 5e-5));
    CHECK(agrees(mean(1), .4289, 5e-5));
}

TEST_CASE("Figure 14: the ball moves by the stated number of pixels, its neighbours stay", "[figures]") {
    const Figure figure = figures::fig14_bouncing_ball();
    const CompiledScene scene = compile(figure.scene);
    const auto y_of = [&](double height) { return project(figure.camera, 400, {0, height, 0}).y; };
    CHECK(close(y_of(0) - y_of(1), 113.43, .005));
    const auto ball_seen = [&](double height, double time) {
        const auto hit = scene.closest_hit(picture_ray(figure.camera, 400, 200, y_of(height), time));
        return hit && hit->object == 1;
    };
    for (const double time : {0.0, 0.3, 1.0}) {
        CHECK(ball_seen(time, time));
        CHECK(ball_seen(time + .39, time));
        CHECK_FALSE(ball_seen(time + .41, time));
    }
    // Objects that stay: the same number in the same pixel at any time, unless the ball is before them.
    int stays = 0, wrong = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const auto seen = [&](double time) {
                const auto hit = scene.closest_hit(picture_ray(figure.camera, 400, x + .5, y + .5, time));
                return hit ? static_cast<int>(hit->object) : -1;
            };
            const int first = seen(0), last = seen(1);
            stays += first > 1;
            wrong += first != last && first != 1 && last != 1;
        }
    CHECK(wrong == 0);
    CHECK(stays > 8000);
}

TEST_CASE("Figure 14: a shutter of no length shows the ball at rest", "[figures]") {
    Figure figure = figures::fig14_bouncing_ball();
    figure.camera.shutter_close = 0;
    figure.settings.width = figure.settings.height = 100;
    Figure still = figure;
    still.scene = only(figure.scene, {0});
    const auto red = std::make_shared<Lambertian>(Color{.7, .2, .1});
    still.scene.add(std::make_shared<Sphere>(Point3{0, 0, 0}, .4, red));
    for (const std::size_t i : {2u, 3u}) still.scene.add(figure.scene.objects()[i]);
    CHECK(render_figure(figure, 8) == render_figure(still, 8));
    figure.camera.shutter_close = 1;
    CHECK_FALSE(render_figure(figure, 8) == render_figure(still, 8));
}

TEST_CASE("Figure 17 is figure 13, bit for bit", "[figures]") {
    CHECK(render_figure(figures::fig17_without_dof(), 1) == render_figure(figures::fig13_dielectric(), 1));
}

TEST_CASE("Figure 18: points out of focus spread as far as the lens makes them", "[figures]") {
    const Camera camera = figures::fig18_with_dof().camera;
    const CameraRays rays(camera, 400, 400);
    const Point3 left = rays.ray(200, 200, 0, .5, 0).origin,
                 right = rays.ray(200, 200, std::nextafter(1, 0), .5, 0).origin;
    CHECK(close(length(left - right) / 2, .29746, 5e-6));
    CHECK(close(circle_of_confusion(camera, kGlass), 19.7, .05));
    CHECK(close(circle_of_confusion(camera, kBlue), 2.1, .05));
    CHECK(close(circle_of_confusion(camera, kGold), 17.6, .05));
    const Vec3 forward = normalize(camera.look_at - camera.look_from);
    CHECK(close(circle_of_confusion(camera, camera.look_from + 1e9 * forward), 111.0, .05));
    CHECK(close(circle_of_confusion(camera, camera.look_from + 3.4 * forward), 0, 1e-9));
}

TEST_CASE("Figures 17 and 18: the lens moves light, it does not add any", "[figures]") {
    const Figure sharp = figures::fig17_without_dof(), blurred = figures::fig18_with_dof();
    const RenderSettings settings{.width = 100, .height = 100, .samples_per_pixel = 4};
    const auto mean = [&](const Figure& figure) {
        return measure(replicates(compile(figure.scene), figure.camera, settings),
                       [](const Image& image) { return mean_over(image, 1); });
    };
    const Estimate a = mean(sharp), b = mean(blurred);
    CAPTURE(a.mean, a.error, b.mean, b.error);
    CHECK(std::abs(a.mean - b.mean) + kSigmas * std::hypot(a.error, b.error) < .01 * a.mean);
}

}  // namespace limn::test_blur
