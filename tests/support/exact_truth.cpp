#include "support/exact_truth.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace limn::test {

namespace {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>,
                                              boost::multiprecision::et_off>;  // 512 bits in place, more on the heap

// mantissa * 2^exponent: sums, differences and products of doubles without any rounding.
struct Dyadic {
    Integer mantissa = 0;
    int exponent = 0;

    Dyadic() = default;
    Dyadic(double x) {
        int power = 0;
        auto bits = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &power), 53));
        if (bits == 0) return;
        const int zeros = std::countr_zero(static_cast<std::uint64_t>(bits));
        mantissa = bits >> zeros;
        exponent = power - 53 + zeros;
    }
    Dyadic(Integer m, int e) : mantissa(std::move(m)), exponent(e) {}

    int sign() const { return mantissa.sign(); }
    Dyadic operator-() const { return {-mantissa, exponent}; }
};

Dyadic operator*(const Dyadic& a, const Dyadic& b) { return {a.mantissa * b.mantissa, a.exponent + b.exponent}; }
Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    if (a.sign() == 0) return b;
    if (b.sign() == 0) return a;
    if (a.exponent > b.exponent) return b + a;
    return {a.mantissa + (b.mantissa << (b.exponent - a.exponent)), a.exponent};
}
Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + -b; }
bool operator<(const Dyadic& a, const Dyadic& b) { return (a - b).sign() < 0; }

struct Vector {
    Dyadic x, y, z;
    Vector(Dyadic x_, Dyadic y_, Dyadic z_) : x(std::move(x_)), y(std::move(y_)), z(std::move(z_)) {}
    explicit Vector(const Point3& p) : x(p.x), y(p.y), z(p.z) {}
    explicit Vector(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Dyadic dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vector image_of_vector(std::span<const Transform> chain, Vector v) {
    for (auto m = chain.rbegin(); m != chain.rend(); ++m) {
        const auto row = [&](std::size_t i) {
            return dot(Vector(Vec3{m->rows[i][0], m->rows[i][1], m->rows[i][2]}), v);
        };
        v = {row(0), row(1), row(2)};
    }
    return v;
}

Vector image_of_point(std::span<const Transform> chain, Vector p) {
    for (auto m = chain.rbegin(); m != chain.rend(); ++m) p = image_of_vector({&*m, 1}, p) + Vector(m->translation());
    return p;
}

Real scaled(Real x, int power) {
    for (; power > 1000; power -= 1000) x *= Real(0x1p1000);
    for (; power < -1000; power += 1000) x *= Real(0x1p-1000);
    return x * Real(std::ldexp(1.0, power));
}

// x * 2^power.
Real to_real(const Dyadic& x, int power = 0) {
    if (x.sign() == 0) return 0;
    Integer m = abs(x.mantissa);
    const int surplus = static_cast<int>(msb(m)) - 127;
    m = surplus > 0 ? m >> surplus : m << -surplus;  // 128 bits: what is cut off is less than half a unit of a Real
    const Real value = Real(static_cast<std::uint64_t>(m >> 64)) * Real(0x1p64) +
                       Real(static_cast<std::uint64_t>(m & ~std::uint64_t{0}));
    return scaled(x.sign() < 0 ? -value : value, x.exponent + surplus + power);
}

// The exponent e of 2^e <= |x| < 2^(e + 1).
int magnitude(const Dyadic& x) {
    return x.sign() == 0 ? -1'000'000 : static_cast<int>(msb(abs(x.mantissa))) + x.exponent;
}
int magnitude(const Vector& v) { return std::max({magnitude(v.x), magnitude(v.y), magnitude(v.z)}); }

Real quotient(const Dyadic& numerator, const Dyadic& denominator) {
    const int n = numerator.sign() == 0 ? 0 : magnitude(numerator), d = magnitude(denominator);
    return scaled(to_real(numerator, -n) / to_real(denominator, -d), n - d);
}

// Cramer's rule for corner + u edge_u + v edge_v = origin + t direction.
ExactHit planar_hit(const Vector& corner, const Vector& edge_u, const Vector& edge_v, bool is_triangle,
                    const Ray& ray) {
    if (!is_usable(ray)) return {};
    const Vector d(ray.direction), q = Vector(ray.origin) - corner;
    const Vector n = cross(edge_u, edge_v), dq = cross(d, q);
    Dyadic det = -dot(n, d), u = -dot(edge_v, dq), v = dot(edge_u, dq), t = dot(n, q);
    if (det.sign() == 0) return {};
    if (det.sign() < 0) det = -det, u = -u, v = -v, t = -t;
    if (u.sign() < 0 || v.sign() < 0) return {};
    if (is_triangle ? det < u + v : det < u || det < v) return {};
    if (std::isfinite(ray.t_min) && !(Dyadic(ray.t_min) * det < t)) return {};
    if (std::isfinite(ray.t_max) && Dyadic(ray.t_max) * det < t) return {};
    return {true, quotient(t, det), quotient(u, det), quotient(v, det)};
}

// a t^2 + 2 b t + c = 0 with a > 0 and real roots.
struct Quadratic {
    Dyadic a, b, c;

    bool near_is_above(double t) const { return value(t).sign() > 0 && half_slope(t).sign() < 0; }
    bool far_is_above(double t) const { return value(t).sign() < 0 || half_slope(t).sign() < 0; }

private:
    Dyadic value(double t) const { return (a * Dyadic(t) + b + b) * Dyadic(t) + c; }
    Dyadic half_slope(double t) const { return a * Dyadic(t) + b; }
};

}  // namespace

ExactHit exact_triangle_hit(const Point3& a, const Point3& b, const Point3& c, const Ray& ray,
                            std::span<const Transform> chain) {
    const Vector corner(a);
    return planar_hit(image_of_point(chain, corner), image_of_vector(chain, Vector(b) - corner),
                      image_of_vector(chain, Vector(c) - corner), true, ray);
}

ExactHit exact_quad_hit(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Ray& ray,
                        std::span<const Transform> chain) {
    return planar_hit(image_of_point(chain, Vector(corner)), image_of_vector(chain, Vector(edge_u)),
                      image_of_vector(chain, Vector(edge_v)), false, ray);
}

// In the object's space, times the determinant of the chain, so that the inverse is its adjugate: |w + t e| = r.
ExactHit exact_sphere_hit(const Point3& center, double radius, const Ray& ray, std::span<const Transform> chain) {
    if (!is_usable(ray)) return {};
    Vector w = Vector(ray.origin) - Vector(center), e(ray.direction);
    Dyadic r(radius);
    if (!chain.empty()) {
        const Vector x = image_of_vector(chain, {1, 0, 0}), y = image_of_vector(chain, {0, 1, 0}),
                     z = image_of_vector(chain, {0, 0, 1});
        const Vector yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
        const Dyadic det = dot(x, yz);
        const auto adjugate = [&](const Vector& v) { return Vector(dot(yz, v), dot(zx, v), dot(xy, v)); };
        w = adjugate(Vector(ray.origin) - image_of_point(chain, Vector(center)));
        e = adjugate(e);
        r = det * r;
    }
    const Quadratic q{dot(e, e), dot(w, e), dot(w, w) - r * r};
    const Dyadic discriminant = q.b * q.b - q.a * q.c;
    if (discriminant.sign() < 0) return {};
    const auto in_range = [&](auto is_above) {
        return (ray.t_min == -kInfinity || is_above(ray.t_min)) && (ray.t_max == kInfinity || !is_above(ray.t_max));
    };
    const bool is_near = in_range([&](double t) { return q.near_is_above(t); });
    if (!is_near && !in_range([&](double t) { return q.far_is_above(t); })) return {};

    // Lengths in units of 2^size and t in units of 2^(size - speed), so that no square leaves the range. The root
    // that would cancel comes from the product of the roots.
    const int size = std::max(magnitude(w), magnitude(r)), speed = magnitude(e);
    const Real a = to_real(q.a, -2 * speed), b = to_real(q.b, -size - speed), c = to_real(q.c, -2 * size);
    const Real root = square_root(to_real(discriminant, -2 * (size + speed)));
    const Real outer = b < 0 ? root - b : -root - b;
    if (outer == 0) return {true, 0, 0, 0};  // tangent at the origin
    const Real t = (outer > 0) == is_near ? c / outer : outer / a;
    return {true, scaled(t, size - speed), 0, 0};
}

bool exact_box_hit(const Box& box, const Ray& ray) {
    if (!is_usable(ray) || box.is_empty()) return false;
    using Fraction = std::pair<Dyadic, Dyadic>;  // with a positive denominator
    std::vector<Fraction> entries, exits;
    if (std::isfinite(ray.t_min)) entries.emplace_back(ray.t_min, 1);
    if (std::isfinite(ray.t_max)) exits.emplace_back(ray.t_max, 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double o = ray.origin[axis], d = ray.direction[axis];
        if (d == 0 && !(box.lower[axis] <= o && o <= box.upper[axis])) return false;
        if (d == 0) continue;
        const auto add = [&](std::vector<Fraction>& list, double side) {
            if (!std::isfinite(side)) return;
            const Dyadic distance = Dyadic(side) - Dyadic(o);
            list.emplace_back(d < 0 ? -distance : distance, std::abs(d));
        };
        add(entries, d < 0 ? box.upper[axis] : box.lower[axis]);
        add(exits, d < 0 ? box.lower[axis] : box.upper[axis]);
    }
    for (const auto& [entry, per] : entries)
        for (const auto& [exit, unit] : exits)
            if (exit * per < entry * unit) return false;
    return true;
}

namespace {

// Each coordinate less than any decision between these numbers notices, and than what the one before it changes. All
// numbers are multiples of 2^least and below 2^most. The determinants are multiples of its cube and linear in the move,
// with slopes that are multiples of its square and below 2^(2 most + 5).
Vector least_move(std::initializer_list<Vec3> numbers) {
    int least = 0, most = 0;
    for (const Vec3& v : numbers)
        for (const double x : {v.x, v.y, v.z}) {
            if (x == 0) continue;
            most = std::max(most, std::ilogb(x) + 1);
            least = std::min(least, Dyadic(x).exponent);
        }
    const int slope = 2 * most + 6, first = slope - 3 * least, further = slope - 2 * least;
    return {Dyadic(1, -first), Dyadic(1, -first - further), Dyadic(1, -first - 2 * further)};
}

}  // namespace

int exact_moved_passage(const Point3& a, const Point3& b, const Point3& c, const Point3& origin,
                        const Vec3& direction) {
    const auto passage = [](const auto& to_a, const auto& to_b, const auto& to_c, const auto& d, const auto& sign) {
        const int wa = sign(dot(d, cross(to_b, to_c))), wb = sign(dot(d, cross(to_c, to_a))),
                  wc = sign(dot(d, cross(to_a, to_b)));
        if (wa * wb < 0 || wb * wc < 0 || wc * wa < 0) return 0;
        if (wa == 0 || wb == 0 || wc == 0) return 2;
        const int ahead = sign(dot(to_a, cross(to_b, to_c))) * wa;
        return ahead == 0 ? 2 : ahead > 0 ? wa : 0;
    };
    // Filters: the bounds are many times what rounding may do, where nothing underflows.
    const auto filtered = [&](const auto& to_a, const auto& to_b, const auto& to_c, const auto& d, double epsilon) {
        const auto size = (length(to_a) + length(to_b) + length(to_c)) * (1 + length(d)),
                   bound = epsilon * size * size * size;
        if (!(bound > 1e-290)) return 2;
        return passage(to_a, to_b, to_c, d, [&](const auto& x) { return x > bound ? 1 : x < -bound ? -1 : 0; });
    };
    const int in_double = filtered(a - origin, b - origin, c - origin, direction, 1e-12);
    if (in_double != 2) return in_double;
    const Real3 o(origin);
    const int told = filtered(Real3(a) - o, Real3(b) - o, Real3(c) - o, Real3(direction), 1e-29);
    if (told != 2) return told;
    const Vector moved =
        Vector(origin) + least_move({a - Point3{}, b - Point3{}, c - Point3{}, origin - Point3{}, direction});
    const int exact = passage(Vector(a) - moved, Vector(b) - moved, Vector(c) - moved, Vector(direction),
                              [](const Dyadic& x) { return x.sign(); });
    return exact == 2 ? 0 : exact;  // a plane along the ray
}

bool exactly_on_triangle(const Point3& a, const Point3& b, const Point3& c, const Point3& p) {
    for (std::size_t axis = 0; axis < 3; ++axis)  // outside of the box of the corners
        if (p[axis] < std::min({a[axis], b[axis], c[axis]}) || p[axis] > std::max({a[axis], b[axis], c[axis]}))
            return false;
    const Vector o(p), to_a = Vector(a) - o, to_b = Vector(b) - o, to_c = Vector(c) - o;
    const Vector n = cross(to_b - to_a, to_c - to_a);
    return dot(to_a, n).sign() == 0 && dot(n, cross(to_a, to_b)).sign() >= 0 && dot(n, cross(to_b, to_c)).sign() >= 0 &&
           dot(n, cross(to_c, to_a)).sign() >= 0;
}

bool exactly_flat(const Point3& a, const Point3& b, const Point3& c) {
    const Vector n = cross(Vector(b) - Vector(a), Vector(c) - Vector(a));
    return n.x.sign() == 0 && n.y.sign() == 0 && n.z.sign() == 0;
}

}  // namespace limn::test
