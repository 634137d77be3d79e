/// \file
/// Environment maps: images of the radiance from all directions.
#pragma once

#include <memory>
#include <utility>

#include "limn/image/image.h"
#include "limn/math/color.h"
#include "limn/math/transform.h"
#include "limn/math/vec.h"

namespace limn {

/// Radiance from infinitely far away, given by an equirectangular image of any size and aspect ratio. Immutable,
/// thread-safe.
///
/// - The upper edge of the image is +y, its centre is -z, and +x is to the right of the centre. Seen from inside, the
///   image is not mirrored.
/// - Radiance is interpolated bilinearly between the centres of pixels. The left and the right edge are neighbours.
/// - The path tracer samples directions in proportion to the luminance.
/// - A compiled scene needs 16 bytes a pixel: 12 for the image and 4 for sampling.
class EnvironmentMap {
public:
    /// \param image linear radiance, in W / (sr m^2)
    /// \param world_from_map a rotation, for example Transform::rotate_y, or a rotation with a reflection
    /// \param scale factor of the radiance; finite, at least 0
    ///
    /// \throws ArgumentError if
    /// - the image is null or empty, or has 2^30 pixels or more
    /// - a pixel is negative, infinite or NaN; the message names the pixel
    /// - the matrix has a translation, or is neither a rotation nor a rotation with a reflection
    /// - the scale is negative or not finite
    explicit EnvironmentMap(std::shared_ptr<const Image> image, const Transform& world_from_map = {}, double scale = 1);
    /// Makes a map that owns its image. The parameters and errors are as above.
    explicit EnvironmentMap(Image image, const Transform& world_from_map = {}, double scale = 1)
        : EnvironmentMap(std::make_shared<const Image>(std::move(image)), world_from_map, scale) {}

    /// Returns the radiance from a direction.
    ///
    /// \param direction points away from the scene; of any length but zero
    Color radiance(const Vec3& direction) const;

    const std::shared_ptr<const Image>& image() const { return image_; }  ///< not null
    const Transform& world_from_map() const { return world_from_map_; }   ///< without translation
    double scale() const { return scale_; }                               ///< factor of the radiance

private:
    std::shared_ptr<const Image> image_;
    Transform world_from_map_;
    double scale_;
};

}  // namespace limn
