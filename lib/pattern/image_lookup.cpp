#include "pattern/image_lookup.h"

#include <algorithm>
#include <cmath>

namespace limn::pattern {

namespace {

// Brings a coordinate into [0, 1]; what is not a number, or an infinity with no place in a period, becomes 0.
double fold(double x, Wrap wrap) {
    if (x >= 0 && x <= 1) return x;
    if (wrap == Wrap::clamp) return std::fmin(std::fmax(x, 0), 1);
    if (wrap == Wrap::repeat) return std::fmax(x - std::floor(x), 0);
    const double in_period = std::abs(x) - 2 * std::floor(std::abs(x) / 2);  // of length 2: there and back
    return std::fmax(in_period <= 1 ? in_period : 2 - in_period, 0);
}

// The two texels around a position in a row or column, and the weight of the second.
struct Neighbours {
    int first, second;
    double weight;
};

// A texel's number is at its centre. Beyond the ends the image begins again, or the last texel goes on: a mirror image
// begins with it too. Positions are rounded to 2^-24 texels, as fine as the float32 of a texel can show, so that the
// centre of a texel gives that texel exactly although u W is rounded.
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
