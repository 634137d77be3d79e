// Normals that a texture bends, and the mirroring of light that is reflected below the surface.
#pragma once

#include <cmath>

#include "limn/math/surface.h"

namespace limn::bsdf {

// Returns the bent shading normal. The components of `texel` in [0, 1] are mapped to coordinates in [-1, 1]: along
// dp_du, perpendicular to it towards dp_dv, and along the shading normal of the outward side. A bent normal whose
// cosine with `out` is below kLeastCosine is turned towards `out`, to about this cosine or a larger one.
inline Normal3 bent_normal(const Surface& s, const Vec3& out, const Color& texel) {
    constexpr double kLeastCosine = 1e-3;  // so large that rounding doesn't put the viewer below the surface
    const Vec3 n(s.shading_normal), along = s.dp_du - dot(s.dp_du, n) * n;
    const double side = s.front_face ? 1 : -1;
    Vec3 bent = n;
    // Cancellation leaves an error of 2^-52 |dp_du| in `along`: relative to its length at most 1e-9.
    if (length_squared(along) > 1e-12 * length_squared(s.dp_du)) {
        const Vec3 x = normalize(along), left = cross(n, x);
        const Vec3 y = dot(left, s.dp_dv) < 0 ? -left : left;
        bent = normalize(side * ((2 * texel.r - 1) * x + (2 * texel.g - 1) * y) + std::abs(2 * texel.b - 1) * n);
        if (!is_finite(bent)) bent = n;
    }
    const double cosine = dot(bent, out);
    return Normal3(cosine < kLeastCosine ? normalize(bent + (kLeastCosine - cosine) * out) : bent);
}

// Beside a bent facet there is a tangent facet. It mirrors light that the bent facet reflects below the geometric
// surface (Schüssler et al., Microfacet-based Normal Mapping for Robust Monte Carlo Path Tracing, SIGGRAPH Asia 2017,
// section 3.3). These return the mirrored direction, and true for directions below the surface.
inline Vec3 mirrored_at(const Normal3& surface, const Vec3& in) { return in - (2 * dot(in, surface)) * Vec3(surface); }
inline bool is_below(const Normal3& surface, const Vec3& in) { return !(dot(in, surface) > 0); }

}  // namespace limn::bsdf
