// Crop windows: their pixels are those of the whole picture.
#include "catch.h"
#include "limn/math/error.h"
#include "limn/render/render_job.h"
#include "support/folder.h"
#include "support/pictures.h"

namespace limn::crop_test {

using namespace test;

namespace {

constexpr PixelBounds kCrop{5, 3, 41, 24};

const CompiledScene& scene() {
    static const CompiledScene compiled = compile_with(
        Background::gradient({1, 1, 1}, {0.5, 0.7, 1}),
        {floor_of(grey(0.6)), sphere({0, 1, 0}, 1, grey(0.8)), quad({-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, lamp(5))});
    return compiled;
}

RenderSettings settings(std::optional<PixelBounds> crop = kCrop) {
    RenderSettings s = square(48, 12, 5);
    s.height = 40;
    s.crop = crop;
    return s;
}

Camera view() {
    Camera camera = camera_at({0, 2, 8}, {0, 1, 0}, 40);
    camera.aperture_angle = 3;
    return camera;
}

bool is_part(const Image& part, const PixelBounds& bounds, const Image& whole) {
    if (part.width() != bounds.width() || part.height() != bounds.height()) return false;
    for (int y = 0; y < part.height(); ++y)
        for (int x = 0; x < part.width(); ++x)
            if (part.at(x, y) != whole.at(bounds.left + x, bounds.top + y)) return false;
    return true;
}

}  // namespace

TEST_CASE("Crop: its pixels are those of the whole picture, bit for bit, for every projection and sampler",
          "[render][crop]") {
    for (const Projection projection : {Projection::perspective, Projection::orthographic, Projection::panorama})
        for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::independent}) {
            Camera camera = view();
            camera.projection = projection;
            if (projection == Projection::panorama) camera.aperture_angle = 0;
            RenderSettings whole = settings({}), part = settings();
            whole.sampler = part.sampler = sampler;
            const RenderResult result = render(scene(), camera, part);
            CHECK(is_part(result.image, kCrop, render(scene(), camera, whole).image));
            CHECK(result.report.width == kCrop.width());
            CHECK(result.report.height == kCrop.height());
            CHECK(result.report.samples_per_pixel == 12);
            CHECK(result.maps.samples.size() == static_cast<std::size_t>(kCrop.width() * kCrop.height()));
        }
}

TEST_CASE("Crop: single pixels in the corners, and a corner of a picture that no memory holds", "[render][crop]") {
    const Image whole = render(scene(), view(), settings({})).image;
    for (const PixelBounds& corner :
         {PixelBounds{0, 0, 1, 1}, PixelBounds{47, 0, 48, 1}, PixelBounds{47, 39, 48, 40}, PixelBounds{0, 0, 48, 40}})
        CHECK(is_part(render(scene(), view(), settings(corner)).image, corner, whole));
    RenderSettings huge = settings(PixelBounds{kMaxSide - 2, kMaxSide - 1, kMaxSide, kMaxSide});
    huge.width = huge.height = kMaxSide;
    CHECK(render(scene(), view(), huge).image.width() == 2);
}

TEST_CASE("Crop: with an error to reach, pixels of equal numbers of samples are equal", "[render][crop]") {
    RenderSettings whole = settings({}), part = settings();
    whole.error = part.error = 1e-3;
    whole.uniform = part.uniform = true;
    const RenderResult all = render(scene(), view(), whole), some = render(scene(), view(), part);
    CHECK(some.error.reached);
    RenderSettings again = settings({});
    again.samples_per_pixel = static_cast<int>(some.report.samples_per_pixel);
    CHECK(is_part(some.image, kCrop, render(scene(), view(), again).image));
    part.uniform = false;
    const RenderResult adaptive = render(scene(), view(), part);
    CHECK(adaptive.error.reached);
    CHECK(adaptive.image.width() == kCrop.width());
}

TEST_CASE("Crop: shards, checkpoints and merging give its bits too, and no other crop's film is taken",
          "[render][crop]") {
    const Folder folder;
    const Image wanted = render(scene(), view(), settings()).image;
    std::vector<std::string> parts;
    for (int i = 1; i <= 3; ++i) {
        RenderSettings s = settings();
        s.shard = {i, 3};
        RenderJob job(scene(), view(), s);
        job.run();
        parts.push_back(folder.path(std::to_string(i)));
        job.save(parts.back());
    }
    const Film merged = Film::merge(parts);
    CHECK(merged.image() == wanted);
    CHECK(merged.info().crop == kCrop);

    RenderSettings begun = settings();
    begun.samples_per_pixel = 8;
    RenderJob first(scene(), view(), begun), second(scene(), view(), settings());
    first.run();
    first.save(folder.path("a.film"));
    second.load(folder.path("a.film"));
    second.run();
    CHECK(second.image() == wanted);
    for (const std::optional<PixelBounds>& other : {std::optional<PixelBounds>{}, {PixelBounds{5, 3, 41, 25}}}) {
        RenderJob job(scene(), view(), settings(other));
        CHECK_THROWS_WITH(job.load(folder.path("a.film")), Catch::Contains("its crop window is another"));
    }
}

TEST_CASE("Crop: one that is empty or leaves the picture is refused", "[render][crop]") {
    for (const PixelBounds& bad : {PixelBounds{}, PixelBounds{5, 3, 5, 24}, PixelBounds{-1, 0, 4, 4},
                                   PixelBounds{0, 0, 49, 40}, PixelBounds{0, 0, 48, 41}, PixelBounds{9, 9, 4, 12}}) {
        CHECK_THROWS_AS(RenderJob(scene(), view(), settings(bad)), ArgumentError);
        CHECK_THROWS_WITH(RenderJob(scene(), view(), settings(bad)), Catch::Contains("crop window"));
    }
}

}  // namespace limn::crop_test
