// How stored values become linear ones, from files and from memory alike.
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "catch.h"
#include "judge_image.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "make_png.h"
#include "support/folder.h"

namespace limn::image_decoding_test {

using namespace test;

namespace {

// Loads the same bytes both ways, which must agree.
Image load_both(const std::string& bytes, Encoding encoding = Encoding::automatic) {
    const Folder folder;
    const Image from_file = load_image(folder.write("a.png", bytes), encoding);
    const Image from_memory = load_image_from_memory(std::as_bytes(std::span(bytes)), encoding);
    CHECK(from_file == from_memory);
    return from_file;
}

void check_near(const Color& a, const Color& b, double distance) {
    CHECK(a.r == Approx(b.r).margin(distance));
    CHECK(a.g == Approx(b.g).margin(distance));
    CHECK(a.b == Approx(b.b).margin(distance));
}

float decoded(double stored) { return static_cast<float>(srgb_decode(stored)); }

using Values = std::vector<float>;

Values values_of(const Image& image) { return {image.values().begin(), image.values().end()}; }
Values grey(float v) { return {v, v, v}; }

}  // namespace

TEST_CASE("Decoding: 8-bit values are sRGB unless told otherwise", "[io][image]") {
    const std::string png = make_png(2, 8, PngColor::rgb, "\xff\x80\x10\x01\x02\x03");
    const int stored[] = {255, 128, 16, 1, 2, 3};
    Values linear, raw;
    for (const int v : stored) linear.push_back(decoded(v / 255.0)), raw.push_back(static_cast<float>(v / 255.0));
    CHECK(values_of(load_both(png)) == linear);
    CHECK(values_of(load_both(png, Encoding::srgb)) == linear);
    CHECK(values_of(load_both(png, Encoding::raw)) == raw);
}

TEST_CASE("Decoding: 16-bit values keep all their bits", "[io][image]") {
    const std::string png = make_png(1, 16, PngColor::rgb, std::string("\x80\x01\x00\x01\xff\xff", 6));
    CHECK(values_of(load_both(png, Encoding::raw)) ==
          Values{static_cast<float>(0x8001 / 65535.0), static_cast<float>(1 / 65535.0), 1});
    CHECK(values_of(load_both(png)) == Values{decoded(0x8001 / 65535.0), decoded(1 / 65535.0), 1});
}

TEST_CASE("Decoding: a single channel is grey, and alpha does not touch colours", "[io][image]") {
    const Values expected = grey(decoded(64 / 255.0));
    CHECK(values_of(load_both(make_png(1, 8, PngColor::grey, "\x40"))) == expected);
    CHECK(values_of(load_both(make_png(1, 8, PngColor::grey_alpha, "\x40\x20"))) == expected);
    CHECK(values_of(load_both(make_png(1, 8, PngColor::rgb_alpha, "\x40\x40\x40\x20"))) == expected);
    CHECK(values_of(load_both(make_png(1, 8, PngColor::rgb_alpha, std::string("\x40\x40\x40\0", 4)))) == expected);
}

TEST_CASE("Decoding: a palette is resolved", "[io][image]") {
    const std::string palette = png_chunk("PLTE", std::string("\0\0\0\xff\x80\x10", 6));
    CHECK(values_of(load_both(make_png(2, 8, PngColor::palette, std::string("\1\0", 2), palette))) ==
          Values{1, decoded(128 / 255.0), decoded(16 / 255.0), 0, 0, 0});
}

TEST_CASE("Decoding: a file that states linear values or a power is believed", "[io][image]") {
    const auto red = [](std::uint32_t gamma, Encoding encoding = Encoding::automatic) {
        const std::string png = make_png(1, 8, PngColor::rgb, "\x80\x80\x80", png_chunk("gAMA", big_endian(gamma)));
        return values_of(load_both(png, encoding))[0];
    };
    CHECK(red(100000) == static_cast<float>(128 / 255.0));
    CHECK(red(33333) == Approx(std::pow(128 / 255.0, 3.00003)).epsilon(1e-4));  // OpenImageIO rounds the power to 3.00
    CHECK(red(33333, Encoding::srgb) == decoded(128 / 255.0));
    CHECK(red(33333, Encoding::raw) == static_cast<float>(128 / 255.0));
}

TEST_CASE("Decoding: a JPEG is read from a file and from memory", "[io][image]") {
    const std::string path = std::string(LIMN_TEST_DATA) + "/orange.jpg";  // (204, 102, 26), 8 x 8
    const std::string bytes = stored_file("orange.jpg");
    const Color orange{204 / 255.0, 102 / 255.0, 26 / 255.0};
    for (const Image& image :
         {load_image(path, Encoding::raw), load_image_from_memory(std::as_bytes(std::span(bytes)), Encoding::raw)}) {
        REQUIRE(image.width() == 8);
        REQUIRE(image.height() == 8);
        check_near(image.at(3, 5), orange, 2 / 255.0);
    }
    check_near(load_image(path).at(0, 0), Color{srgb_decode(orange.r), srgb_decode(orange.g), srgb_decode(orange.b)},
               0.015);
}

TEST_CASE("Decoding: floating-point files are linear unless told otherwise", "[io][image]") {
    // One pixel, mantissas 128, 64, 192 and exponent 128: 0.5, 0.25, 0.75.
    const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\xc0\x80";
    const auto load = [&hdr](Encoding encoding) {
        return values_of(load_image_from_memory(std::as_bytes(std::span(hdr)), encoding));
    };
    CHECK(load(Encoding::automatic) == Values{0.5f, 0.25f, 0.75f});
    CHECK(load(Encoding::raw) == Values{0.5f, 0.25f, 0.75f});
    CHECK(load(Encoding::srgb) == Values{decoded(0.5), decoded(0.25), decoded(0.75)});
}

TEST_CASE("Decoding: broken files are refused with their name, never read in part", "[io][image]") {
    const Folder folder;
    const std::string png = make_png(8, 8, PngColor::rgb, std::string(24, 'x'));
    const std::string jpeg = stored_file("orange.jpg");
    const std::string cases[] = {"",
                                 "x",
                                 "P",
                                 std::string(1000, '\0'),
                                 "#?RADIANCE\n",
                                 "\x76\x2f\x31\x01",
                                 make_png(0, 8, PngColor::rgb, ""),
                                 make_png(2'000'000'000, 8, PngColor::rgb, "x")};
    for (const std::string& bytes : cases) {
        CAPTURE(bytes.size());
        CHECK_THROWS_AS(load_image(folder.write("bad.png", bytes)), FileError);
        CHECK_THROWS_AS(load_image_from_memory(std::as_bytes(std::span(bytes))), FileError);
    }
    for (const std::string& whole : {png, jpeg})
        for (std::size_t size = 0; size + 12 < whole.size(); size += 7) {
            CAPTURE(size);
            const std::string part = whole.substr(0, size);
            CHECK_THROWS_AS(load_image(folder.write("bad.png", part)), FileError);
            CHECK_THROWS_AS(load_image_from_memory(std::as_bytes(std::span(part))), FileError);
        }
    try {
        load_image_from_memory({}, Encoding::automatic, "the logo");
        FAIL("accepted");
    } catch (const FileError& error) {
        CHECK(error.path() == "the logo");
    }
}

}  // namespace limn::image_decoding_test
