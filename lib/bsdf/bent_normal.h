// Normals that a texture bends, and what lobes around them reflect below the surface.
#pragma once

#include <cmath>

#include "limn/math/surface.h"

namespace limn::bsdf {

// `texel` from 0 to 1 are the coordinates from -1 to 1 along dp_du, across towards dp_dv, and along the shading normal
// of the outward side. Turned into view: at least this cosine with `out`.
inline Normal3 bent_normal(const Surface& s, const Vec3& out, const Color& texel) {
    constexpr double kLeastCosine = 1e-3;
    const Vec3 n(s.shading_normal), along = s.dp_du - dot(s.dp_du, n) * n;
    const double side = s.front_face ? 1 : -1;
    Vec3 bent = n;
    if (length_squared(along) > 1e-12 * length_squared(s.dp_du)) {
        const Vec3 x = normalize(along), left = cross(n, x), y = dot(left, s.dp_dv) < 0 ? -left : left;
        bent = normalize(side * ((2 * texel.r - 1) * x + (2 * texel.g - 1) * y) + std::abs(2 * texel.b - 1) * n);
        if (!is_finite(bent)) bent = n;
    }
    const double cosine = dot(bent, out);
    return Normal3(cosine < kLeastCosine ? normalize(bent + (kLeastCosine - cosine) * out) : bent);
}

// The tangent facet beside a bent one reflects what goes below the surface back (Schüssler et al., Microfacet-based
// Normal Mapping for Robust Monte Carlo Path Tracing, SIGGRAPH Asia 2017, section 3.3).
inline Vec3 mirrored_at(const Normal3& surface, const Vec3& in) { return in - (2 * dot(in, surface)) * Vec3(surface); }
inline bool is_below(const Normal3& surface, const Vec3& in) { return !(dot(in, surface) > 0); }

}  // namespace limn::bsdf
