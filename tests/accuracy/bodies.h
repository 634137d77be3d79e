// Shapes and aims that several tables share.
#pragma once

#include <cstdio>
#include <string>

#include "accuracy/question.h"
#include "support/meshes.h"

namespace limn::accuracy {

// A name with a number in it.
inline std::string named(const char* text, double x, double y = 0) {
    char out[120];
    std::snprintf(out, sizeof out, text, x, y);
    return out;
}

inline Vec3 across(test::Random& random, const Vec3& along) { return normalize(cross(along, random.unit())); }

// A closed mesh of 20480 triangles around `center`: an icosphere of radius 1, or a star-shaped body with bumps and
// dents whose inside holds the ball of radius 0.5.
inline Geometry closed_mesh(bool bumpy, const Vec3& center) {
    Geometry g;
    g.mesh = test::icosphere(5);
    g.in_fours = true;
    for (Float3& p : g.mesh.vertices) {
        Vec3 v = to_point(p) - Point3{};
        if (bumpy) v = (1 + 0.15 * std::sin(7 * v.x + 2) * std::sin(9 * v.y) + 0.1 * std::sin(23 * v.z * v.x)) * v;
        p = test::to_float3(v + center);
    }
    return g;
}

}  // namespace limn::accuracy
