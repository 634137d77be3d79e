#include "bsdf/perlin.h"

#include <cmath>
#include <cstddef>

#include "math/elementary.h"

namespace limn::pattern {

namespace {

constexpr int kOctaves = 7;  // Shirley, Ray Tracing: The Next Week, section 5.6

// The position of a coordinate among the lattice points of one axis.
struct Cell {
    std::size_t corner[2];  // the lattice points below and above, modulo 256
    double offset[2];       // the coordinate minus each lattice point
    double weight[2];       // weight of each lattice point: the Hermite smoothstep 3 t^2 - 2 t^3
};

// Returns the cell of a finite coordinate. The cell and the offset are exact for every double; one of magnitude 2^53 or
// more is a lattice point itself.
Cell cell_of(double x) {
    const double below = std::floor(x), t = x - below;
    const auto i = static_cast<std::size_t>(below - 256 * std::floor(below / 256));
    const double smooth = t * t * (3 - 2 * t);
    return {{i, (i + 1) & 255}, {t, t - 1}, {1 - smooth, smooth}};
}

Point3 scaled(double scale, const Point3& p) { return {scale * p.x, scale * p.y, scale * p.z}; }

}  // namespace

double noise(const PerlinLattice& lattice, const Point3& p) {
    if (!is_finite(p)) return 0;
    const Cell x = cell_of(p.x), y = cell_of(p.y), z = cell_of(p.z);
    double sum = 0;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            for (std::size_t k = 0; k < 2; ++k) {
                const auto hash =
                    lattice.perm_x[x.corner[i]] ^ lattice.perm_y[y.corner[j]] ^ lattice.perm_z[z.corner[k]];
                const Vec3 offset{x.offset[i], y.offset[j], z.offset[k]};
                sum += x.weight[i] * y.weight[j] * z.weight[k] *
                       dot(lattice.gradients[static_cast<std::size_t>(hash)], offset);
            }
    return sum;
}

double turbulence(const PerlinLattice& lattice, const Point3& p) {
    double sum = 0, weight = 1;
    Point3 q = p;
    for (int octave = 0; octave < kOctaves; ++octave) {
        sum += weight * noise(lattice, q);
        weight /= 2;
        q = scaled(2, q);
    }
    return std::abs(sum);
}

double noise_factor(const PerlinLattice& lattice, double scale, const Point3& p) {
    return (1 + noise(lattice, scaled(scale, p))) / 2;
}

double turbulence_factor(const PerlinLattice& lattice, double scale, const Point3& p) {
    return turbulence(lattice, scaled(scale, p));
}

double marble(const PerlinLattice& lattice, double scale, const Point3& p) {
    const Point3 q = scaled(scale, p);
    const double phase = q.z + 10 * turbulence(lattice, q);
    return std::isfinite(phase) ? (1 + sine(phase)) / 2 : 0.5;
}

}  // namespace limn::pattern
