#include "io/png_chunks.h"

#include <cstdint>
#include <cstring>

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

// CRC-32 of ISO 3309 (PNG specification, 5.5).
std::uint32_t crc(const std::string& bytes) {
    std::uint32_t remainder = 0xffffffff;
    for (const char c : bytes) {
        remainder ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) remainder = remainder >> 1 ^ (remainder & 1 ? 0xedb88320 : 0);
    }
    return ~remainder;
}

}  // namespace

std::vector<PngChunk> png_header_chunks(std::span<const std::byte> file) {
    std::vector<PngChunk> chunks;
    if (file.size() < kSignature || std::memcmp(file.data(), "\x89PNG\r\n\x1a\n", kSignature) != 0) return chunks;
    file = file.subspan(kSignature);
    while (file.size() >= kLengthAndType + kCrc) {
        const std::uint32_t length = big_endian(file);
        if (length > file.size() - kLengthAndType - kCrc) break;
        const char* type = reinterpret_cast<const char*>(&file[4]);
        if (std::memcmp(type, "IDAT", 4) == 0) break;
        chunks.push_back({std::string(type, 4), std::string(type + 4, length)});
        file = file.subspan(kLengthAndType + length + kCrc);
    }
    return chunks;
}

std::vector<std::byte> insert_png_chunks(std::span<const std::byte> file, const std::vector<PngChunk>& chunks) {
    std::string inserted;
    for (const PngChunk& chunk : chunks) {
        const std::string body = chunk.type + chunk.data;
        inserted += big_endian(static_cast<std::uint32_t>(chunk.data.size())) + body + big_endian(crc(body));
    }
    const auto* begin = reinterpret_cast<const std::byte*>(inserted.data());
    std::vector<std::byte> result(file.begin(), file.end());
    result.insert(result.begin() + kSignature + kLengthAndType + kHeaderData + kCrc, begin, begin + inserted.size());
    return result;
}

}  // namespace limn
