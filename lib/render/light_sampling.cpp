#include "render/light_sampling.h"

#include <algorithm>
#include <cmath>

#include "core/sphere_uv.h"
#include "limn/core/frame.h"
#include "limn/core/warp.h"
#include "predicates/mesh_triangle.h"
#include "render/planar_light.h"

namespace limn::transport {

namespace {

using flat::Light;
using flat::LightKind;

// The sphere as the receiver sees it. From inside it is everywhere; then one_minus_cos is 2.
struct Cone {
    Point3 center;
    Vec3 to_center;
    double distance_squared, one_minus_cos;
    bool inside;
};

Cone cone_of(const Light& light, const Point3& from, double time) {
    Cone c;
    c.center = light.edge_u == Vec3{} ? light.origin : interpolate(light.origin, light.origin + light.edge_u, time);
    c.to_center = c.center - from;
    c.distance_squared = length_squared(c.to_center);
    const double sin_squared = light.radius * light.radius / c.distance_squared;
    c.inside = !(sin_squared < 1);
    // sin^2 / (1 + cos) rather than 1 - cos, which vanishes for distant spheres.
    c.one_minus_cos = c.inside ? 2 : sin_squared / (1 + std::sqrt(1 - sin_squared));
    return c;
}

bool sample_sphere(const Light& light, const Point3& from, double time, double u, double v, LightSample& s) {
    const Cone cone = cone_of(light, from, time);
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
    if (!is_finite(normal)) return false;
    s.point.position = cone.center + light.radius * normal;
    s.point.normal = Normal3(cone.inside ? -normal : normal);
    if (light.textured) s.point.uv = sphere_uv(normal);
    return true;
}

bool sample_flat(const flat::Scene& scene, const Light& light, const Point3& from, double u, double v, LightSample& s) {
    const std::optional<PlanarSample> drawn = sample_planar(light, from, u, v);
    if (!drawn) return false;
    const Uv weights = drawn->weights;
    const Vec3 way = drawn->position - from;
    s.point.position = drawn->position;
    s.pdf = drawn->pdf;
    s.direction = normalize(way);
    const Normal3 normal(normalize(drawn->normal));
    s.point.normal = dot(normal, way) > 0 ? -normal : normal;
    if (!light.textured) return true;
    s.point.uv = weights;
    const flat::Place place = flat::locate(scene, light.number);
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind == PrimitiveKind::mesh)
        s.point.uv =
            texture_coordinates(scene.meshes[range.first_row].arrays, place.element, {0, weights.u, weights.v});
    return true;
}

}  // namespace

std::optional<LightSample> sample_light(const flat::Scene& scene, const Receiver& receiver, double time, double pick,
                                        double u, double v) {
    const std::optional<LightChoice> choice = choose_light(scene.lights, receiver, pick);
    if (!choice) return std::nullopt;
    Light room;
    const Light& light = flat::light_at(scene, choice->rank, time, room);
    return sample_chosen_light(scene, light, choice->probability, receiver, time, u, v);
}

std::optional<LightSample> sample_chosen_light(const flat::Scene& scene, const Light& light, double probability,
                                               const Receiver& receiver, double time, double u, double v) {
    std::optional<LightSample> s(std::in_place);
    const bool drawn = light.kind == LightKind::sphere ? sample_sphere(light, receiver.position, time, u, v, *s)
                                                       : sample_flat(scene, light, receiver.position, u, v, *s);
    if (!drawn) return std::nullopt;
    s->pdf *= probability;
    s->point.shading_normal = s->point.normal;
    s->point.position_error = light.position_error;
    s->point.material = {static_cast<std::uint32_t>(light.material), nullptr, nullptr};
    return s;
}

double pdf_light(const flat::Scene& scene, const Receiver& receiver, double time, std::uint64_t number,
                 const Point3& hit) {
    const auto& numbers = scene.lights.by_number;
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), number,
                                        [](const flat::LightNumber& l, std::uint64_t n) { return l.number < n; });
    if (found == numbers.end() || found->number != number) return 0;
    Light room;
    const Light& light = flat::light_at(scene, found->rank, time, room);
    const double pdf = light.kind == LightKind::sphere
                           ? pdf_uniform_cone(cone_of(light, receiver.position, time).one_minus_cos)
                           : pdf_planar(light, receiver.position, hit - receiver.position);
    return pdf > 0 ? pdf * probability_of(scene.lights, receiver, found->rank) : 0;
}

}  // namespace limn::transport
