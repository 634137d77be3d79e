/// \file
/// Points on surfaces, and the results of scattering there.
#pragma once

#include <cstdint>

#include "limn/math/color.h"
#include "limn/math/ray.h"
#include "limn/math/vec.h"

namespace limn {

class Material;
struct MaterialThunks;

/// The material of a surface: a row of the compiled scene's table of materials, or a user-defined object and the
/// functions to call on it. It owns nothing, and is valid while the compiled scene exists.
struct MaterialRef {
    static constexpr std::uint32_t kNone = 0xffffffff;    ///< the id if there is no material
    static constexpr std::uint32_t kObject = 0xfffffffe;  ///< the id of a user-defined material

    std::uint32_t id = kNone;                ///< row of the table of materials, kObject or kNone
    const Material* object = nullptr;        ///< the user-defined material if id == kObject
    const MaterialThunks* thunks = nullptr;  ///< the functions to call on `object`
};

/// A point on a surface or in a medium, in world space. In a medium the normals are zero.
struct Surface {
    Point3 position;         ///< the computed point, rounded
    Vec3 position_error;     ///< bound on the distance of `position` from the surface along each axis
    Normal3 normal;          ///< geometric normal, unit, on the side that the ray came from
    Normal3 shading_normal;  ///< unit, on the side of `normal`; equals `normal` unless the shape has normals of its own
    Uv uv;                   ///< texture coordinates
    /// True if the ray came from the side of the shape's outward normal. For a ray within 1e-15 radians of the surface
    /// either value is possible.
    bool front_face = true;
    MaterialRef material;  ///< the material; valid while the compiled scene exists
    /// The derivatives of the position with respect to uv.u and uv.v. They are zero on user-defined shapes and at the
    /// poles of spheres. In a mesh triangle whose texture coordinates have no area they are edges of the triangle.
    ///@{
    Vec3 dp_du;
    Vec3 dp_dv;
    ///@}

    /// Returns a ray that starts at this point and goes in `direction`. Its origin is moved off the surface by the
    /// error bound, towards the side that the direction points to. So it cannot hit the same flat or convex surface
    /// again (Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., section 6.8).
    /// \param direction the direction of the ray, of any length and towards either side
    /// \param time the time of the ray, see Ray::time
    Ray spawn_ray(const Vec3& direction, double time) const;

    /// Returns a ray from this point to `target`, to test for obstacles. Its direction is target - origin. Its t_max is
    /// just under 1, so that a surface through the target is no obstacle. The error of the target is estimated from its
    /// coordinates. Prefer the overload below for a point on a surface, because a Surface knows its error.
    Ray spawn_ray_to(const Point3& target, double time) const;

    /// Returns a ray from this point to a point on another surface, to test for obstacles. Both ends are moved off
    /// their surfaces by their error bounds. The direction is the difference of the moved ends, and t_max is 1 - 2^-40.
    Ray spawn_ray_to(const Surface& target, double time) const;
};

/// Returns the origin of the ray that `Surface::spawn_ray` makes. `position` is moved along `normal` by
/// dot(abs(normal), error), towards the side that `direction` points to. Each coordinate that moves is then moved to
/// the next double.
Point3 offset_origin(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction);

/// Three independent random numbers, uniform in [0, 1).
struct Random3 {
    /// One of the numbers.
    ///@{
    double x = 0, y = 0, z = 0;
    ///@}
};

/// A sampled direction of scattered light. A function that samples one returns std::nullopt if light is absorbed.
struct ScatterSample {
    Vec3 direction;  ///< unit, world space, away from the surface
    Color weight;    ///< f |cos| / pdf, the factor by which the path's throughput changes
    double pdf = 0;  ///< per solid angle; 0 for a specular direction, which light sampling cannot find
};

/// The value of a scattering function for a pair of directions.
struct ScatterValue {
    Color value;     ///< f |cos|, in 1/sr
    double pdf = 0;  ///< density per solid angle with which `sample` draws the direction; 0 if it never does
};

}  // namespace limn
