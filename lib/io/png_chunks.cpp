#include "io/png_chunks.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <string_view>

#include "io/picture_bytes.h"

namespace limn {

namespace {

// PNG specification (W3C, 2003), 5.2 and 5.3: eight bytes of signature, then chunks of length, type, data, CRC.
constexpr std::size_t kSignature = 8, kLengthAndType = 8, kCrc = 4, kHeaderData = 13;

std::string bytes_of(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}

// CRC-32 of ISO 3309 (PNG specification, 5.5), of one byte at the end of a remainder.
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

bool has_signature(std::span<const std::byte> file) {
    return file.size() >= kSignature && std::memcmp(file.data(), "\x89PNG\r\n\x1a\n", kSignature) == 0;
}

struct Chunk {
    std::string_view type;
    std::span<const std::byte> type_and_data;
    std::uint64_t stated_crc;
};

// Takes the next chunk off the front of `file`; none if it is not all there.
std::optional<Chunk> take_chunk(std::span<const std::byte>& file) {
    if (file.size() < kLengthAndType + kCrc) return std::nullopt;
    const std::uint64_t length = big_endian(file, 0, 4);
    if (length > file.size() - kLengthAndType - kCrc) return std::nullopt;
    const std::span<const std::byte> type_and_data = file.subspan(4, 4 + length);
    const Chunk chunk{
        {reinterpret_cast<const char*>(&file[4]), 4}, type_and_data, big_endian(file, kLengthAndType + length, kCrc)};
    file = file.subspan(kLengthAndType + length + kCrc);
    return chunk;
}

// The image header (11.2.2): width, height, depth, colour type, and three bytes of methods. `packed` is how many bytes
// of pixels there are: deflate makes at most 1032 bytes of one, and rows begin with a byte.
std::string header_fault(std::span<const std::byte> data, std::uint64_t packed) {
    if (data.size() != kHeaderData) return "its size is damaged";
    const std::uint64_t width = big_endian(data, 0, 4), height = big_endian(data, 4, 4);
    const std::uint64_t depth = big_endian(data, 8, 1), type = big_endian(data, 9, 1);
    constexpr std::uint64_t kChannels[] = {1, 0, 3, 1, 2, 0, 4}, kLargest = 0x7fffffff;
    if (width == 0 || height == 0) return "it has no pixels";
    if (width > kLargest || height > kLargest) return "its size is damaged";
    const bool is_known = type < std::size(kChannels) && kChannels[type] > 0;
    const bool is_depth = depth == 8 || (depth == 16 && type != 3) ||
                          ((depth == 1 || depth == 2 || depth == 4) && (type == 0 || type == 3));
    if (!is_known || !is_depth) return "its pixels are of no known kind";
    const double row = 1 + static_cast<double>(width * kChannels[type] * depth / 8);
    if (row * static_cast<double>(height) > 1032 * static_cast<double>(packed)) return too_short_for(width, height);
    return "";
}

}  // namespace

std::vector<PngChunk> png_header_chunks(std::span<const std::byte> file) {
    std::vector<PngChunk> chunks;
    if (!has_signature(file)) return chunks;
    file = file.subspan(kSignature);
    while (const auto chunk = take_chunk(file)) {
        if (chunk->type == "IDAT") break;
        const char* data = chunk->type.data() + 4;
        chunks.push_back({std::string(chunk->type), std::string(data, chunk->type_and_data.size() - 4)});
    }
    return chunks;
}

std::string png_fault(std::span<const std::byte> file) {
    if (!has_signature(file)) return "its signature is damaged";
    file = file.subspan(kSignature);
    std::span<const std::byte> header;
    std::uint64_t packed = 0;
    for (bool is_first = true;; is_first = false) {
        const auto chunk = take_chunk(file);
        if (!chunk) return "it breaks off before its end";
        if (crc(chunk->type_and_data) != chunk->stated_crc) return "a checksum is wrong";
        if (is_first != (chunk->type == "IHDR"))
            return is_first ? "it does not begin with its size" : "it has two sizes";
        if (is_first) header = chunk->type_and_data.subspan(4);
        if (chunk->type == "IDAT") packed += chunk->type_and_data.size() - 4;
        if (chunk->type == "IEND") return header_fault(header, packed);
    }
}

std::vector<std::byte> insert_png_chunks(std::span<const std::byte> file, const std::vector<PngChunk>& chunks) {
    std::string inserted;
    for (const PngChunk& chunk : chunks) {
        const std::string body = chunk.type + chunk.data;
        inserted += bytes_of(static_cast<std::uint32_t>(chunk.data.size())) + body +
                    bytes_of(crc(std::as_bytes(std::span(body))));
    }
    const auto* begin = reinterpret_cast<const std::byte*>(inserted.data());
    std::vector<std::byte> result(file.begin(), file.end());
    result.insert(result.begin() + kSignature + kLengthAndType + kHeaderData + kCrc, begin, begin + inserted.size());
    return result;
}

}  // namespace limn
