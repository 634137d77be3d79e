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

// The parameter is the coat's index, the second texture what its reflection is multiplied by.
template <class N>
struct Vertex : Facets<N> {
    using Facets<N>::s, Facets<N>::frame, Facets<N>::smooth, Facets<N>::surface;
    N coat;     // of the light seen, what a white surface's coat reflects
    N by_coat;  // how often the coat is sampled: by what each of the two lobes reflects

    HWY_INLINE explicit Vertex(const LobeInput<N>& input) : Facets<N>(input), coat(this->albedo(frame.out)) {
        const N shine = coat * mean_of(s.second_texture), below = (1.0 - coat) * mean_of(s.albedo);
        by_coat = shine / max(shine + below, 1e-300);
    }
    HWY_INLINE LobeValue<N> value(const Vector<N>& world) const {
        const Vector<N> in = frame.to_local(world), &out = frame.out;
        const Mask<N> above = (in.z > 0.0) & (dot(world, s.normal) > 0.0);
        const Vector<N> m = normalize(out + in);
        const N cosine_pdf = cosine_hemisphere_pdf(max(in.z, 0.0));
        // Both ways through the coat; what is reflected back from below it is scattered again.
        const N through = spread_evenly(1.0 - coat, 1.0 - this->albedo(in), this->mean_albedo(), cosine_pdf);
        const N shine =
            select(smooth, 0.0, reflectance_exact(dot(out, m), s.parameter) * surface.scattered_once(out, in, m));
        const N mirrored = select(smooth, 0.0, surface.mirrored_pdf(out, m));
        const N pdf = by_coat * mirrored + (1.0 - by_coat) * cosine_pdf;
        return {weight_where(above, shine * s.second_texture + through * s.albedo), select(above, pdf, 0.0)};
    }
};

struct Coated {
    template <class N>
    static HWY_INLINE LobeValue<N> value(const LobeInput<N>& s, const Vector<N>& in) {
        return Vertex<N>(s).value(in);
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const LobeInput<N>& s, const Vector<N>& random) {
        const Vertex<N> vertex(s);
        const Vector<N>& out = vertex.frame.out;
        const Mask<N> shines = random.z < vertex.by_coat, mirrors = shines & vertex.smooth;
        const Vector<N> mirrored = vertex.surface.mirrored(out, random.x, random.y);
        const Vector<N> spread = cosine_hemisphere(random.x, random.y), of_smooth = {-out.x, -out.y, out.z};
        const Vector<N> local = select(mirrors, of_smooth, select(shines, mirrored, spread));
        const Vector<N> in = normalize(vertex.frame.to_world(local));
        const LobeValue<N> f = vertex.value(in);
        const Mask<N> above = dot(in, s.normal) > 0.0;
        const Vector<N> once = (reflectance_exact(out.z, s.parameter) / vertex.by_coat) * s.second_texture;
        const Vector<N> weight = select(mirrors, once, weight_where(f.pdf > 0.0, f.value / f.pdf));
        return {in, weight_where(above, weight), select(mirrors, 0.0, f.pdf)};
    }
};

LIMN_LOBE_STAGES(Coated)

}  // namespace limn::plastic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

namespace plastic {

LIMN_LOBE(.one_sided = true, .numbers = 3)

}  // namespace plastic

namespace formulas = plastic::HWY_NAMESPACE;

namespace {

std::shared_ptr<const Texture> checked_specular(std::shared_ptr<const Texture> specular) {
    require(specular != nullptr, "Plastic: specular texture must not be null");
    return specular;
}

std::shared_ptr<const Texture> checked_specular(const Color& specular) {
    require(is_reflectance(specular), "Plastic: specular must be in [0, 1]");
    return std::make_shared<SolidColor>(specular);
}

std::shared_ptr<const MaterialDetails> details_of(const Roughness& roughness, double index) {
    require(std::isfinite(index) && index >= 1, "Plastic: index must be at least 1 and finite");
    const Alphas alpha = checked_alphas(roughness, "Plastic");
    MaterialDetails details;
    details.numbers = {0, 0, 0, alpha.x, alpha.y};
    details.tangents = alpha.x != alpha.y;
    details.albedo_table = albedo_table_of(alpha, index);
    return std::make_shared<const MaterialDetails>(details);
}

}  // namespace

Plastic::Plastic(const Color& albedo, const Roughness& roughness, double index, const Color& specular)
    : albedo_(checked_albedo(albedo, "Plastic")),
      specular_(checked_specular(specular)),
      index_(index),
      details_(details_of(roughness, index)) {}

Plastic::Plastic(std::shared_ptr<const Texture> albedo, const Roughness& roughness, double index, const Color& specular)
    : Plastic(std::move(albedo), roughness, index, checked_specular(specular)) {}

Plastic::Plastic(std::shared_ptr<const Texture> albedo, const Roughness& roughness, double index,
                 std::shared_ptr<const Texture> specular)
    : albedo_(checked_albedo(std::move(albedo), "Plastic")),
      specular_(checked_specular(std::move(specular))),
      index_(index),
      details_(details_of(roughness, index)) {}

std::optional<ScatterSample> Plastic::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Coated>(
        formulas::input_of(s, out, albedo_->value(s), index_, *details_, specular_->value(s)), random);
}

ScatterValue Plastic::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::Coated>(
        formulas::input_of(s, out, albedo_->value(s), index_, *details_, specular_->value(s)), in);
}

MaterialRecord Plastic::lower(RecordSink& sink) const {
    MaterialDetails details = *details_;
    details.texture = lower_texture(sink, specular_);
    MaterialRecord record;
    record.kind = "plastic";
    record.lobe = &plastic::kLobe;
    record.texture = lower_texture(sink, albedo_);
    record.parameter = index_;
    record.details = std::make_shared<const MaterialDetails>(details);
    return record;
}

}  // namespace limn
#endif
