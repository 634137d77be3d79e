/// \file
/// Points, vectors and normals in double precision. They are distinct types so that a normal cannot be transformed as
/// a vector by accident; `Vec3(n)` and `Normal3(v)` convert on purpose.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace limn {

/// A displacement or direction, in the user's unit of length.
struct Vec3 {
    /// Coordinates, by name or by axis number 0, 1, 2; zero by default.
    ///@{
    double x = 0, y = 0, z = 0;

    constexpr Vec3() = default;
    constexpr Vec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}

    constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr bool operator==(const Vec3&) const = default;
    ///@}
};

/// A direction that is perpendicular to a surface; transformed by the inverse transpose.
struct Normal3 {
    /// Coordinates. Conversions from and to a vector have to be spelt out.
    ///@{
    double x = 0, y = 0, z = 0;

    constexpr Normal3() = default;
    constexpr Normal3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    constexpr explicit Normal3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
    constexpr Normal3 operator-() const { return {-x, -y, -z}; }
    constexpr bool operator==(const Normal3&) const = default;
    ///@}
    constexpr explicit operator Vec3() const { return {x, y, z}; }  ///< on purpose
};

/// A location in space.
struct Point3 {
    /// Coordinates, by name or by axis number 0, 1, 2; the origin by default.
    ///@{
    double x = 0, y = 0, z = 0;

    constexpr Point3() = default;
    constexpr Point3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}

    constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr bool operator==(const Point3&) const = default;
    ///@}
};

/// Texture coordinates.
struct Uv {
    /// u to the right, v upward over an image; what they mean on a shape, the shape says.
    ///@{
    double u = 0, v = 0;
    constexpr bool operator==(const Uv&) const = default;
    ///@}
};

/// A triple of float32, the form in which a mesh stores positions and normals.
struct Float3 {
    /// Coordinates.
    ///@{
    float x = 0, y = 0, z = 0;
    constexpr bool operator==(const Float3&) const = default;
    ///@}
};

/// A pair of float32, the form in which a mesh stores texture coordinates.
struct Float2 {
    /// As in Uv.
    ///@{
    float u = 0, v = 0;
    constexpr bool operator==(const Float2&) const = default;
    ///@}
};

/// Three vertex numbers of a mesh triangle.
struct Index3 {
    /// Counted from 0; counter-clockwise seen from outside.
    ///@{
    std::uint32_t a = 0, b = 0, c = 0;
    constexpr bool operator==(const Index3&) const = default;
    ///@}
};

/// By coordinate. A difference of points is a vector; points do not add up.
///@{
constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }

constexpr Vec3 operator-(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Point3 operator+(const Point3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Point3 operator-(const Point3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
///@}

/// The scalar product.
///@{
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr double dot(const Normal3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr double dot(const Vec3& a, const Normal3& b) { return dot(b, a); }
constexpr double dot(const Normal3& a, const Normal3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
///@}

/// The vector product, right-handed: cross(x, y) = z.
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// May overflow and underflow; `length` does not.
constexpr double length_squared(const Vec3& a) { return dot(a, a); }

/// Euclidean length. std::hypot: neither overflows nor underflows on the way.
inline double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// The largest magnitude of a coordinate; NaN counts only where all three are.
///@{
inline double max_abs(const Vec3& a) {
    const auto largest = [](double x, double y) { return x < y || x != x ? y : x; };  // std::fmax without its call
    return largest(std::abs(a.x), largest(std::abs(a.y), std::abs(a.z)));
}
inline double max_abs(const Point3& a) { return max_abs(Vec3{a.x, a.y, a.z}); }
///@}

/// `a` scaled by a power of two, exactly, so that its largest coordinate lies in [1/2, 1): its squares stay in range.
/// Zero stays zero.
inline Vec3 scale_to_one(const Vec3& a) {
    int exponent = 0;
    std::frexp(max_abs(a), &exponent);
    return {std::ldexp(a.x, -exponent), std::ldexp(a.y, -exponent), std::ldexp(a.z, -exponent)};
}

/// The unit vector along (x, y, z), whose square double does not hold: a case that `normalize` seldom meets.
Vec3 normalize_extreme(double x, double y, double z);

/// `a` scaled to unit length, right for any finite non-zero length; NaN for the zero vector.
inline Vec3 normalize(const Vec3& a) {
    const double squared = dot(a, a);
    if (squared > 1e-200 && squared < 1e200) return a / std::sqrt(squared);
    return normalize_extreme(a.x, a.y, a.z);
}

/// The unit vector along cross(a, b), right for edges of any finite size; NaN where they are parallel.
inline Vec3 unit_cross(const Vec3& a, const Vec3& b) {
    const Vec3 c = cross(a, b);
    const double squared = dot(c, c);
    if (squared > 1e-200 && squared < 1e200) return c / std::sqrt(squared);
    return normalize(cross(scale_to_one(a), scale_to_one(b)));
}

/// The magnitude of each coordinate.
constexpr Vec3 abs(const Vec3& a) { return {a.x < 0 ? -a.x : a.x, a.y < 0 ? -a.y : a.y, a.z < 0 ? -a.z : a.z}; }

/// Neither infinite nor NaN in any coordinate.
///@{
inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
inline bool is_finite(const Normal3& a) { return is_finite(Vec3(a)); }
inline bool is_finite(const Point3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
///@}

}  // namespace limn
