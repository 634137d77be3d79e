#include "limn/scene/material/rough_conductor.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/rough_conductor.cpp"
#include <hwy/foreach_target.h>

#include <cmath>

#include "bsdf/rough-inl.h"
#include "scene/material/albedo.h"
#include "scene/material/alpha.h"

HWY_BEFORE_NAMESPACE();
namespace limn::rough_conductor::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N, RoughConductor::Parameters>;

template <class N>
struct Vertex : Facets<Input<N>> {
    using Base = Facets<Input<N>>;
    using Base::s, Base::frame, Base::smooth, Base::surface;
    N lost;  // the share of the light that white facets don't scatter once

    HWY_INLINE explicit Vertex(const Input<N>& input) : Base(input), lost(1.0 - this->albedo(frame.out)) {}

    // Return one component, or all, of the light that facets of this reflectance and tint scatter. `once` is the light
    // that white facets scatter once, `often` the light that they scatter more than once.
    HWY_INLINE N reflected(N reflectance, N tint, N cosine, N once, N often, N mean_albedo) const {
        const ConductorIndex<N> index(min(reflectance, 1 - 0x1p-53), tint);
        const N mean = mean_over_cosines<N>([&](N c) HWY_ATTR { return reflectance_conductor(c, index); });
        const Mask<N> all = reflectance >= 1.0;
        return select(all, 1.0, reflectance_conductor(cosine, index)) * once +
               select(all, 1.0, reflected_often(mean, mean_albedo)) * often;
    }
    HWY_INLINE Vector<N> reflected(N cosine, N once, N often, N mean_albedo) const {
        const auto& [tint_r, tint_g, tint_b, alpha_x, alpha_y] = s.parameters;
        return {reflected(s.albedo.x, tint_r, cosine, once, often, mean_albedo),
                reflected(s.albedo.y, tint_g, cosine, once, often, mean_albedo),
                reflected(s.albedo.z, tint_b, cosine, once, often, mean_albedo)};
    }
    HWY_INLINE LobeValue<N> value(const Vector<N>& world) const {
        const Vector<N> in = frame.to_local(world), &out = frame.out;
        const Mask<N> above = (in.z > 0.0) & (dot(world, s.normal) > 0.0) & !smooth;
        const Vector<N> m = normalize(out + in);
        const N once = surface.scattered_once(out, in, m);
        const N mean = this->mean_albedo(), cosine_pdf = cosine_hemisphere_pdf(max(in.z, 0.0));
        const N often = spread_evenly(lost, 1.0 - this->albedo(in), mean, cosine_pdf);
        const N pdf = (1.0 - lost) * surface.mirrored_pdf(out, m) + lost * cosine_pdf;
        const Vector<N> value = reflected(clamp_cosine(dot(out, m)), once, often, mean);
        return {weight_where(above, value), select(above, pdf, 0.0)};
    }
};

struct Conductor {
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>& in) {
        return Vertex<N>(s).value(in);
    }
    // Samples the visible normals, or the cosine. The probability of sampling the cosine is the share of the light that
    // is scattered more than once.
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        const Vertex<N> facets(s);
        const Vector<N> mirrored = facets.surface.mirrored(facets.frame.out, random.x, random.y);
        const Vector<N> spread = cosine_hemisphere(random.x, random.y);
        const Vector<N> local = select(random.z < facets.lost, spread, mirrored), &out = facets.frame.out;
        const Vector<N> of_smooth = {-out.x, -out.y, out.z};
        const Vector<N> in = normalize(facets.frame.to_world(select(facets.smooth, of_smooth, local)));
        const LobeValue<N> f = facets.value(in);
        const Mask<N> above = dot(in, s.normal) > 0.0;
        const Vector<N> once = facets.reflected(out.z, 1.0, 0.0, 1.0);
        const Vector<N> weight = select(facets.smooth, once, weight_where(f.pdf > 0.0, f.value / f.pdf));
        return {in, weight_where(above, weight), f.pdf};
    }
};

LIMN_LOBE_STAGES(Conductor)

}  // namespace limn::rough_conductor::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(rough_conductor, .one_sided = true, .numbers = 3, .microfacets = true)

namespace {

RoughConductor::Parameters<double> parameters_of(const Color& edge_tint, const Roughness& roughness) {
    const Alphas alpha = checked_alphas(roughness, "RoughConductor");
    return {edge_tint.r, edge_tint.g, edge_tint.b, alpha.x, alpha.y};
}

Color checked_tint(const Color& edge_tint) {
    require(is_reflectance(edge_tint), "RoughConductor: edge tint must be in [0, 1]");
    return edge_tint;
}

// A reflectance at normal incidence and an edge tint.
struct Tinted {
    double reflectance, edge_tint;
};

// Returns the reflectance and the tint from which ConductorIndex computes eta and k.
Tinted tinted(double eta, double k) {
    const double below = (eta - 1) * (eta - 1) + k * k, above = (eta + 1) * (eta + 1) + k * k;
    const double reflectance = below / above, root = std::sqrt(reflectance);
    const double rest = 4 * eta / above;  // 1 - reflectance, without cancellation
    const double most = (1 + root) * (1 + root) / rest, least = rest / (1 + reflectance);
    return {reflectance, most > least ? (most - eta) / (most - least) : 0};
}

struct TintedColor {
    Color reflectance, edge_tint;
};

TintedColor tinted(const ComplexIndex& index) {
    require(is_radiance(index.eta) && index.eta.r > 0 && index.eta.g > 0 && index.eta.b > 0 && is_radiance(index.k),
            "RoughConductor: eta must be positive and finite, k finite and at least 0");
    const Tinted r = tinted(index.eta.r, index.k.r), g = tinted(index.eta.g, index.k.g),
                 b = tinted(index.eta.b, index.k.b);
    return {{r.reflectance, g.reflectance, b.reflectance}, {r.edge_tint, g.edge_tint, b.edge_tint}};
}

}  // namespace

RoughConductor::RoughConductor(const Color& reflectance, const Roughness& roughness, const Color& edge_tint)
    : RoughConductor(checked_albedo(reflectance, "RoughConductor"), roughness, edge_tint) {}

RoughConductor::RoughConductor(std::shared_ptr<const Texture> reflectance, const Roughness& roughness,
                               const Color& edge_tint)
    : reflectance_(checked_albedo(std::move(reflectance), "RoughConductor")),
      parameters_(parameters_of(checked_tint(edge_tint), roughness)),
      albedo_table_(albedo_table_of(parameters_.alpha_x, parameters_.alpha_y, 0)) {}

RoughConductor::RoughConductor(const ComplexIndex& index, const Roughness& roughness)
    : reflectance_(checked_albedo(tinted(index).reflectance, "RoughConductor")),
      parameters_(parameters_of(tinted(index).edge_tint, roughness)),
      albedo_table_(albedo_table_of(parameters_.alpha_x, parameters_.alpha_y, 0)) {}

std::optional<ScatterSample> RoughConductor::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Conductor>(
        formulas::input_of(s, out, reflectance_->value(s), parameters_, albedo_table_.get()), random);
}

ScatterValue RoughConductor::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::Conductor>(
        formulas::input_of(s, out, reflectance_->value(s), parameters_, albedo_table_.get()), in);
}

MaterialRecord RoughConductor::lower(RecordSink& sink) const {
    return {.kind = "rough-conductor",
            .lobe = &rough_conductor::kLobe,
            .albedo = lower_texture(sink, reflectance_),
            .specular = parameters_.alpha_x == 0,
            .uses_tangents = parameters_.alpha_x != parameters_.alpha_y,
            .parameters = parameters_,
            .albedo_table = albedo_table_};
}

}  // namespace limn
#endif
