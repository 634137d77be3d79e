// The data files of figures 1, 2, 7, 8 and 12.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/limn.h"

namespace limn::figures {

/// The path of a data file: in the folder that the environment variable LIMN_FIGURE_DATA names, else in the source
/// tree.
std::string data_file(const std::string& name);

/// One small sphere of figures 1 and 2; it moves from center0 to center1 over the shutter.
struct BouncingSphere {
    Point3 center0, center1;
    double radius = 0;
    std::string material;  ///< lambertian, metal or dielectric
    Color color;
    double parameter = 0;  ///< metal: fuzz; dielectric: index of refraction
};

/// Reads lines of cx0,cy0,cz0,cx1,cy1,cz1,radius,material,r,g,b,param after a heading.
/// \throws FileError naming file and line: unreadable, malformed, no sphere
std::vector<BouncingSphere> read_bouncing_spheres(const std::string& path);

/// Reads 256 gradients, then 256 rows of the three permutations; '#' begins a comment line.
/// \throws FileError naming file and line: unreadable, malformed, too short or long, not permutations of 0..255
std::shared_ptr<const PerlinLattice> read_perlin_lattice(const std::string& path);

}  // namespace limn::figures
