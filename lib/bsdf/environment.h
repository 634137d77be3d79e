// Lookup of radiance in an equirectangular map.
#pragma once

#include "limn/image/image.h"
#include "limn/math/transform.h"
#include "limn/math/vec.h"

namespace limn::pattern {

// The axes of a map in world space, of unit length. The centre of the map is at -z, and its upper edge is at +y.
struct MapAxes {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

// Returns the axes of a map. \pre the matrix is a rotation, with or without a reflection
inline MapAxes axes_of(const Transform& world_from_map) {
    const auto column = [&](std::size_t i) {
        return Vec3{world_from_map.rows[0][i], world_from_map.rows[1][i], world_from_map.rows[2][i]};
    };
    return {column(0), column(1), column(2)};
}

// Returns the map coordinates of a direction of any length. u points right and v up; both are in [0, 1].
Uv map_uv(const MapAxes& axes, const Vec3& direction);

// Returns the radiance of the map, interpolated bilinearly between the centres of pixels. The columns wrap around.
// Above the centres of the first row and below those of the last row, the radiance doesn't change with v.
Color map_radiance(const Image& image, double scale, const Uv& uv);

}  // namespace limn::pattern
