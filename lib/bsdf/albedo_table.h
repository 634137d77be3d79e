// Tables of the directional albedo of microfacets: the share of the light that leaves the surface after one scattering,
// for each direction from which the surface is seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace limn::bsdf {

// A table with a column for each cosine of the direction. Its rows are azimuths or roughnesses, or there is a single
// row. Values between are interpolated by the cubics of Catmull and Rom. The error is below 3e-4 for cosines of at
// least 0.05.
struct AlbedoTable {
    // The cosine of column i is (i / (kColumns - 1))^2. A table has kRows rows, or one.
    static constexpr std::size_t kColumns = 32, kRows = 32;
    // Cubics need one more column at each end, and one more row.
    static constexpr std::size_t kStride = kColumns + 2;

    std::size_t rows = 1;        // without those at the ends
    std::vector<double> albedo;  // row by row
    std::vector<double> mean;    // for each row, the mean over the projected solid angle

    // Return the albedo for a cosine, and the mean of a row. \param row position among the rows, from 0 to 1
    double at(double row, double cosine) const {
        const Place column(std::sqrt(cosine), kColumns);
        return std::clamp(interpolated(albedo.data(), kStride, row, column), 0.0, 1.0);
    }
    double mean_at(double row) const { return rows == 1 ? mean[1] : Place(row, rows).between(&mean[0], 1); }

    // A position among `count` values, from 0 to 1. `first` is the first of four values around it, and t is its
    // distance from the second.
    struct Place {
        std::size_t first;
        double t;

        Place(double at, std::size_t count) {
            const double inside = at > 0 ? std::min(at, 1.0) : 0;  // 0 for NaN too
            const double x = inside * static_cast<double>(count - 1);
            first = std::min(static_cast<std::size_t>(x), count - 2);
            t = x - static_cast<double>(first);
        }
        // Interpolates between the values from[0], from[stride], from[2 stride], ...
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

// Returns the table for one surface. It has a single row if the alphas are equal. Otherwise its rows are azimuths from
// the x axis to the y axis. \param eta index of refraction inside the facets, which reflect by Fresnel's equations; 0:
// they reflect all light
AlbedoTable albedo_of(double alpha_x, double alpha_y, double eta);
// Returns a table whose rows are roughnesses from 0 to 1. The square of a roughness is alpha. \param eta as above
AlbedoTable albedo_by_roughness(double eta);

// The least alpha of a rough surface. Directions and normals are rounded to about 2^-52. In Microsurface::density()
// their errors are divided by alpha: the density keeps about 9 digits, and 5 if the viewer is at the horizon.
inline constexpr double kLeastAlpha = 1e-6;

}  // namespace limn::bsdf
