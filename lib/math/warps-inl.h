// Maps from the unit square or cube to directions and points, and their pdfs. limn/math/warp.h and Frame are the same
// functions for one sample. The include guard is per target, as Highway requires.
#if defined(LIMN_MATH_WARPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_WARPS_INL_H
#undef LIMN_MATH_WARPS_INL_H
#else
#define LIMN_MATH_WARPS_INL_H
#endif

#include "math/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// Returns a uniform point of the unit disc in the plane z = 0, with pdf 1 / pi per area. This is the concentric map:
// squares around the centre become circles, and each of the four triangles between the diagonals of the square becomes
// a quarter of the disc.
template <class N>
HWY_INLINE Vector<N> uniform_disc(N u, N v) {
    const N a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    const Mask<N> wide = abs(a) > abs(b);
    const N radius = select(wide, a, b), other = select(wide, b, a);
    const N ratio = select(radius == 0.0, 0.0, other / radius);
    // Sine and cosine of phi if `wide`, else of pi / 2 - phi.
    const SineCosine<N> s = sine_cosine_near_zero<N>(kPi / 4 * ratio);
    return {radius * select(wide, s.cosine, s.sine), radius * select(wide, s.sine, s.cosine), 0.0};
}

// Returns a unit direction around +z whose pdf is cos / pi per solid angle, for the cosine of its angle to +z.
template <class N>
HWY_INLINE Vector<N> cosine_hemisphere(N u, N v) {
    const Vector<N> disc = uniform_disc(u, v);
    return {disc.x, disc.y, sqrt(max(0.0, 1.0 - (disc.x * disc.x + disc.y * disc.y)))};
}

// Returns the pdf per solid angle of cosine_hemisphere(). \pre cosine >= 0
template <class N>
HWY_INLINE N cosine_hemisphere_pdf(N cosine) {
    return cosine / kPi;
}

// Returns a unit direction that is uniform per solid angle in a cone around +z. With one_minus_cos_max = 2 this is the
// whole sphere. The height z is uniform (Archimedes).
template <class N>
HWY_INLINE Vector<N> uniform_cone(N u, N v, N one_minus_cos_max) {
    const N one_minus_cos = u * one_minus_cos_max;
    const N sine = sqrt(one_minus_cos * (2.0 - one_minus_cos));
    const SineCosine<N> phi = sine_cosine_of_turns(v);
    return {sine * phi.cosine, sine * phi.sine, 1.0 - one_minus_cos};
}

// Returns the pdf per solid angle of uniform_cone().
template <class N>
HWY_INLINE N uniform_cone_pdf(N one_minus_cos_max) {
    return 1.0 / (2 * kPi * one_minus_cos_max);
}

// Returns a unit direction that is uniform on the whole sphere.
template <class N>
HWY_INLINE Vector<N> uniform_sphere(N u, N v) {
    return uniform_cone<N>(u, v, 2.0);
}

// Returns the pdf per solid angle of uniform_sphere().
template <class N>
HWY_INLINE N uniform_sphere_pdf() {
    return 1 / (4 * kPi);
}

// Returns a uniform point of the unit ball, with pdf 3 / (4 pi) per volume. Its radius is the cube root of w.
template <class N>
HWY_INLINE Vector<N> uniform_ball(N u, N v, N w) {
    return cube_root(w) * uniform_sphere(u, v);
}

// A right-handed orthonormal basis whose z is a given unit normal (Duff et al., Building an Orthonormal Basis,
// Revisited, JCGT 6(1), 2017).
template <class N>
struct Basis {
    Vector<N> x, y, z;

    HWY_INLINE explicit Basis(const Vector<N>& n) : z(n) {
        const N sign = copy_sign(1.0, n.z);
        const N a = -1.0 / (sign + n.z);
        const N b = n.x * n.y * a;
        x = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
    HWY_INLINE Vector<N> to_world(const Vector<N>& local) const { return local.x * x + local.y * y + local.z * z; }
};

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
