#include "io/png_chunks.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace limn {

namespace {

// PNG specification (W3C, 2003), 5.2 and 5.3: eight bytes of signature, then chunks of length, type, data, CRC.
constexpr std::size_t kSignature = 8, kLengthAndType = 8, kCrc = 4, kHeaderData = 13;

std::uint32_t big_endian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
    return value;
}

std::string big_endian(std::uint32_t value) {
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
    std::uint32_t stated_crc;
};

// Takes the next chunk off the front of `file`; none if it is not all there.
std::optional<Chunk> take_chunk(std::span<const std::byte>& file) {
    if (file.size() < kLengthAndType + kCrc) return std::nullopt;
    const std::uint32_t length = big_endian(file);
    if (length > file.size() - kLengthAndType - kCrc) return std::nullopt;
    const std::span<const std::byte> type_and_data = file.subspan(4, 4 + length);
    const Chunk chunk{
        {reinterpret_cast<const char*>(&file[4]), 4}, type_and_data, big_endian(file.subspan(kLengthAndType + length))};
    file = file.subspan(kLengthAndType + length + kCrc);
    return chunk;
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
    for (bool is_first = true;; is_first = false) {
        const auto chunk = take_chunk(file);
        if (!chunk) return "it breaks off before its end";
        if (crc(chunk->type_and_data) != chunk->stated_crc) return "a checksum is wrong";
        if (is_first && chunk->type != "IHDR") return "it does not begin with its size";
        if (chunk->type == "IEND") return "";
    }
}

std::vector<std::byte> insert_png_chunks(std::span<const std::byte> file, const std::vector<PngChunk>& chunks) {
    std::string inserted;
    for (const PngChunk& chunk : chunks) {
        const std::string body = chunk.type + chunk.data;
        inserted += big_endian(static_cast<std::uint32_t>(chunk.data.size())) + body +
                    big_endian(crc(std::as_bytes(std::span(body))));
    }
    const auto* begin = reinterpret_cast<const std::byte*>(inserted.data());
    std::vector<std::byte> result(file.begin(), file.end());
    result.insert(result.begin() + kSignature + kLengthAndType + kHeaderData + kCrc, begin, begin + inserted.size());
    return result;
}

}  // namespace limn
