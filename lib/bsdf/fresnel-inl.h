// Reflection and refraction at a smooth interface. Between two clear media, `eta` is the index of refraction on the far
// side over that on the incident side. The include guard is per target, as Highway requires.
#if defined(LIMN_BSDF_FRESNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_BSDF_FRESNEL_INL_H
#undef LIMN_BSDF_FRESNEL_INL_H
#else
#define LIMN_BSDF_FRESNEL_INL_H
#endif

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::bsdf::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

template <class N>
HWY_INLINE N clamp_cosine(N cosine) {
    return select(cosine < 0.0, 0.0, select(cosine > 1.0, 1.0, cosine));
}

// Returns the cosine of the refracted direction by Snell's law. It is 0 if all light is reflected: from the critical
// angle on, and if eta^2 overflows or underflows. sin_t = sin_i / eta, so cos_t^2 = (eta^2 - 1 + cos_i^2) / eta^2. The
// factored form is exact for eta near 1. \param cos_incident in [0, 1]
template <class N>
HWY_INLINE N cos_transmitted(N cos_incident, N eta) {
    const N squared = ((eta - 1.0) * (eta + 1.0) + cos_incident * cos_incident) / (eta * eta);
    return select(eta == 1.0, cos_incident, select(squared > 0.0, clamp_cosine(sqrt(squared)), 0.0));
}

// Returns the reflectance by Fresnel's equations, the mean of both polarisations (Born and Wolf, Principles of Optics,
// 7th ed., section 1.5.2). It is in [0, 1], 1 under total reflection, and 0 if eta is 1.
// \param cos_incident clamped to [0, 1]
template <class N>
HWY_INLINE N reflectance_exact(N cos_incident, N eta) {
    const N cos_i = clamp_cosine(cos_incident), cos_t = cos_transmitted(cos_i, eta);
    const N perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const N parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const N mean = (perpendicular * perpendicular + parallel * parallel) / 2.0;
    // If eta is 1 there is no interface. The quotients are then 0 / 0 at grazing incidence.
    return select(eta == 1.0, 0.0, select(cos_t == 0.0, 1.0, mean));
}

// Returns Schlick's approximation of the reflectance (An Inexpensive BRDF Model for Physically-based Rendering,
// Computer Graphics Forum 13(3), 1994). It rises from `at_normal` at normal incidence to 1 at grazing incidence. \param
// cosine in [0, 1]
template <class N>
HWY_INLINE N schlick(N at_normal, N cosine) {
    const N m = 1.0 - cosine;
    return at_normal + (1.0 - at_normal) * (m * m * m * m * m);
}
// Returns its mean over the projected solid angle: the integral of 2 cos schlick(cos) d(cos) from 0 to 1.
template <class N>
HWY_INLINE N mean_schlick(N at_normal) {
    return at_normal + (1.0 - at_normal) / 21.0;
}

// Returns Schlick's approximation for an interface between clear media, in [0, 1]. It takes the cosine on the incident
// side, whichever that is (see Fresnel::schlick), and is 1 under total reflection. \param cos_incident clamped to [0,
// 1]
template <class N>
HWY_INLINE N reflectance_schlick(N cos_incident, N eta) {
    const N cos_i = clamp_cosine(cos_incident);
    const N root = (1.0 - eta) / (1.0 + eta);
    return select(cos_transmitted(cos_i, eta) == 0.0, 1.0, schlick(root * root, cos_i));
}

// The complex index eta + i k of a conductor, computed from its reflectance at normal incidence and its edge tint
// (Gulbrandsen, Artist Friendly Metallic Fresnel, JCGT 3(4), 2014). Every eta between `least` and `most` can have this
// reflectance. The tint 0 chooses `most`.
template <class N>
struct ConductorIndex {
    N eta, k_squared;

    // \param reflectance in [0, 1)
    HWY_INLINE ConductorIndex(N reflectance, N edge_tint) {
        const N root = sqrt(reflectance), below = 1.0 - reflectance;
        const N most = (1.0 + root) * (1.0 + root) / below, least = (1.0 - root) * (1.0 - root) / below;
        const N tinted = edge_tint * (most - below / (1.0 + reflectance));
        eta = most - tinted;
        // k^2 = ((1 + eta)^2 reflectance - (1 - eta)^2) / (1 - reflectance). The factored form is 0 for an edge tint of
        // 0.
        k_squared = max(tinted * (eta - least), 0.0);
    }
};

// Returns the reflectance of a conductor by Fresnel's equations, the mean of both polarisations (Born and Wolf,
// Principles of Optics, 7th ed., section 14.2). It is in [0, 1]. \param cosine in [0, 1]
template <class N>
HWY_INLINE N reflectance_conductor(N cosine, const ConductorIndex<N>& index) {
    const N cos2 = cosine * cosine, sin2 = 1.0 - cos2, eta2 = index.eta * index.eta;
    const N real = eta2 - index.k_squared - sin2;
    const N size = sqrt(real * real + 4.0 * eta2 * index.k_squared);  // a^2 + b^2
    const N a_cos2 = 2.0 * cosine * sqrt(max(0.5 * (size + real), 0.0));
    const N perpendicular = (size + cos2 - a_cos2) / (size + cos2 + a_cos2);
    const N x = cos2 * size + sin2 * sin2, y = a_cos2 * sin2;
    return 0.5 * perpendicular * (1.0 + (x - y) / (x + y));
}

// Returns the mean of a function of the cosine over the projected solid angle: the integral of 2 cos f(cos) d(cos) from
// 0 to 1, by the rule of Gauss and Jacobi with 4 points. The error is at most 7e-4.
template <class N, class Function>
HWY_INLINE N mean_over_cosines(const Function& function) {
    constexpr double kCosines[] = {0.13975986434378057, 0.41640956763108317, 0.7231569863618762, 0.9428958038854822};
    constexpr double kWeights[] = {0.06236194190001614, 0.25969509521646494, 0.4069291360205427, 0.2710138268629761};
    N sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum = sum + kWeights[i] * function(N(kCosines[i]));
    return sum;
}

}  // namespace limn::bsdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
