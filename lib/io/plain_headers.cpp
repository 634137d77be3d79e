#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

#include "io/picture_checks.h"

namespace limn {

namespace {

constexpr std::uint64_t kLargestSide = 1 << 24;  // the largest width and height that stb reads

bool is_one_of(std::uint64_t value, std::initializer_list<std::uint64_t> values) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

// Removes `key` and the number that follows from the front of `line`, and returns the number; 0 if there is none.
std::uint64_t take_size(std::string_view& line, std::string_view key) {
    if (!line.starts_with(key)) return 0;
    line.remove_prefix(key.size());
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    return error == std::errc{} ? value : 0;
}

// Removes a line from the front of `text` and returns it without its end. Throws a Fault if it has no end.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    demand(end != std::string_view::npos, "its header breaks off");
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    return line;
}

}  // namespace

// The header of an HDR is lines of text up to an empty one, and a line with the size; rows of pixels follow (Ward, Real
// Pixels, Graphics Gems II, 1991).
void check_hdr(std::span<const std::byte> file) {
    // Read the header.
    std::string_view rest = text_of(file), line = take_line(rest);
    demand(line == "#?RADIANCE" || line == "#?RGBE", "its first line is damaged");
    bool is_rgbe = false;
    while (!(line = take_line(rest)).empty()) is_rgbe = is_rgbe || line == "FORMAT=32-bit_rle_rgbe";
    demand(is_rgbe, "its format is not 32-bit_rle_rgbe");
    line = take_line(rest);
    const std::uint64_t height = take_size(line, "-Y "), width = take_size(line, " +X ");
    demand(line.empty() && width > 0 && height > 0, "the line with its size is not '-Y rows +X columns'");
    demand(width <= kLargestSide && height <= kLargestSide, "it is too large");
    // Compute the least size of a row. A row is stored with four bytes a pixel or packed. A packed one has a mark of
    // four bytes and four channels, each in runs of at most 127 pixels that take two bytes.
    const bool is_packed = width >= 8 && width < 32768;
    const std::uint64_t row = is_packed ? std::min(4 * width, 4 + 8 * ((width + 126) / 127)) : 4 * width;
    demand(row * height <= rest.size(), kBreaksOff);
}

// A BMP begins with a BITMAPFILEHEADER of 14 bytes and one of five headers, which differ in size.
void check_bmp(std::span<const std::byte> file) {
    // Read the fields. A header of 12 bytes has 16-bit sizes and no compression.
    demand(file.size() >= 26, kBreaksOff);
    const std::uint64_t pixels = little_endian(file, 10, 4), header = little_endian(file, 14, 4);
    demand(is_one_of(header, {12, 40, 56, 108, 124}), "its header is of no known kind");
    const bool is_short = header == 12;
    demand(is_short || file.size() >= 54, kBreaksOff);
    const std::uint64_t width = little_endian(file, 18, is_short ? 2 : 4);
    const auto signed_height = static_cast<std::int32_t>(little_endian(file, is_short ? 20 : 22, is_short ? 2 : 4));
    const auto height = static_cast<std::uint64_t>(std::abs(std::int64_t{signed_height}));
    const std::uint64_t depth = little_endian(file, is_short ? 24 : 28, 2);
    const std::uint64_t compression = is_short ? 0 : little_endian(file, 30, 4);
    // Check their values, and that the file holds all rows. A row is padded to a multiple of four bytes.
    demand(width > 0 && height > 0, kNoPixels);
    demand(width <= kLargestSide && height <= kLargestSide, "it is too large");
    demand(is_one_of(depth, {1, 4, 8, 16, 24, 32}), "its pixels are of no known kind");
    demand(is_one_of(compression, {0, 3}), "it is packed, which is not read");
    demand(pixels >= 14 + header, "its pixels begin in its header");
    demand(pixels + (width * depth + 31) / 32 * 4 * height <= file.size(), kBreaksOff);
}

bool looks_like_pnm(std::span<const std::byte> file) {
    const std::string_view text = text_of(file);
    return text.size() > 2 && text[0] == 'P' && text[1] >= '1' && text[1] <= '7' &&
           (text[2] == '\n' || text[2] == ' ' || text[2] == '\r');
}

// A TGA is a header of 18 bytes, a text, a palette and pixels (Truevision TGA File Format Specification, version 2.0,
// 1991).
bool looks_like_tga(std::span<const std::byte> file) {
    if (file.size() < 18) return false;
    const std::uint64_t has_palette = little_endian(file, 1, 1), type = little_endian(file, 2, 1);
    const std::uint64_t palette_depth = little_endian(file, 7, 1), depth = little_endian(file, 16, 1);
    const bool is_indexed = type == 1 || type == 9;
    return has_palette <= 1 && is_one_of(type, {1, 2, 3, 9, 10, 11}) && (has_palette == 1 || !is_indexed) &&
           (has_palette == 0 || is_one_of(palette_depth, {8, 15, 16, 24, 32})) &&
           is_one_of(depth, {8, 15, 16, 24, 32}) && (!is_indexed || depth <= 16) && little_endian(file, 17, 1) < 64;
}

void check_tga(std::span<const std::byte> file) {
    demand(looks_like_tga(file), "its header is damaged");
    const auto bytes = [&file](std::size_t place) { return (little_endian(file, place, 1) + 7) / 8; };
    const std::uint64_t palette = little_endian(file, 1, 1) * little_endian(file, 5, 2) * bytes(7);
    const std::uint64_t before = 18 + little_endian(file, 0, 1) + palette;
    const std::uint64_t pixels = little_endian(file, 12, 2) * little_endian(file, 14, 2);
    demand(pixels > 0, kNoPixels);
    const bool is_packed = little_endian(file, 2, 1) >= 9;  // runs have at most 128 pixels
    const std::uint64_t data = is_packed ? (pixels + 127) / 128 * (1 + bytes(16)) : pixels * bytes(16);
    demand(before + data <= file.size(), kBreaksOff);
}

}  // namespace limn
