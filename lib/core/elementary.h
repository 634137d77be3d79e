// Elementary functions of our own (lib/lanes/elementary.cpp): the same bits from every compiler, C library and
// processor. The C library's differ in the last bit between versions, and between processors with and without fused
// operations. Within four units in the last place. NaN gives NaN.
#pragma once

namespace limn {

template <class N>
struct SineCosine {
    N sine, cosine;
};

SineCosine<double> sine_cosine(double radians);  // infinite: NaN
double sine(double radians);
double cosine(double radians);
double tangent(double radians);

double arc_cosine(double cosine);        // 0 to pi. \pre -1 <= cosine <= 1
double arc_tangent(double y, double x);  // of y / x in the quadrant of (x, y): -pi to pi, 0 of (0, 0)
inline double arc_tangent(double slope) { return arc_tangent(slope, 1); }

double exponential(double x);
double logarithm(double x);                  // \pre x >= 0
double logarithm_of_1_plus(double x);        // \pre x >= -1
double power(double base, double exponent);  // within 2 + 2 |exponent ln base| units. \pre base >= 0

}  // namespace limn
