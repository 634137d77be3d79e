// A model in other units gives the same picture.
#include "catch.h"
#include "house.h"
#include "limn/image/compare.h"
#include "limn/io/image_io.h"
#include "process.h"
#include "support/folder.h"

namespace limn::test::scale_test {
namespace {

Image picture(const Folder& folder, double scale, const std::string& seed) {
    const std::string model = folder.write("house.obj", house_obj(scale)), path = folder.path("house.exr");
    REQUIRE(limn({"render", model, "-o", path, "--size", "32x32", "--spp", "16", "--seed", seed}).status == 0);
    return load_image(path);
}

TEST_CASE("limn render: a model scaled by a power of two gives the same picture, bit for bit", "[cli]") {
    const Folder folder;
    const Image original = picture(folder, 1, "1");
    CHECK(picture(folder, 0x1p-20, "1") == original);
    CHECK(picture(folder, 0x1p20, "1") == original);
}

TEST_CASE("limn render: a model scaled by 1e-6 or 1e6 gives the same picture but for rounding", "[cli]") {
    const Folder folder;
    const Image original = picture(folder, 1, "1");
    // Coordinates move by half a unit of float32, 6e-8 of themselves, so that hardly a path in a picture takes another
    // turn. The difference that another seed makes is all paths taking another one.
    const double noise = compare_images(picture(folder, 1, "2"), original).mse;
    REQUIRE(noise > 0);
    for (const double scale : {1e-6, 1e6}) {
        CAPTURE(scale);
        CHECK(compare_images(picture(folder, scale, "1"), original).mse < noise / 100);
    }
}

}  // namespace
}  // namespace limn::test::scale_test
