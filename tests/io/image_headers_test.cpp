// No decoder is handed a file whose format was not told by its contents and whose header was not checked: decoders
// believe what a header says, and take memory for it, or write beyond their arrays.
#include "io/file_kind.h"
#include "io/picture_checks.h"
#include "judge_image.h"
#include "make_png.h"
#include "peak_memory.h"
#include "picture_bytes.h"

namespace limn::image_headers_test {

using namespace test;

namespace {

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + zeros(1) + type + zeros(1) + little_endian(static_cast<std::uint32_t>(value.size()), 4) + value;
}

std::string window(std::uint32_t width, std::uint32_t height) {
    return attribute("dataWindow", "box2i", zeros(8) + little_endian(width - 1, 4) + little_endian(height - 1, 4));
}

std::string tiles(std::uint32_t width, std::uint32_t height, char mode) {
    return attribute("tiles", "tiledesc", little_endian(width, 4) + little_endian(height, 4) + mode);
}

std::string packed_by(char compression) { return attribute("compression", "compression", std::string(1, compression)); }

// One channel with a value for each `step`-th pixel.
std::string channel(std::uint32_t type, std::uint32_t step) {
    return attribute(
        "channels", "chlist",
        "Y" + zeros(1) + little_endian(type, 4) + zeros(4) + little_endian(step, 4) + little_endian(1, 4) + zeros(1));
}
const std::string kGreyFloat = channel(2, 1);

// `flags` stand above the version: 2 tiled, 8 deep, 16 in parts. Behind the header as many zeros as are asked for.
std::string exr(const std::string& attributes, char flags = 0, std::size_t behind = 64) {
    return "\x76\x2f\x31\x01\x02" + std::string(1, flags) + zeros(2) + attributes + zeros(1) + zeros(behind);
}

std::string fault_of(const std::string& file) try {
    check_exr(std::as_bytes(std::span(file)));
    return "";
} catch (const Fault& fault) {
    return fault.text;
}

}  // namespace

#ifdef LIMN_WITH_OPENIMAGEIO
TEST_CASE("Image headers: an EXR attribute that claims 1.8 GB takes no memory", "[io][image]") {
    const std::string beginning = exr("", 0, 0).substr(0, 8);
    for (const char* type : {"string", "no such type"}) {
        const std::string file =
            beginning + "notes" + zeros(1) + type + zeros(1) + little_endian(1'800'000'000, 4) + std::string(50, 'x');
        check_memory(64 * 1024,
                     [&] { check(load_from_file(file), "is not a whole EXR: an attribute is larger than the file"); });
    }
}
#endif

TEST_CASE("Image headers: an EXR's sizes are held against its file", "[io][image]") {
    const std::string plain = kGreyFloat + packed_by(0);
    const std::string size_of_2_tiles = window(2, 1) + plain;
    const std::string short_text = "it is too short for a picture of ";
    CHECK(fault_of(exr(plain + window(2, 3))).empty());
    const std::pair<std::string, std::string> rows[] = {
        {exr(plain + window(20'000, 3000)), short_text + "20000 x 3000"},
        {exr(plain + window(1, 0x7fffffff)), short_text + "1 x 2147483647"},
        {exr(plain + window(1, 5)), "it is too short for its 5 chunks"},
        {exr(kGreyFloat + packed_by(9) + window(4'000'000, 1)), short_text},  // a chunk has 256 lines
        {exr(plain + window(0, 1)), "it has no pixels"},
        {exr(channel(3, 1) + packed_by(0) + window(1, 1)), "a channel is of no known kind"},
        {exr(channel(2, 2) + packed_by(0) + window(1, 1)), "a channel is not there for every pixel"},
        {exr(plain), "its header lacks an attribute"},
        {exr(packed_by(0) + window(1, 1)), "its header lacks an attribute"},
        {exr(kGreyFloat + packed_by(10) + window(1, 1)), "it is packed in an unknown way"},
        {exr(plain + window(1, 1) + window(1, 1)), "an attribute stands there twice"},
        {exr(plain + attribute("dataWindow", "box2i", zeros(12))), "an attribute has the wrong size"},
        {exr(plain + window(1, 1) +
             attribute("preview", "preview", little_endian(40'000, 4) + little_endian(40'000, 4))),
         "an attribute has the wrong size"},
        {exr(plain + window(1, 1) + attribute("names", "stringvector", little_endian(1'000'000'000, 4) + "x")),
         "its header breaks off"},
        {exr(plain + window(1, 1) + attribute("ids", "idmanifest", little_endian(0xffffffff, 4) + "x")),
         "an attribute has the wrong size"},
        {exr(plain + window(1, 1) + attribute(std::string(256, 'a'), "int", zeros(4))),
         "a name in its header is too long"},
        {exr(plain + window(1, 1), 32), "its version is unknown"},
        {exr(plain + window(1, 1), 8), "it is not a flat picture"},
        {exr(size_of_2_tiles, 2), "its header lacks an attribute"},
        {exr(size_of_2_tiles + tiles(64, 64, 0), 2), ""},
        {exr(size_of_2_tiles + tiles(1, 1, 1), 2), ""},  // levels of 2 x 1 and 1 x 1
        {exr(size_of_2_tiles + tiles(1, 1, 1), 2, 47), "it is too short for its 3 chunks"},
        {exr(size_of_2_tiles + tiles(50'000, 50'000, 0), 2), short_text},
        {exr(size_of_2_tiles + tiles(0, 1, 0), 2), "its tiles are of no known kind"},
        {exr(size_of_2_tiles + tiles(1, 1, 3), 2), "its tiles are of no known kind"},
        {exr(plain + window(1024, 1024) + tiles(1, 1, 2), 2, 1 << 22), "it is too short for its 4190209 chunks"},
        {exr(size_of_2_tiles, 16), "a part is of no known kind"},
        {exr(size_of_2_tiles + attribute("type", "string", "scanlineimage"), 16), ""},
        {exr(size_of_2_tiles + attribute("type", "string", "deepscanline"), 16), "it is not a flat picture"},
        {exr(size_of_2_tiles + attribute("type", "string", "scanlineimage") + zeros(1) + plain + window(1, 9) +
                 attribute("type", "string", "scanlineimage"),
             16),
         "it is too short for its 10 chunks"},
    };
    for (const auto& [file, fault] : rows) {
        CAPTURE(fault, fault_of(file));
        CHECK(fault_of(file).starts_with(fault));
        CHECK(fault_of(file).empty() == fault.empty());
    }
}

TEST_CASE("Image headers: wherever an EXR's header breaks off, it is told", "[io][image]") {
    const std::string whole = stored_file("images/tiled.exr");
    REQUIRE(fault_of(whole).empty());
    const std::size_t end = whole.find("tiles") + 24;
    for (std::size_t size = 4; size < end; ++size) CHECK_FALSE(fault_of(whole.substr(0, size)).empty());
}

// A table of 4080 codes makes stb write beyond its array.
TEST_CASE("Image headers: a JPEG behind one more 0xff reaches no decoder", "[io][image]") {
    const std::string plain = stored_file("orange.jpg");
    for (const std::string& file : {plain, changed(plain, plain.find("\xff\xc4") + 5, std::string(16, '\xff'))}) {
        check(load_from_file("\xff" + file), "is not a readable image");
        check(load_from_memory("\xff" + file), "is not a readable image");
    }
}

TEST_CASE("Image headers: a JPEG's markers are found where its decoders find them", "[io][image]") {
    const std::string plain = stored_file("orange.jpg"), broken = "is not a whole JPEG: ";
    const std::size_t scan = plain.find("\xff\xda"), table = plain.find("\xff\xc4"), frame = plain.find("\xff\xc0");
    const std::string bad_table = "\xff\xc4" + std::string("\0\x13\0", 3) + std::string(16, '\xff');
    // In a scan 0xff 0xff 0 is a byte of data, not the beginning of a segment that might hide the next.
    check(load_from_memory(plain.substr(0, scan + 14) + std::string("\xff\xff\0\x40", 4) + bad_table + "\xff\xd9"),
          broken + "a Huffman table is damaged");
    const std::string large_table = "\xff\xc4\x01\x14" + zeros(15) + "\x02\xff" + zeros(257);  // one code too many
    check(load_from_memory(plain.substr(0, table) + large_table + plain.substr(table)),
          broken + "a Huffman table is damaged");
    check(load_from_memory(plain.substr(0, table) + "\xff\xd0" + plain.substr(table)), broken + "there is a marker");
    check(load_from_memory(plain.substr(0, table) + "\xff\xd8" + plain.substr(table)), broken + "there is a marker");
    check(load_from_memory(plain.substr(0, frame) + plain.substr(frame, 19) + plain.substr(frame)),
          broken + "it has two");
    check(load_from_memory(plain.substr(0, frame) + plain.substr(scan)), broken + "it has pixels before");
}

TEST_CASE("Image headers: what is no picture that limn reads is named, and so are those that it reads", "[io][image]") {
    const std::pair<std::string, std::string> rows[] = {
        {"GIF89a" + zeros(20), "a GIF picture"},
        {"II*" + zeros(20), "a TIFF picture"},
        {"RIFF" + zeros(4) + "WEBPVP8L", "a WebP picture"},
        {"8BPS" + zeros(20), "a Photoshop picture"},
        {"P6 1 1 255\nxxx", "a PNM picture"},
        {zeros(4) + "ftypavif", "an AVIF picture"},
        {zeros(3) + "\x1c" + "ftypheic", "a HEIF picture"},
        {zeros(3) + "\x0c" + "JXL \r\n", "a JPEG XL picture"},
        {zeros(3) + "\x0c" + "jP  \r\n", "a JPEG 2000 picture"},
        {"<svg/>", "an SVG picture"},
        {"\xff\xfe" + std::string("v\0 \0", 4), "UTF-16 text"},
        {"ply\nformat ascii 1.0\n", "a PLY model"},
        {"PK\3\4" + zeros(20), "a ZIP archive"},
        {"", "an empty file"},
    };
    for (const auto& [file, kind] : rows) {
        const std::string message = "is not a readable image: it appears to be " + kind +
                                    "; those that are read are EXR, PNG, JPEG, HDR, BMP, TGA";
        check(load_from_file(file), message);
        check(load_from_memory(file), message);
    }
    check(load_from_file("text"), "is not a readable image: those that are read are EXR");
}

TEST_CASE("Image headers: a picture that is larger than its file can hold is refused by its header", "[io][image]") {
    const std::string colours(40, 'x');
    const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    const std::pair<std::string, std::string> rows[] = {
        {make_png({.width = 4000, .height = 4000, .data = colours}), "is too short for a picture of 4000 x 4000"},
        {hdr + "-Y 1000 +X 1000\n" + colours, "is not a whole HDR: it breaks off"},
        {hdr + "-Y 1 +X 1 \n" + colours, "is not a whole HDR: the line with its size"},
        {"#?RADIANC\n" + colours, "is not a whole HDR: "},
        {bmp(100, 100, colours), "is not a whole BMP: it breaks off"},
        {changed(bmp(1, 1, colours), 14, little_endian(41, 4)), "is not a whole BMP: its header is of no known kind"},
        {changed(bmp(1, 1, colours), 30, little_endian(1, 4)), "is not a whole BMP: it is packed"},
        {changed(bmp(1, 1, colours), 10, little_endian(20, 4)), "is not a whole BMP: its pixels begin in its header"},
        {tga(100, 100, colours), "is not a whole TGA: it breaks off"},
        {changed(tga(1000, 1000, colours), 2, "\x0a"), "is not a whole TGA: it breaks off"},  // packed
    };
    for (const auto& [file, message] : rows) {
        check(load_from_file(file), message);
        check(load_from_memory(file), message);
    }
}

TEST_CASE("Image headers: a palette's last pixel on a TGA's last byte is there", "[io][image]") {
    const std::string header = zeros(1) + "\1\1" + zeros(2) + little_endian(2, 2) + "\x18" + zeros(4) +
                               little_endian(2, 2) + little_endian(1, 2) + "\x08\x20";
    check(load_from_memory(header + zeros(3) + "\x1a\x66\xcc" + "\1" + zeros(1)), Loads{2, 1, {0.8, 0.4, 0.1}});
    check(load_from_memory(header + zeros(3) + "\x1a\x66\xcc" + "\1"), "breaks off");
}

}  // namespace limn::image_headers_test
