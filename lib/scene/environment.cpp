#include "limn/scene/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bsdf/environment.h"
#include "math/require.h"

namespace limn {

namespace {

// The largest error of the squared lengths and products of a rotation's columns, for products of several rotations.
constexpr double kRounding = 1e-9;

// Returns true if the matrix is a rotation, with or without a reflection.
bool turns_only(const Transform& m) {
    const pattern::MapAxes a = pattern::axes_of(m);
    const double off = std::max({std::abs(length_squared(a.x) - 1), std::abs(length_squared(a.y) - 1),
                                 std::abs(length_squared(a.z) - 1), std::abs(dot(a.x, a.y)), std::abs(dot(a.y, a.z)),
                                 std::abs(dot(a.z, a.x))});
    return off <= kRounding && m.translation() == Vec3{};
}

// Throws ArgumentError if a value is negative or not finite.
void check_pixels(const Image& image) {
    const std::span<const float> values = image.values();
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] >= 0 && values[i] <= std::numeric_limits<float>::max()) continue;
        const auto width = static_cast<std::size_t>(image.width()), pixel = i / 3;
        throw ArgumentError("EnvironmentMap: the pixel in column " + std::to_string(pixel % width) + ", row " +
                            std::to_string(pixel / width) + " is " +
                            (std::isnan(values[i]) ? "not a number"
                             : values[i] < 0       ? "negative"
                                                   : "infinite"));
    }
}

}  // namespace

EnvironmentMap::EnvironmentMap(std::shared_ptr<const Image> image, const Transform& world_from_map, double scale)
    : image_(std::move(image)), world_from_map_(world_from_map), scale_(scale) {
    require(image_ && !image_->empty(), "EnvironmentMap: there is no image");
    require(image_->values().size() / 3 < std::size_t{1} << 30, "EnvironmentMap: the image has 2^30 pixels or more");
    require(std::isfinite(scale) && scale >= 0, "EnvironmentMap: scale must be finite and not negative");
    require(is_finite(world_from_map) && turns_only(world_from_map),
            "EnvironmentMap: world_from_map must turn the map and do no more");
    check_pixels(*image_);
}

Color EnvironmentMap::radiance(const Vec3& direction) const {
    return pattern::map_radiance(*image_, scale_, pattern::map_uv(pattern::axes_of(world_from_map_), direction));
}

}  // namespace limn
