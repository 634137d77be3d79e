// The lights in the lanes of a vector. Each kind of light has a specialisation of InLanes, which samples points on as
// many lights of this kind as a vector has lanes. The include guard is per target, as Highway requires.
#if defined(LIMN_SHADING_LIGHT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SHADING_LIGHT_LANES_INL_H
#undef LIMN_SHADING_LIGHT_LANES_INL_H
#else
#define LIMN_SHADING_LIGHT_LANES_INL_H
#endif

#include <bit>
#include <variant>

#include "flat/lights.h"
#include "math/rows-inl.h"
#include "math/spawn.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

// A specialisation has these members:
//
//     InLanes(const LightsOf<Kind>& lights)
//     LightPoints sample(from, u, v) const     maps points of the unit square to points on the lights, as they are
//                                              sampled for receivers at `from`
//     Doubles pdf(from, position) const        returns the pdf with which sample() draws the position, per solid angle
//                                              at `from`. The position of a distant light is a direction. Only kinds
//                                              that scattering can find have this member
template <class Kind>
struct InLanes;

// Points on lights, as in the rows of LightSamples.
struct LightPoints {
    Vector<Doubles> position{0.0, 0.0, 0.0}, position_error{0.0, 0.0, 0.0}, normal{0.0, 0.0, 0.0};
    Vector<Doubles> direction{0.0, 0.0, 0.0};
    Doubles pdf = 0.0, u = 0.0, v = 0.0, end = 1 - kShadowEnd;

    HWY_INLINE LightPoints() {}
};

// The lights of one kind. Lanes without a light of this kind repeat the light of another lane; what is computed for
// them is not used.
template <class Kind>
class LightsOf {
public:
    // \param lights one for each lane
    // \param lanes the lanes that have a light of this kind, as bits; at least one
    HWY_INLINE LightsOf(const flat::Light* const* lights, std::uint32_t lanes) {
        const flat::Light* const first = lights[std::countr_zero(lanes)];
        lights_[0] = std::get_if<Kind>(first);
        for (std::size_t i = 0; i < kLanes<Doubles>; ++i)
            is_single_ = is_single_ && ((lanes >> i & 1) == 0 || lights[i] == first);
        if (is_single_) return;
        for (std::size_t i = 0; i < kLanes<Doubles>; ++i)
            lights_[i] = std::get_if<Kind>((lanes >> i & 1) != 0 ? lights[i] : first);
    }

    HWY_INLINE const Kind& operator[](std::size_t lane) const { return *lights_[is_single_ ? 0 : lane]; }

    // Returns a field of each light. Points and vectors become a Vector<Doubles>, numbers and enumerators Doubles.
    template <class Field, class Base>
    HWY_INLINE auto operator()(Field Base::*field) const {
        if constexpr (requires(Field v) { v.z; }) {
            if (is_single_) return broadcast<Doubles>(lights_[0]->*field);
            HWY_ALIGN double x[kLanes<Doubles>], y[kLanes<Doubles>], z[kLanes<Doubles>];
            for (std::size_t i = 0; i < kLanes<Doubles>; ++i) {
                const Field& v = lights_[i]->*field;
                x[i] = v.x;
                y[i] = v.y;
                z[i] = v.z;
            }
            return Vector<Doubles>{load<Doubles>(x), load<Doubles>(y), load<Doubles>(z)};
        } else {
            if (is_single_) return Doubles(static_cast<double>(lights_[0]->*field));
            HWY_ALIGN double values[kLanes<Doubles>];
            for (std::size_t i = 0; i < kLanes<Doubles>; ++i) values[i] = static_cast<double>(lights_[i]->*field);
            return load<Doubles>(values);
        }
    }

private:
    const Kind* lights_[kLanes<Doubles>];
    bool is_single_ = true;  // true if all lanes have the same light, which is in lights_[0]
};

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
