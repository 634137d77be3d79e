// Vectors in __float128: 113 bits, exponents far beyond those of double.
#pragma once

#include <cmath>
#include <limits>

#include "limn/math/transform.h"
#include "limn/math/vec.h"

namespace limn::test {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Real = __float128;
#else
using Real = long double;
static_assert(std::numeric_limits<Real>::digits == 113, "the same numbers by another name");
#endif

struct Real3 {
    Real x = 0, y = 0, z = 0;
    Real3() = default;
    Real3(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
    explicit Real3(const Point3& p) : x(p.x), y(p.y), z(p.z) {}
    explicit Real3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
    explicit Real3(const Normal3& n) : x(n.x), y(n.y), z(n.z) {}
};

inline Real3 operator+(const Real3& a, const Real3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Real3 operator-(const Real3& a, const Real3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Real3 operator*(Real s, const Real3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Real dot(const Real3& a, const Real3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Real3 cross(const Real3& a, const Real3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real absolute(Real x) { return x < 0 ? -x : x; }

/// Newton's iteration from the double root doubles its 53 bits twice.
inline Real square_root(Real x) {
    if (!(x > 0)) return 0;
    Real unit = 1;  // takes x to where double has its root
    for (; x < Real(0x1p-1000); x *= Real(0x1p1000)) unit *= Real(0x1p-500);
    for (; x > Real(0x1p1000); x *= Real(0x1p-1000)) unit *= Real(0x1p500);
    Real root = std::sqrt(static_cast<double>(x));
    for (int i = 0; i < 3; ++i) root = (root + x / root) / 2;
    return unit * root;
}
inline Real length(const Real3& a) { return square_root(dot(a, a)); }

inline Real3 transform_point(const Transform& m, const Real3& p) {
    const auto row = [&](std::size_t i) {
        return Real(m.rows[i][0]) * p.x + Real(m.rows[i][1]) * p.y + Real(m.rows[i][2]) * p.z + Real(m.rows[i][3]);
    };
    return {row(0), row(1), row(2)};
}

inline Real3 transform_vector(const Transform& m, const Real3& v) {
    return transform_point(m, v) - transform_point(m, Real3{});
}

}  // namespace limn::test
