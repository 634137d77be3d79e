#include "bsdf/dielectric.h"

#include <cmath>

#include "bsdf/mirror.h"

namespace limn::bsdf {

namespace {

double clamp_cosine(double cosine) { return cosine < 0 ? 0 : cosine > 1 ? 1 : cosine; }

// Both for a transmitted cosine above 0.
double exact(double cos_i, double cos_t, double eta) {
    const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return (perpendicular * perpendicular + parallel * parallel) / 2;
}
double schlick(double cos_i, double eta) {
    const double root = (1 - eta) / (1 + eta), at_normal = root * root;
    const double m = 1 - cos_i;
    return at_normal + (1 - at_normal) * (m * m * m * m * m);
}

}  // namespace

// sin_t = sin_i / eta, so cos_t^2 = (eta^2 - 1 + cos_i^2) / eta^2; the factored form is exact for eta near 1.
double cos_transmitted(double cos_incident, double eta) {
    if (eta == 1) return cos_incident;
    const double squared = ((eta - 1) * (eta + 1) + cos_incident * cos_incident) / (eta * eta);
    return squared > 0 ? clamp_cosine(std::sqrt(squared)) : 0;
}

// Born and Wolf, Principles of Optics, 7th ed., section 1.5.2.
double reflectance_exact(double cos_incident, double eta) {
    if (eta == 1) return 0;  // no interface, not even at grazing incidence, where the quotients are 0 / 0
    const double cos_i = clamp_cosine(cos_incident), cos_t = cos_transmitted(cos_i, eta);
    return cos_t == 0 ? 1 : exact(cos_i, cos_t, eta);
}

// Schlick, An Inexpensive BRDF Model for Physically-based Rendering, Computer Graphics Forum 13(3), 1994.
double reflectance_schlick(double cos_incident, double eta) {
    const double cos_i = clamp_cosine(cos_incident);
    return cos_transmitted(cos_i, eta) == 0 ? 1 : schlick(cos_i, eta);
}

std::optional<ScatterSample> sample_dielectric(double index, Fresnel fresnel, const Surface& s, const Vec3& out,
                                               const Random3& random) {
    const double eta = s.front_face ? index : 1 / index;
    const Vec3 normal(s.shading_normal);
    const double cos_i = clamp_cosine(dot(out, normal)), cos_t = cos_transmitted(cos_i, eta);
    double reflectance = cos_t == 0 ? 1 : schlick(cos_i, eta);
    if (fresnel == Fresnel::exact) reflectance = eta == 1 ? 0 : cos_t == 0 ? 1 : exact(cos_i, cos_t, eta);
    const bool reflects = random.x < reflectance;
    const Vec3 along_surface = cos_i * normal - out;  // length sin_i
    const Vec3 in = normalize(reflects ? mirror(out, s.shading_normal) : along_surface / eta - cos_t * normal);
    const double side = dot(in, s.normal);
    if (reflects ? side < 0 : !(side < 0)) return std::nullopt;
    return ScatterSample{.direction = in, .weight = {1, 1, 1}, .pdf = 0};
}

}  // namespace limn::bsdf
