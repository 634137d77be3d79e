#include "shading/light_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/light_points.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <bit>
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

// Returns the first lanes of a vector as bits. \param count their number, which may be more than a vector has
HWY_INLINE std::uint32_t first_bits(std::size_t count) {
    return (std::uint32_t{1} << std::min(count, kLanes<Doubles>)) - 1;
}

// Returns which of `lanes` have a light of this kind, as bits.
HWY_INLINE std::uint32_t lanes_of_kind(const flat::Light* const* lights, std::uint32_t lanes, std::size_t kind) {
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < kLanes<Doubles>; ++i)
        if ((lanes >> i & 1) != 0 && lights[i]->index() == kind) found |= std::uint32_t{1} << i;
    return found;
}

// Calls visit() for a kind that is only known at run time.
template <class Visit, class... Kind>
HWY_INLINE void visit_kind(std::type_identity<std::variant<Kind...>>, std::size_t kind, const Visit& visit) {
    std::size_t k = 0;
    static_cast<void>(((kind == k++ && (visit(std::type_identity<Kind>()), true)) || ...));
}

// Calls visit(std::type_identity<Kind>(), lanes_of_kind) for each kind of light in `lanes`.
template <class Visit>
HWY_INLINE void for_each_kind(const flat::Light* const* lights, std::uint32_t lanes, const Visit& visit) {
    while (lanes != 0) {
        const std::size_t kind = lights[std::countr_zero(lanes)]->index();
        const std::uint32_t of_kind = lanes_of_kind(lights, lanes, kind);
        visit_kind(std::type_identity<flat::Light>(), kind, [&](auto k) HWY_ATTR { visit(k, of_kind); });
        lanes &= ~of_kind;
    }
}

// Calls visit(lanes, row) for each row of the results, from element i on.
template <class Visit>
HWY_INLINE void for_each_row(LightPoints& points, LightSamples& samples, std::size_t i, const Visit& visit) {
    const auto three = [&](Vector<Doubles>& v, Rows3& rows) HWY_ATTR {
        visit(v.x, rows.x + i);
        visit(v.y, rows.y + i);
        visit(v.z, rows.z + i);
    };
    three(points.position, samples.position);
    three(points.position_error, samples.position_error);
    three(points.normal, samples.normal);
    three(points.direction, samples.direction);
    visit(points.pdf, samples.pdf + i);
    visit(points.u, samples.u + i);
    visit(points.v, samples.v + i);
    visit(points.end, samples.end + i);
}

void sample_points(const Receivers& receivers, LightSamples& samples) {
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const flat::Light* const* const lights = samples.light + i;
        const Vector<Doubles> from = load3<Doubles>(receivers.position, i);
        const Doubles u = load<Doubles>(samples.numbers[1] + i), v = load<Doubles>(samples.numbers[2] + i);
        const std::uint32_t all = first_bits(receivers.count - i);
        for_each_kind(lights, all, [&]<class Kind>(std::type_identity<Kind>, std::uint32_t lanes) HWY_ATTR {
            LightPoints points = InLanes<Kind>(LightsOf<Kind>(lights, lanes)).sample(from, u, v);
            // Keep the lanes of other kinds.
            if (lanes != all) {
                const Mask<Doubles> kept = mask_of<Doubles>(lanes);
                for_each_row(points, samples, i,
                             [&](Doubles& x, const double* row) HWY_ATTR { x = select(kept, x, load<Doubles>(row)); });
            }
            for_each_row(points, samples, i, [](Doubles x, double* row) HWY_ATTR { store(x, row); });
        });
    }
}

void find_point_pdf(const Receivers& receivers, const flat::Light* const* lights, const Rows3& position, Row& pdf) {
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const Vector<Doubles> from = load3<Doubles>(receivers.position, i), at = load3<Doubles>(position, i);
        std::uint32_t all = 0;
        for (std::size_t k = 0; k < kLanes<Doubles> && i + k < receivers.count; ++k)
            all |= (lights[i + k] != nullptr ? std::uint32_t{1} : 0) << k;
        Doubles found = 0.0;
        for_each_kind(lights + i, all, [&]<class Kind>(std::type_identity<Kind>, std::uint32_t lanes) HWY_ATTR {
            const LightsOf<Kind> of_kind(lights + i, lanes);
            const InLanes<Kind> in_lanes(of_kind);
            if constexpr (requires { in_lanes.pdf(from, at); }) {
                // Lanes of other kinds get some direction, because the tables of an environment map are looked up by
                // it.
                const Mask<Doubles> kept = mask_of<Doubles>(lanes);
                const Vector<Doubles> place = select(kept, at, Vector<Doubles>{0.0, 1.0, 0.0});
                found = select(kept, in_lanes.pdf(from, place), found);
            }
        });
        store(found, pdf + i);
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
