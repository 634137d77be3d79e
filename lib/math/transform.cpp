#include "limn/math/transform.h"

#include <algorithm>
#include <cmath>

#include "limn/math/error.h"
#include "limn/math/math.h"
#include "math/elementary.h"
#include "math/scaled_matrix.h"

namespace limn {

namespace {

// Returns sine and cosine of an angle in degrees. They are exact for multiples of 90 degrees, so that a rotation which
// permutes the axes has only the entries 0, 1 and -1.
SineCosine<double> sine_cosine_of_degrees(double degrees) {
    const double turn = std::remainder(degrees, 360.0);
    if (turn == 0) return {0, 1};
    if (turn == 90) return {1, 0};
    if (turn == -90) return {-1, 0};
    if (std::abs(turn) == 180) return {0, -1};
    return sine_cosine(radians(turn));
}

}  // namespace

Transform Transform::translate(const Vec3& by) { return {{{{1, 0, 0, by.x}, {0, 1, 0, by.y}, {0, 0, 1, by.z}}}}; }

Transform Transform::scale(double x, double y, double z) { return {{{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}}}}; }

Transform Transform::rotate_x(double degrees) {
    const auto [s, c] = sine_cosine_of_degrees(degrees);
    return {{{{1, 0, 0, 0}, {0, c, -s, 0}, {0, s, c, 0}}}};
}

Transform Transform::rotate_y(double degrees) {
    const auto [s, c] = sine_cosine_of_degrees(degrees);
    return {{{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}}}};
}

Transform Transform::rotate_z(double degrees) {
    const auto [s, c] = sine_cosine_of_degrees(degrees);
    return {{{{c, -s, 0, 0}, {s, c, 0, 0}, {0, 0, 1, 0}}}};
}

// Builds the matrix by Rodrigues' rotation formula.
Transform Transform::rotate(const Vec3& axis, double degrees) {
    if (!limn::is_finite(axis) || axis == Vec3{}) throw ArgumentError("rotate: the axis must be finite and not zero");
    const auto [s, c] = sine_cosine_of_degrees(degrees);
    const Vec3 k = normalize(axis);
    const double d = 1 - c;
    return {{{{c + k.x * k.x * d, k.x * k.y * d - k.z * s, k.x * k.z * d + k.y * s, 0},
              {k.y * k.x * d + k.z * s, c + k.y * k.y * d, k.y * k.z * d - k.x * s, 0},
              {k.z * k.x * d - k.y * s, k.z * k.y * d + k.x * s, c + k.z * k.z * d, 0}}}};
}

Transform operator*(const Transform& a, const Transform& b) {
    Transform product;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j)
            product.rows[i][j] =
                a.rows[i][0] * b.rows[0][j] + a.rows[i][1] * b.rows[1][j] + a.rows[i][2] * b.rows[2][j];
        product.rows[i][3] += a.rows[i][3];
    }
    return product;
}

Transform interpolate(const Transform& at0, const Transform& at1, double time) {
    const double t = std::clamp(time, 0.0, 1.0);
    Transform m;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) m.rows[i][j] = (1 - t) * at0.rows[i][j] + t * at1.rows[i][j];
    return m;
}

double determinant(const Transform& m) {
    const auto& r = m.rows;
    return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
           r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

Transform inverse(const Transform& m) {
    if (!is_finite(m)) throw ArgumentError("inverse: the matrix must be finite");
    const ScaledMatrix scaled(m);
    const double det = determinant(scaled.matrix);
    if (!(std::abs(det) > 0)) throw ArgumentError("inverse: the matrix is singular");
    const auto& r = scaled.matrix.rows;
    const PowerOfTwo scale(-scaled.exponent);
    Transform inv;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inv.rows[i][j] = scale * ((r[a][c] * r[b][d] - r[a][d] * r[b][c]) / det);
        }
        inv.rows[i][3] = 0;
    }
    const Vec3 back = transform_vector(inv, m.translation());
    inv.rows[0][3] = -back.x;
    inv.rows[1][3] = -back.y;
    inv.rows[2][3] = -back.z;
    if (!is_finite(inv)) throw ArgumentError("inverse: the matrix is too close to singular");
    return inv;
}

bool is_finite(const Transform& m) {
    bool finite = true;
    for (const auto& row : m.rows)
        for (const double x : row) finite &= std::isfinite(x);
    return finite;
}

Point3 transform_point(const Transform& m, const Point3& p) {
    return Point3{} + (transform_vector(m, p - Point3{}) + m.translation());
}

Vec3 transform_vector(const Transform& m, const Vec3& v) {
    const auto& r = m.rows;
    return {r[0][0] * v.x + r[0][1] * v.y + r[0][2] * v.z, r[1][0] * v.x + r[1][1] * v.y + r[1][2] * v.z,
            r[2][0] * v.x + r[2][1] * v.y + r[2][2] * v.z};
}

Normal3 transform_normal(const Transform& inverse_of_m, const Normal3& n) {
    const auto& r = inverse_of_m.rows;
    return {r[0][0] * n.x + r[1][0] * n.y + r[2][0] * n.z, r[0][1] * n.x + r[1][1] * n.y + r[2][1] * n.z,
            r[0][2] * n.x + r[1][2] * n.y + r[2][2] * n.z};
}

// Transforms the intervals of the box by the method of Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems,
// 1990. Then grows the result by the rounding error of the sums.
Box transform_box(const Transform& m, const Box& b) {
    if (b.is_empty()) return b;
    Box out;
    Vec3 rounding;
    for (std::size_t i = 0; i < 3; ++i) {
        double lower = m.rows[i][3], upper = lower, magnitude = std::abs(lower);
        for (std::size_t j = 0; j < 3; ++j) {
            if (m.rows[i][j] == 0) continue;  // 0 times an infinite bound would be NaN
            const double at_lower = m.rows[i][j] * b.lower[j], at_upper = m.rows[i][j] * b.upper[j];
            lower += std::min(at_lower, at_upper);
            upper += std::max(at_lower, at_upper);
            magnitude += std::max(std::abs(at_lower), std::abs(at_upper));
        }
        out.lower[i] = lower;
        out.upper[i] = upper;
        rounding[i] = gamma(6) * magnitude;
    }
    return grow(out, rounding);
}

}  // namespace limn
