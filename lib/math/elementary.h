// Elementary functions of limn's own, defined in lib/math/elementary.cpp. Their results have the same bits with every
// compiler, C library and processor. The results of a C library differ in the last bit between its versions, and
// between processors with and without fused multiply-add.
//
// Errors are at most four units in the last place (ulp) except where noted. NaN gives NaN. Angles are in radians.
#pragma once

namespace limn {

template <class N>
struct SineCosine {
    N sine, cosine;
};

SineCosine<double> sine_cosine(double radians);  // NaN if the angle is infinite
double sine(double radians);
double cosine(double radians);
double tangent(double radians);

// Returns an angle from 0 to pi. \pre -1 <= cosine <= 1
double arc_cosine(double cosine);
// Returns the angle of the point (x, y), from -pi to pi. The angle of (0, 0) is 0.
double arc_tangent(double y, double x);
// Returns an angle from -pi / 2 to pi / 2.
inline double arc_tangent(double slope) { return arc_tangent(slope, 1); }

double exponential(double x);
double logarithm(double x);            // \pre x >= 0
double logarithm_of_1_plus(double x);  // \pre x >= -1
// The error is at most 2 + 2 |exponent ln base| ulp. \pre base >= 0
double power(double base, double exponent);

}  // namespace limn
