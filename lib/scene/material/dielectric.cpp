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

// Reflects where the first number is below the reflectance, else refracts. Absorbed where an interpolated normal sends
// the direction to the wrong side of the geometric surface. The parameter is the index of the inside, behind the
// shape's outward normal, relative to the outside.
struct Interface {
    template <class N>
    static HWY_INLINE LobeValue<N> value(const LobeInput<N>&, const Vector<N>&) {
        return {{0.0, 0.0, 0.0}, 0.0};
    }
    template <class N>
    static HWY_INLINE LobeSample<N> sample(const LobeInput<N>& s, const Vector<N>& random) {
        const N eta = select(s.front_face, s.parameter, 1.0 / s.parameter);
        const Vector<N>& n = s.shading_normal;
        const N cos_i = clamp_cosine(dot(s.out, n)), cos_t = cos_transmitted(cos_i, eta);
        N reflectance = reflectance_schlick(cos_i, eta);
        if (any(s.exact_fresnel)) reflectance = select(s.exact_fresnel, reflectance_exact(cos_i, eta), reflectance);
        const Mask<N> reflects = random.x < reflectance;
        const Vector<N> along_surface = cos_i * n - s.out;  // length sin_i
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

namespace dielectric {

LIMN_LOBE(.one_sided = false, .numbers = 1)

}  // namespace dielectric

namespace formulas = dielectric::HWY_NAMESPACE;

Dielectric::Dielectric(double index, Fresnel fresnel) : index_(index), fresnel_(fresnel) {
    require(std::isfinite(index) && index > 0, "Dielectric: index must be positive and finite");
}

std::optional<ScatterSample> Dielectric::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return formulas::sample_one<formulas::Interface>(formulas::input_of(s, out, {1, 1, 1}, index_, fresnel_), random);
}

MaterialRecord Dielectric::lower(RecordSink&) const {
    MaterialRecord record;
    record.kind = "dielectric";
    record.lobe = &dielectric::kLobe;
    record.fresnel = fresnel_;
    record.parameter = index_;
    record.specular = true;
    return record;
}

}  // namespace limn
#endif
