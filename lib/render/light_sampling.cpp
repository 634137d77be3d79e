#include "render/light_sampling.h"

#include <algorithm>
#include <cmath>

#include "core/mesh_triangle.h"
#include "core/sphere_uv.h"
#include "limn/core/frame.h"
#include "limn/core/warp.h"
#include "render/spherical_rectangle.h"

namespace limn::tracing {

namespace {

using flat::Light;
using flat::LightKind;

// Below this solid angle (in steradians) the inversion that places samples has lost two thirds of its digits: such a
// rectangle is small, far or seen almost edge-on, and gives little light however it is sampled.
constexpr double kSmallSolidAngle = 1e-5;

// Density per solid angle of a point drawn uniformly on a planar light; 0 if it is seen edge-on.
double pdf_by_area(const Light& light, const Vec3& to_point) {
    const Vec3 scaled_normal = cross(light.edge_u, light.edge_v);  // its length is the quad's area
    const double projected = std::abs(dot(scaled_normal, to_point)) * (light.kind == LightKind::triangle ? 0.5 : 1);
    const double distance_squared = length_squared(to_point);
    return projected > 0 ? distance_squared * std::sqrt(distance_squared) / projected : 0;
}

double pdf_planar(const Light& light, const Point3& from, const Vec3& to_point) {
    if (light.kind == LightKind::rectangle) {
        const double angle = SphericalRectangle(light.origin, light.edge_u, light.edge_v, from).solid_angle();
        if (angle >= kSmallSolidAngle) return 1 / angle;
    }
    return pdf_by_area(light, to_point);
}

// The sphere as the receiver sees it. From inside it is everywhere; then one_minus_cos is 2.
struct Cone {
    Point3 center;
    Vec3 to_center;
    double distance_squared, one_minus_cos;
    bool inside;
};

Cone cone_of(const Light& light, const Point3& from, double time) {
    Cone c;
    c.center = interpolate(light.origin, light.origin + light.edge_u, time);
    c.to_center = c.center - from;
    c.distance_squared = length_squared(c.to_center);
    const double sin_squared = light.radius * light.radius / c.distance_squared;
    c.inside = !(sin_squared < 1);
    // sin^2 / (1 + cos) rather than 1 - cos, which vanishes for distant spheres.
    c.one_minus_cos = c.inside ? 2 : sin_squared / (1 + std::sqrt(1 - sin_squared));
    return c;
}

std::optional<LightSample> sample_sphere(const Light& light, const Point3& from, double time, double u, double v) {
    const Cone cone = cone_of(light, from, time);
    LightSample s;
    s.pdf = pdf_uniform_cone(cone.one_minus_cos);
    if (cone.inside) {
        s.direction = sample_uniform_sphere(u, v);
    } else {
        const Frame frame(normalize(cone.to_center));
        s.direction = frame.to_world(sample_uniform_cone(u, v, cone.one_minus_cos));
    }
    // Where the direction meets the sphere: along it to the foot of the centre, then half a chord back (from inside:
    // forward). At the rim rounding may leave no chord.
    const double along = dot(cone.to_center, s.direction);
    const Vec3 foot = along * s.direction - cone.to_center;
    const double half_chord = std::sqrt(std::max(0.0, light.radius * light.radius - length_squared(foot)));
    const Vec3 normal = normalize(foot + (cone.inside ? half_chord : -half_chord) * s.direction);
    if (!is_finite(normal)) return std::nullopt;
    s.point.position = cone.center + light.radius * normal;
    s.point.normal = Normal3(cone.inside ? -normal : normal);
    s.point.uv = sphere_uv(normal);
    return s;
}

std::optional<LightSample> sample_planar(const flat::Scene& scene, const Light& light, const Point3& from, double u,
                                         double v) {
    Uv weights = light.kind == LightKind::triangle ? sample_uniform_triangle(u, v) : Uv{u, v};
    LightSample s;
    double solid_angle = 0;
    if (light.kind == LightKind::rectangle) {
        const SphericalRectangle rectangle(light.origin, light.edge_u, light.edge_v, from);
        solid_angle = rectangle.solid_angle();
        if (solid_angle >= kSmallSolidAngle) weights = rectangle.sample(u, v);
    }
    s.point.position = light.origin + (weights.u * light.edge_u + weights.v * light.edge_v);
    const Vec3 to_point = s.point.position - from;
    s.pdf = solid_angle >= kSmallSolidAngle ? 1 / solid_angle : pdf_by_area(light, to_point);
    if (!(s.pdf > 0)) return std::nullopt;
    s.direction = normalize(to_point);
    const Normal3 normal(normalize(cross(light.edge_u, light.edge_v)));
    s.point.normal = dot(normal, to_point) > 0 ? -normal : normal;
    s.point.uv = weights;
    const TextureId texture = scene.materials[static_cast<std::size_t>(light.material)].texture;
    if (scene.textures[static_cast<std::size_t>(texture)].kind != TextureKind::solid) {
        const flat::Place place = flat::locate(scene, light.number);
        const PrimitiveRange& range = scene.ranges[place.range];
        if (range.kind == PrimitiveKind::mesh)
            s.point.uv =
                texture_coordinates(scene.meshes[range.first_row].arrays, place.element, {0, weights.u, weights.v});
    }
    return s;
}

}  // namespace

std::optional<LightSample> sample_light(const flat::Scene& scene, const Point3& from, double time, double pick,
                                        double u, double v) {
    const auto after = std::upper_bound(scene.lights.begin(), scene.lights.end(), pick,
                                        [](double p, const Light& light) { return p < light.pick_below; });
    const Light& light = after == scene.lights.begin() ? *after : *(after - 1);
    std::optional<LightSample> s = light.kind == LightKind::sphere ? sample_sphere(light, from, time, u, v)
                                                                   : sample_planar(scene, light, from, u, v);
    if (!s) return s;
    s->pdf *= light.pick;
    s->point.shading_normal = s->point.normal;
    s->point.position_error = light.position_error;
    s->point.material = {static_cast<std::uint32_t>(light.material), nullptr, nullptr};
    return s;
}

double pdf_light(const flat::Scene& scene, std::uint64_t number, const Point3& from, const Surface& hit, double time) {
    const auto light = std::lower_bound(scene.lights.begin(), scene.lights.end(), number,
                                        [](const Light& l, std::uint64_t n) { return l.number < n; });
    if (light == scene.lights.end() || light->number != number) return 0;
    const double pdf = light->kind == LightKind::sphere ? pdf_uniform_cone(cone_of(*light, from, time).one_minus_cos)
                                                        : pdf_planar(*light, from, hit.position - from);
    return light->pick * pdf;
}

}  // namespace limn::tracing
