// Elementary functions of our own, for results that are the same bits on every processor and in every lane. Per-target
// include guard, as Highway has it.
#if defined(LIMN_LANES_FUNCTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_LANES_FUNCTIONS_INL_H
#undef LIMN_LANES_FUNCTIONS_INL_H
#else
#define LIMN_LANES_FUNCTIONS_INL_H
#endif

#include <bit>

#include "core/elementary.h"
#include "lanes/lanes-inl.h"
#include "limn/core/math.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

inline constexpr std::int64_t kHighBits = ~std::int64_t{0xffffffff};

template <class N, std::size_t n>
HWY_INLINE N polynomial(N x, const double (&highest_first)[n]) {
    N sum = highest_first[0];
    for (std::size_t i = 1; i < n; ++i) sum = sum * x + highest_first[i];
    return sum;
}

// Of |x| <= pi / 4, within a unit in the last place: the polynomials of fdlibm (k_sin.c, k_cos.c).
template <class N>
HWY_INLINE SineCosine<N> sine_cosine_near_zero(N x) {
    constexpr double kSine[] = {1.58969099521155010221e-10,  -2.50507602534068634195e-08, 2.75573137070700676789e-06,
                                -1.98412698298579493134e-04, 8.33333333332248946124e-03,  -1.66666666666666324348e-01};
    constexpr double kCosine[] = {-1.13596475577881948265e-11, 2.08757232129817482790e-09,  -2.75573143513906633035e-07,
                                  2.48015872894767294178e-05,  -1.38888888888741095749e-03, 4.16666666666666019037e-02};
    const N z = x * x;
    const N half = 0.5 * z, one_less = 1.0 - half;
    return {x + x * z * polynomial(z, kSine), one_less + (((1.0 - one_less) - half) + z * z * polynomial(z, kCosine))};
}

// Those of an angle and a whole number of quarter turns, |quarters| < 2^32.
template <class N>
HWY_INLINE SineCosine<N> turned(SineCosine<N> s, N quarters) {
    // Which quarter: 0 ... 3.
    const N quarter = quarters - floor(quarters * 0.25) * 4.0;
    const Mask<N> odd = (quarter == 1.0) | (quarter == 3.0);
    const N sine = select(odd, s.cosine, s.sine), cosine = select(odd, s.sine, s.cosine);
    return {select(quarter >= 2.0, -sine, sine), select((quarter == 1.0) | (quarter == 2.0), -cosine, cosine)};
}

// Of `turns` times 2 pi, |turns| < 2^30.
template <class N>
HWY_INLINE SineCosine<N> sine_cosine_of_turns(N turns) {
    const N quarters = round(turns * 4.0);
    return turned(sine_cosine_near_zero<N>((turns - quarters * 0.25) * (2 * kPi)), quarters);
}

// Of |radians| <= 2^20. A quarter turn is subtracted in three parts, the products of the first two without rounding
// (fdlibm, e_rem_pio2.c).
template <class N>
HWY_INLINE SineCosine<N> sine_cosine(N radians) {
    constexpr double kFirst = 1.57079632673412561417, kSecond = 6.07710050630396597660e-11,
                     kThird = 2.02226624879595063154e-21;
    const N quarters = round(radians * (2 / kPi));
    const N more = radians - quarters * kFirst, second = quarters * kSecond, rest = more - second;
    return turned(sine_cosine_near_zero<N>(rest - (quarters * kThird - ((more - rest) - second))), quarters);
}

// The angle of (cosine, |sine|), of any length but 0, from 0 to pi, within some units in the last place. Arc tangent as
// in Cephes (atan.c).
template <class N>
HWY_INLINE N angle_of_upper(const SineCosine<N>& at) {
    constexpr double kUpper[] = {-8.750608600031904122785e-1, -1.615753718733365076637e1, -7.500855792314704667340e1,
                                 -1.228866684490136173410e2, -6.485021904942025371773e1};
    constexpr double kLower[] = {1.0,
                                 2.485846490142306297962e1,
                                 1.650270098316988542046e2,
                                 4.328810604912902668951e2,
                                 4.853903996359136964868e2,
                                 1.945506571482613964425e2};
    const N x = abs(at.cosine), y = abs(at.sine);
    const Mask<N> steep = y > x;
    const N low = select(steep, x, y), high = select(steep, y, x);
    // Of a ratio over tan(pi / 8) the arc tangent is pi / 4 and that of (ratio - 1) / (ratio + 1).
    const Mask<N> large = low > 0.41421356237309503 * high;
    const N t = select(large, low - high, low) / select(large, low + high, high);
    const N z = t * t;
    const N arc = t + t * (z * polynomial(z, kUpper) / polynomial(z, kLower));
    N angle = select(large, kPi / 4 + arc, arc);
    angle = select(steep, kPi / 2 - angle, angle);
    return select(at.cosine < 0.0, kPi - angle, angle);
}

// The angle of (cosine, sine), from 0 to 2 pi.
template <class N>
HWY_INLINE N angle_of(const SineCosine<N>& at) {
    const N angle = angle_of_upper(at);
    return select(at.sine < 0.0, 2 * kPi - angle, angle);
}

// The number whose bits, as an integer, are a third of x's highest ones and `more`.
HWY_INLINE double third_of_bits(double x, double more) {
    const auto bits = static_cast<double>(std::bit_cast<std::int64_t>(x) & kHighBits);
    return std::bit_cast<double>(static_cast<std::int64_t>(bits / 3 + more));
}
template <class D>
HWY_INLINE Wide<D> third_of_bits(Wide<D> x, double more) {
    const hn::Rebind<std::int64_t, D> whole;
    const Wide<D> bits = hn::ConvertTo(D(), hn::And(hn::BitCast(whole, x.v), hn::Set(whole, kHighBits)));
    return hn::BitCast(D(), hn::ConvertTo(whole, (bits / 3.0 + more).v));
}

// Of x in [0, 1], within some units in the last place: Halley's iteration from a guess that divides the exponent by 3.
template <class N>
HWY_INLINE N cube_root(N x) {
    const N positive = max(x, 0x1p-900);
    N y = third_of_bits(positive, 682.0 * 0x1p52);
    for (int i = 0; i < 3; ++i) {
        const N cube = y * y * y;
        y = y * ((cube + 2.0 * positive) / (2.0 * cube + positive));
    }
    return select(x > 0.0, y, 0.0);
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
