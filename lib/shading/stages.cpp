#include "shading/stages.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/stages.cpp"
#include <hwy/foreach_target.h>

#include <bit>

#include "math/heuristic-inl.h"
#include "math/rows-inl.h"
#include "math/spawn-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::shade::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

// Of rays from lanes: how many, and which of them are usable.
HWY_INLINE Mask<Doubles> usable(const Vector<Doubles>& origin, const Vector<Doubles>& direction, Mask<Doubles> lanes,
                                RayCounts& counts) {
    const auto finite = [](const Vector<Doubles>& v) HWY_ATTR {
        return (abs(v.x) < kInfinity) & (abs(v.y) < kInfinity) & (abs(v.z) < kInfinity);
    };
    const Mask<Doubles> usable = lanes & finite(origin) & finite(direction) & (max_abs(direction) > 0.0);
    const auto all = static_cast<std::size_t>(std::popcount(bits(lanes)));
    counts.all += all;
    counts.unusable += all - static_cast<std::size_t>(std::popcount(bits(usable)));
    return usable;
}

HWY_INLINE Mask<Doubles> is_black(const Vector<Doubles>& color) {
    return (color.x == 0.0) & (color.y == 0.0) & (color.z == 0.0);
}

RayCounts add_shadow_rays(const Paths& paths, const bsdf::Vertices& v, const lights::LightSamples& s,
                          const Rows3& emission, const Row& odds, ShadowRays& shadows) {
    RayCounts counts;
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const Vector<Doubles> position = load3<Doubles>(v.position, i), light = load3<Doubles>(s.position, i);
        const Doubles pdf = load<Doubles>(s.pdf + i), odd = load<Doubles>(odds + i);
        const Doubles weight = power_heuristic<Doubles>(odd * pdf, load<Doubles>(v.value_pdf + i));
        const Vector<Doubles> arriving = load3<Doubles>(paths.throughput, i) *
                                         ((weight / pdf) * (load3<Doubles>(v.value, i) * load3<Doubles>(emission, i)));
        const Mask<Doubles> lit = first_lanes<Doubles>(v.count - i) & (pdf > 0.0) & (odd > 0.0) & !is_black(arriving);
        if (!any(lit)) continue;
        const Doubles end = load<Doubles>(s.end + i);
        const Mask<Doubles> distant = end == kInfinity;
        const Vector<Doubles> direction = load3<Doubles>(s.direction, i);
        const Vector<Doubles> from =
            offset_along(position, load3<Doubles>(v.position_error, i), load3<Doubles>(v.normal, i),
                         select(distant, direction, light - position));
        const Vector<Doubles> to =
            offset_along(light, load3<Doubles>(s.position_error, i), load3<Doubles>(s.normal, i), from - light);
        const Vector<Doubles> way = select(distant, direction, to - from);
        const Mask<Doubles> leaves = usable(from, way, lit, counts);
        const Compress<Doubles> kept(leaves);
        compress3(from, kept, shadows.origin, shadows.count);
        compress3(way, kept, shadows.direction, shadows.count);
        store(kept(end), shadows.end + shadows.count);
        compress3(arriving, kept, shadows.light, shadows.count);
        for (std::uint32_t rest = bits(leaves); rest != 0; rest &= rest - 1) {
            const std::size_t k = i + static_cast<std::size_t>(std::countr_zero(rest));
            shadows.path[shadows.count] = paths.path[k], shadows.time[shadows.count++] = paths.time[k];
        }
    }
    return counts;
}

bool scatter(const Roulette& roulette, const bsdf::Vertices& v, Paths& paths, Row& survival) {
    bool some_end = false;
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const Vector<Doubles> t = load3<Doubles>(paths.throughput, i) * load3<Doubles>(v.weight, i);
        store3(t, paths.throughput, i);
        const Doubles of_two = select(t.x > t.y, t.x, t.y), largest = select(of_two > t.z, of_two, t.z);
        const Doubles wanted = roulette.factor * largest;
        HWY_ALIGN double vertex[8];
        for (std::size_t k = 0; k < kLanes<Doubles>; ++k) vertex[k] = paths.vertex[i + k];
        const Mask<Doubles> early = load<Doubles>(vertex) < static_cast<double>(roulette.start);
        const Doubles lives = select(early, 1.0, select(wanted < roulette.largest, wanted, roulette.largest));
        const Doubles survives = select(is_black(t), 0.0, lives);
        some_end = some_end || any(first_lanes<Doubles>(v.count - i) & (survives < 1.0));
        store(survives, survival + i);
    }
    return some_end;
}

RayCounts add_segments(const Paths& paths, const bsdf::Vertices& v, bool one_sided, const Row& survival,
                       const Row& numbers, const Row& odds, Segments& next) {
    RayCounts counts;
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const Doubles survives = load<Doubles>(survival + i);
        const Mask<Doubles> goes_on =
            first_lanes<Doubles>(v.count - i) & ((survives == 1.0) | (load<Doubles>(numbers + i) < survives));
        if (!any(goes_on)) continue;
        const Vector<Doubles> position = load3<Doubles>(v.position, i), normal = load3<Doubles>(v.normal, i);
        const Vector<Doubles> direction = load3<Doubles>(v.direction, i);
        const Vector<Doubles> origin = offset_along(position, load3<Doubles>(v.position_error, i), normal, direction);
        const Mask<Doubles> leaves = usable(origin, direction, goes_on, counts);
        const Compress<Doubles> kept(leaves);
        const std::size_t at = next.count;
        compress3(origin, kept, next.origin, at), compress3(direction, kept, next.direction, at);
        compress3(position, kept, next.receiver, at);
        compress3(one_sided ? normal : 0.0 * normal, kept, next.receiver_normal, at);
        compress3(load3<Doubles>(paths.throughput, i) / survives, kept, next.throughput, at);
        store(kept(load<Doubles>(v.pdf + i)), next.scatter_pdf + at);
        store(kept(load<Doubles>(odds + i)), next.light_odds + at);
        for (std::uint32_t rest = bits(leaves); rest != 0; rest &= rest - 1) {
            const std::size_t k = i + static_cast<std::size_t>(std::countr_zero(rest));
            sampling::copy_row<sampling::PathRows>(next, next.count, paths, k);
            ++next.vertex[next.count++];
        }
    }
    return counts;
}

void weigh_emission(std::size_t count, const Row& scatter_pdf, const Row& light_pdf, Row& weight) {
    for (std::size_t i = 0; i < count; i += kLanes<Doubles>)
        store(power_heuristic(load<Doubles>(scatter_pdf + i), load<Doubles>(light_pdf + i)), weight + i);
}

}  // namespace limn::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::shade {

HWY_EXPORT(add_shadow_rays);
HWY_EXPORT(scatter);
HWY_EXPORT(add_segments);
HWY_EXPORT(weigh_emission);

RayCounts add_shadow_rays(const Paths& paths, const bsdf::Vertices& vertices, const lights::LightSamples& samples,
                          const Rows3& emission, const Row& odds, ShadowRays& shadows) {
    return HWY_DYNAMIC_DISPATCH(add_shadow_rays)(paths, vertices, samples, emission, odds, shadows);
}

bool scatter(const Roulette& roulette, const bsdf::Vertices& vertices, Paths& paths, Row& survival) {
    return HWY_DYNAMIC_DISPATCH(scatter)(roulette, vertices, paths, survival);
}

RayCounts add_segments(const Paths& paths, const bsdf::Vertices& vertices, bool one_sided, const Row& survival,
                       const Row& numbers, const Row& odds, Segments& next) {
    return HWY_DYNAMIC_DISPATCH(add_segments)(paths, vertices, one_sided, survival, numbers, odds, next);
}

void weigh_emission(std::size_t count, const Row& scatter_pdf, const Row& light_pdf, Row& weight) {
    HWY_DYNAMIC_DISPATCH(weigh_emission)(count, scatter_pdf, light_pdf, weight);
}

}  // namespace limn::shade
#endif
