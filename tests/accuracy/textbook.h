// The intersections that textbooks print, as they print them.
#pragma once

#include <cmath>
#include <limits>

#include "accuracy/question.h"

namespace limn::accuracy::textbook {

template <class Real>
struct Triple {
    Real x, y, z;
    friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Triple operator*(Real s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend Real dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend Triple cross(const Triple& a, const Triple& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
};
using F = Triple<float>;
using D = Triple<double>;

template <class Real, class Vector>
Triple<Real> as(const Vector& v) {
    return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

// Moeller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, JGT 2(1), 1997, without culling or epsilon.
// \returns t, or infinity
inline float moeller_trumbore(const F& origin, const F& direction, const F& a, const F& b, const F& c) {
    constexpr float miss = std::numeric_limits<float>::infinity();
    const F edge1 = b - a, edge2 = c - a, p = cross(direction, edge2);
    const float determinant = dot(edge1, p);
    if (determinant == 0) return miss;
    const float inverse = 1 / determinant;
    const F s = origin - a;
    const float u = dot(s, p) * inverse;
    if (!(u >= 0 && u <= 1)) return miss;
    const F q = cross(s, edge1);
    const float v = dot(direction, q) * inverse;
    if (!(v >= 0 && u + v <= 1)) return miss;
    const float t = dot(edge2, q) * inverse;
    return t > 0 ? t : miss;
}

// Signed volumes of the ray with the three edges (Pluecker coordinates about the origin of the ray), without slack.
inline float pluecker(const F& origin, const F& direction, const F& a, const F& b, const F& c) {
    constexpr float miss = std::numeric_limits<float>::infinity();
    const F v0 = a - origin, v1 = b - origin, v2 = c - origin;
    const F e0 = v2 - v0, e1 = v0 - v1, e2 = v1 - v2;
    const float u = dot(cross(v2 + v0, e0), direction), v = dot(cross(v0 + v1, e1), direction),
                w = dot(cross(v1 + v2, e2), direction);
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) return miss;
    const F normal = cross(e0, e1);
    const float denominator = dot(normal, direction);
    if (denominator == 0) return miss;
    const float t = dot(v0, normal) / denominator;
    return t > 0 ? t : miss;
}

// Shirley, Black, Hollasch, Ray Tracing in One Weekend, section 6.2 (version 4), with h for -b / 2. In the book's
// double, or in the float of many who follow it.
template <class Real>
Real sphere(const Triple<Real>& origin, const Triple<Real>& direction, const Triple<Real>& center, Real radius,
            Real t_min) {
    constexpr Real miss = std::numeric_limits<Real>::infinity();
    const auto to_center = center - origin;
    const Real a = dot(direction, direction), h = dot(direction, to_center),
               c = dot(to_center, to_center) - radius * radius;
    const Real discriminant = h * h - a * c;
    if (!(discriminant >= 0)) return miss;
    const Real root = std::sqrt(discriminant);
    for (const Real t : {(h - root) / a, (h + root) / a})
        if (t > t_min && t < miss) return t;
    return miss;
}

// The same authors, The Next Week, chapter 6: plane equation, then coordinates in the plane; rays within 1e-8 of
// parallel miss.
inline double quad(const D& origin, const D& direction, const D& corner, const D& u, const D& v) {
    constexpr double miss = kInfinity;
    const D n = cross(u, v), normal = (1 / std::sqrt(dot(n, n))) * n, w = (1 / dot(n, n)) * n;
    const double denominator = dot(normal, direction);
    if (std::abs(denominator) < 1e-8) return miss;
    const double t = (dot(normal, corner) - dot(normal, origin)) / denominator;
    if (!(t > 0)) return miss;
    const D in_plane = origin + t * direction - corner;
    const double alpha = dot(w, cross(in_plane, v)), beta = dot(w, cross(u, in_plane));
    return alpha >= 0 && alpha <= 1 && beta >= 0 && beta <= 1 ? t : miss;
}

// The Next Week, section 3.4: slabs, the intervals' order decided by comparison, empty where they only touch.
template <class Real>
bool meets_box(const Real (&origin)[3], const Real (&direction)[3], const Real (&lower)[3], const Real (&upper)[3]) {
    Real least = 0, most = std::numeric_limits<Real>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const Real inverse = 1 / direction[axis];
        const Real t0 = (lower[axis] - origin[axis]) * inverse, t1 = (upper[axis] - origin[axis]) * inverse;
        if (t0 < t1) {
            if (t0 > least) least = t0;
            if (t1 < most) most = t1;
        } else {
            if (t1 > least) least = t1;
            if (t0 < most) most = t0;
        }
        if (most <= least) return false;
    }
    return true;
}

}  // namespace limn::accuracy::textbook
