// The light around the scene as an equirectangular map, and the tables by which directions are drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "limn/image/image.h"
#include "pattern/environment.h"

namespace limn::flat {

// The density of a direction is its luminance, interpolated like the map between the centres of pixels: along a row
// with the angle, between rows with the cosine of the angle to the map's y axis, by which solid angle goes. Between h
// rows of centres and to the poles there are h + 1 bands; the first and the last have one row on both sides.
struct Environment {
    std::shared_ptr<const Image> image;  // null: there is none
    pattern::MapAxes axes;
    double scale = 1;

    // Empty where all is black.
    std::vector<double> row_luminance;        // sum of each row of pixels
    std::vector<double> band_cosine;          // at the upper edge of each band, and -1
    std::vector<double> band_before;          // sums up to the upper edge of each band, and of all
    std::vector<std::int32_t> column_before;  // of each row, up to each pixel and of all: 0 to kWhole
    double luminance = 0;                     // integral over all directions, without the scale

    // What the sums of a row are rounded to: 5e-10 of the row.
    static constexpr std::int32_t kWhole = 0x7fffffff;

    bool is_sampled() const { return !band_before.empty(); }
};

}  // namespace limn::flat
