#include "sampling/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace limn::sampling {

namespace {

// 1 - cos of the angle between two unit vectors, which does not cancel where they are close.
double one_minus_dot(const Vec3& a, const Vec3& b) { return length_squared(a - b) / 2; }

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
    : a_(a), b_(b), c_(c), cos_c_(dot(a, b)), volume_(std::abs(dot(a, cross(b - a, c - a)))) {
    solid_angle_ = 2 * std::atan2(volume_, 1 + cos_c_ + dot(b, c) + dot(c, a));
}

// A corner moves from a towards c until the triangle that it makes with a and b has the solid angle s = u times the
// whole; then the direction lies on the arc from b to it. With the corner at p = cos(t) a + sin(t) e, e perpendicular
// to a, the formula for the solid angle reads
//     tan(s / 2) = sin(t) |e . (a x b)| / ((1 + a.b) (1 + cos(t)) + sin(t) b.e),
// which tan(t / 2) = sin(t) / (1 + cos(t)) solves.
Vec3 SphericalTriangle::sample(double u, double v) const {
    const double half = u * solid_angle_ / 2, sine = std::sin(half), cosine = std::cos(half);
    const Vec3 along = c_ - dot(a_, c_) * a_;  // e, times its length
    const double scale = 1 / length(along);
    const double rise = sine * (1 + cos_c_), run = cosine * (volume_ * scale) - sine * (dot(b_, along) * scale);
    const double over = 1 / (rise * rise + run * run);
    const Vec3 p = ((run * run - rise * rise) * over) * a_ + (2 * rise * run * over * scale) * along;
    const double fall = v * one_minus_dot(b_, p);  // 1 - cos of the angle from b
    const Vec3 aside = p - dot(b_, p) * b_;
    const double length_aside = length(aside);
    if (!(length_aside > 0)) return b_;
    return (1 - fall) * b_ + (std::sqrt(std::max(0.0, fall * (2 - fall))) / length_aside) * aside;
}

}  // namespace limn::sampling
