#include "limn/scene/material/metal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/metal.cpp"
#include <hwy/foreach_target.h>

#include "bsdf/lobe-inl.h"
#include "scene/material/albedo.h"

HWY_BEFORE_NAMESPACE();
namespace limn::metal::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N, Metal::Parameters>;

// A mirror without a Fresnel term. The mirror direction is displaced by a point drawn uniformly in a ball. Light that
// is reflected below the geometric surface is absorbed.
struct Fuzzy {
    // True if the displacement is below half a unit in the last place of a unit vector. It then has no effect.
    template <class N>
    static HWY_INLINE Mask<N> is_mirror(const Input<N>& s) {
        return s.parameters.fuzz < kRoundoff;
    }
    // The pdf is that of the direction w of m + fuzz x, per solid angle. m is the unit mirror direction, and x is
    // uniform in the unit ball. The points m + fuzz x fill a ball around m with density 3 / (4 pi fuzz^3). Those with
    // the direction w are on the half-line s w, s > 0. It is inside the ball for s1 < s < s2, where |s w - m| = fuzz.
    // The solid angle dw contains the volume s^2 ds dw at s. Therefore
    //     pdf(w) = 3 / (4 pi fuzz^3) integral of s^2 ds = (s2^3 - s1^3) / (4 pi fuzz^3).
    // Let c = dot(w, m). If c <= 0, the half-line misses the ball. Otherwise the roots are c - h and c + h, where
    // h^2 = fuzz^2 - (1 - c^2). Both are >= 0, since fuzz <= 1, and s2^3 - s1^3 = 2 h (3 c^2 + h^2). The code computes
    // 1 - c^2 as |w x m|^2, in which nothing cancels.
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>& s, const Vector<N>& in) {
        const N fuzz = s.parameters.fuzz;
        const Vector<N> m = mirror(s.out, s.shading_normal);
        const N c = dot(in, m), height = dot(in, s.normal);
        const N h_squared = fuzz * fuzz - length_squared(cross(in, m));
        const Mask<N> mirrors = is_mirror(s), reached = (c > 0.0) & (h_squared > 0.0) & (height > 0.0) & !mirrors;
        const N pdf = sqrt(h_squared) * (3.0 * c * c + h_squared) / (2 * kPi * fuzz * fuzz * fuzz);
        const N drawn = select(reached, pdf, 0.0);
        return {drawn * s.albedo, drawn};
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        const Vector<N> m = mirror(s.out, s.shading_normal);
        const Vector<N> moved = normalize(m + s.parameters.fuzz * uniform_ball(random.x, random.y, random.z));
        const Vector<N> in = select(is_mirror(s), m, moved);
        const Mask<N> above = dot(in, s.normal) > 0.0;  // not NaN: fuzz 1 can reach the zero vector
        return {in, weight_where(above, s.albedo), value(s, in).pdf};
    }
};

LIMN_LOBE_STAGES(Fuzzy)

}  // namespace limn::metal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(metal, .one_sided = true, .numbers = 3)

Metal::Metal(const Color& albedo, double fuzz) : Metal(checked_albedo(albedo, "Metal"), fuzz) {}

Metal::Metal(std::shared_ptr<const Texture> albedo, double fuzz)
    : albedo_(checked_albedo(std::move(albedo), "Metal")), parameters_{checked_share(fuzz, "Metal: fuzz")} {}

std::optional<ScatterSample> Metal::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Fuzzy>(formulas::input_of(s, out, albedo_->value(s), parameters_), random);
}

ScatterValue Metal::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return formulas::value_one<formulas::Fuzzy>(formulas::input_of(s, out, albedo_->value(s), parameters_), in);
}

MaterialRecord Metal::lower(RecordSink& sink) const {
    return {.kind = "metal",
            .lobe = &metal::kLobe,
            .albedo = lower_texture(sink, albedo_),
            .specular = parameters_.fuzz == 0,
            .parameters = parameters_};
}

}  // namespace limn
#endif
