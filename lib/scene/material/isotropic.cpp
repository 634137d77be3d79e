#include "limn/scene/material/isotropic.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/isotropic.cpp"
#include <hwy/foreach_target.h>

#include "bsdf/lobe-inl.h"
#include "scene/material/albedo.h"

HWY_BEFORE_NAMESPACE();
namespace limn::isotropic::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N>;

// The isotropic phase function, albedo / (4 pi). It has no cosine.
struct Phase {
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>&) {
        const N pdf = uniform_sphere_pdf<N>();
        return {pdf * s.albedo, pdf};
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        return {uniform_sphere(random.x, random.y), s.albedo, uniform_sphere_pdf<N>()};
    }
};

LIMN_LOBE_STAGES(Phase)

}  // namespace limn::isotropic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(isotropic, .one_sided = false, .numbers = 2)

Isotropic::Isotropic(const Color& albedo) : albedo_(checked_albedo(albedo, "Isotropic")) {}

Isotropic::Isotropic(std::shared_ptr<const Texture> albedo) : albedo_(checked_albedo(std::move(albedo), "Isotropic")) {}

std::optional<ScatterSample> Isotropic::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Phase>(formulas::input_of(s, out, albedo_->value(s)), random);
}

ScatterValue Isotropic::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::Phase>(formulas::input_of(s, out, albedo_->value(s)), in);
}

MaterialRecord Isotropic::lower(RecordSink& sink) const {
    return {.kind = "isotropic", .lobe = &isotropic::kLobe, .albedo = lower_texture(sink, albedo_)};
}

}  // namespace limn
#endif
