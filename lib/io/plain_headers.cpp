#include "io/plain_headers.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "io/picture_bytes.h"

namespace limn {

namespace {

constexpr const char* kBreaksOff = "it breaks off before its end";
constexpr const char* kNoPixels = "it has no pixels";
constexpr std::uint64_t kLargestSide = 1 << 24;  // stb's

bool is_one_of(std::uint64_t value, std::initializer_list<std::uint64_t> values) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

// Takes a number behind `key` off the front of `line`; 0 if there is none.
std::uint64_t take_size(std::string_view& line, std::string_view key) {
    if (!line.starts_with(key)) return 0;
    line.remove_prefix(key.size());
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    return error == std::errc{} ? value : 0;
}

}  // namespace

// Ward, Real Pixels, Graphics Gems II, 1991: lines up to an empty one, a line with the size, then rows.
std::string hdr_fault(std::span<const std::byte> file) {
    std::string_view rest(reinterpret_cast<const char*>(file.data()), file.size());
    bool is_rgbe = false;
    for (bool is_first = true;; is_first = false) {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) return "its header breaks off";
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        if (is_first && line != "#?RADIANCE" && line != "#?RGBE") return "its first line is damaged";
        if (line.empty()) break;
        if (line == "FORMAT=32-bit_rle_rgbe") is_rgbe = true;
    }
    if (!is_rgbe) return "its format is not 32-bit_rle_rgbe";
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return "its header breaks off";
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    const std::uint64_t height = take_size(line, "-Y "), width = take_size(line, " +X ");
    if (!line.empty() || width == 0 || height == 0) return "the line with its size is not '-Y rows +X columns'";
    if (width > kLargestSide || height > kLargestSide) return "it is too large";
    // Four bytes a pixel, or rows that are packed: a mark of four bytes, then four channels in runs of at most 127.
    const bool is_packed = width >= 8 && width < 32768;
    const std::uint64_t row = is_packed ? std::min(4 * width, 4 + 8 * ((width + 126) / 127)) : 4 * width;
    return row * height > rest.size() ? kBreaksOff : "";
}

// BITMAPFILEHEADER, then one of five headers, told apart by their size.
std::string bmp_fault(std::span<const std::byte> file) {
    if (file.size() < 26) return kBreaksOff;
    const std::uint64_t pixels = little_endian(file, 10, 4), header = little_endian(file, 14, 4);
    if (!is_one_of(header, {12, 40, 56, 108, 124})) return "its header is of no known kind";
    const bool is_short = header == 12;
    if (!is_short && file.size() < 54) return kBreaksOff;
    const std::uint64_t width = little_endian(file, 18, is_short ? 2 : 4);
    const auto signed_height = static_cast<std::int32_t>(little_endian(file, is_short ? 20 : 22, is_short ? 2 : 4));
    const auto height = static_cast<std::uint64_t>(signed_height < 0 ? -std::int64_t{signed_height} : signed_height);
    const std::uint64_t depth = little_endian(file, is_short ? 24 : 28, 2);
    const std::uint64_t compression = is_short ? 0 : little_endian(file, 30, 4);
    if (width == 0 || height == 0) return kNoPixels;
    if (width > kLargestSide || height > kLargestSide) return "it is too large";
    if (!is_one_of(depth, {1, 4, 8, 16, 24, 32})) return "its pixels are of no known kind";
    if (!is_one_of(compression, {0, 3})) return "it is packed, which is not read";
    const std::uint64_t row = (width * depth + 31) / 32 * 4;
    if (pixels < 14 + header) return "its pixels begin in its header";
    return pixels > file.size() || row * height > file.size() - pixels ? kBreaksOff : "";
}

// Truevision TGA File Format Specification, version 2.0, 1991: 18 bytes, a text, a palette, pixels.
bool looks_like_tga(std::span<const std::byte> file) {
    if (file.size() < 18) return false;
    const std::uint64_t has_palette = little_endian(file, 1, 1), type = little_endian(file, 2, 1);
    const std::uint64_t palette_depth = little_endian(file, 7, 1), depth = little_endian(file, 16, 1);
    const bool is_indexed = type == 1 || type == 9;
    return has_palette <= 1 && is_one_of(type, {1, 2, 3, 9, 10, 11}) && (has_palette == 1 || !is_indexed) &&
           (has_palette == 0 || is_one_of(palette_depth, {8, 15, 16, 24, 32})) &&
           is_one_of(depth, {8, 15, 16, 24, 32}) && (!is_indexed || depth <= 16) && little_endian(file, 17, 1) < 64;
}

std::string tga_fault(std::span<const std::byte> file) {
    if (!looks_like_tga(file)) return "its header is damaged";
    const auto bytes = [&file](std::size_t place) { return (little_endian(file, place, 1) + 7) / 8; };
    const std::uint64_t palette = little_endian(file, 1, 1) * little_endian(file, 5, 2) * bytes(7);
    const std::uint64_t before = 18 + little_endian(file, 0, 1) + palette;
    const std::uint64_t pixels = little_endian(file, 12, 2) * little_endian(file, 14, 2);
    if (pixels == 0) return kNoPixels;
    const bool is_packed = little_endian(file, 2, 1) >= 9;  // in runs of at most 128
    const std::uint64_t data = is_packed ? (pixels + 127) / 128 * (1 + bytes(16)) : pixels * bytes(16);
    return before > file.size() || data > file.size() - before ? kBreaksOff : "";
}

}  // namespace limn
