#include "bsdf/metal.h"

#include <cmath>

#include "bsdf/mirror.h"
#include "limn/core/math.h"
#include "limn/core/warp.h"

namespace limn::bsdf {

namespace {

// A displacement below half a unit in the last place of a unit vector is none.
bool is_mirror(double fuzz) { return fuzz < kRoundoff; }

// Density per solid angle of w = unit(m + fuzz x), x uniform in the unit ball, m the unit mirror direction. The points
// m + fuzz x fill a ball around m with density 3 / (4 pi fuzz^3). Those that end up as w lie on the half-line s w,
// inside the ball for s1 < s < s2, where |s w - m| = fuzz, and a solid angle dw cuts the volume s^2 ds dw out there:
//     pdf(w) = 3 / (4 pi fuzz^3) integral of s^2 ds = (s2^3 - s1^3) / (4 pi fuzz^3).
// With c = dot(w, m) the roots are c -+ h, h^2 = fuzz^2 - (1 - c^2), both >= 0 for c > 0 as fuzz <= 1, and
// s2^3 - s1^3 = 2 h (3 c^2 + h^2). For c <= 0 the half-line misses the ball. 1 - c^2 = |w x m|^2 does not cancel.
double fuzz_pdf(double fuzz, const Vec3& m, const Vec3& w) {
    const double c = dot(w, m);
    const double h_squared = fuzz * fuzz - length_squared(cross(w, m));
    if (!(c > 0 && h_squared > 0)) return 0;
    return std::sqrt(h_squared) * (3 * c * c + h_squared) / (2 * kPi * fuzz * fuzz * fuzz);
}

}  // namespace

ScatterValue value_metal(const Color& albedo, double fuzz, const Surface& s, const Vec3& out, const Vec3& in) {
    if (is_mirror(fuzz) || !(dot(in, s.normal) > 0)) return {};
    const double pdf = fuzz_pdf(fuzz, mirror(out, s.shading_normal), in);
    return {.value = albedo * pdf, .pdf = pdf};
}

std::optional<ScatterSample> sample_metal(const Color& albedo, double fuzz, const Surface& s, const Vec3& out,
                                          const Random3& random) {
    Vec3 in = mirror(out, s.shading_normal);
    if (!is_mirror(fuzz)) in = normalize(in + fuzz * sample_uniform_ball(random.x, random.y, random.z));
    if (!(dot(in, s.normal) > 0)) return std::nullopt;  // also NaN: fuzz 1 can reach the zero vector
    return ScatterSample{.direction = in, .weight = albedo, .pdf = value_metal(albedo, fuzz, s, out, in).pdf};
}

}  // namespace limn::bsdf
