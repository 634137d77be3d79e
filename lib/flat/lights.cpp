#include "flat/lights.h"

#include <algorithm>
#include <cmath>

#include "bsdf/environment.h"
#include "geometry/registry.h"
#include "limn/math/math.h"
#include "math/elementary.h"

namespace limn::flat {

namespace {

// Returns the bounds of a light that looks alike from everywhere.
LightBounds without_normals(const Box& box, double strength) { return {box, {{0, 0, 1}, kNoNormals}, strength}; }

// Returns the radiance of a light without extent. \param irradiance arrives from it at a distance of 1. The pdf of its
// samples grows with the square of the distance.
Color radiance_without_extent(const Color& irradiance) { return irradiance / kNoSolidAngle; }

// Returns the radiance of a disc of angular radius r: it gives a perpendicular plane the irradiance pi radiance
// sin(r)^2.
Color disc_radiance(const SunLight& sun) {
    return sun.irradiance / (kPi * sun.one_minus_cos * (2 - sun.one_minus_cos));
}

}  // namespace

Box box_of(const Light& light) {
    return std::visit(
        []<class Kind>(const Kind& kind) {
            if constexpr (requires { kind.box(); })
                return kind.box();
            else
                return Box{};
        },
        light);
}

Color seen_radiance(const Light& light, const Vec3& direction) {
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (requires { kind.seen_radiance(direction); })
                return kind.seen_radiance(direction);
            else
                return Color{};
        },
        light);
}

// ---- triangles, quads and disks ------------------------------------------------------------------------------------

Box PlanarLight::box() const {
    Box box;
    box.extend(corner);
    box.extend(corner + edge_u);
    box.extend(corner + edge_v);
    if (shape != PlanarShape::triangle) box.extend(corner + edge_u + edge_v);
    return box;
}

LightBounds PlanarLight::bounds(double radiance) const {
    const Vec3 normal = cross(edge_u, edge_v), axis = normalize(normal);
    return {box(), {axis, is_finite(axis) ? 1.0 : 0.0}, radiance * length(normal) * share};
}

Uv PlanarLight::sample_area(double u, double v) const {
    return primitives::value_of_kind(primitive, Uv{},
                                     [&]<class Kind>(std::type_identity<Kind>) { return Kind::weights(u, v); });
}

// ---- spheres -------------------------------------------------------------------------------------------------------

Box SphereLight::box() const {
    Box box;
    for (const Point3& c : {center, center + motion})
        for (const double r : {-radius, radius}) box.extend(c + along_every_axis(r));
    return box;
}

LightBounds SphereLight::bounds(double radiance) const {
    return without_normals(box(), radiance * kPi * radius * radius);
}

// ---- points --------------------------------------------------------------------------------------------------------

LightBounds LightAtPoint::bounds() const { return without_normals(box(), max_component(intensity)); }

PointLight light_from(const limn::PointLight& source) { return {{source.position, source.intensity}}; }

Color PointLight::sampled_radiance(const Vec3&, const Uv&) const { return radiance_without_extent(intensity); }

SpotLight light_from(const limn::SpotLight& source) {
    return {{source.position, source.intensity},
            normalize(source.direction),
            cosine(radians(source.inner_cone_angle)),
            cosine(radians(source.outer_cone_angle))};
}

// The square makes the edge of the cone soft: KHR_lights_punctual, section "Inner and outer cone angles".
Color SpotLight::sampled_radiance(const Vec3& direction, const Uv&) const {
    const double cosine = -dot(direction, axis);
    const double part = cosine >= cos_inner ? 1 : std::max(0.0, (cosine - cos_outer) / (cos_inner - cos_outer));
    return part * part * radiance_without_extent(intensity);
}

// ---- distant lights ------------------------------------------------------------------------------------------------

DirectionalLight light_from(const limn::DirectionalLight& source) {
    return {-normalize(source.direction), source.irradiance};
}

DistantBounds DirectionalLight::bounds() const { return {max_component(irradiance), towards, 0}; }

Color DirectionalLight::sampled_radiance(const Vec3&, const Uv&) const { return radiance_without_extent(irradiance); }

SunLight light_from(const limn::SunLight& source) {
    const double half_sine = sine(radians(source.angular_radius) / 2);
    return {-normalize(source.direction), source.irradiance, 2 * half_sine * half_sine};
}

DistantBounds SunLight::bounds() const {
    return {max_component(irradiance), towards, std::sqrt(one_minus_cos * (2 - one_minus_cos))};
}

Color SunLight::seen_radiance(const Vec3& direction) const {
    // Half the squared difference of two unit vectors is 1 - cos of their angle.
    const bool hits = length_squared(normalize(direction) - towards) / 2 <= one_minus_cos;
    return hits ? disc_radiance(*this) : Color{};
}

Color SunLight::sampled_radiance(const Vec3&, const Uv&) const { return disc_radiance(*this); }

// A plane receives a quarter of what arrives from all directions, in the mean over all planes.
DistantBounds EnvironmentLight::bounds() const { return {map->scale * map->luminance / 4, {}, 1}; }

Color EnvironmentLight::seen_radiance(const Vec3& direction) const {
    return sampled_radiance(direction, pattern::map_uv(map->axes, direction));
}

Color EnvironmentLight::sampled_radiance(const Vec3&, const Uv& uv) const {
    return pattern::map_radiance(*map->image, map->scale, uv);
}

}  // namespace limn::flat
