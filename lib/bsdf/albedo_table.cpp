#include "bsdf/albedo_table.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bsdf/albedo_table.cpp"
#include <hwy/foreach_target.h>

#include "bsdf/fresnel-inl.h"
#include "bsdf/microfacet-inl.h"
#include "math/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::bsdf::HWY_NAMESPACE {

// Returns the mean weight of sampled directions, by the midpoint rule over the numbers from which they are drawn. The
// numbers are squared, which gathers them around the mirror direction, where the weights change fastest. The result for
// 48 x 32 numbers is within 2e-4 of that for 2000 x 1000.
template <class N>
HWY_INLINE N directional_albedo(const Microsurface<N>& s, const Vector<N>& out, double eta) {
    constexpr int kAround = 48, kAcross = 32;
    const N middle = angle_of<N>({s.alpha_y * out.y, max(s.alpha_x * out.x, 1e-12)}) / (2 * kPi) + 0.5;
    const N bound = s.bound(out), from = s.stretched(out);
    N sum = 0.0;
    for (int i = 0; i < kAround; ++i) {
        const double a = (2 * i + 1.0) / kAround - 1;
        for (int j = 0; j < kAcross; ++j) {
            const double b = (j + 0.5) / kAcross;
            const Vector<N> m = s.visible_normal(out, middle + 0.5 * a * std::abs(a), 1 - b * b, bound);
            const N cosine = dot(out, m);
            const Vector<N> in = (2.0 * cosine) * m - out;
            N weight = in.z * (bound * out.z + from) / (from * in.z + s.stretched(in) * out.z);
            if (eta > 0) weight = weight * reflectance_exact<N>(cosine, eta);
            sum = sum + select(in.z > 0.0, 4 * std::abs(a) * b * weight, 0.0);
        }
    }
    return sum / static_cast<double>(kAround * kAcross);
}

// Computes one row. \param turns azimuth of the row, in turns
void fill_row(double alpha_x, double alpha_y, double turns, double eta, double* row) {
    const Microsurface<Doubles> surface{alpha_x, alpha_y};
    const SineCosine<double> azimuth = sine_cosine_of_turns(turns);
    static_assert(AlbedoTable::kColumns % kLanes<Doubles> == 0);
    for (std::size_t i = 0; i < AlbedoTable::kColumns; i += kLanes<Doubles>) {
        HWY_ALIGN double cosines[kLanes<Doubles>], sines[kLanes<Doubles>];
        for (std::size_t k = 0; k < kLanes<Doubles>; ++k) {
            const double root = static_cast<double>(i + k) / (AlbedoTable::kColumns - 1);
            cosines[k] = std::max(root * root, 1e-4);  // the least cosine of ShadingFrame, for column 0
            sines[k] = std::sqrt(1 - cosines[k] * cosines[k]);
        }
        const Doubles sine = load<Doubles>(sines);
        const Vector<Doubles> out{azimuth.cosine * sine, azimuth.sine * sine, load<Doubles>(cosines)};
        store(directional_albedo(surface, out, eta), row + i);
    }
}

}  // namespace limn::bsdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::bsdf {

HWY_EXPORT(fill_row);

namespace {

// How values continue beyond the end: in a straight line, or mirrored.
enum class Beyond { straight, mirrored };

// Sets the values one step beyond both ends of row[stride], row[2 stride], ..., row[count stride].
void extend(double* row, std::size_t count, std::size_t stride, Beyond beyond) {
    double *first = row + stride, *last = row + count * stride;
    row[0] = beyond == Beyond::mirrored ? first[stride] : 2 * first[0] - first[stride];
    last[stride] = beyond == Beyond::mirrored ? *(last - stride) : 2 * last[0] - *(last - stride);
}

// Returns the mean of an interpolated row over the projected solid angle: with cos = c^2, 2 cos d(cos) = 4 c^3 dc.
double mean_of(const double* row) {
    constexpr int kSteps = 2048;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double c = (i + 0.5) / kSteps;
        sum += 4 * c * c * c * std::min(AlbedoTable::Place(c, AlbedoTable::kColumns).between(row, 1), 1.0);
    }
    return sum / kSteps;
}

// Returns a table. `fill` is called with the position of each row, from 0 to 1, and with the address of its values.
template <class Fill>
AlbedoTable make(std::size_t rows, Beyond beyond, const Fill& fill) {
    // Compute the rows.
    AlbedoTable table;
    table.rows = rows;
    table.albedo.resize((rows + 2) * AlbedoTable::kStride);
    table.mean.resize(rows + 2);
    const auto row = [&](std::size_t i) { return &table.albedo[i * AlbedoTable::kStride]; };
    for (std::size_t i = 1; i <= rows; ++i) {
        fill(rows == 1 ? 0 : static_cast<double>(i - 1) / static_cast<double>(rows - 1), row(i) + 1);
        extend(row(i), AlbedoTable::kColumns, 1, Beyond::straight);
        table.mean[i] = mean_of(row(i));
    }
    // Continue the table by a row at each end.
    if (rows == 1) return table;
    for (std::size_t k = 0; k < AlbedoTable::kStride; ++k) extend(row(0) + k, rows, AlbedoTable::kStride, beyond);
    extend(table.mean.data(), rows, 1, beyond);
    return table;
}

}  // namespace

AlbedoTable albedo_of(double alpha_x, double alpha_y, double eta) {
    const bool turned_alike = alpha_x == alpha_y;
    AlbedoTable table = make(turned_alike ? 1 : AlbedoTable::kRows, Beyond::mirrored, [&](double at, double* row) {
        HWY_DYNAMIC_DISPATCH(fill_row)(alpha_x, alpha_y, at / 4, eta, row);
    });
    if (turned_alike) return table;
    // All rows are of one surface, so they have the same mean: that over a quarter turn, by the trapezoidal rule.
    double sum = 0;
    for (std::size_t i = 1; i < table.rows; ++i) sum += (table.mean[i] + table.mean[i + 1]) / 2;
    std::fill(table.mean.begin(), table.mean.end(), sum / static_cast<double>(table.rows - 1));
    return table;
}

AlbedoTable albedo_by_roughness(double eta) {
    return make(AlbedoTable::kRows, Beyond::straight, [&](double roughness, double* row) {
        const double alpha = std::max(roughness * roughness, kLeastAlpha);
        HWY_DYNAMIC_DISPATCH(fill_row)(alpha, alpha, 0, eta, row);
    });
}

}  // namespace limn::bsdf
#endif
