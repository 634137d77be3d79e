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

template <class N>
using Input = LobeInput<N, RoughDielectric::Parameters>;

// Facets that reflect or refract. They are never smooth.
struct RoughInterface {
    // Returns the index on the far side over that on the incident side.
    template <class N>
    static HWY_INLINE N eta_of(const Input<N>& s) {
        return select(s.front_face, s.parameters.index, 1.0 / s.parameters.index);
    }
    // The formulas are those of Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007,
    // sections 4.2 and 5.3, with directions drawn by visible normals. f |cos| over the pdf is then Smith's G1 of `in`
    // for refracted light. For reflected light it is G2 over G1 of `out` (Heitz, equation 99).
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Facets<Input<N>>& facets, const Vector<N>& world) {
        const Input<N>& s = facets.s;
        // Find the normal m of the facets that scatter from `in` to `out`.
        const N eta = eta_of(s);
        const Vector<N> in = facets.frame.to_local(world), &out = facets.frame.out;
        const Mask<N> reflects = in.z > 0.0;
        const Vector<N> half = normalize(out + select(reflects, 1.0, eta) * in);
        const Vector<N> m = select(half.z < 0.0, -1.0, 1.0) * half;
        const N cos_o = dot(out, m), cos_i = dot(in, m);
        // Find the pdf.
        const N reflectance = reflectance_exact(cos_o, eta), visible = facets.surface.visible_normal_pdf(out, m);
        const N path = cos_o + eta * cos_i;
        const N bent = eta * eta * abs(cos_i) / (path * path);  // solid angle of normals over solid angle of directions
        const N pdf = visible * select(reflects, reflectance / (4.0 * cos_o), (1.0 - reflectance) * bent);
        // The pdf is 0 if the directions are on other sides of the facets or of the geometric surface than of z = 0.
        const Mask<N> through = (reflects & (cos_i > 0.0)) | ((in.z < 0.0) & (cos_i < 0.0));
        const Mask<N> agrees = !((dot(world, s.normal) > 0.0) ^ reflects);
        const N drawn = select(through & agrees & (cos_o > 0.0), pdf, 0.0);
        // Find f |cos|.
        const N both =
            facets.surface.masking_over_cosines(out, in) * (out.z + facets.surface.stretched(out)) * in.z * 2.0;
        return {(drawn * select(reflects, both, facets.surface.masking(in))) * s.albedo, drawn};
    }
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>& in) {
        return value(Facets<Input<N>>(s), in);
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        const Facets<Input<N>> facets(s);
        const N eta = eta_of(s);
        const Vector<N>& out = facets.frame.out;
        const Vector<N> m = facets.surface.visible_normal(out, random.x, random.y, 1.0);
        const N cos_o = clamp_cosine(dot(out, m)), cos_t = cos_transmitted(cos_o, eta);
        const Mask<N> reflects = random.z < reflectance_exact(cos_o, eta);
        const Vector<N> refracted = (cos_o * m - out) / eta - cos_t * m;
        const Vector<N> local = select(reflects, mirror(out, m), refracted);
        const Vector<N> in = normalize(facets.frame.to_world(local));
        const LobeValue<N> f = value(facets, in);
        // Light that is reflected downward or refracted upward meets the surface again. It is lost.
        const Mask<N> leaves = (f.pdf > 0.0) & !((local.z > 0.0) ^ reflects);
        return {in, weight_where(leaves, f.value / f.pdf), f.pdf};
    }
};

LIMN_LOBE_STAGES(RoughInterface)

}  // namespace limn::rough_dielectric::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(rough_dielectric, .one_sided = false, .numbers = 3, .microfacets = true)

RoughDielectric::RoughDielectric(double index, const Roughness& roughness) {
    require(std::isfinite(index) && index > 0, "RoughDielectric: index must be positive and finite");
    const Alphas alpha = checked_alphas(roughness, "RoughDielectric");
    parameters_ = index == 1 ? Parameters<double>{index, 0, 0} : Parameters<double>{index, alpha.x, alpha.y};
}

std::optional<ScatterSample> RoughDielectric::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    if (parameters_.alpha_x == 0) return Dielectric(parameters_.index).sample(s, out, random);
    return formulas::sample_one<formulas::RoughInterface>(formulas::input_of(s, out, {1, 1, 1}, parameters_), random);
}

ScatterValue RoughDielectric::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    if (parameters_.alpha_x == 0) return {};
    return formulas::value_one<formulas::RoughInterface>(formulas::input_of(s, out, {1, 1, 1}, parameters_), in);
}

MaterialRecord RoughDielectric::lower(RecordSink& sink) const {
    if (parameters_.alpha_x == 0) return Dielectric(parameters_.index).lower(sink);
    return {.kind = "rough-dielectric",
            .lobe = &rough_dielectric::kLobe,
            .uses_tangents = parameters_.alpha_x != parameters_.alpha_y,
            .parameters = parameters_};
}

}  // namespace limn
#endif
