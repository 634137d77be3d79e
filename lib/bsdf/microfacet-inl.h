// A surface of microfacets with the distribution of Trowbridge and Reitz (GGX) and the masking of Smith (Heitz,
// Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014). The include guard is per
// target, as Highway requires.
#if defined(LIMN_BSDF_MICROFACET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_BSDF_MICROFACET_INL_H
#undef LIMN_BSDF_MICROFACET_INL_H
#else
#define LIMN_BSDF_MICROFACET_INL_H
#endif

#include "limn/math/math.h"
#include "math/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::bsdf::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// All directions are in the frame of the surface. z is the normal; x and y are the axes of the two roughnesses.
template <class N>
struct Microsurface {
    N alpha_x, alpha_y;

    // Returns the length of w after a stretch that gives the surface the roughness 1. Smith's Lambda is
    // (stretched(w) / cos - 1) / 2.
    HWY_INLINE N stretched(const Vector<N>& w) const {
        const N x = alpha_x * w.x, y = alpha_y * w.y;
        return sqrt(x * x + y * y + w.z * w.z);
    }
    // Returns the density of normals m, per solid angle and projected area (Heitz, equation 85).
    HWY_INLINE N density(const Vector<N>& m) const {
        const N x = m.x / alpha_x, y = m.y / alpha_y, squared = x * x + y * y + m.z * m.z;
        return 1.0 / (kPi * alpha_x * alpha_y * squared * squared);
    }
    // Returns G2 / (4 cos_o cos_i) for directions on the same side. G2 takes into account that the heights of facets
    // are correlated (Heitz, equation 99).
    HWY_INLINE N masking_over_cosines(const Vector<N>& out, const Vector<N>& in) const {
        return 0.5 / (stretched(out) * in.z + stretched(in) * out.z);
    }
    // Returns f |cos| of facets that reflect all light. m is the normal that mirrors `out` to `in`.
    HWY_INLINE N scattered_once(const Vector<N>& out, const Vector<N>& in, const Vector<N>& m) const {
        return density(m) * masking_over_cosines(out, in) * max(in.z, 0.0);
    }
    // Returns Smith's G1. It depends on |cos|.
    HWY_INLINE N masking(const Vector<N>& w) const {
        const N cosine = abs(w.z);
        return 2.0 * cosine / (cosine + stretched(w));
    }

    // Draws a normal in proportion to its area that is visible from `out`, from the uniform numbers u and v. The mirror
    // directions of a surface of roughness 1 fill a cap of the sphere evenly (Dupuy and Benyoub, Sampling Visible GGX
    // Normals with Spherical Caps, CGF 42(8), 2023). A `bound` below 1 makes the cap smaller. \pre out.z > 0
    HWY_INLINE Vector<N> visible_normal(const Vector<N>& out, N u, N v, N bound) const {
        const Vector<N> from = normalize(Vector<N>{alpha_x * out.x, alpha_y * out.y, out.z});
        const N z = (1.0 - v) * (1.0 + bound * from.z) - bound * from.z;
        const N sine = sqrt(max(1.0 - z * z, 0.0));
        const SineCosine<N> phi = sine_cosine_of_turns(u);
        const Vector<N> half = {sine * phi.cosine + from.x, sine * phi.sine + from.y, z + from.z};
        return normalize(Vector<N>{alpha_x * half.x, alpha_y * half.y, half.z});
    }
    // Returns the pdf of that normal per solid angle, for a `bound` of 1.
    HWY_INLINE N visible_normal_pdf(const Vector<N>& out, const Vector<N>& m) const {
        return density(m) * max(dot(out, m), 0.0) * 2.0 / (out.z + stretched(out));
    }

    // Returns the `bound` of the cap that excludes most of the mirror directions below the surface (Eto and Tokuyoshi,
    // Bounded VNDF Sampling for Smith-GGX Reflections, SIGGRAPH Asia 2023 Technical Communications, equations 5 and 6).
    HWY_INLINE N bound(const Vector<N>& out) const {
        const N a = min(min(alpha_x, alpha_y), 1.0), s = 1.0 + sqrt(out.x * out.x + out.y * out.y);
        return (1.0 - a * a) * s * s / (s * s + a * a * out.z * out.z);
    }
    // Draws the mirror direction of a visible normal, with that bound.
    HWY_INLINE Vector<N> mirrored(const Vector<N>& out, N u, N v) const {
        const Vector<N> m = visible_normal(out, u, v, bound(out));
        return (2.0 * dot(out, m)) * m - out;
    }
    // Returns the pdf of that direction per solid angle. m is the normal.
    HWY_INLINE N mirrored_pdf(const Vector<N>& out, const Vector<N>& m) const {
        return density(m) / (2.0 * (bound(out) * out.z + stretched(out)));
    }
};

}  // namespace limn::bsdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
