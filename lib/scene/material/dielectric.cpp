#include "limn/scene/material/dielectric.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/material/dielectric.cpp"
#include <hwy/foreach_target.h>

#include <cmath>

#include "bsdf/fresnel-inl.h"
#include "bsdf/lobe-inl.h"
#include "math/require.h"

HWY_BEFORE_NAMESPACE();
namespace limn::dielectric::HWY_NAMESPACE {

using namespace bsdf::HWY_NAMESPACE;

template <class N>
using Input = LobeInput<N, Dielectric::Parameters>;

// Reflects if the first random number is below the reflectance, and refracts otherwise. Light is absorbed if an
// interpolated normal sends it to the wrong side of the geometric surface. Inside is behind the shape's outward normal.
struct Interface {
    template <class N>
    static HWY_INLINE LobeValue<N> value(const Input<N>&, const Vector<N>&) {
        return {{0.0, 0.0, 0.0}, 0.0};
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const Input<N>& s, const Vector<N>& random) {
        // Find the index on the far side over that on the incident side, and the reflectance.
        const N eta = select(s.front_face, s.parameters.index, 1.0 / s.parameters.index);
        const Vector<N>& n = s.shading_normal;
        const N cos_i = clamp_cosine(dot(s.out, n)), cos_t = cos_transmitted(cos_i, eta);
        const Mask<N> is_exact = s.parameters.exact_fresnel > 0.0;
        N reflectance = reflectance_schlick(cos_i, eta);
        if (any(is_exact)) reflectance = select(is_exact, reflectance_exact(cos_i, eta), reflectance);
        // Reflect or refract.
        const Mask<N> reflects = random.x < reflectance;
        const Vector<N> along_surface = cos_i * n - s.out;  // of length sin_i
        const Vector<N> in = normalize(select(reflects, mirror(s.out, n), along_surface / eta - cos_t * n));
        const Mask<N> below = dot(in, s.normal) < 0.0;
        return {in, weight_where<N>(reflects ^ below, s.albedo), 0.0};
    }
};

LIMN_LOBE_STAGES(Interface)

}  // namespace limn::dielectric::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

LIMN_LOBE(dielectric, .one_sided = false, .numbers = 1)

Dielectric::Dielectric(double index, Fresnel fresnel) : parameters_{index, fresnel == Fresnel::exact ? 1.0 : 0.0} {
    require(std::isfinite(index) && index > 0, "Dielectric: index must be positive and finite");
}

std::optional<ScatterSample> Dielectric::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Interface>(formulas::input_of(s, out, {1, 1, 1}, parameters_), random);
}

MaterialRecord Dielectric::lower(RecordSink&) const {
    return {.kind = "dielectric", .lobe = &dielectric::kLobe, .specular = true, .parameters = parameters_};
}

}  // namespace limn
#endif
