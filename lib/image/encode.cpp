#include "limn/image/encode.h"

#include <algorithm>
#include <cmath>

#include "limn/math/error.h"

namespace limn {

namespace {

// Returns a value in 8 bits. It is clamped to [0, 1], and halves are rounded up, as other writers do. NaN becomes 0.
std::uint8_t to_byte(double encoded) {
    const double clamped = encoded > 0 ? std::min(encoded, 1.0) : 0;
    return static_cast<std::uint8_t>(std::floor(255 * clamped + 0.5));
}

}  // namespace

std::vector<std::uint8_t> encode_srgb8(const Image& image, double exposure, std::span<const float> alpha) {
    const std::span<const float> values = image.values();
    if (!std::isfinite(exposure)) throw ArgumentError("encode_srgb8: the exposure must be finite");
    if (!alpha.empty() && 3 * alpha.size() != values.size())
        throw ArgumentError("encode_srgb8: alpha does not have one value for each pixel");
    const double gain = std::exp2(exposure);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(values.size() + alpha.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double opaque = alpha.empty() ? 1 : static_cast<double>(alpha[i / 3]);
        const double colour = opaque > 0 ? gain * static_cast<double>(values[i]) / opaque : 0;
        bytes.push_back(to_byte(srgb_encode(std::min(colour, 1.0))));
        if (!alpha.empty() && i % 3 == 2) bytes.push_back(to_byte(opaque));
    }
    return bytes;
}

}  // namespace limn
