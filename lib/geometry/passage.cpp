#include "geometry/passage.h"

#include <array>
#include <cmath>
#include <span>

#include "geometry/dyadic.h"

namespace limn {

namespace {

// Returns the sign of value + move.slope for the move of passage.h.
int moved_sign(const Dyadic& value, const Dyadic3& slope, const RayFrame& frame) {
    if (value.sign() != 0) return value.sign();
    for (std::size_t a = 0; a < 3; ++a) {
        Vec3 axis;
        axis[a] = 1;
        const int sign = dot(exact_vector(frame, axis), slope).sign();
        if (sign != 0) return sign;
    }
    return 0;
}

// A flat convex shape. Its corners are relative to the ray's origin, multiplied by ray.unit, and counter-clockwise
// about the normal.
template <std::size_t kCorners>
struct Polygon {
    std::array<Dyadic3, kCorners> corners;
    Dyadic3 normal;

    const Dyadic3& next(std::size_t i) const { return corners[(i + 1) % kCorners]; }
};

Polygon<3> polygon_of(const Point3& a, const Point3& b, const Point3& c, const ExactRay& ray) {
    const auto seen = [&](const Point3& p) { return ray.unit * to_dyadic(p) - ray.origin; };
    const Dyadic3 to_a = seen(a), to_b = seen(b), to_c = seen(c);
    return {{to_a, to_b, to_c}, cross(to_b - to_a, to_c - to_a)};
}

Polygon<4> polygon_of(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const ExactRay& ray) {
    const auto plus = [](const Dyadic3& a, const Dyadic3& b) { return Dyadic3{a.x + b.x, a.y + b.y, a.z + b.z}; };
    const Dyadic3 q = ray.unit * to_dyadic(corner) - ray.origin;
    const Dyadic3 u = ray.unit * to_dyadic(edge_u), v = ray.unit * to_dyadic(edge_v);
    const Dyadic3 at_u = plus(q, u);
    return {{q, at_u, plus(at_u, v), plus(q, v)}, cross(u, v)};
}

// Returns true if the moved ray passes through the polygon, and sets t and `inward` of the passage.
//
// Let D be the direction, N the normal, A and B the two corners of an edge, and E the move.
//   - The ray passes an edge on the side given by the sign of D.(A x B). The move adds E.(D x (B - A)). The sign is 0
//     for an edge along the ray. Then the face is parallel to the ray, and D.N = 0: such a face has no passage.
//   - t = A.N / D.N. Therefore t - t_end has the sign of A.N - t_end D.N, times the sign of D.N. The move subtracts E.N
//     from A.N.
template <std::size_t kCorners>
bool passes(const Polygon<kCorners>& polygon, const ExactRay& ray, const RayFrame& frame, const Search& search,
            Passage& passage) {
    // A ray parallel to the plane has no passage.
    const Dyadic along = dot(ray.direction, polygon.normal);
    const int side = along.sign();
    if (side == 0) return false;
    // The ray must pass all edges on the same side.
    for (std::size_t i = 0; i < kCorners; ++i) {
        const Dyadic3 &a = polygon.corners[i], &b = polygon.next(i);
        if (moved_sign(dot(ray.direction, cross(a, b)), cross(ray.direction, b - a), frame) != side) return false;
    }
    // The passage must be between the ends of the ray.
    const Dyadic to_plane = dot(polygon.corners[0], polygon.normal);
    const Dyadic3 slope = Dyadic(-1.0) * polygon.normal;
    const auto is_after = [&](double end) {
        return moved_sign(to_plane - Dyadic(end) * along, slope, frame) * side > 0;
    };
    if (std::isfinite(search.t_min) && !is_after(search.t_min)) return false;
    if (std::isfinite(search.t_max) && is_after(search.t_max)) return false;
    passage.t = ratio(to_plane, along);
    passage.inward = side < 0;
    return true;
}

// Returns true if the ray's origin o is on the polygon: in its plane, and with n.((b - a) x (o - a)) not negative for
// any edge from a to b. As the corners are relative to o, this is n.(a x b).
template <std::size_t kCorners>
bool holds_origin(const Polygon<kCorners>& polygon) {
    if (dot(polygon.corners[0], polygon.normal).sign() != 0) return false;
    for (std::size_t i = 0; i < kCorners; ++i)
        if (dot(polygon.normal, cross(polygon.corners[i], polygon.next(i))).sign() < 0) return false;
    return true;
}

// A sphere and a ray. p is the ray's origin relative to the centre. The power of a point is its squared distance from
// the centre minus the squared radius; for the point of the ray at t it is a t^2 + 2 b t + c. All numbers are
// multiplied by powers of ray.unit.
struct ExactSphere {
    ExactRay ray;
    Dyadic3 p;
    Dyadic a, b, c;

    ExactSphere(const Point3& center, double radius, const RayFrame& frame) : ray(exact_ray(frame)) {
        p = ray.origin - ray.unit * to_dyadic(center);
        const Dyadic r = ray.unit * Dyadic(radius);
        a = dot(ray.direction, ray.direction);
        b = dot(p, ray.direction);
        c = dot(p, p) - r * r;
    }

    // Returns true if the moved ray is inside the sphere at t = `end`: if the power there is negative. The move E adds
    // 2 E.(p + t d), d the direction, to the power. On the sphere p + t d is not the zero vector. An infinite end is
    // outside.
    bool is_inside(double end, const RayFrame& frame) const {
        if (!std::isfinite(end)) return false;
        const Dyadic t(end);
        const Dyadic3 back = Dyadic(-1.0) * (t * ray.direction);
        return moved_sign(t * (t * a + b + b) + c, p - back, frame) < 0;
    }
    // Returns true if the middle of the chord is at a larger t than `end`.
    bool is_before_middle(double end) const {
        return end < 0 && !std::isfinite(end) ? true : std::isfinite(end) && (b + Dyadic(end) * a).sign() < 0;
    }
};

}  // namespace

bool exact_passage(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                   Passage& passage) {
    const ExactRay ray = exact_ray(frame);
    const Polygon<3> polygon = polygon_of(a, b, c, ray);
    if (!passes(polygon, ray, frame, search, passage)) return false;
    const auto& [to_a, to_b, to_c] = polygon.corners;
    const Dyadic along = dot(ray.direction, polygon.normal);
    passage.u = ratio(dot(ray.direction, cross(to_c, to_a)), along);
    passage.v = ratio(dot(ray.direction, cross(to_a, to_b)), along);
    return true;
}

bool exact_passage(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                   const Search& search, Passage& passage) {
    const ExactRay ray = exact_ray(frame);
    const Polygon<4> polygon = polygon_of(corner, edge_u, edge_v, ray);
    if (!passes(polygon, ray, frame, search, passage)) return false;
    const Dyadic along = dot(ray.direction, polygon.normal);
    const Dyadic3& q = polygon.corners[0];
    passage.u = ratio(dot(q, cross(ray.direction, polygon.corners[3] - q)), along);
    passage.v = ratio(dot(q, cross(polygon.corners[1] - q, ray.direction)), along);
    return true;
}

int exact_passages(const Point3& center, double radius, const RayFrame& frame, const Search& search,
                   Passage (&passages)[2]) {
    const ExactSphere sphere(center, radius, frame);
    // Find out on which side the ends are, and whether a ray from outside to outside crosses the sphere.
    const bool starts_inside = sphere.is_inside(search.t_min, frame),
               ends_inside = sphere.is_inside(search.t_max, frame);
    const bool is_met = (sphere.b * sphere.b - sphere.a * sphere.c).sign() > 0;
    if (starts_inside && ends_inside) return 0;
    const bool is_crossed = is_met && sphere.is_before_middle(search.t_min) && !sphere.is_before_middle(search.t_max);
    if (!starts_inside && !ends_inside && !is_crossed) return 0;
    // The ray enters the sphere at the first root unless it starts inside, and leaves it at the second unless it ends
    // inside.
    const SphereHits hits = exact_sphere(center, radius, frame, nullptr, nullptr, {-kInfinity, kInfinity});
    int count = 0;
    if (!starts_inside) passages[count++] = {{hits.near, 0, 0}, radius > 0};
    if (!ends_inside) passages[count++] = {{hits.far, 0, 0}, radius < 0};
    return count;
}

int exact_facing(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame) {
    const ExactRay ray = exact_ray(frame);
    return dot(ray.direction, polygon_of(a, b, c, ray).normal).sign();
}
int exact_facing(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame) {
    const ExactRay ray = exact_ray(frame);
    return dot(ray.direction, polygon_of(corner, edge_u, edge_v, ray).normal).sign();
}

bool is_origin_on(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame) {
    return holds_origin(polygon_of(a, b, c, exact_ray(frame)));
}
bool is_origin_on(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame) {
    return holds_origin(polygon_of(corner, edge_u, edge_v, exact_ray(frame)));
}
bool is_origin_on(const Point3& center, double radius, const RayFrame& frame) {
    return ExactSphere(center, radius, frame).c.sign() == 0;
}

}  // namespace limn
