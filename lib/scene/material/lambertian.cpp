#include "limn/scene/material/lambertian.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/lambertian.cpp"
#include <hwy/foreach_target.h>

#include "bsdf/lobe-inl.h"
#include "scene/material/albedo.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lambertian::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N>;

// The ideal diffuse lobe around the shading normal, f = albedo / pi. Light is absorbed if it is scattered below the
// geometric surface. An interpolated normal thus cannot send light through a wall (Veach, Robust Monte Carlo Methods
// for Light Transport Simulation, 1997, section 5.3).
struct Diffuse {
    // Returns the pdf of `in`.
    template <class N>
    static HWY_INLINE N density(const Input<N>& s, const Vector<N>& in) {
        const N cosine = dot(in, s.shading_normal);
        return select((dot(in, s.normal) > 0.0) & (cosine > 0.0), cosine_hemisphere_pdf(cosine), 0.0);
    }
    // f |cos| and the pdf are both proportional to the cosine. Their ratio is the albedo.
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>& in) {
        const N pdf = density(s, in);
        return {pdf * s.albedo, pdf};
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        const Vector<N> in = Basis<N>(s.shading_normal).to_world(cosine_hemisphere(random.x, random.y));
        const N pdf = density(s, in);
        return {in, weight_where(pdf > 0.0, s.albedo), pdf};
    }
};

LIMN_LOBE_STAGES(Diffuse)

}  // namespace limn::lambertian::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(lambertian, .one_sided = true, .numbers = 2)

Lambertian::Lambertian(const Color& albedo) : albedo_(checked_albedo(albedo, "Lambertian")) {}

Lambertian::Lambertian(std::shared_ptr<const Texture> albedo)
    : albedo_(checked_albedo(std::move(albedo), "Lambertian")) {}

std::optional<ScatterSample> Lambertian::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Diffuse>(formulas::input_of(s, out, albedo_->value(s)), random);
}

ScatterValue Lambertian::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::Diffuse>(formulas::input_of(s, out, albedo_->value(s)), in);
}

MaterialRecord Lambertian::lower(RecordSink& sink) const {
    return {.kind = "lambertian", .lobe = &lambertian::kLobe, .albedo = lower_texture(sink, albedo_)};
}

}  // namespace limn
#endif
