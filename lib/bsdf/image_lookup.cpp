#include "bsdf/image_lookup.h"

#include <algorithm>
#include <cmath>

namespace limn::pattern {

namespace {

// Maps a coordinate to [0, 1]. NaN becomes 0. An infinity becomes 0 too, unless it's clamped.
double fold(double x, Wrap wrap) {
    if (x >= 0 && x <= 1) return x;
    if (wrap == Wrap::clamp) return std::fmin(std::fmax(x, 0), 1);
    if (wrap == Wrap::repeat) return std::fmax(x - std::floor(x), 0);
    const double in_period = std::abs(x) - 2 * std::floor(std::abs(x) / 2);  // in [0, 2): the second half is mirrored
    return std::fmax(in_period <= 1 ? in_period : 2 - in_period, 0);
}

// The two texels next to a position in a row or column, and the interpolation weight of the second.
struct Neighbours {
    int first, second;
    double weight;
};

// Returns the neighbours of a folded coordinate among `size` texels. A texel's value is at its centre. Beyond the ends
// the image is repeated or its last texel continues; the latter is right for a mirrored image too. Positions are
// rounded to 2^-24 texels, the resolution of a float32 texel. The centre of a texel then gives that texel exactly,
// although u W is rounded.
Neighbours neighbours(double folded, int size, Wrap wrap) {
    const double x = std::nearbyint((folded * size - 0.5) * 0x1p24) * 0x1p-24;
    const double below = std::floor(x);
    const auto inside = [&](int i) { return wrap == Wrap::repeat ? (i + size) % size : std::clamp(i, 0, size - 1); };
    const int i = static_cast<int>(below);
    return {inside(i), inside(i + 1), x - below};
}

int nearest(double folded, int size) { return std::min(static_cast<int>(folded * size), size - 1); }

Color mix(const Color& a, const Color& b, double weight) { return (1 - weight) * a + weight * b; }

}  // namespace

Color lookup_image(const Image& image, const Uv& uv, Filter filter, Wrap wrap_u, Wrap wrap_v) {
    const double right = fold(uv.u, wrap_u), down = 1 - fold(uv.v, wrap_v);
    if (filter == Filter::nearest) return image.at(nearest(right, image.width()), nearest(down, image.height()));
    const Neighbours x = neighbours(right, image.width(), wrap_u), y = neighbours(down, image.height(), wrap_v);
    return mix(mix(image.at(x.first, y.first), image.at(x.second, y.first), x.weight),
               mix(image.at(x.first, y.second), image.at(x.second, y.second), x.weight), y.weight);
}

}  // namespace limn::pattern
