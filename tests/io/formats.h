// The formats that this build writes, and pictures to write.
#pragma once

#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "limn/image/image.h"

namespace limn::test {

inline std::vector<std::string> written_suffixes() {
#ifdef LIMN_WITH_OPENIMAGEIO
    return {".exr", ".png"};
#else
    return {".hdr", ".png"};
#endif
}

// Random values in [0, 1], so that no format can pack them.
inline Image noise(int width, int height, unsigned seed) {
    Image image(width, height);
    std::mt19937 generator(seed);
    for (float& v : image.values()) v = std::uniform_real_distribution<float>()(generator);
    return image;
}

inline std::uint32_t bits(float v) { return std::bit_cast<std::uint32_t>(v); }

}  // namespace limn::test
