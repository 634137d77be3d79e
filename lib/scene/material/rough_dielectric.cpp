#include "limn/scene/material/rough_dielectric.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/rough_dielectric.cpp"
#include <hwy/foreach_target.h>

#include <cmath>

#include "bsdf/rough-inl.h"
#include "limn/scene/material/dielectric.h"
#include "math/require.h"
#include "scene/material/alpha.h"

HWY_BEFORE_NAMESPACE();
namespace limn::rough_dielectric::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

// The parameter is the index of the inside relative to the outside. Never smooth.
struct RoughInterface {
    template <class N>
    static HWY_INLINE N eta_of(const LobeInput<N>& s) {
        return select(s.front_face, s.parameter, 1.0 / s.parameter);
    }
    // Walter et al., sections 4.2 and 5.3, by visible normals: their f |cos| over the density is Smith's G1 of `in`,
    // or, for light that is reflected, the share of it that heights leave (Heitz, equation 99).
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Facets<N>& facets, const Vector<N>& world) {
        const LobeInput<N>& s = facets.s;
        const N eta = eta_of(s);
        const Vector<N> in = facets.frame.to_local(world), &out = facets.frame.out;
        const Mask<N> reflects = in.z > 0.0;
        const Vector<N> half = normalize(out + select(reflects, 1.0, eta) * in);
        const Vector<N> m = select(half.z < 0.0, -1.0, 1.0) * half;
        const N cos_o = dot(out, m), cos_i = dot(in, m);
        const N reflectance = reflectance_exact(cos_o, eta), visible = facets.surface.visible_normal_pdf(out, m);
        const N path = cos_o + eta * cos_i;
        const N bent = eta * eta * abs(cos_i) / (path * path);  // solid angle of normals over that of directions
        const N pdf = visible * select(reflects, reflectance / (4.0 * cos_o), (1.0 - reflectance) * bent);
        const N both =
            facets.surface.masking_over_cosines(out, in) * (out.z + facets.surface.stretched(out)) * in.z * 2.0;
        const Mask<N> through = (reflects & (cos_i > 0.0)) | ((in.z < 0.0) & (cos_i < 0.0));
        const Mask<N> agrees = !((dot(world, s.normal) > 0.0) ^ reflects);
        const N drawn = select(through & agrees & (cos_o > 0.0), pdf, 0.0);
        return {(drawn * select(reflects, both, facets.surface.masking(in))) * s.albedo, drawn};
    }
    template <class N>
    static HWY_INLINE LobeValue<N> value(const LobeInput<N>& s, const Vector<N>& in) {
        return value(Facets<N>(s), in);
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const LobeInput<N>& s, const Vector<N>& random) {
        const Facets<N> facets(s);
        const N eta = eta_of(s);
        const Vector<N>& out = facets.frame.out;
        const Vector<N> m = facets.surface.visible_normal(out, random.x, random.y, 1.0);
        const N cos_o = clamp_cosine(dot(out, m)), cos_t = cos_transmitted(cos_o, eta);
        const Mask<N> reflects = random.z < reflectance_exact(cos_o, eta);
        const Vector<N> refracted = (cos_o * m - out) / eta - cos_t * m;
        const Vector<N> local = select(reflects, mirror(out, m), refracted);
        const Vector<N> in = normalize(facets.frame.to_world(local));
        const LobeValue<N> f = value(facets, in);
        // Reflected from below, or refracted upward: it meets the surface again, and is lost.
        const Mask<N> leaves = (f.pdf > 0.0) & !((local.z > 0.0) ^ reflects);
        return {in, weight_where(leaves, f.value / f.pdf), f.pdf};
    }
};

LIMN_LOBE_STAGES(RoughInterface)

}  // namespace limn::rough_dielectric::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

namespace rough_dielectric {

LIMN_LOBE(.one_sided = false, .numbers = 3)

}  // namespace rough_dielectric

namespace formulas = rough_dielectric::HWY_NAMESPACE;

RoughDielectric::RoughDielectric(double index, const Roughness& roughness) : index_(index) {
    require(std::isfinite(index) && index > 0, "RoughDielectric: index must be positive and finite");
    const Alphas alpha = checked_alphas(roughness, "RoughDielectric");
    if (alpha.x == 0 || index == 1) return;
    MaterialDetails details;
    details.numbers = {0, 0, 0, alpha.x, alpha.y};
    details.tangents = alpha.x != alpha.y;
    details_ = std::make_shared<const MaterialDetails>(details);
}

std::optional<ScatterSample> RoughDielectric::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    if (!details_) return Dielectric(index_).sample(s, out, random);
    return formulas::sample_one<formulas::RoughInterface>(formulas::input_of(s, out, {1, 1, 1}, index_, *details_),
                                                          random);
}

ScatterValue RoughDielectric::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    if (!details_) return {};
    return formulas::value_one<formulas::RoughInterface>(formulas::input_of(s, out, {1, 1, 1}, index_, *details_), in);
}

MaterialRecord RoughDielectric::lower(RecordSink& sink) const {
    if (!details_) return Dielectric(index_).lower(sink);
    MaterialRecord record;
    record.kind = "rough-dielectric";
    record.lobe = &rough_dielectric::kLobe;
    record.parameter = index_;
    record.details = details_;
    return record;
}

}  // namespace limn
#endif
