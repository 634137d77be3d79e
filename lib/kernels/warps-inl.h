// The maps of limn/core/warp.h in vectors. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_WARPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_WARPS_INL_H
#undef LIMN_KERNELS_WARPS_INL_H
#else
#define LIMN_KERNELS_WARPS_INL_H
#endif

#include "kernels/doubles-inl.h"
#include "limn/core/math.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

struct SineCosine {
    W sine, cosine;
};

template <std::size_t n>
HWY_INLINE W polynomial(W x, const double (&highest_first)[n]) {
    W sum = all(highest_first[0]);
    for (std::size_t i = 1; i < n; ++i) sum = sum * x + all(highest_first[i]);
    return sum;
}

// Of |x| <= pi / 4, within a unit in the last place: the polynomials of fdlibm (k_sin.c, k_cos.c).
HWY_INLINE SineCosine sine_cosine_near_zero(W x) {
    constexpr double kSine[] = {1.58969099521155010221e-10,  -2.50507602534068634195e-08, 2.75573137070700676789e-06,
                                -1.98412698298579493134e-04, 8.33333333332248946124e-03,  -1.66666666666666324348e-01};
    constexpr double kCosine[] = {-1.13596475577881948265e-11, 2.08757232129817482790e-09,  -2.75573143513906633035e-07,
                                  2.48015872894767294178e-05,  -1.38888888888741095749e-03, 4.16666666666666019037e-02};
    const W z = x * x;
    const W half = all(0.5) * z, one_less = all(1.0) - half;
    return {x + x * z * polynomial(z, kSine),
            one_less + (((all(1.0) - one_less) - half) + z * z * polynomial(z, kCosine))};
}

// Of `turns` times 2 pi, |turns| < 2^30.
HWY_INLINE SineCosine sine_cosine_of_turns(W turns) {
    const W quarters = hn::Round(turns * all(4.0));
    const SineCosine s = sine_cosine_near_zero((turns - quarters * all(0.25)) * all(2 * kPi));
    // Which quarter: 0 ... 3.
    const W whole = hn::Floor(quarters * all(0.25)), quarter = quarters - whole * all(4.0);
    const Where odd = hn::Or(hn::Eq(quarter, all(1.0)), hn::Eq(quarter, all(3.0)));
    const W sine = choose(odd, s.cosine, s.sine), cosine = choose(odd, s.sine, s.cosine);
    return {choose(hn::Ge(quarter, all(2.0)), hn::Neg(sine), sine),
            choose(hn::Or(hn::Eq(quarter, all(1.0)), hn::Eq(quarter, all(2.0))), hn::Neg(cosine), cosine)};
}

// The angle of (cosine, sine), from 0 to 2 pi, within some units in the last place. Arc tangent as in Cephes (atan.c).
HWY_INLINE W angle_of(const SineCosine& at) {
    constexpr double kUpper[] = {-8.750608600031904122785e-1, -1.615753718733365076637e1, -7.500855792314704667340e1,
                                 -1.228866684490136173410e2, -6.485021904942025371773e1};
    constexpr double kLower[] = {1.0,
                                 2.485846490142306297962e1,
                                 1.650270098316988542046e2,
                                 4.328810604912902668951e2,
                                 4.853903996359136964868e2,
                                 1.945506571482613964425e2};
    const W x = hn::Abs(at.cosine), y = hn::Abs(at.sine);
    const Where steep = hn::Gt(y, x);
    const W low = choose(steep, x, y), high = choose(steep, y, x);
    // Of a ratio over tan(pi / 8) the arc tangent is pi / 4 and that of (ratio - 1) / (ratio + 1).
    const Where large = hn::Gt(low, all(0.41421356237309503) * high);
    const W t = choose(large, low - high, low) / choose(large, low + high, high);
    const W z = t * t;
    const W arc = t + t * (z * polynomial(z, kUpper) / polynomial(z, kLower));
    W angle = choose(large, all(kPi / 4) + arc, arc);
    angle = choose(steep, all(kPi / 2) - angle, angle);
    angle = choose(hn::Lt(at.cosine, all(0.0)), all(kPi) - angle, angle);
    return choose(hn::Lt(at.sine, all(0.0)), all(2 * kPi) - angle, angle);
}

// sample_cosine_hemisphere.
HWY_INLINE W3 cosine_hemisphere(W u, W v) {
    const W a = all(2.0) * u - all(1.0), b = all(2.0) * v - all(1.0);
    const Where wide = hn::Gt(hn::Abs(a), hn::Abs(b));
    const W radius = choose(wide, a, b), other = choose(wide, b, a);
    const W ratio = choose(hn::Eq(radius, all(0.0)), all(0.0), other / radius);
    // phi, or a quarter turn less phi.
    const SineCosine s = sine_cosine_near_zero(all(kPi / 4) * ratio);
    const W x = radius * choose(wide, s.cosine, s.sine), y = radius * choose(wide, s.sine, s.cosine);
    return {x, y, hn::Sqrt(hn::Max(all(0.0), all(1.0) - (x * x + y * y)))};
}

// sample_uniform_cone; with 2 sample_uniform_sphere.
HWY_INLINE W3 uniform_cone(W u, W v, W one_minus_cos_max) {
    const W one_minus_cos = u * one_minus_cos_max;
    const W sine = hn::Sqrt(one_minus_cos * (all(2.0) - one_minus_cos));
    const SineCosine phi = sine_cosine_of_turns(v);
    return {sine * phi.cosine, sine * phi.sine, all(1.0) - one_minus_cos};
}

// Frame::to_world.
HWY_INLINE W3 to_world(const W3& n, const W3& local) {
    const W sign = hn::CopySign(all(1.0), n.z);
    const W a = all(-1.0) / (sign + n.z);
    const W b = n.x * n.y * a;
    const W3 x{all(1.0) + sign * n.x * n.x * a, sign * b, hn::Neg(sign) * n.x};
    const W3 y{b, sign + n.y * n.y * a, hn::Neg(n.y)};
    return local.x * x + local.y * y + local.z * n;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
