// Ray against sphere, triangle and parallelogram in __float128 on the stored doubles: what the answer is, and how near
// to the border of a decision the question lies. Plain double cannot decide what lies within a few of its own roundings
// of the border, so a test asks for agreement where the decision value exceeds kMargin of the magnitudes that make it
// up (about 900 double roundings), and for t within one float ulp beside the error that this margin allows.
#pragma once

#include <cmath>
#include <string>

#include "limn/core/ray.h"
#include "limn/shape/hittable.h"
#include "support/real.h"
#include "support/tally.h"

namespace limn::test {

inline constexpr double kMargin = 1e-13;

struct Truth {
    enum class Verdict { hit, miss, undecided } verdict = Verdict::miss;
    Real t = 0, u = 0, v = 0;
    Real t_error = 0, uv_error = 0;  // what the margin allows
};

namespace detail {

enum class Side { inside, outside, undecided };

// (t_min, t_max]: below it, in it, above it.
inline Side in_range(Real t, Real error, const Ray& ray, bool& beyond) {
    beyond = false;
    if (std::isfinite(ray.t_min)) {
        if (absolute(t - Real(ray.t_min)) <= error) return Side::undecided;
        if (t < Real(ray.t_min)) return Side::outside;
    }
    if (std::isfinite(ray.t_max)) {
        if (absolute(t - Real(ray.t_max)) <= error) return Side::undecided;
        if (t > Real(ray.t_max)) {
            beyond = true;
            return Side::outside;
        }
    }
    return Side::inside;
}

}  // namespace detail

inline Truth true_sphere_hit(const Point3& center, double radius, const Ray& ray) {
    const Real3 from_center = Real3(ray.origin) - Real3(center), d(ray.direction);
    const Real r = absolute(Real(radius)), speed = length(d);
    const Real distance = length(cross(from_center, d)) / speed;
    const Real magnitude = length(from_center) + r;
    Truth truth;
    if (absolute(distance - r) <= Real(kMargin) * magnitude) {
        truth.verdict = Truth::Verdict::undecided;
        return truth;
    }
    if (distance > r) return truth;
    const Real foot = -dot(from_center, d) / (speed * speed);
    const Real half_chord = square_root(r * r - distance * distance);
    // A grazing chord magnifies the error of the distance by r / half_chord.
    truth.t_error = Real(kMargin) * magnitude * (1 + r / half_chord) / speed;
    for (const Real t : {foot - half_chord / speed, foot + half_chord / speed}) {
        bool beyond = false;
        const detail::Side side = detail::in_range(t, truth.t_error, ray, beyond);
        truth.t = t;
        if (side == detail::Side::inside) truth.verdict = Truth::Verdict::hit;
        if (side == detail::Side::undecided) truth.verdict = Truth::Verdict::undecided;
        if (side != detail::Side::outside || beyond) break;
    }
    return truth;
}

/// corner + u edge_u + v edge_v = origin + t direction by Cramer's rule. `triangle`: u, v >= 0 and u + v <= 1; else
/// both in [0, 1].
inline Truth true_planar_hit(const Real3& corner, const Real3& edge_u, const Real3& edge_v, bool triangle,
                             const Ray& ray) {
    const Real3 d(ray.direction), q = Real3(ray.origin) - corner;
    Real determinant = -dot(cross(edge_u, edge_v), d);
    Real u = -dot(cross(q, edge_v), d), v = -dot(cross(edge_u, q), d), t = dot(cross(edge_u, edge_v), q);
    if (determinant < 0) determinant = -determinant, u = -u, v = -v, t = -t;

    // The decisions are areas seen along the ray: distances from the ray times their own error, which grows with the
    // distance from the eye.
    const Real speed = length(d);
    Real far = 0, beside = 0;
    for (const Real3& p : {Real3{} - q, edge_u - q, edge_v - q, edge_u + edge_v - q}) {
        far = std::max(far, length(p));
        beside = std::max(beside, length(cross(p, d)) / speed);
    }
    const Real doubt = Real(kMargin) * speed * far * (beside + Real(kMargin) * far);

    Truth truth;
    const Real a = u, b = v, c = triangle ? determinant - u - v : determinant - u, e = triangle ? c : determinant - v;
    const Real worst = std::min(std::min(a, b), std::min(c, e));
    if (worst < -doubt) return truth;
    truth.verdict = Truth::Verdict::undecided;
    if (worst <= doubt || determinant <= doubt) return truth;
    truth.u = u / determinant, truth.v = v / determinant, truth.t = t / determinant;
    truth.uv_error = doubt / determinant;
    truth.t_error = (Real(kMargin) * far + truth.uv_error * (length(edge_u) + length(edge_v))) / speed;
    bool beyond = false;
    const detail::Side side = detail::in_range(truth.t, truth.t_error, ray, beyond);
    if (side == detail::Side::inside) truth.verdict = Truth::Verdict::hit;
    if (side == detail::Side::outside) truth.verdict = Truth::Verdict::miss;
    return truth;
}

inline Truth true_triangle_hit(const Point3& a, const Point3& b, const Point3& c, const Ray& ray) {
    return true_planar_hit(Real3(a), Real3(b) - Real3(a), Real3(c) - Real3(a), true, ray);
}

inline Truth true_quad_hit(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Ray& ray) {
    return true_planar_hit(Real3(corner), Real3(edge_u), Real3(edge_v), false, ray);
}

/// Counts one answer against the truth. `ulps`: float ulps that t may be off.
inline void judge(Tally& tally, const Ray& ray, const Truth& truth, bool hit, double t, double ulps = 1) {
    ++tally.rays;
    if (truth.verdict == Truth::Verdict::undecided) return;
    ++tally.judged;
    const bool expected = truth.verdict == Truth::Verdict::hit;
    if (hit != expected) return tally.fault(ray, expected ? "missed" : "false hit");
    if (!hit) return;
    ++tally.hits;
    if (!std::isfinite(t) || absolute(Real(t) - truth.t) > Real(ulps * 0x1p-23) * absolute(truth.t) + truth.t_error)
        tally.fault(ray, "t = " + std::to_string(t) + " instead of " + std::to_string(static_cast<double>(truth.t)));
}

inline void judge(Tally& tally, const Ray& ray, const Truth& truth, const std::optional<Hit>& hit, double ulps = 1) {
    judge(tally, ray, truth, hit.has_value(), hit ? hit->t : 0, ulps);
}

/// The same for u and v of a planar shape.
inline void judge_uv(Tally& tally, const Ray& ray, const Truth& truth, const std::optional<Hit>& hit) {
    if (truth.verdict != Truth::Verdict::hit || !hit) return;
    const Real allowed = truth.uv_error + Real(0x1p-23);
    if (absolute(Real(hit->u) - truth.u) > allowed || absolute(Real(hit->v) - truth.v) > allowed)
        tally.fault(ray, "u, v");
}

}  // namespace limn::test
