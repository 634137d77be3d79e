#include "shading/light_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/light_points.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <type_traits>

#include "shading/environment_light-inl.h"
#include "shading/light_lanes-inl.h"
#include "shading/planar_light-inl.h"
#include "shading/sphere_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

template <class Kind>
requires std::is_base_of_v<flat::LightAtPoint, Kind>
struct InLanes<Kind> {
    Vector<Doubles> position;

    HWY_INLINE explicit InLanes(const LightsOf<Kind>& of) : position(of(&Kind::position)) {}

    HWY_INLINE LightPoints sample(const Vector<Doubles>& from, Doubles, Doubles) const {
        const Vector<Doubles> way = position - from;
        LightPoints s;
        s.position = position;
        s.direction = normalize(way);
        s.pdf = length_squared(way) * (1 / flat::kNoSolidAngle);
        return s;
    }
};

template <>
struct InLanes<flat::DirectionalLight> {
    Vector<Doubles> towards;

    HWY_INLINE explicit InLanes(const LightsOf<flat::DirectionalLight>& of)
        : towards(of(&flat::DirectionalLight::towards)) {}

    HWY_INLINE LightPoints sample(const Vector<Doubles>&, Doubles, Doubles) const {
        LightPoints s;
        s.direction = towards;
        s.pdf = 1 / flat::kNoSolidAngle;
        s.end = kInfinity;
        return s;
    }
};

template <>
struct InLanes<flat::SunLight> {
    Vector<Doubles> towards;
    Doubles one_minus_cos;

    HWY_INLINE explicit InLanes(const LightsOf<flat::SunLight>& of)
        : towards(of(&flat::SunLight::towards)), one_minus_cos(of(&flat::SunLight::one_minus_cos)) {}

    HWY_INLINE LightPoints sample(const Vector<Doubles>&, Doubles u, Doubles v) const {
        LightPoints s;
        s.direction = Basis<Doubles>(towards).to_world(uniform_cone(u, v, one_minus_cos));
        s.pdf = uniform_cone_pdf(one_minus_cos);
        s.end = kInfinity;
        return s;
    }

    HWY_INLINE Doubles pdf(const Vector<Doubles>&, const Vector<Doubles>&) const {
        return uniform_cone_pdf(one_minus_cos);
    }
};

inline constexpr std::size_t kKinds = std::variant_size_v<flat::Light>;
template <std::size_t kind>
using Kind = std::variant_alternative_t<kind, flat::Light>;

// The lights of the lanes of a vector, sorted by their kinds.
struct SortedLights {
    const flat::Light* const* lights;
    std::uint32_t lanes[kKinds] = {};  // by kind, the lanes that have a light of this kind, as bits
    std::uint32_t all = 0;             // the lanes that have a light, as bits

    // \param count number of lights, which may be less than a vector has lanes
    HWY_INLINE SortedLights(const flat::Light* const* first, std::size_t count) : lights(first) {
        for (std::size_t i = 0; i < std::min(count, kLanes<Doubles>); ++i) {
            if (!lights[i]) continue;
            lanes[lights[i]->index()] |= std::uint32_t{1} << i;
            all |= std::uint32_t{1} << i;
        }
    }
};

// Samples the lights of one kind.
template <std::size_t kind>
HWY_INLINE void sample_kind(const SortedLights& sorted, const Vector<Doubles>& from, Doubles u, Doubles v,
                            LightPoints& points) {
    const std::uint32_t lanes = sorted.lanes[kind];
    if (lanes == 0) return;
    const LightsOf<Kind<kind>> lights(sorted.lights, lanes);
    const LightPoints sampled = InLanes<Kind<kind>>(lights).sample(from, u, v);
    points = lanes == sorted.all ? sampled : select(lights.lanes(), sampled, points);
}

template <std::size_t... kind>
HWY_INLINE LightPoints sample_kinds(std::index_sequence<kind...>, const SortedLights& sorted,
                                    const Vector<Doubles>& from, Doubles u, Doubles v) {
    LightPoints points;
    (sample_kind<kind>(sorted, from, u, v, points), ...);
    return points;
}

// Finds the pdfs for the lights of one kind.
template <std::size_t kind>
HWY_INLINE void find_kind_pdf(const SortedLights& sorted, const Vector<Doubles>& from, const Vector<Doubles>& position,
                              Doubles& pdf) {
    const std::uint32_t lanes = sorted.lanes[kind];
    if (lanes == 0) return;
    if constexpr (requires(InLanes<Kind<kind>> in_lanes) { in_lanes.pdf(from, position); }) {
        const LightsOf<Kind<kind>> lights(sorted.lights, lanes);
        pdf = select(lights.lanes(), InLanes<Kind<kind>>(lights).pdf(from, position), pdf);
    }
}

template <std::size_t... kind>
HWY_INLINE Doubles find_kinds_pdf(std::index_sequence<kind...>, const SortedLights& sorted, const Vector<Doubles>& from,
                                  const Vector<Doubles>& position) {
    Doubles pdf = 0.0;
    (find_kind_pdf<kind>(sorted, from, position, pdf), ...);
    return pdf;
}

void sample_points(const Receivers& receivers, LightSamples& samples) {
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const SortedLights sorted(samples.light + i, receivers.count - i);
        const Doubles u = load<Doubles>(samples.numbers[1] + i), v = load<Doubles>(samples.numbers[2] + i);
        const LightPoints points =
            sample_kinds(std::make_index_sequence<kKinds>(), sorted, load3<Doubles>(receivers.position, i), u, v);
        store3(points.position, samples.position, i);
        store3(points.position_error, samples.position_error, i);
        store3(points.normal, samples.normal, i);
        store3(points.direction, samples.direction, i);
        store(points.pdf, samples.pdf + i);
        store(points.u, samples.u + i);
        store(points.v, samples.v + i);
        store(points.end, samples.end + i);
    }
}

void find_point_pdf(const Receivers& receivers, const flat::Light* const* lights, const Rows3& position, Row& pdf) {
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const SortedLights sorted(lights + i, receivers.count - i);
        store(find_kinds_pdf(std::make_index_sequence<kKinds>(), sorted, load3<Doubles>(receivers.position, i),
                             load3<Doubles>(position, i)),
              pdf + i);
    }
}

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::lights {

HWY_EXPORT(sample_points);
HWY_EXPORT(find_point_pdf);

void sample_points(const Receivers& receivers, LightSamples& samples) {
    HWY_DYNAMIC_DISPATCH(sample_points)(receivers, samples);
}

void find_point_pdf(const Receivers& receivers, const flat::Light* const* lights, const Rows3& position, Row& pdf) {
    HWY_DYNAMIC_DISPATCH(find_point_pdf)(receivers, lights, position, pdf);
}

}  // namespace limn::lights
#endif
