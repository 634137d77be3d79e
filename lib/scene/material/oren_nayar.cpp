#include "limn/scene/material/oren_nayar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/oren_nayar.cpp"
#include <hwy/foreach_target.h>

#include "bsdf/lobe-inl.h"
#include "math/require.h"
#include "scene/material/albedo.h"

HWY_BEFORE_NAMESPACE();
namespace limn::oren_nayar::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N, OrenNayar::Parameters>;

// The model of Portsmouth, Kutz and Hill, EON: A Practical Energy-Preserving Rough Diffuse BRDF, 2024. r is the
// roughness. Cosines are those with the shading normal. Fujii's form of Oren and Nayar's model has an albedo E below 1
// for facets that reflect all light. The lost light is scattered more than once and comes back (Kulla and Conty,
// Revisiting Physically Based Shading at Imageworks, 2017).
struct RoughDiffuse {
    static constexpr double kLoss = 0.5 - 2 / (3 * kPi), kMeanGain = 2.0 / 3 - 28 / (15 * kPi);

    // Returns E for this cosine, the albedo of single scattering by facets that reflect all light.
    // \param a 1 / (1 + kLoss r)
    template <class N>
    static HWY_INLINE N directional_albedo(N cosine, N a, N r) {
        const N sine = sqrt(max(1.0 - cosine * cosine, 0.0));
        // (1 - sine^3) / cosine, without the cancellation at grazing angles.
        const N rest = cosine * (1.0 + sine + sine * sine) / (1.0 + sine);
        const N g = sine * (angle_of<N>({sine, cosine}) - sine * cosine) + (2.0 / 3) * (sine * (rest - 1.0));
        return a + r * a * g / kPi;
    }
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>& in) {
        const N r = s.parameters.roughness, a = 1.0 / (1.0 + kLoss * r);
        const N cos_i = dot(in, s.shading_normal), cos_o = max(dot(s.out, s.shading_normal), 0.0);
        const Mask<N> above = (dot(in, s.normal) > 0.0) & (cos_i > 0.0);
        const N across = dot(in, s.out) - cos_i * cos_o;
        const N single = a * (1.0 + r * across / select(across > 0.0, max(cos_i, cos_o), 1.0));
        const N mean = a * (1.0 + kMeanGain * r);
        const N lost = (1.0 - directional_albedo(cos_o, a, r)) * (1.0 - directional_albedo(cos_i, a, r));
        // At r = 0 both are 0. The bound 1e-7 matters below r = 5e-7 alone, where the quotient is less than 0.4 r.
        const N multiple = lost / max(1.0 - mean, 1e-7);
        const auto of = [&](N rho) HWY_ATTR {
            return rho * single + rho * rho * mean / (1.0 - rho * (1.0 - mean)) * multiple;
        };
        const N pdf = select(above, cosine_hemisphere_pdf(cos_i), 0.0);
        const Vector<N> value = pdf * Vector<N>{of(s.albedo.x), of(s.albedo.y), of(s.albedo.z)};
        return {weight_where(above, value), pdf};  // below the surface the formulas may divide by 0
    }
    // Draws directions in proportion to the cosine.
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        const Vector<N> in = Basis<N>(s.shading_normal).to_world(cosine_hemisphere(random.x, random.y));
        const LobeValue<N> f = value(s, in);
        return {in, weight_where(f.pdf > 0.0, f.value / f.pdf), f.pdf};
    }
};

LIMN_LOBE_STAGES(RoughDiffuse)

}  // namespace limn::oren_nayar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(oren_nayar, .one_sided = true, .numbers = 2)

OrenNayar::OrenNayar(const Color& albedo, double roughness)
    : OrenNayar(checked_albedo(albedo, "OrenNayar"), roughness) {}

OrenNayar::OrenNayar(std::shared_ptr<const Texture> albedo, double roughness)
    : albedo_(checked_albedo(std::move(albedo), "OrenNayar")),
      parameters_{checked_share(roughness, "OrenNayar: roughness")} {}

std::optional<ScatterSample> OrenNayar::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::RoughDiffuse>(formulas::input_of(s, out, albedo_->value(s), parameters_),
                                                        random);
}

ScatterValue OrenNayar::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::RoughDiffuse>(formulas::input_of(s, out, albedo_->value(s), parameters_), in);
}

MaterialRecord OrenNayar::lower(RecordSink& sink) const {
    return {.kind = "oren-nayar",
            .lobe = &oren_nayar::kLobe,
            .albedo = lower_texture(sink, albedo_),
            .parameters = parameters_};
}

}  // namespace limn
#endif
