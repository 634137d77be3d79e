#include "render/planar_light.h"

#include <algorithm>
#include <cmath>

#include "sampling/spherical_rectangle.h"
#include "sampling/spherical_triangle.h"

namespace limn::transport {

namespace {

using flat::Light;
using flat::LightKind;

bool is_far(const Light& light, const Point3& from) {
    if (light.kind == LightKind::triangle) {
        const Vec3 to_center = light.origin + (light.edge_u + light.edge_v) / 3 - from;
        // The longest way from the centroid is two thirds of a median, less than two thirds of the longest side.
        const double side2 = std::max(
            {length_squared(light.edge_u), length_squared(light.edge_v), length_squared(light.edge_v - light.edge_u)});
        return flat::kFarSquared * (4.0 / 9.0) * side2 <= length_squared(to_center);
    }
    const Vec3 diagonal = light.edge_u + light.edge_v, other = light.edge_u - light.edge_v;
    const double radius2 = std::max(length_squared(diagonal), length_squared(other)) / 4;
    return flat::kFarSquared * radius2 <= length_squared(light.origin + diagonal / 2 - from);
}

// Density per solid angle of a point drawn uniformly by area; 0 if the plane is seen edge-on. \param scaled_normal as
// long as a quad's area
double pdf_by_area(const Light& light, const Vec3& scaled_normal, const Vec3& way) {
    const double projected = std::abs(dot(scaled_normal, way)) * flat::share_of(light);
    const double distance_squared = length_squared(way);
    return projected > 0 ? distance_squared * std::sqrt(distance_squared) / projected : 0;
}

sampling::SphericalTriangle seen(const Point3& from, const Point3& a, const Point3& b, const Point3& c) {
    return {normalize(a - from), normalize(b - from), normalize(c - from)};
}

// The parts that a parallelogram without right angles is made of: origin, u, v and what is opposite.
struct Halves {
    sampling::SphericalTriangle lower, upper;

    Halves(const Light& light, const Point3& from)
        : lower(seen(from, light.origin + light.edge_u, light.origin, light.origin + light.edge_v)),
          upper(seen(from, light.origin + light.edge_v, light.origin + light.edge_u + light.edge_v,
                     light.origin + light.edge_u)) {}
    double solid_angle() const { return lower.solid_angle() + upper.solid_angle(); }
};

// Where a direction meets the plane, as weights of the edges; rounding may not leave the light.
Uv weights_of(const Light& light, const Point3& from, const Vec3& direction) {
    const Vec3 p = cross(direction, light.edge_v), s = from - light.origin;
    const double over = 1 / dot(light.edge_u, p);
    if (!std::isfinite(over)) return {};
    Uv w{std::clamp(dot(s, p) * over, 0.0, 1.0), std::clamp(dot(direction, cross(s, light.edge_u)) * over, 0.0, 1.0)};
    if (light.kind == LightKind::triangle && w.u + w.v > 1) {
        const double sum = w.u + w.v;
        w = {w.u / sum, w.v / sum};
    }
    return w;
}

}  // namespace

std::optional<PlanarSample> sample_planar(const Light& light, const Point3& from, double u, double v) {
    PlanarSample s;
    s.normal = cross(light.edge_u, light.edge_v);
    if (dot(s.normal, light.origin - from) == 0) return std::nullopt;  // edge-on
    double solid_angle = 0;
    if (!is_far(light, from)) {
        switch (light.kind) {
            case LightKind::rectangle: {
                const sampling::SphericalRectangle rectangle(light.origin, light.edge_u, light.edge_v, from);
                solid_angle = rectangle.solid_angle();
                if (solid_angle >= flat::kSmallSolidAngle) s.weights = rectangle.sample(u, v);
                break;
            }
            case LightKind::triangle: {
                const sampling::SphericalTriangle triangle =
                    seen(from, light.origin, light.origin + light.edge_u, light.origin + light.edge_v);
                solid_angle = triangle.solid_angle();
                if (solid_angle >= flat::kSmallSolidAngle) s.weights = weights_of(light, from, triangle.sample(u, v));
                break;
            }
            case LightKind::parallelogram: {
                const Halves halves(light, from);
                solid_angle = halves.solid_angle();
                if (!(solid_angle >= flat::kSmallSolidAngle)) break;
                const double share = halves.lower.solid_angle() / solid_angle;
                s.weights = weights_of(
                    light, from,
                    u < share ? halves.lower.sample(u / share, v) : halves.upper.sample((u - share) / (1 - share), v));
                break;
            }
            default: break;
        }
    }
    const bool by_area = !(solid_angle >= flat::kSmallSolidAngle);
    if (by_area) s.weights = flat::sample_area(light, u, v);
    s.position = light.origin + (s.weights.u * light.edge_u + s.weights.v * light.edge_v);
    s.pdf = by_area ? pdf_by_area(light, s.normal, s.position - from) : 1 / solid_angle;
    if (!(s.pdf > 0)) return std::nullopt;
    return s;
}

double pdf_planar(const Light& light, const Point3& from, const Vec3& way) {
    const Vec3 normal = cross(light.edge_u, light.edge_v);
    if (dot(normal, light.origin - from) == 0) return 0;
    if (is_far(light, from)) return pdf_by_area(light, normal, way);
    double solid_angle = 0;
    switch (light.kind) {
        case LightKind::rectangle:
            solid_angle = sampling::SphericalRectangle(light.origin, light.edge_u, light.edge_v, from).solid_angle();
            break;
        case LightKind::triangle:
            solid_angle =
                seen(from, light.origin, light.origin + light.edge_u, light.origin + light.edge_v).solid_angle();
            break;
        case LightKind::parallelogram: solid_angle = Halves(light, from).solid_angle(); break;
        default: break;
    }
    return solid_angle >= flat::kSmallSolidAngle ? 1 / solid_angle : pdf_by_area(light, normal, way);
}

}  // namespace limn::transport
