/// \file
/// Environment maps: images of the light from all directions.
#pragma once

#include <memory>
#include <utility>

#include "limn/core/color.h"
#include "limn/core/transform.h"
#include "limn/core/vec.h"
#include "limn/image/image.h"

namespace limn {

/// Radiance from infinitely far away, as an equirectangular image has it, of any size and any width over height. The
/// upper edge of the image is +y, its middle -z, and +x is to the right of that: seen from inside it is not mirrored.
/// Between the centres of pixels it is interpolated; it goes on round the horizon. The path tracer samples it by its
/// luminance. Immutable, thread-safe.
///
/// Memory while a compiled scene holds it: the image, 12 bytes a pixel, and 4 bytes a pixel for sampling.
class EnvironmentMap {
public:
    /// \param image linear radiance
    /// \param world_from_map turns the map about the origin, as Transform::rotate_y does; it may mirror it too
    /// \param scale multiplies the radiance; finite, not negative
    /// \throws ArgumentError if the image is null or empty, has 2^30 pixels or more or one that is negative, infinite
    /// or NaN, which is named; the matrix does more than turn and mirror; the scale is impossible
    explicit EnvironmentMap(std::shared_ptr<const Image> image, const Transform& world_from_map = {}, double scale = 1);
    /// Takes an image that nothing else shares.
    explicit EnvironmentMap(Image image, const Transform& world_from_map = {}, double scale = 1)
        : EnvironmentMap(std::make_shared<const Image>(std::move(image)), world_from_map, scale) {}

    /// \param direction of any non-zero length, towards where the light comes from
    Color radiance(const Vec3& direction) const;

    const std::shared_ptr<const Image>& image() const { return image_; }  ///< not null
    const Transform& world_from_map() const { return world_from_map_; }   ///< without translation
    double scale() const { return scale_; }                               ///< of the radiance

private:
    std::shared_ptr<const Image> image_;
    Transform world_from_map_;
    double scale_;
};

}  // namespace limn
