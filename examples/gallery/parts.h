// Parts that several pictures of the gallery use.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/limn.h"

namespace limn::gallery {

/// Copper at 650, 550 and 450 nm (Johnson and Christy, Optical Constants of the Noble Metals, Physical Review B 6,
/// 1972).
inline constexpr ComplexIndex kCopper{{0.21, 1.04, 1.17}, {3.67, 2.59, 2.36}};

/// A model of examples/models. \throws FileError
Model load(const std::string& name);

/// The only mesh of knot.ply, smooth, of this material.
std::shared_ptr<const Mesh> knot(std::shared_ptr<const Material> material);

struct ProfilePoint {
    double radius = 0, height = 0;
};

/// What a profile sweeps about the y axis, with edges where it turns by more than 40 degrees. Outside is to the right
/// of the way, seen with the axis at the left.
MeshData lathe(const std::vector<ProfilePoint>& profile, int steps);

}  // namespace limn::gallery
