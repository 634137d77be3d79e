// How much a surface of microfacets reflects in all, by the direction that it is seen from: what of all light leaves it
// at the first bounce.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace limn::bsdf {

// Rows of the albedo over the cosine, interpolated by Catmull and Rom's cubics. What the rows are is the maker's: one
// roughness, the azimuth, or all roughnesses. Below 3e-4 from the integral down to cosines of 0.05.
struct AlbedoTable {
    static constexpr std::size_t kColumns = 32, kRows = 32;  // of cosines c^2; or one row
    static constexpr std::size_t kStride = kColumns + 2;     // with one more value at each side

    std::size_t rows = 1;        // without one more at each side
    std::vector<double> albedo;  // row by row
    std::vector<double> mean;    // of a row, over the projected solid angle

    // \param row from 0 to 1
    double at(double row, double cosine) const {
        const Place column(std::sqrt(cosine), kColumns);
        return std::clamp(interpolated(albedo.data(), kStride, row, column), 0.0, 1.0);
    }
    double mean_at(double row) const { return rows == 1 ? mean[1] : Place(row, rows).between(&mean[0], 1); }

    // Between four values, of which the first is `first`.
    struct Place {
        std::size_t first;
        double t;

        Place(double at, std::size_t count) {
            const double inside = at > 0 ? std::min(at, 1.0) : 0;  // of NaN too
            const double x = inside * static_cast<double>(count - 1);
            first = std::min(static_cast<std::size_t>(x), count - 2);
            t = x - static_cast<double>(first);
        }
        double between(const double* from, std::size_t stride) const {
            const double* p = from + first * stride;
            return cubic(p[0], p[stride], p[2 * stride], p[3 * stride], t);
        }
        static double cubic(double a, double b, double c, double d, double t) {
            return b + 0.5 * t * ((c - a) + t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * (b - c) + d - a)));
        }
    };

private:
    double interpolated(const double* from, std::size_t stride, double row, const Place& column) const {
        if (rows == 1) return column.between(from + stride, 1);
        const Place place(row, rows);
        double of_row[4];
        for (std::size_t i = 0; i < 4; ++i) of_row[i] = column.between(from + (place.first + i) * stride, 1);
        return Place::cubic(of_row[0], of_row[1], of_row[2], of_row[3], place.t);
    }
};

// \param eta index of what lies under the surface, reflecting by Fresnel's equations; 0: it reflects all
///@{
// Of alphas: one row, or, where they differ, rows over the azimuth from x to y.
AlbedoTable albedo_of(double alpha_x, double alpha_y, double eta);
// Rows over the roughness, whose square is alpha.
AlbedoTable albedo_by_roughness(double eta);
///@}

// The least alpha of a rough surface.
inline constexpr double kLeastAlpha = 1e-6;

}  // namespace limn::bsdf
