#include "limn/scene/material/plastic.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/plastic.cpp"
#include <hwy/foreach_target.h>

#include <cmath>

#include "bsdf/rough-inl.h"
#include "scene/material/albedo.h"
#include "scene/material/alpha.h"

HWY_BEFORE_NAMESPACE();
namespace limn::plastic::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N, Plastic::Parameters>;

// The coat reflects, and the base below it scatters diffusely. Input::factors is the factor of the coat's reflection.
template <class N>
struct Vertex : Facets<Input<N>> {
    using Base = Facets<Input<N>>;
    using Base::s, Base::frame, Base::smooth, Base::surface;
    N coat;     // the share of the light that the coat of a white surface reflects towards the viewer
    N by_coat;  // the probability of sampling the coat: its share of the light that both of them scatter

    HWY_INLINE explicit Vertex(const Input<N>& input) : Base(input), coat(this->albedo(frame.out)) {
        const N shine = coat * mean_of(s.factors), below = (1.0 - coat) * mean_of(s.albedo);
        by_coat = shine / max(shine + below, 1e-300);  // 0, not 0 / 0, if the surface reflects nothing
    }
    HWY_INLINE LobeValue<N> value(const Vector<N>& world) const {
        const Vector<N> in = frame.to_local(world), &out = frame.out;
        const Mask<N> above = (in.z > 0.0) & (dot(world, s.normal) > 0.0);
        const Vector<N> m = normalize(out + in);
        const N cosine_pdf = cosine_hemisphere_pdf(max(in.z, 0.0));
        // Light enters and leaves through the coat. What the coat reflects back down, the base scatters again.
        const N through = spread_evenly(1.0 - coat, 1.0 - this->albedo(in), this->mean_albedo(), cosine_pdf);
        const N shine = select(smooth, 0.0,
                               reflectance_exact(dot(out, m), s.parameters.index) * surface.scattered_once(out, in, m));
        const N mirrored_pdf = select(smooth, 0.0, surface.mirrored_pdf(out, m));
        const N pdf = by_coat * mirrored_pdf + (1.0 - by_coat) * cosine_pdf;
        return {weight_where(above, shine * s.factors + through * s.albedo), select(above, pdf, 0.0)};
    }
};

struct Coated {
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>& in) {
        return Vertex<N>(s).value(in);
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        const Vertex<N> vertex(s);
        const Vector<N>& out = vertex.frame.out;
        // Sample the coat, which mirrors if it is smooth, or the base.
        const Mask<N> by_coat = random.z < vertex.by_coat, mirrors = by_coat & vertex.smooth;
        const Vector<N> mirrored = vertex.surface.mirrored(out, random.x, random.y);
        const Vector<N> spread = cosine_hemisphere(random.x, random.y), of_smooth = {-out.x, -out.y, out.z};
        const Vector<N> local = select(mirrors, of_smooth, select(by_coat, mirrored, spread));
        const Vector<N> in = normalize(vertex.frame.to_world(local));
        // Weigh the direction.
        const LobeValue<N> f = vertex.value(in);
        const Mask<N> above = dot(in, s.normal) > 0.0;
        const Vector<N> once = (reflectance_exact(out.z, s.parameters.index) / vertex.by_coat) * s.factors;
        const Vector<N> weight = select(mirrors, once, weight_where(f.pdf > 0.0, f.value / f.pdf));
        return {in, weight_where(above, weight), select(mirrors, 0.0, f.pdf)};
    }
};

LIMN_LOBE_STAGES(Coated)

}  // namespace limn::plastic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(plastic, .one_sided = true, .numbers = 3, .microfacets = true)

namespace {

std::shared_ptr<const Texture> checked_specular(std::shared_ptr<const Texture> specular) {
    require(specular != nullptr, "Plastic: specular texture must not be null");
    return specular;
}

std::shared_ptr<const Texture> checked_specular(const Color& specular) {
    require(is_reflectance(specular), "Plastic: specular must be in [0, 1]");
    return std::make_shared<SolidColor>(specular);
}

Plastic::Parameters<double> checked_parameters(double index, const Roughness& roughness) {
    require(std::isfinite(index) && index >= 1, "Plastic: index must be at least 1 and finite");
    const Alphas alpha = checked_alphas(roughness, "Plastic");
    return {index, alpha.x, alpha.y};
}

}  // namespace

Plastic::Plastic(const Color& albedo, const Roughness& roughness, double index, const Color& specular)
    : Plastic(checked_albedo(albedo, "Plastic"), roughness, index, checked_specular(specular)) {}

Plastic::Plastic(std::shared_ptr<const Texture> albedo, const Roughness& roughness, double index, const Color& specular)
    : Plastic(std::move(albedo), roughness, index, checked_specular(specular)) {}

Plastic::Plastic(std::shared_ptr<const Texture> albedo, const Roughness& roughness, double index,
                 std::shared_ptr<const Texture> specular)
    : albedo_(checked_albedo(std::move(albedo), "Plastic")),
      specular_(checked_specular(std::move(specular))),
      parameters_(checked_parameters(index, roughness)),
      albedo_table_(albedo_table_of(parameters_.alpha_x, parameters_.alpha_y, index)) {}

std::optional<ScatterSample> Plastic::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Coated>(
        formulas::input_of(s, out, albedo_->value(s), parameters_, albedo_table_.get(), specular_->value(s)), random);
}

ScatterValue Plastic::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::Coated>(
        formulas::input_of(s, out, albedo_->value(s), parameters_, albedo_table_.get(), specular_->value(s)), in);
}

MaterialRecord Plastic::lower(RecordSink& sink) const {
    return {.kind = "plastic",
            .lobe = &plastic::kLobe,
            .albedo = lower_texture(sink, albedo_),
            .factors = lower_texture(sink, specular_),
            .uses_tangents = parameters_.alpha_x != parameters_.alpha_y,
            .parameters = parameters_,
            .albedo_table = albedo_table_};
}

}  // namespace limn
#endif
