// The environment map of a scene, and the tables for sampling directions towards it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bsdf/environment.h"
#include "limn/image/image.h"

namespace limn::flat {

// An equirectangular map. The pdf of a direction is proportional to the map's luminance, interpolated between the
// centres of pixels. Interpolation is linear in the angle along a row. Between rows it is linear in the cosine of the
// angle to the map's y axis, because solid angle is proportional to this cosine.
//
// h rows of pixels have h + 1 bands: h - 1 between the centres of neighbouring rows, and one from the first and the
// last row to each pole. In the bands at the poles the luminance equals that of the nearest row.
struct Environment {
    std::shared_ptr<const Image> image;
    pattern::MapAxes axes;
    double scale = 1;  // multiplies the radiance of the image

    // The tables are empty if the map is black.
    std::vector<double> row_luminance;        // sum of each row of pixels
    std::vector<double> band_cosine;          // cosine at the upper edge of each band; -1 at the end
    std::vector<double> band_before;          // integral over the bands above each band, and over all bands at the end
    std::vector<std::int32_t> column_before;  // width + 1 for each row: sum up to each pixel's centre, 0 to kWhole
    double luminance = 0;                     // integral of the luminance over all directions, without the scale

    // The integer that represents the sum of a whole row in `column_before`. The sums are rounded to 5e-10 of it.
    static constexpr std::int32_t kWhole = 0x7fffffff;

    // Returns true if directions can be sampled: if the map isn't black.
    bool is_sampled() const { return !band_before.empty(); }
};

}  // namespace limn::flat
