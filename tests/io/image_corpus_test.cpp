// Odd and broken pictures, and what load_image and load_image_from_memory make of them.
#include <limits>
#include <variant>

#include "formats.h"
#include "io/image_checks.h"
#include "judge_image.h"
#include "make_png.h"
#include "peak_memory.h"
#include "picture_bytes.h"

namespace limn::image_corpus_test {

using namespace test;

namespace {

const Color kOrange{0.8, 0.4, 0.1}, kGrey{128 / 255.0, 128 / 255.0, 128 / 255.0};
const std::string kOrangeBytes = "\xcc\x66\x1a";

std::string png(std::uint32_t width, std::uint32_t height, const std::string& row = "") {
    std::string data;
    for (std::uint32_t y = 0; y < height && !row.empty(); ++y) data += zeros(1) + row;
    return make_png({.width = width, .height = height, .data = data});
}

// With `data` behind the header: mantissas for red, green, blue, and an exponent.
std::string hdr(const std::string& size, const std::string& data,
                const std::string& header = "FORMAT=32-bit_rle_rgbe\n") {
    return "#?RADIANCE\n" + header + "\n" + size + "\n" + data;
}
const std::string kOrangeRgbe = "\xcc\x66\x1a\x80";

const std::string kOrangeBgr = "\x1a\x66\xcc";

struct Row {
    const char* what;
    std::string bytes;
    std::variant<Loads, std::string> verdict;
};

template <std::size_t N>
void judge(const Row (&rows)[N]) {
    for (const Row& row : rows) {
        CAPTURE(row.what);
        std::visit([&](const auto& expected) { check(load_from_file(row.bytes), expected); }, row.verdict);
        std::visit([&](const auto& expected) { check(load_from_memory(row.bytes), expected); }, row.verdict);
    }
}

}  // namespace

TEST_CASE("Image corpus: a PNG loads with its colours if it is valid, else it is refused", "[io][image]") {
    const std::string plain = png(2, 3, kOrangeBytes + kOrangeBytes), broken = "is not a whole PNG: ";
    const std::string header = plain.substr(8, 25), data = plain.substr(33, plain.size() - 45),
                      end = png_chunk("IEND", "");
    const std::string signature = plain.substr(0, 8);
    const auto one = [](PngColor color, char depth, const std::string& pixel, const std::string& chunks = "") {
        return make_png(1, depth, color, pixel, chunks);
    };
    const Row rows[] = {
        {"RGB", plain, Loads{2, 3, kOrange}},
        {"a column", png(1, 5, kOrangeBytes), Loads{1, 5, kOrange}},
        {"16 bits", one(PngColor::rgb, 16, "\xcc\xcc\x66\x66\x1a\x1a"), Loads{1, 1, kOrange}},
        {"grey", one(PngColor::grey, 8, "\x80"), Loads{1, 1, kGrey}},
        {"grey of 1 bit", one(PngColor::grey, 1, "\x80"), Loads{1, 1, {1, 1, 1}}},
        {"grey of 4 bits", one(PngColor::grey, 4, "\x80"), Loads{1, 1, {8 / 15.0, 8 / 15.0, 8 / 15.0}}},
        {"grey and alpha", one(PngColor::grey_alpha, 8, "\x80\x10"), Loads{1, 1, kGrey}},
        {"RGBA", one(PngColor::rgb_alpha, 8, kOrangeBytes + "\x10"), Loads{1, 1, kOrange}},
        {"palette", one(PngColor::palette, 8, "\1", png_chunk("PLTE", zeros(3) + kOrangeBytes)), Loads{1, 1, kOrange}},
        {"palette with alpha",
         one(PngColor::palette, 8, "\1", png_chunk("PLTE", zeros(3) + kOrangeBytes) + png_chunk("tRNS", "\xff\x10")),
         Loads{1, 1, kOrange}},
        {"interlaced", make_png({.width = 2, .interlace = 1, .data = zeros(1) + kOrangeBytes + zeros(1) + "\1\2\3"}),
         Loads{2, 1, kOrange}},
        {"unknown chunk", one(PngColor::rgb, 8, kOrangeBytes, png_chunk("liMn", "x")), Loads{1, 1, kOrange}},
        {"more behind its end", plain + "and so on", Loads{2, 3, kOrange}},
        {"no colour type", one(static_cast<PngColor>(5), 8, "xxx"), ""},
        {"no such depth", one(PngColor::rgb, 3, "xxx"), ""},
        {"palette missing", one(PngColor::palette, 8, "\1"), ""},
        {"palette of 4 bytes", one(PngColor::palette, 8, "\1", png_chunk("PLTE", "xxxx")), ""},
        {"wrong checksum of the size", changed(plain, 29, "xxxx"), broken + "a checksum is wrong"},
        {"wrong checksum of the pixels", changed(plain, plain.size() - 16, "xxxx"), broken + "a checksum is wrong"},
        {"wrong sum within the pixels", signature + header + png_chunk("IDAT", "\x78\x01\3\0\0\0\0\1") + end, ""},
        {"no pixels", signature + header + end, ""},
        {"pixels of two rows less", signature + header + png(2, 1, kOrangeBytes + kOrangeBytes).substr(33), ""},
        {"size twice", signature + header + header + data + end, ""},
        {"size missing", signature + data + end, broken + "it does not begin with its size"},
        {"no end", signature + header + data, broken + "it breaks off"},
        {"chunk of 4 GB", signature + header + "\xff\xff\xff\xffIDAT" + data, broken + "it breaks off"},
        {"signature of a text transfer", changed(plain, 4, "\n\n\x1a\n"), broken + "its signature is damaged"},
        {"no columns", png(0, 3), ""},
        {"no rows", png(3, 0), ""},
        {"2^31 columns", png(0x80000000, 1), ""},
        {"2^31 - 1 rows", png(1, 0x7fffffff, ""), ""},
        {"2^31 - 1 squared", png(0x7fffffff, 0x7fffffff, ""), ""},
        {"50000 squared", png(50000, 50000, ""), ""},
        {"65536 squared", png(65536, 65536, ""), ""},
    };
    judge(rows);
}

TEST_CASE("Image corpus: a JPEG loads with its colours if it is valid, else it is refused", "[io][image]") {
    const std::string plain = stored_file("orange.jpg"), broken = "is not a whole JPEG: ";
    const std::string cut = broken + "it breaks off";
    const std::size_t table = plain.find("\xff\xc4");  // length, name, then the numbers of codes
    const std::size_t frame = plain.find("\xff\xc0");  // length, precision, then height and width
    REQUIRE(frame != std::string::npos);
    const Row rows[] = {
        {"RGB", plain, Loads{8, 8, kOrange}},
        {"grey", stored_file("images/grey.jpg"), Loads{8, 8, kGrey}},
        {"progressive", stored_file("images/progressive.jpg"), Loads{8, 8, kOrange}},
        {"CMYK", stored_file("images/cmyk.jpg"), Loads{8, 8, kOrange}},
        {"more behind its end", plain + "and so on", Loads{8, 8, kOrange}},
        {"only its mark", "\xff\xd8", cut},
        {"only its mark and end", "\xff\xd8\xff\xd9", broken + "it has no pixels"},
        {"a table of 4080 codes", changed(plain, table + 5, std::string(16, '\xff')), broken + "a Huffman table"},
        {"a table longer than its segment", changed(plain, table + 2, std::string("\0\x13", 2)), broken},
        {"a byte between segments", plain.substr(0, table) + "x" + plain.substr(table), broken + "there is no marker"},
        {"fill bytes between segments", plain.substr(0, table) + "\xff\xff" + plain.substr(table),
         Loads{8, 8, kOrange}},
        {"no pixels", plain.substr(0, plain.find("\xff\xda")) + "\xff\xd9", ""},
        {"no columns", changed(plain, frame + 7, zeros(2)), ""},
        {"65500 squared", changed(plain, frame + 5, "\xff\xdc\xff\xdc"), "is too short for a picture of 65500 x 65500"},
        {"12 bits", changed(plain, frame + 4, "\x0c"), ""},
        {"200 components", changed(plain, frame + 9, "\xc8"), ""},
    };
    judge(rows);
}

TEST_CASE("Image corpus: an HDR, BMP or TGA loads if it is valid; it and files of other kinds are refused otherwise",
          "[io][image]") {
    std::string packed = {2, 2, 0, 9};  // nine columns, packed by channel
    for (const char c : kOrangeRgbe) packed += std::string{static_cast<char>(128 + 9), c};
    const std::string one = "-Y 1 +X 1", cut = "breaks off before its end";
    const Row rows[] = {
        {"HDR", hdr(one, kOrangeRgbe), Loads{1, 1, {204 / 256.0, 102 / 256.0, 26 / 256.0}}},
        {"HDR, packed", hdr("-Y 1 +X 9", packed), Loads{9, 1, {204 / 256.0, 102 / 256.0, 26 / 256.0}}},
        {"HDR, a column", hdr("-Y 3 +X 1", kOrangeRgbe + kOrangeRgbe + kOrangeRgbe), Loads{1, 3, {0.8, 0.4, 0.1}}},
        {"HDR, no pixels", hdr(one, ""), ""},
        {"HDR, a pixel less", hdr("-Y 1 +X 2", kOrangeRgbe), ""},
        {"HDR, packed row breaks off", hdr("-Y 1 +X 9", packed.substr(0, 7)), ""},
        {"HDR, packed over the row's end", hdr("-Y 1 +X 9", changed(packed, 4, "\xff")), ""},
        {"HDR, 2^31 columns", hdr("-Y 1 +X 2147483648", kOrangeRgbe), ""},
        {"HDR, 50000 squared", hdr("-Y 50000 +X 50000", kOrangeRgbe), ""},
        {"HDR, no columns", hdr("-Y 1 +X 0", kOrangeRgbe), ""},
        {"HDR, negative", hdr("-Y -1 +X 1", kOrangeRgbe), ""},
        {"HDR, words as size", hdr("-Y one +X two", kOrangeRgbe), ""},
        {"HDR, no format", hdr(one, kOrangeRgbe, "EXPOSURE=1\n"), ""},
        {"HDR, only its mark", "#?RADIANCE", ""},
        {"HDR, header without end", "#?RADIANCE\n" + std::string(5000, 'x'), ""},
        {"BMP", bmp(1, 2, kOrangeBgr + zeros(1) + kOrangeBgr + zeros(1)), Loads{1, 2, kOrange}},
        {"BMP, a row less", bmp(1, 2, kOrangeBgr + zeros(1)), cut},
        {"BMP, no columns", bmp(0, 1, kOrangeBgr), ""},
        {"BMP, 50000 squared", bmp(50000, 50000, kOrangeBgr), ""},
        {"BMP, only its mark", "BM", ""},
        {"TGA", tga(2, 1, kOrangeBgr + kOrangeBgr), Loads{2, 1, kOrange}},
        {"TGA, a pixel less", tga(2, 1, kOrangeBgr), cut},
        {"TGA, 65535 squared", tga(65535, 65535, kOrangeBgr), ""},
        {"empty", "", ""},
        {"a byte", "x", ""},
        {"text", "This is not a picture, whatever its name says.\n", "is not a readable image"},
        {"zeros", zeros(5000), ""},
        {"PPM", "P6 1 1 255\n" + kOrangeBytes, "is not a readable image"},
        {"GIF", "GIF89a\1\0\1\0\x80\0\0" + zeros(20), "is not a readable image"},
        {"TIFF", "II*\0" + zeros(100), "is not a readable image"},
        {"WebP", "RIFF\x1a\0\0\0WEBPVP8L" + zeros(20), "is not a readable image"},
        {"SVG", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>", "is not a readable image"},
    };
    judge(rows);
}

#ifdef LIMN_WITH_OPENIMAGEIO

TEST_CASE("Image corpus: an EXR loads with its colours if it is valid, else it is refused", "[io][image]") {
    const std::string plain = stored_file("images/rgba.exr"), attribute = zeros(1) + "box2i" + zeros(1);
    const std::size_t window = plain.find("dataWindow" + attribute) + 21;  // x and y of both corners
    REQUIRE(plain.find("dataWindow" + attribute) != std::string::npos);
    const auto with_corner = [&](std::uint32_t x, std::uint32_t y) {
        return changed(plain, window + 8, little_endian(x, 4) + little_endian(y, 4));
    };
    const Color color{0.5, 0.25, 0.125}, half{0.5, 0.5, 0.5};
    const std::pair<const char*, std::variant<Loads, std::string>> stored[] = {
        {"rgba", Loads{2, 3, color}},  {"grey", Loads{2, 3, half}},  {"two_channels", Loads{2, 3, half}},
        {"tiled", Loads{2, 3, color}}, {"uint", Loads{2, 3, color}}, {"window", Loads{2, 3, color}}};
    for (const auto& [name, verdict] : stored) {
        CAPTURE(name);
        const std::string bytes = stored_file("images/" + std::string(name) + ".exr");
        std::visit([&](const auto& expected) { check(load_from_file(bytes), expected); }, verdict);
        std::visit([&](const auto& expected) { check(load_from_memory(bytes), expected); }, verdict);
    }
    const std::pair<const char*, std::string> broken[] = {
        {"only its mark", plain.substr(0, 4)},
        {"another version", changed(plain, 4, "\x7f")},
        {"said to have parts", changed(plain, 5, "\x10")},
        {"no columns", with_corner(0xffffffff, 2)},
        {"40 rows more", with_corner(1, 42)},
        {"2^31 - 1 columns", with_corner(0x7fffffff, 2)},
        {"2^31 - 1 rows", with_corner(1, 0x7fffffff)},
        {"2^31 - 2 squared", with_corner(0x7ffffffe, 0x7ffffffe)},
        {"50000 squared", with_corner(49999, 49999)},
        {"upside down", with_corner(1, 0x80000000)},
        {"no such packing", changed(plain, plain.find("compression") + 28, "\x63")},
        {"no channels", changed(plain, plain.find("chlist") + 11, zeros(1))},
        {"a chunk far behind its end",
         changed(plain, plain.find("screenWindowWidth") + 33, zeros(5) + "\1" + zeros(2))},
    };
    for (const auto& [what, bytes] : broken) {
        CAPTURE(what);
        check(load_from_file(bytes), "");
        check(load_from_memory(bytes), "");
    }
}

#endif

TEST_CASE("Image corpus: sizes that a header only claims take no memory", "[io][image]") {
    check_memory(1 << 20, [] {
        for (const std::string& bytes :
             {png(50000, 50000, ""), png(60000, 12000, ""), png(0x7fffffff, 1), bmp(20000, 20000, "x"),
              hdr("-Y 30000 +X 30000", "xxxx"), tga(65535, 65535, "x")}) {
            check(load_from_file(bytes), "");
            check(load_from_memory(bytes), "");
        }
    });
}

TEST_CASE("Image corpus: a picture is read only where the file can hold it and the machine too", "[io][image]") {
    constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();
    constexpr int kLargest = std::numeric_limits<int>::max();
    CHECK_NOTHROW(require_possible_size(1, 1, 1, 1, "a"));
    CHECK_NOTHROW(require_possible_size(4096, 4096, 3, 1, "a"));             // under a gibibyte
    CHECK_NOTHROW(require_possible_size(10'000, 9'000, 3, 1'080'000, "a"));  // 1.08e9 bytes, 1000 to 1
    CHECK_THROWS_WITH(require_possible_size(50'000, 50'000, 3, 5'999'999, "a"),
                      "a: is too short for a picture of 50000 x 50000");
    CHECK_THROWS_WITH(require_possible_size(kLargest, kLargest, 3, kAnySize, "a"),
                      "a: there is not enough memory for its 2147483647 x 2147483647 pixels");
    CHECK_THROWS_AS(require_possible_size(0, 1, 3, 100, "a"), FileError);
    CHECK_THROWS_AS(require_possible_size(1, -1, 3, 100, "a"), FileError);
}

}  // namespace limn::image_corpus_test
