/// \file
/// What is known of one point on a surface, and how a material scatters there.
#pragma once

#include <cstdint>

#include "limn/core/color.h"
#include "limn/core/ray.h"
#include "limn/core/vec.h"

namespace limn {

class Material;
struct MaterialThunks;

/// Which material a surface has: a row of the compiled scene's table, or a user-defined object with the functions to
/// call on it. Not owning: valid as long as the scene that it came from.
struct MaterialRef {
    static constexpr std::uint32_t kNone = 0xffffffff;    ///< an id: no material
    static constexpr std::uint32_t kObject = 0xfffffffe;  ///< an id: `object` is the material

    std::uint32_t id = kNone;                ///< row in the table; kObject: `object` counts; kNone: no material
    const Material* object = nullptr;        ///< the described material, where id == kObject
    const MaterialThunks* thunks = nullptr;  ///< how to call it
};

/// A point on a surface (or in a medium, where normal is zero), in world space.
struct Surface {
    Point3 position;         ///< as computed: rounded
    Vec3 position_error;     ///< bound on the distance of `position` from the true surface along each axis
    Normal3 normal;          ///< geometric, unit, on the side of front_face
    Normal3 shading_normal;  ///< interpolated, unit, same side; equals `normal` where the shape has no own normals
    Uv uv;                   ///< texture coordinates
    /// Whether the ray came from the side of the shape's outward normal. Of rays within 1e-15 of its plane: either.
    bool front_face = true;
    MaterialRef material;  ///< valid as long as the compiled scene
    /// How the position moves with u; zero of user-defined shapes and at poles of spheres, edges of a mesh's triangle
    /// where its uv have no area.
    Vec3 dp_du;
    Vec3 dp_dv;  ///< the same with v

    /// A ray that leaves in `direction` from a point moved off the surface by its error bound, towards the side that
    /// the direction points to, so that it cannot hit the same flat or convex surface again (Pharr, Jakob, Humphreys,
    /// Physically Based Rendering, 4th ed., section 6.8).
    /// \param direction of any length, towards either side: t is in units of it
    /// \param time in shutter units, passed on
    Ray spawn_ray(const Vec3& direction, double time) const;

    /// A ray to `target` with t_max just under 1: a surface through the target does not count as an obstacle. Direction
    /// is target - origin, so that t is a fraction of the way. Of the target only its coordinates are known: for a
    /// point computed on a large surface prefer the form below.
    Ray spawn_ray_to(const Point3& target, double time) const;

    /// The same for a target on another surface, which both ends leave by their error bounds.
    Ray spawn_ray_to(const Surface& target, double time) const;
};

/// The origin that `Surface::spawn_ray` starts from: `position`, moved along `normal` by the error's extent along it,
/// towards the side that `direction` points to, and then to the next double.
Point3 offset_origin(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction);

/// Three independent numbers in [0, 1).
struct Random3 {
    /// Each uniform.
    ///@{
    double x = 0, y = 0, z = 0;
    ///@}
};

/// A scattered direction. Absent (std::nullopt) means absorbed.
struct ScatterSample {
    Vec3 direction;  ///< unit, world space, away from the surface
    Color weight;    ///< f |cos| / pdf: what the path's throughput is multiplied by
    double pdf = 0;  ///< per solid angle; 0 marks a specular direction, which no other sampling can find
};

/// The scattering function for a given pair of directions.
struct ScatterValue {
    Color value;     ///< f |cos|, in 1/sr
    double pdf = 0;  ///< with which `sample` draws that direction, per solid angle; 0 if it never does
};

}  // namespace limn
