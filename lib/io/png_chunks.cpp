#include <array>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "io/picture_checks.h"

namespace limn {

namespace {

// A PNG is a signature of eight bytes, followed by chunks. A chunk is a length, a type, data and a CRC (PNG
// specification, W3C, 2003, 5.2 and 5.3).
constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

// Returns a number as four bytes, big-endian.
std::string bytes_of(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}

// The table of CRC-32 (ISO 3309; PNG specification, 5.5): the remainder of each value of a byte.
constexpr std::array<std::uint32_t, 256> kCrcTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t remainder = byte;
        for (int bit = 0; bit < 8; ++bit) remainder = remainder >> 1 ^ (remainder & 1 ? 0xedb88320 : 0);
        table[byte] = remainder;
    }
    return table;
}();

std::uint32_t crc(std::span<const std::byte> bytes) {
    std::uint32_t remainder = 0xffffffff;
    for (const std::byte b : bytes)
        remainder = remainder >> 8 ^ kCrcTable[(remainder ^ std::to_integer<std::uint32_t>(b)) & 255];
    return ~remainder;
}

PngChunk take_chunk(Cursor& file) {
    const std::uint64_t length = file.big(4);
    const std::span<const std::byte> type_and_data = file.take(4 + length);
    const std::string_view text = text_of(type_and_data);
    return {text.substr(0, 4), text.substr(4), type_and_data, file.big(4)};
}

// Checks the image header (11.2.2): width, height, depth, colour type, and three bytes of methods. Checks that `packed`
// bytes of compressed pixels suffice for the picture. Deflate unpacks a byte to at most 1032 bytes, and each row begins
// with a byte for its filter. \throws Fault
void check_header(std::span<const std::byte> data, std::uint64_t packed) {
    demand(data.size() == 13, "its size is damaged");
    const std::uint64_t width = big_endian(data, 0, 4), height = big_endian(data, 4, 4);
    const std::uint64_t depth = big_endian(data, 8, 1), type = big_endian(data, 9, 1);
    constexpr std::uint64_t kChannels[] = {1, 0, 3, 1, 2, 0, 4}, kLargest = 0x7fffffff;
    demand(width > 0 && height > 0, kNoPixels);
    demand(width <= kLargest && height <= kLargest, "its size is damaged");
    const bool is_known = type < std::size(kChannels) && kChannels[type] > 0;
    const bool is_depth = depth == 8 || (depth == 16 && type != 3) ||
                          ((depth == 1 || depth == 2 || depth == 4) && (type == 0 || type == 3));
    demand(is_known && is_depth, "its pixels are of no known kind");
    const double row = 1 + static_cast<double>(width * kChannels[type] * depth / 8);
    demand(row * static_cast<double>(height) <= 1032 * static_cast<double>(packed), too_short_for(width, height));
}

}  // namespace

std::vector<PngChunk> png_header_chunks(std::span<const std::byte> file) {
    Cursor rest(file.subspan(kSignature.size()));
    std::vector<PngChunk> chunks{take_chunk(rest)};
    while (chunks.back().type != "IDAT") chunks.push_back(take_chunk(rest));
    return chunks;
}

void check_png(std::span<const std::byte> file) {
    demand(text_of(file).starts_with(kSignature), "its signature is damaged");
    Cursor rest(file.subspan(kSignature.size()));
    PngChunk header, chunk;
    std::uint64_t packed = 0;
    for (bool is_first = true; chunk.type != "IEND"; is_first = false) {
        chunk = take_chunk(rest);
        demand(crc(chunk.type_and_data) == chunk.stated_crc, "a checksum is wrong");
        demand(is_first == (chunk.type == "IHDR"), is_first ? "it does not begin with its size" : "it has two sizes");
        if (is_first) header = chunk;
        if (chunk.type == "IDAT") packed += chunk.data.size();
    }
    check_header(header.type_and_data.subspan(4), packed);
}

std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    return bytes_of(static_cast<std::uint32_t>(data.size())) + body + bytes_of(crc(std::as_bytes(std::span(body))));
}

}  // namespace limn
