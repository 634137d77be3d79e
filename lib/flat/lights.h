// The kinds of lights that can be sampled. Each kind is a struct, which describes a light in world space. `Light` is a
// variant of all kinds. shading/light_points.cpp has the other half of each kind: how points on it are sampled.
//
// A light at a finite distance is in the light tree. Its kind has these members:
//
//     Box box() const                                bounds the light while the shutter is open
//     LightBounds bounds() const                     what the light tree knows of it. The bounds of a surface also
//                                                    depend on the radiance of its material, which is an argument
//
// A light that is infinitely far away is not in the tree. Its kind has these members:
//
//     DistantBounds bounds() const                   what the choice between distant lights and the tree knows of it
//     Color seen_radiance(direction) const           the radiance that a ray in this direction sees if it leaves the
//                                                    scene; black if it misses the light
//
// A light that is no surface also has these members:
//
//     Color sampled_radiance(direction, uv) const    the radiance that arrives from a sample of the light. `direction`
//                                                    is the unit vector towards it, and uv are its map coordinates
//     auto fields() const                            the numbers that the digest of the scene covers; not needed for
//                                                    EnvironmentLight
//
// An overload of light_from() makes the struct from the description of a light in limn/scene/lights.h.
#pragma once

#include <cstdint>
#include <tuple>
#include <variant>

#include "flat/environment.h"
#include "limn/math/box.h"
#include "limn/math/color.h"
#include "limn/math/vec.h"
#include "limn/records/records.h"
#include "limn/scene/lights.h"

namespace limn::flat {

// Lights without extent count as if they filled this solid angle (in steradians). It is so small that light sampling
// has all the weight against scattering, which never finds them. It is a power of two, so nothing is rounded by it.
inline constexpr double kNoSolidAngle = 0x1p-100;

// Replaces the cosine of the spread of a cone if lights look alike from everywhere, as spheres do.
inline constexpr float kNoNormals = -1;

// A double cone that bounds the normals of planar lights and their opposites.
struct Cone {
    Vec3 axis;              // unit vector
    double cos_spread = 0;  // cosine of the half angle; 0 for any normals; kNoNormals for lights without normals
};

// The bounds of one or several lights, by which a light is chosen.
struct LightBounds {
    Box box;  // while the shutter is open
    Cone cone;
    // Sum of radiance * area. The area of a sphere is that of its disc, pi r^2. A light at a point has its intensity.
    double strength = 0;
};

// The properties of a distant light by which it is chosen.
struct DistantBounds {
    double irradiance = 0;   // of a plane perpendicular to the direction of the light. If the light arrives from all
                             // directions, the mean over all planes
    Vec3 towards;            // unit vector towards the light; zero if the light arrives from all directions
    double sine_radius = 0;  // sine of the angular radius; 1 if the light arrives from all directions
};

// The fields that all surfaces have.
struct SurfaceLight {
    Vec3 position_error;       // bounds the rounding error of points that are computed on the light
    std::uint64_t number = 0;  // number of the primitive in the scene
    MaterialId material = MaterialId::none;
    // The side that shines: 1 is the outside, -1 the inside, 0 both. The outside of a planar light is the side that
    // cross(edge_u, edge_v) points to.
    std::int8_t side = 0;
    bool textured = false;  // true if the radiance is not the same everywhere
};

// How a planar light fills its parallelogram. A `part` is sampled as its primitive says.
enum class PlanarShape : std::uint8_t { triangle, parallelogram, rectangle, part };

// A triangle, a quad or a disk: a part of a parallelogram.
struct PlanarLight : SurfaceLight {
    PlanarShape shape = PlanarShape::triangle;
    PrimitiveKind primitive = PrimitiveKind::triangle;
    Point3 corner;  // the first vertex of a triangle
    Vec3 edge_u, edge_v;
    double share = 1;  // area of the light divided by the area of the parallelogram

    Box box() const;
    LightBounds bounds(double radiance) const;
    // Maps the unit square to the light, uniformly by area. Returns the weights of the edges.
    Uv sample_area(double u, double v) const;
};

// A sphere, which may move in a straight line.
struct SphereLight : SurfaceLight {
    Point3 center;  // at time 0
    Vec3 motion;    // from the centre at time 0 to the centre at time 1
    double radius = 0;

    Box box() const;
    LightBounds bounds(double radiance) const;
};

// A light without extent at a point.
struct LightAtPoint {
    Point3 position;
    Color intensity;  // the largest of all directions

    Box box() const { return {position, position}; }
    LightBounds bounds() const;
};

// A point that emits the same intensity in all directions.
struct PointLight : LightAtPoint {
    auto fields() const { return std::tie(position, intensity); }
    Color sampled_radiance(const Vec3& direction, const Uv& uv) const;
};

// A point that emits into a cone.
struct SpotLight : LightAtPoint {
    Vec3 axis;             // unit vector away from the light
    double cos_inner = 1;  // cosine of the angle up to which the intensity is full
    double cos_outer = 0;  // cosine of the angle from which on the intensity is 0

    auto fields() const { return std::tie(position, intensity, axis, cos_inner, cos_outer); }
    Color sampled_radiance(const Vec3& direction, const Uv& uv) const;
};

// Light that arrives from infinitely far away in a single direction.
struct DirectionalLight {
    Vec3 towards;  // unit vector towards the light
    Color irradiance;

    auto fields() const { return std::tie(towards, irradiance); }
    DistantBounds bounds() const;
    Color seen_radiance(const Vec3&) const { return {}; }
    Color sampled_radiance(const Vec3& direction, const Uv& uv) const;
};

// A disc infinitely far away.
struct SunLight {
    Vec3 towards;  // unit vector towards the centre
    Color irradiance;
    double one_minus_cos = 0;  // 1 - cos(angular radius)

    auto fields() const { return std::tie(towards, irradiance, one_minus_cos); }
    DistantBounds bounds() const;
    Color seen_radiance(const Vec3& direction) const;
    Color sampled_radiance(const Vec3& direction, const Uv& uv) const;
};

// The environment map of the scene.
struct EnvironmentLight {
    const Environment* map = nullptr;  // Scene::environment

    DistantBounds bounds() const;
    Color seen_radiance(const Vec3& direction) const;
    Color sampled_radiance(const Vec3& direction, const Uv& uv) const;
};

using Light =
    std::variant<PlanarLight, SphereLight, PointLight, SpotLight, DirectionalLight, SunLight, EnvironmentLight>;

// Returns the box of a light in the tree. The box of a distant light is empty.
Box box_of(const Light& light);

// Returns the radiance that a ray in this direction sees of a distant light if it leaves the scene. It is black if the
// ray misses the light.
Color seen_radiance(const Light& light, const Vec3& direction);

// Returns the light that is described. \pre Scene::add accepts the description
PointLight light_from(const limn::PointLight& source);
SpotLight light_from(const limn::SpotLight& source);
DirectionalLight light_from(const limn::DirectionalLight& source);
SunLight light_from(const limn::SunLight& source);

}  // namespace limn::flat
