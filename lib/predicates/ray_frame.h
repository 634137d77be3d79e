// The ray that a shape is intersected with, and what it stands for: inside instances the numbers of a ray are rounded,
// and decisions are to be those of the ray that the user gave.
#pragma once

#include "limn/core/ray.h"
#include "limn/core/transform.h"
#include "predicates/dyadic.h"

namespace limn {

// What inverting a matrix in double loses.
struct InverseError {
    double error;  // bound on the sum, over a row, of the errors of its entries, and of the product with a vector
    double norm;   // bound on the sum of the magnitudes in a row
};

// The linear part of inverse(m), X = cofactors / determinant. A cofactor is off by 2 u K_ij, K_ij being the sum of its
// two products' magnitudes, the determinant by 6 u P, P = sum |m_0j| K_0j. So X_ij is off by at most 16 u (P / |det|)
// (K_ij / |det|), and |X_ij| <= K_ij / |det|; the product with a vector adds 4 u of that. Infinite where the
// determinant is uncertain.
InverseError inverse_error(const Transform& m);

// Whether the determinant of the linear part is exactly 0.
bool is_singular(const Transform& m);

// A ray as an instance's object sees it, rounded. The translation is subtracted first, where it cancels best. The
// direction keeps its length, so that t means the same on both sides.
inline Ray ray_inside(const Ray& ray, const Transform& world_from_object, const Transform& object_from_world) {
    const Vec3 v = (ray.origin - Point3{}) - world_from_object.translation();
    return {Point3{} + transform_vector(object_from_world, v), transform_vector(object_from_world, ray.direction),
            ray.t_min, ray.t_max, ray.time};
}

// A ray in the space of an instance's object, or (without `outer`) the ray itself.
struct RayFrame {
    Ray ray;                     // as the shapes there see it, rounded
    double origin_error = 0;     // bound, along each axis, on the distance of ray.origin from the exact image
    double direction_error = 0;  // the same for ray.direction
    const RayFrame* outer = nullptr;
    const Transform* world_from_object = nullptr;  // the instance between `outer` and here

    explicit RayFrame(const Ray& r) : ray(r) {}  // whatever r.frame says

    // The ray of `outer_frame` inside an instance. Both frame and matrix are kept by reference.
    RayFrame(const RayFrame& outer_frame, const Transform& matrix, const Transform& object_from_world,
             const InverseError& of_inverse);
    RayFrame(const RayFrame& outer_frame, const Transform& matrix)
        : RayFrame(outer_frame, matrix, inverse(matrix), inverse_error(matrix)) {}

    // `ray` as a hit() is given it: inside instances it points to this frame, which must outlive that call.
    Ray with_frame() const {
        Ray r = ray;
        r.frame = outer != nullptr ? this : nullptr;
        return r;
    }
};

// What `ray`, as handed to a hit(), stands for: ray.frame if that is of this ray, else the ray itself. t_min and t_max
// are those of `ray`.
RayFrame frame_of(const Ray& ray);

// A ray in homogeneous coordinates, exactly: origin / unit and direction / unit.
struct ExactRay {
    Dyadic3 origin, direction;
    Dyadic unit;  // above 0
};
ExactRay exact_ray(const RayFrame& frame);
// The image of a vector of the world, times some number above 0.
Dyadic3 exact_vector(const RayFrame& frame, const Vec3& v);

}  // namespace limn
