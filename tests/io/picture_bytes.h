// Pieces of picture files for tests that break them.
#pragma once

#include <cstdint>
#include <string>

namespace limn::test {

inline std::string zeros(std::size_t count) { return std::string(count, '\0'); }

inline std::string changed(std::string bytes, std::size_t place, const std::string& to) {
    return bytes.replace(place, to.size(), to);
}

inline std::string little_endian(std::uint32_t v, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(v >> 8 * i);
    return text;
}

// 24 bits, rows from the bottom, padded to four bytes.
inline std::string bmp(std::uint32_t width, std::uint32_t height, const std::string& data) {
    return "BM" + little_endian(54 + static_cast<std::uint32_t>(data.size()), 4) + zeros(4) + little_endian(54, 4) +
           little_endian(40, 4) + little_endian(width, 4) + little_endian(height, 4) + little_endian(1, 2) +
           little_endian(24, 2) + zeros(24) + data;
}

inline std::string tga(std::uint32_t width, std::uint32_t height, const std::string& data) {
    return zeros(2) + "\2" + zeros(9) + little_endian(width, 2) + little_endian(height, 2) + "\x18\x20" + data;
}

}  // namespace limn::test
