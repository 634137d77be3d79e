// A smooth interface between two clear media. `eta` is the index on the far side over the index on the incident side.
// Per-target include guard, as Highway has it.
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

// Cosine of the refracted direction by Snell's law; 0 at and beyond the critical angle, and where eta^2 leaves the
// range of double, where all light is reflected. sin_t = sin_i / eta, so cos_t^2 = (eta^2 - 1 + cos_i^2) / eta^2; the
// factored form is exact for eta near 1. \param cos_incident in [0, 1]
template <class N>
HWY_INLINE N cos_transmitted(N cos_incident, N eta) {
    const N squared = ((eta - 1.0) * (eta + 1.0) + cos_incident * cos_incident) / (eta * eta);
    return select(eta == 1.0, cos_incident, select(squared > 0.0, clamp_cosine(sqrt(squared)), 0.0));
}

// Fresnel's equations, mean of both polarisations (Born and Wolf, Principles of Optics, 7th ed., section 1.5.2). 1
// under total reflection, 0 for eta 1. In [0, 1]. \param cos_incident clamped to [0, 1]
template <class N>
HWY_INLINE N reflectance_exact(N cos_incident, N eta) {
    const N cos_i = clamp_cosine(cos_incident), cos_t = cos_transmitted(cos_i, eta);
    const N perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const N parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const N mean = (perpendicular * perpendicular + parallel * parallel) / 2.0;
    // No interface, not even at grazing incidence, where the quotients are 0 / 0.
    return select(eta == 1.0, 0.0, select(cos_t == 0.0, 1.0, mean));
}

// Schlick's approximation (An Inexpensive BRDF Model for Physically-based Rendering, Computer Graphics Forum 13(3),
// 1994), between what is reflected at normal and at grazing incidence. \param cosine in [0, 1]
template <class N>
HWY_INLINE N schlick(N at_normal, N cosine) {
    const N m = 1.0 - cosine;
    return at_normal + (1.0 - at_normal) * (m * m * m * m * m);
}
// 2 cos d(cos) of it from 0 to 1.
template <class N>
HWY_INLINE N mean_schlick(N at_normal) {
    return at_normal + (1.0 - at_normal) / 21.0;
}

// On the incident-side cosine whichever side that is, as the books have it; 1 under total reflection. In [0, 1].
// \param cos_incident clamped to [0, 1]
template <class N>
HWY_INLINE N reflectance_schlick(N cos_incident, N eta) {
    const N cos_i = clamp_cosine(cos_incident);
    const N root = (1.0 - eta) / (1.0 + eta);
    return select(cos_transmitted(cos_i, eta) == 0.0, 1.0, schlick(root * root, cos_i));
}

// The index of a conductor by what it reflects at normal incidence and its edge tint (Gulbrandsen, Artist Friendly
// Metallic Fresnel, JCGT 3(4), 2014). Of eta between `most` and `least` that have this reflectance.
template <class N>
struct ConductorIndex {
    N eta, k_squared;

    // \param reflectance in [0, 1)
    HWY_INLINE ConductorIndex(N reflectance, N edge_tint) {
        const N root = sqrt(reflectance), below = 1.0 - reflectance;
        const N most = (1.0 + root) * (1.0 + root) / below, least = (1.0 - root) * (1.0 - root) / below;
        const N tinted = edge_tint * (most - below / (1.0 + reflectance));
        eta = most - tinted;
        // ((1 + eta)^2 reflectance - (1 - eta)^2) / (1 - reflectance), factored: 0 for an edge tint of 0.
        k_squared = max(tinted * (eta - least), 0.0);
    }
};

// Fresnel's equations for a conductor, mean of both polarisations (Born and Wolf, Principles of Optics, 7th ed.,
// section 14.2). In [0, 1]. \param cosine in [0, 1]
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

// 2 cos d(cos) from 0 to 1: Gauss and Jacobi's rule of 4 points, to 7e-4.
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
