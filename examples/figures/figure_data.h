// Reads the data files of figures 1, 2, 7, 8 and 12.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/limn.h"

namespace limn::figures {

/// Returns the path of a data file. Its folder is the environment variable LIMN_FIGURE_DATA if that is set and not
/// empty, or else examples/figures/data in the source tree.
std::string data_file(const std::string& name);

/// A sphere of figures 1 and 2. It moves from center0 to center1 while the shutter is open.
struct BouncingSphere {
    Point3 center0, center1;
    double radius = 0;
    std::string material;  ///< "lambertian", "metal" or "dielectric"
    Color color;
    double parameter = 0;  ///< fuzz of metal, index of refraction of dielectric
};

/// Reads a heading and then a sphere from each line: cx0,cy0,cz0,cx1,cy1,cz1,radius,material,r,g,b,param.
/// \throws FileError that names the file, and the line if a line is wrong; also if there is no sphere
std::vector<BouncingSphere> read_bouncing_spheres(const std::string& path);

/// Reads 256 gradients, then 256 rows of the three permutations. A line that begins with '#' is a comment.
/// \throws FileError that names the file, and the line if a line is wrong; also if rows are missing or a column is not
/// a permutation of 0..255
std::shared_ptr<const PerlinLattice> read_perlin_lattice(const std::string& path);

}  // namespace limn::figures
