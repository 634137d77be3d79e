// The pictures of an MTL's materials, but for map_Kd.
#include <cmath>

#include "catch.h"
#include "limn/io/image_io.h"
#include "limn/io/obj.h"
#include "limn/math/vec.h"
#include "lowered_material.h"
#include "support/folder.h"

namespace limn::mtl_maps_test {

using namespace test;

namespace {

Model load_one(const Folder& folder, const std::string& mtl) {
    folder.write("a.mtl", "newmtl m\n" + mtl);
    return load_obj(
        folder.write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"));
}

}  // namespace

TEST_CASE("MTL: Ks scales the coat of plastic, and map_Ks stands for it", "[io][obj][mtl]") {
    const Folder folder;
    save_image(Image(1, 1, Color{0.5, 0.25, 0.125}), folder.path("a.png"));
    const auto coat = [&](const std::string& mtl) {
        const LoweredMaterial lowered(load_one(folder, "illum 2\nKd .5 .5 .5\n" + mtl));
        CHECK(lowered.record.kind == "plastic");
        return lowered.at(lowered.record.factors, 0.5, 0.5);
    };
    CHECK(coat("Ks .25 .5 1\n") == Color{.25, .5, 1});
    CHECK(coat("Ks .25 .5 1\nmap_Ks a.png\n").b == Approx(0.125).margin(0.005));
    CHECK(coat("map_Ks a.png\n").r == Approx(0.5).margin(0.005));
}

TEST_CASE("MTL: map_d is opacity, by its alpha or else its grey, times d", "[io][obj][mtl]") {
    const Folder folder;
    Image image(2, 1);
    image.set(0, 0, {1, 1, 1});
    save_image(image, folder.path("grey.png"));
    save_image(image, folder.path("alpha.png"), {.alpha = {0, 1}});
    const auto opacity = [&](const std::string& mtl, double u) {
        const Model model = load_one(folder, "Kd 1 0 0\n" + mtl);
        CHECK(model.warnings.empty());
        const LoweredMaterial lowered(model);
        CHECK(lowered.record.kind == "lambertian");
        return lowered.at(lowered.record.opacity, u, 0.5).r;
    };
    CHECK(opacity("map_d grey.png\n", 0.25) == 1);
    CHECK(opacity("map_d grey.png\n", 0.75) == 0);
    CHECK(opacity("map_d grey.png\nd .5\n", 0.25) == 0.5);
    CHECK(opacity("map_d alpha.png\n", 0.25) == 0);
    CHECK(opacity("map_d alpha.png\n", 0.75) == 1);
    // A leaf, and no glass.
    CHECK(LoweredMaterial(load_one(folder, "illum 4\nmap_d alpha.png\n")).record.kind == "lambertian");
}

TEST_CASE("MTL: norm bends normals, and so do the heights of bump, of which white is higher", "[io][obj][mtl]") {
    const Folder folder;
    const auto normal = [&](const std::string& mtl, double u, double v) {
        const LoweredMaterial lowered(load_one(folder, mtl));
        REQUIRE(lowered.record.normal_map != TextureId::none);
        const Color c = lowered.at(lowered.record.normal_map, u, v);
        return Vec3{2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1};
    };
    // One white row, and a column of half as much, on black: 16 texels of 1/16.
    Image heights(16, 16);
    for (int i = 0; i < 16; ++i) heights.set(i, 4, {1, 1, 1});
    for (int i = 0; i < 16; ++i)
        if (i != 4) heights.set(10, i, {0.5, 0.5, 0.5});
    save_image(heights, folder.path("h.png"));
    const double grey = std::round(255 * srgb_encode(0.5)) / 255;  // the values are taken as they are
    const auto near = [](const Vec3& a, const Vec3& slopes) { return length(a - normalize(slopes)) < 1e-5; };
    const double row_above = 1 - 3.5 / 16, row_below = 1 - 5.5 / 16, column = 9.5 / 16;
    CHECK(near(normal("bump h.png\n", 2.5 / 16, row_above), {0, 0.5, 1}));  // it falls upward
    CHECK(near(normal("map_Bump h.png\n", 2.5 / 16, row_below), {0, -0.5, 1}));
    CHECK(near(normal("map_bump -bm 2 h.png\n", column, 0.5 / 16), {-grey, 0, 1}));
    CHECK(near(normal("bump h.png\n", 2.5 / 16, 0.5 / 16), {0, 0, 1}));

    // A picture of normals is one, also behind map_Bump.
    save_image(Image(2, 2, Color{srgb_decode(0.7), srgb_decode(0.5), srgb_decode(0.958)}), folder.path("n.png"));
    const Vec3 stored{2 * std::round(0.7 * 255) / 255 - 1, 2 * std::round(0.5 * 255) / 255 - 1,
                      2 * std::round(0.958 * 255) / 255 - 1};
    CHECK(length(normal("norm n.png\n", 0.5, 0.5) - stored) < 1e-5);
    CHECK(length(normal("map_Bump n.png\n", 0.5, 0.5) - normalize(stored)) < 1e-5);
    CHECK(near(normal("map_Bump -bm 2 n.png\n", 0.5, 0.5), {2 * stored.x, 2 * stored.y, stored.z}));
    // With both, norm.
    const Model both = load_one(folder, "bump h.png\nnorm n.png\n");
    CHECK(both.warnings ==
          std::vector<std::string>{folder.path("a.mtl") + ": line 2: bump of material 'm' is not used"});
    CHECK(length(normal("bump h.png\nnorm n.png\n", 0.5, 0.5) - stored) < 1e-5);
    // Their options, of which -bm of heights counts.
    const Model options = load_one(folder, "bump -bm 2 -s 2 h.png\n");
    CHECK(options.warnings ==
          std::vector<std::string>{folder.path("a.mtl") + ": line 2: the options of bump are not used, except -bm"});
}

}  // namespace limn::mtl_maps_test
