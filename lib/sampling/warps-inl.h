// The maps of limn/core/warp.h in vectors. Per-target include guard, as Highway has it.
#if defined(LIMN_SAMPLING_WARPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SAMPLING_WARPS_INL_H
#undef LIMN_SAMPLING_WARPS_INL_H
#else
#define LIMN_SAMPLING_WARPS_INL_H
#endif

#include "lanes/lanes-inl.h"
#include "limn/core/math.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

struct SineCosine {
    Doubles sine, cosine;
};

template <std::size_t n>
HWY_INLINE Doubles polynomial(Doubles x, const double (&highest_first)[n]) {
    Doubles sum = highest_first[0];
    for (std::size_t i = 1; i < n; ++i) sum = sum * x + highest_first[i];
    return sum;
}

// Of |x| <= pi / 4, within a unit in the last place: the polynomials of fdlibm (k_sin.c, k_cos.c).
HWY_INLINE SineCosine sine_cosine_near_zero(Doubles x) {
    constexpr double kSine[] = {1.58969099521155010221e-10,  -2.50507602534068634195e-08, 2.75573137070700676789e-06,
                                -1.98412698298579493134e-04, 8.33333333332248946124e-03,  -1.66666666666666324348e-01};
    constexpr double kCosine[] = {-1.13596475577881948265e-11, 2.08757232129817482790e-09,  -2.75573143513906633035e-07,
                                  2.48015872894767294178e-05,  -1.38888888888741095749e-03, 4.16666666666666019037e-02};
    const Doubles z = x * x;
    const Doubles half = 0.5 * z, one_less = 1.0 - half;
    return {x + x * z * polynomial(z, kSine), one_less + (((1.0 - one_less) - half) + z * z * polynomial(z, kCosine))};
}

// Of `turns` times 2 pi, |turns| < 2^30.
HWY_INLINE SineCosine sine_cosine_of_turns(Doubles turns) {
    const Doubles quarters = round(turns * 4.0);
    const SineCosine s = sine_cosine_near_zero((turns - quarters * 0.25) * (2 * kPi));
    // Which quarter: 0 ... 3.
    const Doubles whole = floor(quarters * 0.25), quarter = quarters - whole * 4.0;
    const Mask<Doubles> odd = (quarter == 1.0) | (quarter == 3.0);
    const Doubles sine = select(odd, s.cosine, s.sine), cosine = select(odd, s.sine, s.cosine);
    return {select(quarter >= 2.0, -sine, sine), select((quarter == 1.0) | (quarter == 2.0), -cosine, cosine)};
}

// The angle of (cosine, sine), from 0 to 2 pi, within some units in the last place. Arc tangent as in Cephes (atan.c).
HWY_INLINE Doubles angle_of(const SineCosine& at) {
    constexpr double kUpper[] = {-8.750608600031904122785e-1, -1.615753718733365076637e1, -7.500855792314704667340e1,
                                 -1.228866684490136173410e2, -6.485021904942025371773e1};
    constexpr double kLower[] = {1.0,
                                 2.485846490142306297962e1,
                                 1.650270098316988542046e2,
                                 4.328810604912902668951e2,
                                 4.853903996359136964868e2,
                                 1.945506571482613964425e2};
    const Doubles x = abs(at.cosine), y = abs(at.sine);
    const Mask<Doubles> steep = y > x;
    const Doubles low = select(steep, x, y), high = select(steep, y, x);
    // Of a ratio over tan(pi / 8) the arc tangent is pi / 4 and that of (ratio - 1) / (ratio + 1).
    const Mask<Doubles> large = low > 0.41421356237309503 * high;
    const Doubles t = select(large, low - high, low) / select(large, low + high, high);
    const Doubles z = t * t;
    const Doubles arc = t + t * (z * polynomial(z, kUpper) / polynomial(z, kLower));
    Doubles angle = select(large, kPi / 4 + arc, arc);
    angle = select(steep, kPi / 2 - angle, angle);
    angle = select(at.cosine < 0.0, kPi - angle, angle);
    return select(at.sine < 0.0, 2 * kPi - angle, angle);
}

// sample_cosine_hemisphere.
HWY_INLINE Vector<Doubles> cosine_hemisphere(Doubles u, Doubles v) {
    const Doubles a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    const Mask<Doubles> wide = abs(a) > abs(b);
    const Doubles radius = select(wide, a, b), other = select(wide, b, a);
    const Doubles ratio = select(radius == 0.0, 0.0, other / radius);
    // phi, or a quarter turn less phi.
    const SineCosine s = sine_cosine_near_zero(kPi / 4 * ratio);
    const Doubles x = radius * select(wide, s.cosine, s.sine), y = radius * select(wide, s.sine, s.cosine);
    return {x, y, sqrt(max(0.0, 1.0 - (x * x + y * y)))};
}

// sample_uniform_cone; with 2 sample_uniform_sphere.
HWY_INLINE Vector<Doubles> uniform_cone(Doubles u, Doubles v, Doubles one_minus_cos_max) {
    const Doubles one_minus_cos = u * one_minus_cos_max;
    const Doubles sine = sqrt(one_minus_cos * (2.0 - one_minus_cos));
    const SineCosine phi = sine_cosine_of_turns(v);
    return {sine * phi.cosine, sine * phi.sine, 1.0 - one_minus_cos};
}

// Frame::to_world.
HWY_INLINE Vector<Doubles> to_world(const Vector<Doubles>& n, const Vector<Doubles>& local) {
    const Doubles sign = copy_sign(1.0, n.z);
    const Doubles a = -1.0 / (sign + n.z);
    const Doubles b = n.x * n.y * a;
    const Vector<Doubles> x{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    const Vector<Doubles> y{b, sign + n.y * n.y * a, -n.y};
    return local.x * x + local.y * y + local.z * n;
}

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
