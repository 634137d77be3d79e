// Elementary functions of limn's own. Their results have the same bits on every processor and in every lane. The
// include guard is per target, as Highway requires.
#if defined(LIMN_MATH_FUNCTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_FUNCTIONS_INL_H
#undef LIMN_MATH_FUNCTIONS_INL_H
#else
#define LIMN_MATH_FUNCTIONS_INL_H
#endif

#include <bit>

#include "limn/math/math.h"
#include "math/elementary.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The upper 32 bits of a double.
inline constexpr std::int64_t kHighBits = ~std::int64_t{0xffffffff};

// Returns the polynomial with these coefficients at x.
template <class N, std::size_t n>
HWY_INLINE N polynomial(N x, const double (&highest_first)[n]) {
    N sum = highest_first[0];
    for (std::size_t i = 1; i < n; ++i) sum = sum * x + highest_first[i];
    return sum;
}

// Returns sine and cosine of x radians, with an error of at most one unit in the last place, by the polynomials of
// fdlibm (k_sin.c, k_cos.c). \pre |x| <= pi / 4
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

// Returns sine and cosine of an angle plus `quarters` quarter turns, given those of the angle. \pre `quarters` is an
// integer, |quarters| < 2^32
template <class N>
HWY_INLINE SineCosine<N> turned(SineCosine<N> s, N quarters) {
    // quarters modulo 4, in 0 ... 3
    const N quarter = quarters - floor(quarters * 0.25) * 4.0;
    const Mask<N> odd = (quarter == 1.0) | (quarter == 3.0);
    const N sine = select(odd, s.cosine, s.sine), cosine = select(odd, s.sine, s.cosine);
    return {select(quarter >= 2.0, -sine, sine), select((quarter == 1.0) | (quarter == 2.0), -cosine, cosine)};
}

// Returns sine and cosine of 2 pi times `turns`. \pre |turns| < 2^30
template <class N>
HWY_INLINE SineCosine<N> sine_cosine_of_turns(N turns) {
    const N quarters = round(turns * 4.0);
    return turned(sine_cosine_near_zero<N>((turns - quarters * 0.25) * (2 * kPi)), quarters);
}

// Returns sine and cosine of an angle. The quarter turns are subtracted in three parts of pi / 2; the products of the
// first two parts are exact (fdlibm, e_rem_pio2.c). \pre |radians| <= 2^20
template <class N>
HWY_INLINE SineCosine<N> sine_cosine(N radians) {
    constexpr double kFirst = 1.57079632673412561417, kSecond = 6.07710050630396597660e-11,
                     kThird = 2.02226624879595063154e-21;
    const N quarters = round(radians * (2 / kPi));
    const N more = radians - quarters * kFirst, second = quarters * kSecond, rest = more - second;
    return turned(sine_cosine_near_zero<N>(rest - (quarters * kThird - ((more - rest) - second))), quarters);
}

// Returns the angle of the vector (cosine, |sine|), from 0 to pi, with an error of a few units in the last place. The
// vector may have any length but 0. The arc tangent is that of Cephes (atan.c).
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
    // Reduce the vector to the first octant, where its slope low / high is in [0, 1].
    const N x = abs(at.cosine), y = abs(at.sine);
    const Mask<N> steep = y > x;
    const N low = select(steep, x, y), high = select(steep, y, x);
    // Reduce slopes r above tan(pi / 8) by atan(r) = pi / 4 + atan((r - 1) / (r + 1)).
    const Mask<N> large = low > 0.41421356237309503 * high;
    const N t = select(large, low - high, low) / select(large, low + high, high);
    // Compute the arc tangent of t, then undo the reductions.
    const N z = t * t;
    const N arc = t + t * (z * polynomial(z, kUpper) / polynomial(z, kLower));
    N angle = select(large, kPi / 4 + arc, arc);
    angle = select(steep, kPi / 2 - angle, angle);
    return select(at.cosine < 0.0, kPi - angle, angle);
}

// Returns the angle of the vector (cosine, sine), from 0 to 2 pi, as angle_of_upper() does.
template <class N>
HWY_INLINE N angle_of(const SineCosine<N>& at) {
    const N angle = angle_of_upper(at);
    return select(at.sine < 0.0, 2 * kPi - angle, angle);
}

// Returns the double whose bits, taken as an integer, are a third of x's plus `more`. Only the upper 32 bits of x
// count.
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

// Returns the cube root of x, with an error of a few units in the last place. The first guess divides the exponent by
// 3: 682 is two thirds of the bias 1023 of exponents. Halley's iteration improves the guess. \pre 0 <= x <= 1
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
