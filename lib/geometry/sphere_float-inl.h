// Tests of rays against spheres in float: many spheres against one ray, or many rays against one sphere. The include
// guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_SPHERE_FLOAT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_SPHERE_FLOAT_INL_H
#undef LIMN_GEOMETRY_SPHERE_FLOAT_INL_H
#else
#define LIMN_GEOMETRY_SPHERE_FLOAT_INL_H
#endif

#include "geometry/float_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// A ray for spheres, in float. Its origin is the sum of two floats, `high` and `low`.
//
// The foot point is off by relative L + absolute, with L as in SpherePredicate::roots(). By the derivation there the
// error is (2 + 10 + 8 * 2) u L + e with u = 2^-24: 2 u because the origin is a sum of two floats, and s = 2 u because
// the direction is rounded to float.
template <class N>
struct SphereFloatRay {
    static constexpr std::size_t kNumbers = 13;
    Vector<N> high;
    N inverse_squared;  // 1 / |direction|^2
    Vector<N> low;
    N inverse_length;  // at least 1 / |direction|
    Vector<N> direction;
    N relative, absolute;

    // Returns the ray whose i-th number is number(i), i < kNumbers.
    template <class Number>
    HWY_INLINE static SphereFloatRay from(const Number& number) {
        return {three<N>(number, 0), number(3),  three<N>(number, 4), number(7),
                three<N>(number, 8), number(11), number(12)};
    }
};

// Bounds on the two roots of a sphere. If it is not certain that the ray hits, the bounds on both roots enclose the
// whole sphere. If all lanes miss, only `missed` is set.
template <class N>
struct FloatRoots {
    Mask<N> missed, certain;  // the line of the ray surely misses, or surely hits
    N near_first, far_first;  // bounds on the first root
    N near_last, far_last;    // bounds on the second root
};

// Returns bounds on the roots. The discriminant and the bound on its error are those of SpherePredicate::roots(), with
// u = 2^-24. If the discriminant exceeds the bound, both roots are off by what is derived there for `outer`; here that
// error is doubled.
template <class N>
HWY_INLINE FloatRoots<N> float_roots(const Vector<N>& center, N radius, const SphereFloatRay<N>& ray) {
    constexpr float kUlp = 0x1p-24f;
    // Compare the discriminant with the bound on its error.
    const Vector<N> p = (center - ray.high) - ray.low;
    const Vector<N>& d = ray.direction;
    const N foot_t = mul_add(p.x, d.x, mul_add(p.y, d.y, p.z * d.z)) * ray.inverse_squared;
    const Vector<N> foot{neg_mul_add(foot_t, d.x, p.x), neg_mul_add(foot_t, d.y, p.y), neg_mul_add(foot_t, d.z, p.z)};
    const N foot2 = mul_add(foot.x, foot.x, mul_add(foot.y, foot.y, foot.z * foot.z)), r2 = radius * radius;
    const N foot_error = mul_add(ray.relative, sum_abs(p), ray.absolute);
    const N error = mul_add(foot_error, mul_add(4.0f, radius, foot_error), 64 * kUlp * (r2 + foot2));
    const N discriminant = r2 - foot2;
    FloatRoots<N> r;
    r.missed = -discriminant > error;
    if (HWY_LIKELY(!any(!r.missed))) return r;

    // If the sign is not certain, the roots are between foot_t - half and foot_t + half: the half chord is at most the
    // radius.
    r.certain = discriminant > error;
    const N half = mul_add(1.001f, radius, 4.0f * foot_error) * ray.inverse_length;
    // If it is certain, compute both roots and the bound on their error.
    const N half_chord = sqrt(discriminant * ray.inverse_squared);
    const N relative = error / discriminant + ray.relative;
    const N root_error = mul_add(foot_error, 2.0f * ray.inverse_length,
                                 mul_add(2.0f * half_chord, relative, 16 * kUlp * (abs(foot_t) + half_chord)));
    const N first = foot_t - half_chord, last = foot_t + half_chord;
    const N near = foot_t - half, far = foot_t + half;
    r.near_first = select(r.certain, first - root_error, near);
    r.far_first = select(r.certain, first + root_error, far);
    r.near_last = select(r.certain, last - root_error, near);
    r.far_last = select(r.certain, last + root_error, far);
    return r;
}

// Returns the first root within the interval. A root whose bounds are above `surely_after` is surely greater than
// t_min.
template <class N>
HWY_INLINE FloatHits<N> first_root(const FloatRoots<N>& r, N surely_after, const Interval<N>& within) {
    const auto is_first = r.certain & (r.near_first > surely_after);
    const auto is_behind = r.certain & (r.far_first < within.t_min);
    const auto is_last = is_behind & (r.near_last > surely_after);
    FloatHits<N> hits;
    hits.near = select(is_behind, r.near_last, r.near_first);
    hits.far = select(is_first, r.far_first, r.far_last);
    hits.certain = is_first | is_last;
    hits.possible = !(r.missed | (hits.near > within.t_max) | (hits.far < within.t_min));
    return hits;
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
