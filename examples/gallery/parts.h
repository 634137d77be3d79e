// Models and shapes that several pictures of the gallery use.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/limn.h"

namespace limn::gallery {

/// The index of refraction of copper at 650, 550 and 450 nm (Johnson and Christy, Optical Constants of the Noble
/// Metals, Physical Review B 6, 1972).
inline constexpr ComplexIndex kCopper{{0.21, 1.04, 1.17}, {3.67, 2.59, 2.36}};

/// Returns a model of the folder examples/models. \throws FileError
Model load(const std::string& name);

/// Returns the mesh of knot.ply with smooth normals and the given material. \throws FileError
std::shared_ptr<const Mesh> knot(std::shared_ptr<const Material> material);

/// A point of a profile: its distance from the y axis and its height, in world units.
struct ProfilePoint {
    double radius = 0, height = 0;
};

/// Returns the surface of revolution of a profile about the y axis, with `steps` points around. Normals are smooth, but
/// for edges at which the surface turns by 40 degrees or more. If the profile is drawn to the right of the axis, the
/// outside is on the right of the way from its first to its last point.
MeshData lathe(const std::vector<ProfilePoint>& profile, int steps);

}  // namespace limn::gallery
