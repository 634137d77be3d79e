// Figures 15 and 16: direct light and smoke with known answers, and what stands where in the picture.
#include <cmath>
#include <numbers>

#include "catch.h"
#include "limn/render/render_job.h"
#include "scene_parts.h"
#include "support.h"
#include "support/folder.h"
#include "support/same_render.h"

namespace limn::test_cornell {

using namespace test;

namespace {

const Camera kCamera = figures::cornell_camera();

// The point that pixel (x, y) of the 400 x 400 picture looks at through its centre.
Point3 target_of(int x, int y) { return picture_ray(kCamera, 400, x + .5, y + .5).at(1000); }

// How long a ray is within media, by the crossings of their boundaries.
double length_inside(const CompiledScene& scene, Ray ray) {
    double length_ = 0, entered = 0;
    bool inside = false;
    while (const auto hit = scene.closest_hit(ray)) {
        if (!hit->index_matched) break;
        if (inside) length_ += hit->t - entered;
        inside = !inside;
        entered = ray.t_min = hit->t;
    }
    return length_ * length(ray.direction);
}

// ---- T7: the empty room
// ------------------------------------------------------------------------------------------------

CompiledScene empty_room() {
    const auto lamp = std::make_shared<DiffuseLight>(Color{15, 15, 15});
    return compile(
        figures::cornell_room(std::make_shared<Quad>(Point3{343, 554, 332}, Vec3{-130, 0, 0}, Vec3{0, 0, -105}, lamp)));
}

// Irradiance from the light of radiance 15, by the midpoint rule over 400 x 400 patches.
double irradiance(const Point3& at, const Vec3& normal) {
    double sum = 0;
    for (int i = 0; i < 400; ++i)
        for (int j = 0; j < 400; ++j) {
            const Vec3 d = Point3{213 + 130 * (i + .5) / 400, 554, 227 + 105 * (j + .5) / 400} - at;
            const double r2 = dot(d, d);
            sum += std::max(0.0, dot(d, normal)) * std::abs(d.y) / (r2 * r2);
        }
    return 15 * sum * 130 * 105 / 160000;
}

}  // namespace

TEST_CASE("T6: smoke in the shape of both boxes lets exp(-density length) through", "[figures]") {
    struct Row {
        int x, y;
        double length;  // from a table whose last digit is not certain
    };
    const Row row = GENERATE(Row{140, 200, 166.98}, Row{120, 200, 116.54}, Row{160, 250, 168.73}, Row{250, 300, 171.95},
                             Row{255, 280, 170.62}, Row{240, 320, 173.91});
    const auto boundary = figures::matte({.73, .73, .73});
    const CompiledScene scene =
        compile(scene_of(Background::constant({1, 1, 1}),
                         {std::make_shared<ConstantMedium>(figures::tall_box(boundary), .01, Color{}),
                          std::make_shared<ConstantMedium>(figures::short_box(boundary), .01, Color{})}));
    CAPTURE(row.x, row.y);
    const double length_ = length_inside(scene, picture_ray(kCamera, 400, row.x + .5, row.y + .5));
    CHECK(close(length_, row.length, .01));
    const Radiance seen = radiance(scene, kCamera.look_from, target_of(row.x, row.y), {.samples_per_pixel = 4000});
    CAPTURE(seen.r.mean, seen.r.error);
    // What is absorbed is not left to chance: only the picture's float rounds.
    const double truth = std::exp(-.01 * length_);
    CHECK(agrees(seen.r, truth, 1e-7 * truth));
}

TEST_CASE("T6: white smoke in a white furnace loses only what the depth limit cuts off", "[figures]") {
    const auto smoke = std::make_shared<ConstantMedium>(figures::tall_box(figures::matte({})), .01, Color{1, 1, 1});
    const CompiledScene scene = compile(scene_of(Background::constant({1, 1, 1}), {smoke}));
    const int size = 100;
    const auto mean_through_smoke = [&](int max_depth) {
        const auto images = replicates(
            scene, kCamera,
            {.width = size, .height = size, .samples_per_pixel = 8, .max_depth = max_depth, .antialias = false});
        return measure(images, [&](const Image& image) {
            double sum = 0, count = 0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    if (scene.any_hit(picture_ray(kCamera, size, x + .5, y + .5))) sum += image.at(x, y).r, ++count;
            return sum / count;
        });
    };
    const Estimate cut = mean_through_smoke(10), all = mean_through_smoke(kUnlimitedDepth);
    CAPTURE(cut.mean, cut.error, all.mean, all.error);
    CHECK(agrees(cut, .997, 5e-4));
    CHECK((same_float(all.mean, 1) || agrees(all, 1)));
}

TEST_CASE("T7: direct light in the empty room is the integral over the lamp, for both estimators", "[figures]") {
    struct Row {
        Point3 at;
        Vec3 normal;
        Color albedo;
        double irradiance, x, y;
    };
    const Color white{.73, .73, .73}, red{.65, .05, .05}, green{.12, .45, .15};
    const Row row = GENERATE_COPY(Row{{278, 0, 278}, {0, 1, 0}, white, .65716, 200, 341.7},
                                  Row{{278, 0, 100}, {0, 1, 0}, white, .54062, 200, 369.7},
                                  Row{{278, 278, 555}, {0, 0, -1}, white, .66055, 200, 200},
                                  Row{{278, 100, 555}, {0, 0, -1}, white, .31594, 200, 272.2},
                                  Row{{0, 278, 278}, {1, 0, 0}, red, .65877, 341.7, 200},
                                  Row{{555, 278, 278}, {-1, 0, 0}, green, .66101, 58.8, 200});
    const Projected pixel = project(kCamera, 400, row.at);
    CHECK(std::abs(pixel.x - row.x) <= .05);
    CHECK(std::abs(pixel.y - row.y) <= .05);
    const double truth = irradiance(row.at, row.normal);
    CHECK(std::abs(truth - row.irradiance) <= 1e-5);
    const CompiledScene scene = empty_room();
    for (const Estimator estimator : {Estimator::path, Estimator::naive}) {
        const Radiance seen = radiance(scene, kCamera.look_from, row.at,
                                       {.samples_per_pixel = 2000, .max_depth = 2, .estimator = estimator});
        CAPTURE(int(estimator), row.at.x, row.at.y, row.at.z, seen.r.mean, seen.r.error);
        CHECK(agrees(seen.r, row.albedo.r * truth / std::numbers::pi));
        CHECK(agrees(seen.g, row.albedo.g * truth / std::numbers::pi));
        CHECK(agrees(seen.b, row.albedo.b * truth / std::numbers::pi));
    }
}

TEST_CASE("Figure 15: lamp, walls and border are where the camera's geometry puts them", "[figures]") {
    const auto at = [](const Point3& p) { return project(kCamera, 400, p); };
    const auto close = [](double a, double b, double rounding) { return std::abs(a - b) <= rounding; };
    // The lamp's corners, the back wall, the room's opening.
    CHECK((close(at({343, 554, 227}).x, 165.2, .05) && close(at({343, 554, 227}).y, 52.3, .05)));
    CHECK((close(at({213, 554, 227}).x, 234.8, .05) && close(at({213, 554, 227}).y, 52.3, .05)));
    CHECK((close(at({213, 554, 332}).x, 231.6, .05) && close(at({213, 554, 332}).y, 66.0, .05)));
    CHECK((close(at({343, 554, 332}).x, 168.4, .05) && close(at({343, 554, 332}).y, 66.0, .05)));
    CHECK((close(at({555, 555, 555}).x, 87.67, .005) && close(at({555, 555, 555}).y, 87.67, .005)));
    CHECK((close(at({0, 0, 555}).x, 312.74, .005) && close(at({0, 0, 555}).y, 312.74, .005)));

    const CompiledScene scene = compile(figures::fig15_cornell_box().scene);
    const auto seen = [&](double x, double y) { return scene.closest_hit(picture_ray(kCamera, 400, x, y)); };
    // A pixel coordinate at which a wall begins or ends, seen in a row or column that no box is in.
    CHECK(close(boundary(0, 200, [&](double x) { return seen(x, 100).has_value(); }), 9.74, .005));
    CHECK(close(boundary(0, 200, [&](double y) { return seen(200, y).has_value(); }), 9.74, .005));
    CHECK(close(boundary(400, 200, [&](double x) { return seen(x, 100).has_value(); }), 400 - 9.05, .005));
    CHECK(close(boundary(400, 300, [&](double y) { return seen(200, y).has_value(); }), 400 - 9.05, .005));
    CHECK(close(boundary(20, 200, [&](double x) { return seen(x, 100)->object == 0; }), 87.67, .005));    // green, left
    CHECK(close(boundary(380, 200, [&](double x) { return seen(x, 100)->object == 1; }), 312.74, .005));  // red, right
    CHECK(seen(200, 59)->object == 5);                                                                    // the lamp
    CHECK(seen(150, 250)->object == 6);  // the tall box
    CHECK(seen(250, 310)->object == 7);
}

TEST_CASE("Figures 15 and 16: outside the room it is exactly black, the lamp has exactly its radiance", "[figures]") {
    struct Row {
        Figure (*figure)(const FigureInputs&);
        double lamp;
    };
    const Row row = GENERATE(Row{figures::fig15_cornell_box, 15}, Row{figures::fig16_volume_cornell_box, 7});
    Figure figure = row.figure({});
    figure.settings.samples_per_pixel = 1;
    const Image image = render(compile(figure.scene), figure.camera, figure.settings).image;
    int wrong = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            if (std::min(x, y) <= 8 || std::max(x, y) >= 391) wrong += image.at(x, y) != Color{};
            if (x >= 190 && x < 210 && y >= 55 && y < 63)
                wrong += image.at(x, y) != Color{row.lamp, row.lamp, row.lamp};
        }
    CHECK(wrong == 0);
    // Green is left and red is right, by the light of the lamp.
    const auto sum = [&](std::size_t channel, int x0) { return mean_over(image, channel, x0, 100, x0 + 60, 300); };
    CHECK(sum(1, 20) > 2 * sum(0, 20));
    CHECK(sum(0, 320) > 2 * sum(1, 320));
}

TEST_CASE("Figure 16: black smoke dims what lies behind it and adds no light", "[figures]") {
    const CompiledScene scene = compile(figures::fig16_volume_cornell_box().scene);
    const Ray ray = picture_ray(kCamera, 400, 140.5, 200.5);
    // The ray enters the smoke, leaves it, and meets the back wall.
    const auto in = scene.closest_hit(ray);
    REQUIRE((in && in->index_matched && in->object == 6));
    Ray behind = ray;
    behind.t_min = in->t;
    const auto out = scene.closest_hit(behind);
    REQUIRE((out && out->index_matched && out->object == 6));
    behind.t_min = out->t;
    const auto wall = scene.closest_hit(behind);
    REQUIRE((wall && !wall->index_matched && wall->object == 4));

    const double transmittance = std::exp(-.01 * length_inside(scene, ray));
    const Radiance before = radiance(scene, kCamera.look_from, ray.at(wall->t), {.samples_per_pixel = 4000});
    const Radiance after =
        radiance(scene, ray.at((out->t + wall->t) / 2), ray.at(wall->t), {.samples_per_pixel = 1000});
    CAPTURE(before.g.mean, before.g.error, after.g.mean, after.g.error, transmittance);
    CHECK(agrees(
        {before.g.mean - transmittance * after.g.mean, std::hypot(before.g.error, transmittance * after.g.error)}, 0));
}

TEST_CASE("Figure 16: seven shards, merged in three orders, are the bits of one run", "[figures]") {
    const Figure figure = figures::fig16_volume_cornell_box();
    const CompiledScene scene = compile(figure.scene);
    RenderSettings settings = figure.settings;
    settings.width = 80, settings.height = 64;  // 20 tiles: not as many for each
    settings.samples_per_pixel = 8;             // from which on the error is known
    const RenderResult whole = render(scene, figure.camera, settings);
    const Folder folder;
    for (int i = 1; i <= 7; ++i) {
        settings.shard = {i, 7};
        RenderJob shard(scene, figure.camera, settings);
        shard.run();
        shard.save(folder.path(std::to_string(i)));
    }
    for (const std::string_view order : {"1234567", "7654321", "4162753"}) {
        std::vector<std::string> films;
        for (const char shard : order) films.push_back(folder.path({shard}));
        check_same(render_result(Film::merge(films)), whole);
    }
}

}  // namespace limn::test_cornell
