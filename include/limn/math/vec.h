/// \file
/// Points, vectors and normals in double precision. They are distinct types, so that a normal cannot be transformed as
/// a vector by accident. `Vec3(n)` and `Normal3(v)` convert explicitly.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace limn {

/// A displacement or direction, in the user's unit of length.
struct Vec3 {
    /// The coordinates, by name or by axis number 0, 1, 2. They are zero by default.
    ///@{
    double x = 0, y = 0, z = 0;

    constexpr Vec3() = default;
    constexpr Vec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}

    constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr bool operator==(const Vec3&) const = default;
    ///@}
};

/// A direction perpendicular to a surface. It is transformed by the inverse transpose.
struct Normal3 {
    /// The coordinates. Conversions from and to a vector are explicit.
    ///@{
    double x = 0, y = 0, z = 0;

    constexpr Normal3() = default;
    constexpr Normal3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    constexpr explicit Normal3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
    constexpr Normal3 operator-() const { return {-x, -y, -z}; }
    constexpr bool operator==(const Normal3&) const = default;
    ///@}
    constexpr explicit operator Vec3() const { return {x, y, z}; }  ///< converts to a vector
};

/// A location in space.
struct Point3 {
    /// The coordinates, by name or by axis number 0, 1, 2. They are zero by default.
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
    /// In an image, u goes from left to right and v from the bottom up. Each shape defines its own u and v.
    ///@{
    double u = 0, v = 0;
    constexpr bool operator==(const Uv&) const = default;
    ///@}
};

/// Three float32: a position or normal of a mesh.
struct Float3 {
    /// The coordinates.
    ///@{
    float x = 0, y = 0, z = 0;
    constexpr bool operator==(const Float3&) const = default;
    ///@}
};

/// Two float32: texture coordinates of a mesh.
struct Float2 {
    /// The texture coordinates, as in Uv.
    ///@{
    float u = 0, v = 0;
    constexpr bool operator==(const Float2&) const = default;
    ///@}
};

/// The indices of the three vertices of a mesh triangle.
struct Index3 {
    /// Indices from 0. The vertices are in counter-clockwise order, seen from outside.
    ///@{
    std::uint32_t a = 0, b = 0, c = 0;
    constexpr bool operator==(const Index3&) const = default;
    ///@}
};

/// Return the result of the operation on each coordinate. The difference of two points is a vector. Points cannot be
/// added.
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

/// Return the scalar product.
///@{
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr double dot(const Normal3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr double dot(const Vec3& a, const Normal3& b) { return dot(b, a); }
constexpr double dot(const Normal3& a, const Normal3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
///@}

/// Returns the right-handed vector product: cross(x, y) = z.
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns the squared length. It may overflow or underflow, unlike `length`.
constexpr double length_squared(const Vec3& a) { return dot(a, a); }

/// Returns the Euclidean length, by std::hypot: no intermediate result overflows or underflows.
inline double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// Return the largest magnitude of a coordinate. A NaN is ignored unless all three coordinates are NaN.
///@{
inline double max_abs(const Vec3& a) {
    const auto largest = [](double x, double y) { return x < y || x != x ? y : x; };  // std::fmax, inlined
    return largest(std::abs(a.x), largest(std::abs(a.y), std::abs(a.z)));
}
inline double max_abs(const Point3& a) { return max_abs(Vec3{a.x, a.y, a.z}); }
///@}

/// Returns `a` times a power of two such that the largest magnitude of a coordinate is in [1/2, 1). The squared length
/// of the result cannot overflow. The zero vector stays zero.
/// \pre a is finite
inline Vec3 scale_to_one(const Vec3& a) {
    int exponent = 0;
    std::frexp(max_abs(a), &exponent);
    return {std::ldexp(a.x, -exponent), std::ldexp(a.y, -exponent), std::ldexp(a.z, -exponent)};
}

/// Returns the unit vector along (x, y, z). `normalize` calls it if the squared length may overflow or underflow.
Vec3 normalize_extreme(double x, double y, double z);

/// Returns the unit vector along `a`. `a` may be any finite vector, however short or long. The zero vector gives NaN.
inline Vec3 normalize(const Vec3& a) {
    const double squared = dot(a, a);
    if (squared > 1e-200 && squared < 1e200) return a / std::sqrt(squared);
    return normalize_extreme(a.x, a.y, a.z);
}

/// Returns the unit vector along cross(a, b). The vectors may be any finite ones, however short or long. Parallel
/// vectors give NaN.
inline Vec3 unit_cross(const Vec3& a, const Vec3& b) {
    const Vec3 c = cross(a, b);
    const double squared = dot(c, c);
    if (squared > 1e-200 && squared < 1e200) return c / std::sqrt(squared);
    return normalize(cross(scale_to_one(a), scale_to_one(b)));
}

/// Returns the vector of the magnitudes of the coordinates.
constexpr Vec3 abs(const Vec3& a) { return {a.x < 0 ? -a.x : a.x, a.y < 0 ? -a.y : a.y, a.z < 0 ? -a.z : a.z}; }

/// Return true if no coordinate is infinite or NaN.
///@{
inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
inline bool is_finite(const Normal3& a) { return is_finite(Vec3(a)); }
inline bool is_finite(const Point3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
///@}

}  // namespace limn
