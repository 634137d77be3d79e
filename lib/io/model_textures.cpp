#include "io/model_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "limn/math/vec.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/material/metallic_roughness.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"

namespace limn {

namespace {

// Returns an image of the size of `like` with the pixels color(x, y).
template <class Function>
Image made(const Image& like, const Function& color) {
    Image image(like.width(), like.height());
    for (int y = 0; y < like.height(); ++y)
        for (int x = 0; x < like.width(); ++x) image.set(x, y, color(x, y));
    return image;
}

// Returns a value clamped to [0, largest]; 0 for NaN.
double clamped(double value, double largest) { return value > 0 ? std::min(value, largest) : 0; }

double mean(const Color& c) { return (c.r + c.g + c.b) / 3; }

// Convert between texels and normals: a component in [-1, 1] is stored in [0, 1].
Vec3 vector_of(const Color& texel) { return {2 * texel.r - 1, 2 * texel.g - 1, 2 * texel.b - 1}; }

Color texel_of(const Vec3& normal) {
    const Vec3 n = normalize(normal);
    return is_finite(n) ? Color{0.5 + 0.5 * n.x, 0.5 + 0.5 * n.y, 0.5 + 0.5 * n.z} : Color{0.5, 0.5, 1};
}

}  // namespace

Image scaled(const Image& picture, const Color& factor, double largest) {
    return made(picture, [&](int x, int y) {
        const Color c = factor * picture.at(x, y);
        return Color{clamped(c.r, largest), clamped(c.g, largest), clamped(c.b, largest)};
    });
}

Image grey(const Image& picture) {
    return made(picture, [&](int x, int y) {
        const double value = clamped(mean(picture.at(x, y)), 1);
        return Color{value, value, value};
    });
}

Image scaled_normals(const Image& normals, double scale) {
    return made(normals, [&](int x, int y) {
        const Vec3 n = vector_of(normals.at(x, y));
        return texel_of({scale * n.x, scale * n.y, n.z});
    });
}

Image normals_of_heights(const Image& heights, double scale) {
    const auto height = [&](int x, int y) {
        const int width = heights.width(), rows = heights.height();
        return mean(heights.at((x + width) % width, (y + rows) % rows));
    };
    return made(heights, [&](int x, int y) {
        // Take central differences. v grows upward, but rows go downward.
        const double along = height(x + 1, y) - height(x - 1, y);
        const double up = height(x, y - 1) - height(x, y + 1);
        return texel_of({-0.5 * scale * along, -0.5 * scale * up, 1});
    });
}

bool holds_normals(const Image& picture) {
    double vectors = 0, pixels = 0;
    Color sum;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const Color c = picture.at(x, y);
            if (c.b > 0.5 && std::abs(length(vector_of(c)) - 1) < 0.1) ++vectors;
            sum += c;
            ++pixels;
        }
    return vectors >= 0.9 * pixels && sum.b > std::max(sum.r, sum.g) + 0.1 * pixels;
}

std::shared_ptr<const Material> metallic_roughness_material(std::shared_ptr<const Texture> base_color, double metallic,
                                                            double roughness, double index) {
    // An index of 1 makes a coat that reflects nothing.
    if (metallic == 0 && index == 1) return std::make_shared<Lambertian>(std::move(base_color));
    if (metallic == 0) return std::make_shared<Plastic>(std::move(base_color), roughness, index);
    if (metallic == 1) return std::make_shared<RoughConductor>(std::move(base_color), roughness);
    return std::make_shared<MetallicRoughness>(std::move(base_color), metallic, roughness, index);
}

}  // namespace limn
