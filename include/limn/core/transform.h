/// \file
/// Affine transforms. `Transform::translate(a) * Transform::rotate_y(b)` rotates first, then translates.
#pragma once

#include <array>

#include "limn/core/box.h"
#include "limn/core/vec.h"

namespace limn {

/// A 3x4 matrix in double: columns of the linear part, then the translation. Immutable by convention; thread-safe.
struct Transform {
    /// rows[i] = {m_i0, m_i1, m_i2, translation_i}
    std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    static Transform translate(const Vec3& by);  ///< moves points, leaves vectors
    /// Along the axes; negative factors mirror, zero ones make the matrix singular.
    static Transform scale(double x, double y, double z);
    /// Right-handed about an axis of space through the origin, in degrees; multiples of a quarter turn are exact.
    ///@{
    static Transform rotate_x(double degrees);
    static Transform rotate_y(double degrees);
    static Transform rotate_z(double degrees);
    ///@}
    /// The same about an axis of any length (Rodrigues' formula).
    ///
    /// \throws ArgumentError if the axis is zero or not finite
    static Transform rotate(const Vec3& axis, double degrees);

    Vec3 translation() const { return {rows[0][3], rows[1][3], rows[2][3]}; }  ///< where the origin goes
    bool operator==(const Transform&) const = default;                         ///< entry by entry
};

/// First b, then a.
Transform operator*(const Transform& a, const Transform& b);

/// Entry by entry from `at0` to `at1`, bit-exact at both ends; `time` is clamped to [0, 1].
Transform interpolate(const Transform& at0, const Transform& at1, double time);

/// Determinant of the linear part.
double determinant(const Transform& m);

/// By cofactors, right up to rounding for tiny and huge matrices too.
///
/// \throws ArgumentError if the matrix is singular, not finite, or its inverse is not
Transform inverse(const Transform& m);

bool is_finite(const Transform& m);  ///< all twelve entries

Point3 transform_point(const Transform& m, const Point3& p);  ///< M p + translation
Vec3 transform_vector(const Transform& m, const Vec3& v);     ///< M v
/// M^-T n, given the inverse of M; not normalised.
Normal3 transform_normal(const Transform& inverse_of_m, const Normal3& n);
/// A box around the transformed box, rounded outward (Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems,
/// 1990). An empty box stays empty.
Box transform_box(const Transform& m, const Box& b);

}  // namespace limn
