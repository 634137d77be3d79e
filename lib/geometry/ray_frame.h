// Rays in the spaces of instances. The transformed ray is rounded. Decisions must be those for the exact image of the
// user's ray. Therefore a RayFrame has bounds on the rounding error, and knows how to compute the exact image.
#pragma once

#include "geometry/dyadic.h"
#include "limn/math/ray.h"
#include "limn/math/transform.h"

namespace limn {

// Bounds on the error of a matrix that was inverted in double.
struct InverseError {
    double error;  // bound on the error of its product with a vector, divided by the largest coordinate of the vector
    double norm;   // bound on the sum of the magnitudes of the entries in a row
};

// Returns the bounds for the linear part of inverse(m). They are infinite if the determinant is uncertain.
//
// The inverse is X = cofactors / determinant. Let u = 2^-53, K_ij the sum of the magnitudes of the two products in
// cofactor ij, and P = |m_00| K_00 + |m_01| K_01 + |m_02| K_02. Then
//   - a cofactor is off by at most 2 u K_ij;
//   - the determinant is off by at most 6 u P;
//   - therefore X_ij is off by at most 16 u (P / |det|) (K_ij / |det|);
//   - |X_ij| <= K_ij / |det|, and the rounding of the product with a vector adds at most 4 u of that.
// As P >= |det|, the error of the product is at most 20 u (P / |det|) times the sum of K_ij / |det| in a row. The code
// takes 24 u, which leaves room for a rounding of the vector.
InverseError inverse_error(const Transform& m);

// Returns true if the determinant of the linear part is exactly 0.
bool is_singular(const Transform& m);

// Returns the ray in the object space of an instance, rounded. The translation is subtracted before the linear part is
// applied, since it cancels best there. The direction is not normalised, so that t is the same in both spaces.
inline Ray ray_inside(const Ray& ray, const Transform& world_from_object, const Transform& object_from_world) {
    const Vec3 v = (ray.origin - Point3{}) - world_from_object.translation();
    return {Point3{} + transform_vector(object_from_world, v), transform_vector(object_from_world, ray.direction),
            ray.t_min, ray.t_max, ray.time};
}

// A ray in the object space of an instance, with bounds on its rounding error. Without `outer` it is a ray in world
// space, which is exact.
struct RayFrame {
    Ray ray;                                       // in this space, rounded
    double origin_error = 0;                       // bound on the error of each coordinate of ray.origin
    double direction_error = 0;                    // bound on the error of each coordinate of ray.direction
    const RayFrame* outer = nullptr;               // the ray outside the instance
    const Transform* world_from_object = nullptr;  // the instance's matrix, from this space to that of `outer`

    // Makes the frame of a ray in world space. r.frame is ignored.
    explicit RayFrame(const Ray& r) : ray(r) {}

    // Transforms the ray of `outer_frame` into an instance. Frame and matrix are kept by pointer and must outlive this.
    RayFrame(const RayFrame& outer_frame, const Transform& matrix, const Transform& object_from_world,
             const InverseError& of_inverse);
    RayFrame(const RayFrame& outer_frame, const Transform& matrix)
        : RayFrame(outer_frame, matrix, inverse(matrix), inverse_error(matrix)) {}

    // Returns `ray` for a call of hit(). Inside an instance its member `frame` points to this object, which must
    // outlive the call.
    Ray with_frame() const {
        Ray r = ray;
        r.frame = outer != nullptr ? this : nullptr;
        return r;
    }
};

// Returns the frame of a ray that hit() was given: ray.frame if that has the same origin and direction, else a frame of
// `ray` as it is. t_min, t_max and time are those of `ray`.
RayFrame frame_of(const Ray& ray);

// An exact ray in homogeneous coordinates: its origin is origin / unit, its direction direction / unit.
struct ExactRay {
    Dyadic3 origin, direction;
    Dyadic unit;  // > 0
};
// Returns the exact image of the user's ray in the space of the frame.
ExactRay exact_ray(const RayFrame& frame);
// Returns the image of a vector in world space, multiplied by some number > 0.
Dyadic3 exact_vector(const RayFrame& frame, const Vec3& v);

}  // namespace limn
