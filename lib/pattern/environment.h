// The radiance of an equirectangular map.
#pragma once

#include "limn/core/transform.h"
#include "limn/core/vec.h"
#include "limn/image/image.h"

namespace limn::pattern {

// The axes of a map in world space, unit: its middle is at -z, its upper edge at +y.
struct MapAxes {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

// \pre the matrix turns and mirrors only
inline MapAxes axes_of(const Transform& world_from_map) {
    const auto column = [&](std::size_t i) {
        return Vec3{world_from_map.rows[0][i], world_from_map.rows[1][i], world_from_map.rows[2][i]};
    };
    return {column(0), column(1), column(2)};
}

// Where a direction of any length lies in a map: u to the right and v upward, in [0, 1].
Uv map_uv(const MapAxes& axes, const Vec3& direction);

// Interpolated between the centres of pixels: round the horizon, and from the first and last row on to the poles alike.
Color map_radiance(const Image& image, double scale, const Uv& uv);

}  // namespace limn::pattern
