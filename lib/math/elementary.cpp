#include "math/elementary.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "math/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

namespace inl = HWY_NAMESPACE;

namespace {

// ln 2 is the sum of two parts. The first has 32 bits, so that its product with the exponent of a double is exact.
constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
// Above the first of these, exp is infinite as a double. Below the second, it is 0.
constexpr double kInfiniteAbove = 709.782712893383973096, kZeroBelow = -745.133219101941108420;
constexpr double kSqrt2 = 1.41421356237309504880;
// Up to this angle in radians, quarter turns are subtracted without an error.
constexpr double kFewTurns = 0x1p20;

}  // namespace

SineCosine<double> sine_cosine(double radians) {
    // Reduce larger angles by multiples of the double nearest to 2 pi. The rounding of the angle itself is no smaller
    // an error.
    const double some = std::abs(radians) < kFewTurns ? radians : std::remainder(radians, 2 * kPi);
    return inl::sine_cosine(some);
}

double sine(double radians) { return sine_cosine(radians).sine; }
double cosine(double radians) { return sine_cosine(radians).cosine; }

double tangent(double radians) {
    const auto [s, c] = sine_cosine(radians);
    return s / c;
}

double arc_cosine(double cosine) {
    return inl::angle_of_upper(SineCosine<double>{std::sqrt((1 - cosine) * (1 + cosine)), cosine});
}

double arc_tangent(double y, double x) {
    if (x == 0 && y == 0) return 0;
    return std::copysign(inl::angle_of_upper(SineCosine<double>{std::abs(y), x}), y);
}

// Uses the algorithm and the polynomial of fdlibm, e_exp.c.
double exponential(double x) {
    if (!(x <= kInfiniteAbove)) return std::isnan(x) ? x : kInfinity;
    if (x < kZeroBelow) return 0;
    constexpr double kRest[] = {4.13813679705723846039e-08, -1.65339022054652515390e-06, 6.61375632143793436117e-05,
                                -2.77777777770155933842e-03, 1.66666666666666019037e-01};
    // Write x as twos * ln 2 + r, |r| <= ln 2 / 2.
    const double twos = std::nearbyint(x * (1 / (kLn2High + kLn2Low)));
    const double high = x - twos * kLn2High, low = twos * kLn2Low;
    const double r = high - low, z = r * r;
    // Compute y = exp(r).
    const double c = r - z * inl::polynomial(z, kRest);
    const double y = 1 - ((low - r * c / (2 - c)) - high);
    // Return y * 2^twos. If 2^twos is a normal number, a product is faster than std::ldexp.
    if (std::abs(twos) > 1022) return std::ldexp(y, static_cast<int>(twos));
    return y * std::bit_cast<double>((static_cast<std::int64_t>(twos) + 1023) << 52);
}

// Uses the algorithm and the polynomials of fdlibm, e_log.c.
double logarithm(double x) {
    if (!(x > 0) || std::isinf(x)) return x == 0 ? -kInfinity : x;
    constexpr double kOdd[] = {1.479819860511658591e-01, 1.818357216161805012e-01, 2.857142874366239149e-01,
                               6.666666666666735130e-01};
    constexpr double kEven[] = {1.531383769920937332e-01, 2.222219843214978396e-01, 3.999999999940941908e-01};
    // Write x as m * 2^twos, sqrt(1/2) <= m < sqrt(2).
    int twos = 0;
    double m = std::frexp(x, &twos);
    if (m < kSqrt2 / 2) {
        m *= 2;
        --twos;
    }
    // Compute log(m) and add twos * ln 2.
    const double f = m - 1, s = f / (2 + f), z = s * s, w = z * z;
    const double rest = z * inl::polynomial(w, kOdd) + w * inl::polynomial(w, kEven), half = 0.5 * f * f;
    return twos * kLn2High - ((half - (s * (half + rest) + twos * kLn2Low)) - f);
}

// Uses a formula by Kahan: the rounding of 1 + x changes both its logarithm and the divisor of x, and the two errors
// cancel (Goldberg, What every computer scientist should know about floating-point arithmetic, 1991, theorem 4).
double logarithm_of_1_plus(double x) {
    const double sum = 1 + x;
    return sum == 1 ? x : logarithm(sum) * (x / (sum - 1));
}

double power(double base, double exponent) { return exponential(exponent * logarithm(base)); }

}  // namespace limn
HWY_AFTER_NAMESPACE();
