// What the header of a picture says.
#include "catch.h"
#include "formats.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "make_png.h"
#include "support/folder.h"

namespace limn::image_info_test {

using namespace test;

namespace {

// "width x height: R uint8, ..."
std::string summary(const std::string& path) {
    const ImageInfo info = load_image_info(path);
    std::string text = std::to_string(info.width) + " x " + std::to_string(info.height) + ":";
    for (const ImageChannel& channel : info.channels) text += " " + channel.name + " " + channel.type;
    return text;
}

}  // namespace

TEST_CASE("Image info: what save_image wrote, in every format", "[io][image]") {
    const Folder folder;
    save_image(noise(7, 4, 1), folder.path("a.png"));
    CHECK(summary(folder.path("a.png")) == "7 x 4: R uint8 G uint8 B uint8");
#ifdef LIMN_WITH_OPENIMAGEIO
    save_image(noise(7, 4, 1), folder.path("a.exr"));
    CHECK(summary(folder.path("a.exr")) == "7 x 4: R float G float B float");
    save_image(noise(7, 4, 1), folder.path("a.exr"), {.half = true});
    CHECK(summary(folder.path("a.exr")) == "7 x 4: R half G half B half");
#else
    save_image(noise(7, 4, 1), folder.path("a.hdr"));
    CHECK(summary(folder.path("a.hdr")) == "7 x 4: R float G float B float");
#endif
}

TEST_CASE("Image info: all channels of a file are named, those that loading leaves out too", "[io][image]") {
    const Folder folder;
    const auto png = [&folder](char bit_depth, PngColor color, std::size_t bytes) {
        return summary(folder.write("a.png", make_png(2, bit_depth, color, std::string(bytes, '\x55'))));
    };
    CHECK(png(8, PngColor::grey, 2) == "2 x 1: Y uint8");
    CHECK(png(8, PngColor::grey_alpha, 4) == "2 x 1: Y uint8 A uint8");
    CHECK(png(8, PngColor::rgb_alpha, 8) == "2 x 1: R uint8 G uint8 B uint8 A uint8");
    CHECK(png(16, PngColor::rgb, 12) == "2 x 1: R uint16 G uint16 B uint16");
    CHECK(png(16, PngColor::grey, 4) == "2 x 1: Y uint16");
}

TEST_CASE("Image info: no pixel is decoded", "[io][image]") {
    const Folder folder;
    // Pixels of the wrong length, which loading refuses.
    const std::string path = folder.write("a.png", make_png(2, 8, PngColor::rgb, "xyz"));
    CHECK(summary(path) == "2 x 1: R uint8 G uint8 B uint8");
    CHECK(load_image_facts(path).empty());
    CHECK_THROWS_AS(load_image(path), FileError);
    // A run of 127 in a row of eight.
    const std::string hdr = folder.write("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\x02\x02" +
                                                      std::string("\0\x08", 2) + std::string(32, '\xff'));
    CHECK(summary(hdr) == "8 x 1: R float G float B float");
    CHECK(load_image_facts(hdr).empty());
    CHECK_THROWS_AS(load_image(hdr), FileError);
}

TEST_CASE("Image info: files that are no pictures are refused with their name", "[io][image]") {
    const Folder folder;
    for (const std::string& path : {folder.path("none.png"), folder.path(), folder.write("a.png", "text"),
                                    folder.write("a.exr", "text"), folder.write("a.txt", "text")}) {
        CAPTURE(path);
        try {
            load_image_info(path);
            FAIL_CHECK("accepted");
        } catch (const FileError& e) {
            CHECK(std::string(e.what()).starts_with(path + ": "));
        }
    }
}

}  // namespace limn::image_info_test
