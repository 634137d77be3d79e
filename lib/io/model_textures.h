// What the pictures and numbers of models' materials become.
#pragma once

#include <memory>

#include "limn/image/image.h"
#include "limn/material/material.h"

namespace limn {

// Times a colour, between 0 and `largest`; NaN becomes 0.
Image scaled(const Image& picture, const Color& factor, double largest);

// The mean of red, green and blue, between 0 and 1.
Image grey(const Image& picture);

// Normals as NormalMap has them, whose coordinates along the surface are multiplied by `scale`.
Image scaled_normals(const Image& normals, double scale);

// Of heights, which are the mean of red, green and blue: where they differ by 1 from one texel to the next, the slope
// is `scale`. They go on around the edges.
Image normals_of_heights(const Image& heights, double scale);

// Whether a picture holds normals and no heights: it is bluish, and nine of ten texels are vectors of length 1 that
// point outward.
bool holds_normals(const Image& picture);

// Plastic without metal, RoughConductor of nothing else, MetallicRoughness between. \param metallic,roughness in [0, 1]
// \param index at least 1
std::shared_ptr<const Material> metallic_roughness_material(std::shared_ptr<const Texture> base_color, double metallic,
                                                            double roughness, double index);

}  // namespace limn
