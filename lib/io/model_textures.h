// Converts the pictures and parameters of the materials in model files.
#pragma once

#include <memory>

#include "limn/image/image.h"
#include "limn/scene/material/material.h"

namespace limn {

// Returns the picture multiplied by a colour and clamped to [0, largest]. NaN becomes 0.
Image scaled(const Image& picture, const Color& factor, double largest);

// Returns the mean of red, green and blue, clamped to [0, 1], in all three channels.
Image grey(const Image& picture);

// Returns a normal map, encoded as NormalMap needs it, with the tangential components multiplied by `scale`.
Image scaled_normals(const Image& normals, double scale);

// Converts a height map into a normal map. The height of a texel is the mean of red, green and blue. Where heights
// differ by 1 from one texel to the next, the slope is `scale`. The map is continued periodically at its edges.
Image normals_of_heights(const Image& heights, double scale);

// Returns true if a picture appears to be a normal map and not a height map: blue prevails, and at least nine of ten
// texels are vectors of about length 1 that point outward.
bool holds_normals(const Image& picture);

// Returns the simplest material for the parameters: Plastic (Lambertian if the index is 1) if metallic is 0,
// RoughConductor if it is 1, and MetallicRoughness between.
// \param metallic,roughness in [0, 1]
// \param index refractive index, at least 1
std::shared_ptr<const Material> metallic_roughness_material(std::shared_ptr<const Texture> base_color, double metallic,
                                                            double roughness, double index);

}  // namespace limn
