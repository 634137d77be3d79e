// A smooth interface between two clear media. `eta` is the index on the far side over the index on the incident side.
// Per-target include guard, as Highway has it.
#if defined(LIMN_BSDF_FRESNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_BSDF_FRESNEL_INL_H
#undef LIMN_BSDF_FRESNEL_INL_H
#else
#define LIMN_BSDF_FRESNEL_INL_H
#endif

#include "lanes/lanes-inl.h"

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
// 1994) on the incident-side cosine whichever side that is, as the books have it; 1 under total reflection. In [0, 1].
// \param cos_incident clamped to [0, 1]
template <class N>
HWY_INLINE N reflectance_schlick(N cos_incident, N eta) {
    const N cos_i = clamp_cosine(cos_incident);
    const N root = (1.0 - eta) / (1.0 + eta), at_normal = root * root;
    const N m = 1.0 - cos_i;
    return select(cos_transmitted(cos_i, eta) == 0.0, 1.0, at_normal + (1.0 - at_normal) * (m * m * m * m * m));
}

}  // namespace limn::bsdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
