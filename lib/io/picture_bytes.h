// What the checks of picture files share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace limn {

// Of `count` bytes, at most eight, from `place` on, all of which must be there.
inline std::uint64_t little_endian(std::span<const std::byte> bytes, std::size_t place, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(bytes[place + i]);
    return value;
}
inline std::uint64_t big_endian(std::span<const std::byte> bytes, std::size_t place, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | std::to_integer<std::uint64_t>(bytes[place + i]);
    return value;
}

inline std::string too_short_for(std::uint64_t width, std::uint64_t height) {
    return "it is too short for a picture of " + std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace limn
