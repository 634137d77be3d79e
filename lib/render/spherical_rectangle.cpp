#include "render/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

#include "limn/core/math.h"

namespace limn::tracing {

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
    // The inner angles of the spherical quadrilateral lie between the planes through its sides. Each plane's normal has
    // but two components, since it contains an edge.
    const auto across = [&](double along) { return along / norm(z0_, along); };
    // n0 = (0, z0, -y0), n1 = (-z0, 0, x1), n2 = (0, -z0, y1), n3 = (z0, 0, -x0), normalised
    const double n0z = -across(y0_), n1z = across(x1_), n2z = across(y1_), n3z = -across(x0_);
    const auto angle = [](double product) { return std::acos(std::clamp(-product, -1.0, 1.0)); };
    const double g0 = angle(n0z * n1z), g1 = angle(n1z * n2z), g2 = angle(n2z * n3z), g3 = angle(n3z * n0z);
    b0_ = n0z, b1_ = n2z;
    k_ = 2 * kPi - g2 - g3;
    solid_angle_ = z0_ == 0 ? 0 : std::max(0.0, g0 + g1 - k_);
}

Uv SphericalRectangle::sample(double u, double v) const {
    const double au = u * solid_angle_ + k_;
    const double fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
    const double cu = std::clamp(std::copysign(1.0, fu) / std::sqrt(fu * fu + b0_ * b0_), -1.0, 1.0);
    const double xu = std::clamp(-(cu * z0_) / std::sqrt(std::max(1 - cu * cu, 1e-300)), x0_, x1_);
    const double d = norm(xu, z0_);
    const double h0 = y0_ / norm(d, y0_), h1 = y1_ / norm(d, y1_);
    const double hv = h0 + v * (h1 - h0);
    const double rest = 1 - hv * hv;
    const double yv = rest > 0 ? std::clamp(hv * d / std::sqrt(rest), y0_, y1_) : (hv < 0 ? y0_ : y1_);
    return {(xu - x0_) / (x1_ - x0_), (yv - y0_) / (y1_ - y0_)};
}

}  // namespace limn::tracing
