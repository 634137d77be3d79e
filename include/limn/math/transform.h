/// \file
/// Affine transforms.
#pragma once

#include <array>

#include "limn/math/box.h"
#include "limn/math/vec.h"

namespace limn {

/// An affine transform, stored as a 3x4 matrix of doubles: the linear part, and the translation in the last column.
/// `Transform::translate(a) * Transform::rotate_y(b)` rotates first, then translates.
struct Transform {
    /// rows[i] = {m_i0, m_i1, m_i2, translation_i}
    std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    static Transform translate(const Vec3& by);  ///< returns a translation, which moves points and keeps vectors
    /// Returns a scaling along the axes. A negative factor mirrors. A zero factor makes the matrix singular.
    static Transform scale(double x, double y, double z);
    /// Return a right-handed rotation about a coordinate axis. Multiples of 90 degrees are exact.
    ///@{
    static Transform rotate_x(double degrees);
    static Transform rotate_y(double degrees);
    static Transform rotate_z(double degrees);
    ///@}
    /// Returns a right-handed rotation about an axis through the origin (Rodrigues' formula). The axis may have any
    /// length.
    ///
    /// \throws ArgumentError if the axis is zero or not finite
    static Transform rotate(const Vec3& axis, double degrees);

    Vec3 translation() const { return {rows[0][3], rows[1][3], rows[2][3]}; }  ///< returns the image of the origin
    bool operator==(const Transform&) const = default;                         ///< compares all entries
};

/// Returns the product, which applies b first, then a.
Transform operator*(const Transform& a, const Transform& b);

/// Interpolates each entry linearly between `at0` at time 0 and `at1` at time 1. The result is exact at both ends.
/// `time` is clamped to [0, 1].
Transform interpolate(const Transform& at0, const Transform& at1, double time);

/// Returns the determinant of the linear part.
double determinant(const Transform& m);

/// Returns the inverse, computed by cofactors. Very small or very large entries don't make intermediate results
/// overflow or underflow.
///
/// \throws ArgumentError if the matrix is singular or not finite, or its inverse is not finite
Transform inverse(const Transform& m);

bool is_finite(const Transform& m);  ///< returns true if all twelve entries are finite

Point3 transform_point(const Transform& m, const Point3& p);  ///< returns M p + translation
Vec3 transform_vector(const Transform& m, const Vec3& v);     ///< returns M v
/// Returns M^-T n, not normalised: the normal of a surface after the surface is transformed by M.
/// \param inverse_of_m the inverse of M
/// \param n the normal before the transform
Normal3 transform_normal(const Transform& inverse_of_m, const Normal3& n);
/// Returns a box that contains the transformed box, rounded outward (Arvo, Transforming Axis-Aligned Bounding Boxes,
/// Graphics Gems, 1990). An empty box stays empty.
Box transform_box(const Transform& m, const Box& b);

}  // namespace limn
