#include "geometry/ray_frame.h"

#include <algorithm>
#include <cmath>

#include "limn/math/math.h"
#include "math/scaled_matrix.h"

namespace limn {

namespace {

// A bound on the error of products that underflow, added to the relative bounds.
constexpr double kTiny = 0x1p-1000;

// The exact inverse of the linear part of a matrix: rows / determinant, with determinant > 0. The rows are those of the
// adjugate, which are cross products of the matrix's columns. If the determinant is negative, both are negated.
struct ExactInverse {
    Dyadic3 rows[3];
    Dyadic determinant;

    explicit ExactInverse(const Transform& m) {
        const auto column = [&](std::size_t j) { return Dyadic3{m.rows[0][j], m.rows[1][j], m.rows[2][j]}; };
        const Dyadic3 a = column(0), b = column(1), c = column(2);
        rows[0] = cross(b, c);
        rows[1] = cross(c, a);
        rows[2] = cross(a, b);
        determinant = dot(a, rows[0]);
        if (determinant.sign() > 0) return;
        determinant = -determinant;
        for (Dyadic3& row : rows) row = {-row.x, -row.y, -row.z};
    }
    // Returns the product with a vector, times the determinant.
    Dyadic3 operator*(const Dyadic3& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
};

}  // namespace

InverseError inverse_error(const Transform& m) {
    const ScaledMatrix scaled(m);
    const auto at = [&](std::size_t i, std::size_t j) { return scaled.matrix.rows[i % 3][j % 3]; };
    const auto cofactor_magnitude = [&](std::size_t i, std::size_t j) {
        return std::abs(at(i + 1, j + 1) * at(i + 2, j + 2)) + std::abs(at(i + 1, j + 2) * at(i + 2, j + 1));
    };
    // Compute P and the largest sum of K_ij in a row of the inverse.
    double permanent = 0, row_sum = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        permanent += std::abs(at(0, j)) * cofactor_magnitude(0, j);
        // A row of the inverse corresponds to a column of the matrix.
        row_sum = std::max(row_sum, cofactor_magnitude(0, j) + cofactor_magnitude(1, j) + cofactor_magnitude(2, j));
    }
    // Give up if the determinant may be 0. Otherwise it is off by at most 6/32 of itself.
    const double det = std::abs(determinant(scaled.matrix));
    if (!(det > 32 * kRoundoff * permanent + kTiny)) return {kInfinity, kInfinity};
    const double norm = std::ldexp(row_sum / det, -scaled.exponent) * (1 + 0x1p-20);
    return {24 * kRoundoff * (permanent / det) * norm, norm};
}

bool is_singular(const Transform& m) {
    return !std::isfinite(inverse_error(m).norm) && ExactInverse(m).determinant.sign() == 0;
}

RayFrame::RayFrame(const RayFrame& outer_frame, const Transform& matrix, const Transform& object_from_world,
                   const InverseError& of_inverse)
    : ray(ray_inside(outer_frame.ray, matrix, object_from_world)), outer(&outer_frame), world_from_object(&matrix) {
    // The error is that of this transformation, plus the transformed error of the outer ray. The factor 1.25 covers the
    // error of the determinant in `norm`: 1 / (1 - 6/32) < 1.25.
    const Vec3 v = (outer_frame.ray.origin - Point3{}) - matrix.translation();
    const Vec3 d = outer_frame.ray.direction;
    origin_error = of_inverse.error * max_abs(v) + 1.25 * of_inverse.norm * outer_frame.origin_error + kTiny;
    direction_error = of_inverse.error * max_abs(d) + 1.25 * of_inverse.norm * outer_frame.direction_error + kTiny;
    // If rounding cancels the direction to zero, round the exact direction instead: a ray without direction could not
    // be used.
    if (ray.direction == Vec3{} && is_usable(outer_frame.ray)) {
        const ExactRay exact = exact_ray(*this);
        const auto nearest = [&](const Dyadic& x) { return ratio(x, exact.unit); };
        ray.direction = {nearest(exact.direction.x), nearest(exact.direction.y), nearest(exact.direction.z)};
    }
}

RayFrame frame_of(const Ray& ray) {
    const RayFrame* const known = ray.frame;
    if (known == nullptr || known->ray.origin != ray.origin || known->ray.direction != ray.direction)
        return RayFrame(ray);
    RayFrame frame = *known;
    frame.ray = ray;
    return frame;
}

ExactRay exact_ray(const RayFrame& frame) {
    if (frame.outer == nullptr) return {to_dyadic(frame.ray.origin), to_dyadic(frame.ray.direction), 1.0};
    const ExactRay outside = exact_ray(*frame.outer);
    const ExactInverse inverse(*frame.world_from_object);
    const Dyadic3 translation = to_dyadic(frame.world_from_object->translation());
    return {inverse * (outside.origin - outside.unit * translation), inverse * outside.direction,
            inverse.determinant * outside.unit};
}

Dyadic3 exact_vector(const RayFrame& frame, const Vec3& v) {
    if (frame.outer == nullptr) return to_dyadic(v);
    return ExactInverse(*frame.world_from_object) * exact_vector(*frame.outer, v);
}

}  // namespace limn
