#include "limn/scene/material/metallic_roughness.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/metallic_roughness.cpp"
#include <hwy/foreach_target.h>

#include <cmath>

#include "bsdf/rough-inl.h"
#include "scene/material/albedo.h"
#include "scene/material/alpha.h"

HWY_BEFORE_NAMESPACE();
namespace limn::metallic_roughness::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N, MetallicRoughness::Parameters>;

// The albedos of facets that reflect all light, and of the coat. The rows of both tables are roughnesses.
template <class N>
struct Albedos {
    N facets, coat;
};

constexpr double kLeastRoughness = 1e-3;  // its square is kLeastAlpha

// A metal, mixed with a diffuse base below a coat. The green and the blue of Input::factors are the factors of
// roughness and metallic.
template <class N>
struct Vertex {
    const Input<N>& s;
    N roughness, metallic;
    Microsurface<N> surface;
    ShadingFrame<N> frame;
    Albedos<N> seen;  // the albedos for `out`
    N by_facets;      // the probability of sampling facets, not the cosine: about their share of the light

    static HWY_INLINE N share(N x) { return min(max(x, 0.0), 1.0); }

    HWY_INLINE explicit Vertex(const Input<N>& input)
        : s(input),
          roughness(max(share(s.parameters.roughness * s.factors.y), kLeastRoughness)),
          metallic(share(s.parameters.metallic * s.factors.z)),
          surface{roughness * roughness, roughness * roughness},
          frame(input),
          seen(albedos(frame.out)) {
        const N base = mean_of(s.albedo), matte = 1.0 - metallic;
        const N once = metallic * schlick(base, frame.out.z) * seen.facets + matte * seen.coat;
        const N rest = metallic * base * (1.0 - seen.facets) + matte * base * (1.0 - seen.coat);
        by_facets = once / max(once + rest, 1e-300);  // 0, not 0 / 0, if the surface reflects nothing
    }
    HWY_INLINE Albedos<N> albedos(const Vector<N>& w) const {
        const N cosine = share(w.z);
        return {albedo_at(s.albedo_table, roughness, cosine), albedo_at(s.coat_albedo_table, roughness, cosine)};
    }
    HWY_INLINE LobeValue<N> value(const Vector<N>& world) const {
        // Find what does not depend on the colour: light that the metal scatters once and more than once, light that
        // the coat reflects, and light that leaves a white base through the coat.
        const Vector<N> in = frame.to_local(world), &out = frame.out;
        const Mask<N> above = (in.z > 0.0) & (dot(world, s.normal) > 0.0);
        const Vector<N> m = normalize(out + in);
        const N cosine = clamp_cosine(dot(out, m)), matte = 1.0 - metallic;
        const N cosine_pdf = cosine_hemisphere_pdf(max(in.z, 0.0));
        const Albedos<N> lit = albedos(in);
        const N mean = mean_albedo(s.albedo_table, roughness), coat_mean = mean_albedo(s.coat_albedo_table, roughness);
        const N once = surface.scattered_once(out, in, m);
        const N often = metallic * spread_evenly(1.0 - seen.facets, 1.0 - lit.facets, mean, cosine_pdf);
        const N coat = matte * reflectance_exact(cosine, s.parameters.index) * once;
        const N below = matte * spread_evenly(1.0 - seen.coat, 1.0 - lit.coat, coat_mean, cosine_pdf);
        // Mix them for each component of the base colour.
        const auto of = [&](N base) HWY_ATTR {
            const N metal = schlick(base, cosine) * once * metallic + reflected_often(mean_schlick(base), mean) * often;
            return metal + coat + below * base;
        };
        const N pdf = by_facets * surface.mirrored_pdf(out, m) + (1.0 - by_facets) * cosine_pdf;
        const Vector<N> mixed = {of(s.albedo.x), of(s.albedo.y), of(s.albedo.z)};
        return {weight_where(above, mixed), select(above, pdf, 0.0)};
    }
};

struct Mixture {
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>& in) {
        return Vertex<N>(s).value(in);
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        const Vertex<N> vertex(s);
        const Vector<N> mirrored = vertex.surface.mirrored(vertex.frame.out, random.x, random.y);
        const Vector<N> local = select(random.z < vertex.by_facets, mirrored, cosine_hemisphere(random.x, random.y));
        const Vector<N> in = normalize(vertex.frame.to_world(local));
        const LobeValue<N> f = vertex.value(in);
        return {in, weight_where(f.pdf > 0.0, f.value / f.pdf), f.pdf};
    }
};

LIMN_LOBE_STAGES(Mixture)

}  // namespace limn::metallic_roughness::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(metallic_roughness, .one_sided = true, .numbers = 3, .microfacets = true)

namespace {

MetallicRoughness::Parameters<double> checked_parameters(double index, double metallic, double roughness) {
    require(std::isfinite(index) && index >= 1, "MetallicRoughness: index must be at least 1 and finite");
    return {index, checked_share(metallic, "MetallicRoughness: metallic"),
            checked_share(roughness, "MetallicRoughness: roughness")};
}

Color texel(const Texture* metallic_roughness, const Surface& s) {
    return metallic_roughness ? metallic_roughness->value(s) : Color{1, 1, 1};
}

}  // namespace

MetallicRoughness::MetallicRoughness(const Color& base_color, double metallic, double roughness, double index)
    : MetallicRoughness(checked_albedo(base_color, "MetallicRoughness"), metallic, roughness, index) {}

MetallicRoughness::MetallicRoughness(std::shared_ptr<const Texture> base_color, double metallic, double roughness,
                                     double index)
    : base_color_(checked_albedo(std::move(base_color), "MetallicRoughness")),
      parameters_(checked_parameters(index, metallic, roughness)),
      albedo_table_(albedo_table_by_roughness(0)),
      coat_albedo_table_(albedo_table_by_roughness(index)) {}

MetallicRoughness::MetallicRoughness(std::shared_ptr<const Texture> base_color,
                                     std::shared_ptr<const Texture> metallic_roughness, double metallic,
                                     double roughness, double index)
    : MetallicRoughness(std::move(base_color), metallic, roughness, index) {
    require(metallic_roughness != nullptr, "MetallicRoughness: metallic-roughness texture must not be null");
    metallic_roughness_ = std::move(metallic_roughness);
}

std::optional<ScatterSample> MetallicRoughness::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Mixture>(
        formulas::input_of(s, out, base_color_->value(s), parameters_, albedo_table_.get(),
                           texel(metallic_roughness_.get(), s), coat_albedo_table_.get()),
        random);
}

ScatterValue MetallicRoughness::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::Mixture>(
        formulas::input_of(s, out, base_color_->value(s), parameters_, albedo_table_.get(),
                           texel(metallic_roughness_.get(), s), coat_albedo_table_.get()),
        in);
}

MaterialRecord MetallicRoughness::lower(RecordSink& sink) const {
    return {.kind = "metallic-roughness",
            .lobe = &metallic_roughness::kLobe,
            .albedo = lower_texture(sink, base_color_),
            .factors = lower_texture(sink, metallic_roughness_),
            .parameters = parameters_,
            .albedo_table = albedo_table_,
            .coat_albedo_table = coat_albedo_table_};
}

}  // namespace limn
#endif
