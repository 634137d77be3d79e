// PNG files of any colour type, made without any library.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

namespace limn::test {

inline std::string big_endian(std::uint32_t v) {
    return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffff;
    for (const char c : type + data) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

// Makes the checksums of all chunks right again, so that damage reaches the decoder.
inline std::string with_checksums(const std::string& png) {
    std::string result = png.substr(0, 8);
    for (std::size_t i = 8; i + 12 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k) length = length << 8 | static_cast<std::uint8_t>(png[i + k]);
        length = std::min(length, png.size() - i - 12);
        result += png_chunk(png.substr(i + 4, 4), png.substr(i + 8, length));
        i += 12 + length;
    }
    return result;
}

enum class PngColor : char { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgb_alpha = 6 };

struct PngParts {
    std::uint32_t width = 1, height = 1;
    char bit_depth = 8;
    PngColor color = PngColor::rgb;
    char interlace = 0;    // 1: Adam7
    std::string data{};    // rows with their filter types before them, at most 65535 bytes
    std::string chunks{};  // that come before the data
};

inline std::string make_png(const PngParts& png) {
    std::uint32_t a = 1, b = 0;  // Adler-32
    for (const char c : png.data) {
        a = (a + static_cast<std::uint8_t>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint16_t>(png.data.size());
    const auto complement = static_cast<std::uint16_t>(~size);
    const std::string stored{1, static_cast<char>(size), static_cast<char>(size >> 8), static_cast<char>(complement),
                             static_cast<char>(complement >> 8)};
    const std::string header = big_endian(png.width) + big_endian(png.height) +
                               std::string{png.bit_depth, static_cast<char>(png.color), 0, 0, png.interlace};
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png.chunks +
           png_chunk("IDAT", "\x78\x01" + stored + png.data + big_endian(b << 16 | a)) + png_chunk("IEND", "");
}

// One row of pixels, whose bytes are `row`; `chunks` come before them.
inline std::string make_png(int width, char bit_depth, PngColor color, const std::string& row,
                            const std::string& chunks = "") {
    return make_png({.width = static_cast<std::uint32_t>(width),
                     .bit_depth = bit_depth,
                     .color = color,
                     .data = std::string(1, '\0') + row,  // filter type none
                     .chunks = chunks});
}

}  // namespace limn::test
