#include "sampling/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

#include "limn/core/math.h"

namespace limn::sampling {

namespace {

// std::hypot guards against overflow, which lengths in a scene do not reach, and costs a tenth of a whole path.
double norm(double a, double b) { return std::sqrt(a * a + b * b); }

}  // namespace

SphericalRectangle::SphericalRectangle(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v,
                                       const Point3& from) {
    const double length_u = length(edge_u), length_v = length(edge_v);
    const Vec3 x = edge_u / length_u, y = edge_v / length_v, z = cross(x, y);
    const Vec3 d = corner - from;
    x0_ = dot(d, x), y0_ = dot(d, y), z0_ = -std::abs(dot(d, z));
    x1_ = x0_ + length_u, y1_ = y0_ + length_v;
    // The inner angle at a corner of the spherical quadrilateral lies between the planes through its two sides; (x, y,
    // z0) is the corner. Sine and cosine of it have a common factor that is left out. Neither cancels, as the cosine
    // alone would where the rectangle is seen almost edge-on: its angles are near 0 and pi there.
    const auto angle = [this](double cx, double cy, double cosine) {
        return std::atan2(-z0_ * std::sqrt(cx * cx + cy * cy + z0_ * z0_), cosine);
    };
    const double g0 = angle(x1_, y0_, x1_ * y0_), g1 = angle(x1_, y1_, -x1_ * y1_);
    const double g2 = angle(x0_, y1_, x0_ * y1_), g3 = angle(x0_, y0_, -x0_ * y0_);
    b0_ = -y0_ / norm(z0_, y0_), b1_ = y1_ / norm(z0_, y1_);
    k_ = 2 * kPi - g2 - g3;
    solid_angle_ = z0_ == 0 ? 0 : std::max(0.0, g0 + g1 - k_);
}

Uv SphericalRectangle::sample(double u, double v) const {
    const double au = u * solid_angle_ + k_;
    // fu = (cos(au) b0 - b1) / sin(au), and xu = -z0 cu / sqrt(1 - cu^2) with cu = 1 / sqrt(fu^2 + b0^2). Almost
    // edge-on b0 and b1 are 1 but for q0 / 2 and q1 / 2, and so is cos(au), up to signs: the differences are taken of
    // what is left of them.
    const double z2 = z0_ * z0_, q0 = z2 / (z2 + y0_ * y0_), q1 = z2 / (z2 + y1_ * y1_);
    const bool same_sign = std::signbit(b0_) == std::signbit(b1_);
    const double half = same_sign ? std::sin(au / 2) : std::cos(au / 2);
    const double cosine_less_sign = (same_sign ? -2 : 2) * half * half;
    const double b_difference = std::copysign(1.0, b1_) * (q1 - q0) / (std::abs(b0_) + std::abs(b1_));
    const double fu = (cosine_less_sign * b0_ + b_difference) / std::sin(au);
    const double xu = std::clamp(std::copysign(-z0_, fu) / std::sqrt(std::max(fu * fu - q0, 1e-300)), x0_, x1_);
    const double d = norm(xu, z0_);
    const double h0 = y0_ / norm(d, y0_), h1 = y1_ / norm(d, y1_);
    const double hv = h0 + v * (h1 - h0);
    const double rest = 1 - hv * hv;
    const double yv = rest > 0 ? std::clamp(hv * d / std::sqrt(rest), y0_, y1_) : (hv < 0 ? y0_ : y1_);
    return {(xu - x0_) / (x1_ - x0_), (yv - y0_) / (y1_ - y0_)};
}

}  // namespace limn::sampling
