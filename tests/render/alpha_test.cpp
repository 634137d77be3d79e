// Pictures without their background.
#include "catch.h"
#include "limn/render/render_job.h"
#include "limn/scene/material/dielectric.h"
#include "support/folder.h"
#include "support/pictures.h"

namespace limn::alpha_test {

using namespace test;

namespace {

const Color kBehind{0.25, 0.5, 0.75};

RenderSettings settings(bool transparent) {
    RenderSettings s = square(24, 32, 6);
    s.transparent = transparent;
    return s;
}

Camera view() { return camera_at({0, 1, 6}, {0, 1, 0}, 40); }

// The largest difference between a picture and its transparent form over the background.
double largest_difference(const std::vector<Object>& objects) {
    const CompiledScene scene = compile_with(Background::constant(kBehind), objects);
    const Image opaque = render(scene, view(), settings(false)).image;
    const RenderResult clear = render(scene, view(), settings(true));
    double largest = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const double alpha = static_cast<double>(clear.maps.alpha[static_cast<std::size_t>(24 * y + x)]);
            const Color over = clear.image.at(x, y) + (1 - alpha) * kBehind;
            const Color wrong = over - opaque.at(x, y);
            largest = std::max({largest, std::abs(wrong.r), std::abs(wrong.g), std::abs(wrong.b)});
        }
    return largest;
}

}  // namespace

TEST_CASE("Alpha: over the background it gives the picture with that background", "[render][alpha]") {
    CHECK(largest_difference({sphere({0, 1, 0}, 1, grey(0.7))}) <= 1e-6);
    CHECK(largest_difference({sphere({0, 1, 0}, 1, std::make_shared<Dielectric>(1.5)), floor_of(grey(0.5))}) <= 1e-6);
    // Fog that scatters, and smoke that only absorbs, of grey.
    CHECK(largest_difference({std::make_shared<ConstantMedium>(sphere({0, 1, 0}, 1, grey(1)), 1, Color{1, 1, 1})}) <=
          1e-6);
    CHECK(largest_difference({std::make_shared<ConstantMedium>(sphere({0, 1, 0}, 1, grey(1)), 1, Color{0, 0, 0})}) <=
          1e-6);
}

TEST_CASE("Alpha: the part of the camera's paths that meet something", "[render][alpha]") {
    // A wall that covers the left half of the picture and a quarter of the column beside it.
    const Camera camera{
        .look_from = {0, 0, 4}, .look_at = {0, 0, 0}, .projection = Projection::orthographic, .view_height = 24};
    const CompiledScene scene =
        compile_with(Background::constant(kBehind), {quad({-99, -99, 0}, {99.25, 0, 0}, {0, 198, 0}, grey(0.5))});
    RenderSettings s = settings(true);
    s.samples_per_pixel = 64;
    const RenderResult result = render(scene, camera, s);
    REQUIRE(result.maps.alpha.size() == 24 * 24);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const float alpha = result.maps.alpha[static_cast<std::size_t>(24 * y + x)];
            // 64 Sobol points in two replicates of 32, of which a quarter is 16.
            CHECK(alpha == (x < 12 ? 1.0F : x == 12 ? 0.25F : 0.0F));
            if (x > 12) CHECK(result.image.at(x, y) == Color{});
        }
    CHECK(render(scene, camera, settings(false)).maps.alpha.empty());
}

TEST_CASE("Alpha: index-matched boundaries without anything in between are nothing", "[render][alpha]") {
    const CompiledScene scene =
        compile_with(Background::constant(kBehind),
                     {std::make_shared<ConstantMedium>(sphere({0, 1, 0}, 1, grey(1)), 1e-12, Color{1, 1, 1})});
    for (const float alpha : render(scene, view(), settings(true)).maps.alpha) CHECK(alpha == 0.0F);
}

TEST_CASE("Alpha: a film keeps it, and is not taken for an opaque one", "[render][alpha]") {
    const Folder folder;
    const CompiledScene scene = compile_with(Background::constant(kBehind), {sphere({0, 1, 0}, 1, grey(0.7))});
    RenderJob whole(scene, view(), settings(true));
    whole.run();
    RenderSettings begun = settings(true);
    begun.samples_per_pixel = 8;
    RenderJob first(scene, view(), begun), second(scene, view(), settings(true)),
        opaque(scene, view(), settings(false));
    first.run();
    first.save(folder.path("a.film"));
    second.load(folder.path("a.film"));
    second.run();
    CHECK(second.alpha() == whole.alpha());
    CHECK(second.result().maps.alpha == whole.alpha());
    CHECK(second.image() == whole.image());
    CHECK(Film::load(folder.path("a.film")).alpha() == first.alpha());
    CHECK_THROWS_WITH(opaque.load(folder.path("a.film")), Catch::Contains("transparent background is on, not off"));
    CHECK(opaque.alpha().empty());
    CHECK(second.film().memory_bytes() > opaque.film().memory_bytes());
}

}  // namespace limn::alpha_test
