#include "shade/leave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/leave.cpp"
#include <hwy/foreach_target.h>

#include <limits>

#include "sampling/heuristic-inl.h"
#include "sampling/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::shade::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

// The next double towards the side that `by` goes to.
HWY_INLINE Doubles moved(Doubles at, Doubles by) {
    const hn::Rebind<std::int64_t, Doubles::Tag> whole;
    const Doubles zero = 0.0, sum = at + by;
    const Mask<Doubles> up = (by > zero), down = (by < zero);
    const Mask<Doubles> moves = (up & (sum < kInfinity)) | (down & (sum > (-kInfinity)));
    const Mask<Doubles> longer = (up & (sum > zero)) | (down & (sum < zero));
    const auto step = hn::IfThenElse(hn::RebindMask(whole, longer.m), hn::Set(whole, 1), hn::Set(whole, -1));
    const Doubles next = hn::BitCast(Doubles::Tag(), hn::Add(hn::BitCast(whole, sum.v), step));
    const Doubles from_zero = copy_sign((std::numeric_limits<double>::denorm_min()), by);
    return select(moves, select(sum == zero, from_zero, next), sum);
}

HWY_INLINE Vector<Doubles> offset_along(const Vector<Doubles>& position, const Vector<Doubles>& error,
                                        const Vector<Doubles>& normal, const Vector<Doubles>& direction) {
    const Doubles distance = dot(abs(normal), error);
    const Vector<Doubles> by = select(dot(normal, direction) < 0.0, -distance, distance) * normal;
    return {moved(position.x, by.x), moved(position.y, by.y), moved(position.z, by.z)};
}

void find_origins(const bsdf::Vertices& v, Rows3& origin) {
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>)
        store3(offset_along(load3<Doubles>(v.position, i), load3<Doubles>(v.position_error, i),
                            load3<Doubles>(v.normal, i), load3<Doubles>(v.direction, i)),
               origin, i);
}

void weigh_light(const bsdf::Vertices& v, const lights::LightSamples& s, const Rows3& emission, const Row& odds,
                 ShadowRays& shadows) {
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const Vector<Doubles> position = load3<Doubles>(v.position, i), light = load3<Doubles>(s.position, i);
        const Doubles pdf = load<Doubles>(s.pdf + i);
        const Doubles weight = power_heuristic<Doubles>(load<Doubles>(odds + i) * pdf, load<Doubles>(v.value_pdf + i));
        const Vector<Doubles> arriving = (weight / pdf) * (load3<Doubles>(v.value, i) * load3<Doubles>(emission, i));
        store3(select(pdf > 0.0, arriving, {0.0, 0.0, 0.0}), shadows.light, i);
        const Vector<Doubles> from =
            offset_along(position, load3<Doubles>(v.position_error, i), load3<Doubles>(v.normal, i), light - position);
        const Vector<Doubles> to =
            offset_along(light, load3<Doubles>(s.position_error, i), load3<Doubles>(s.normal, i), from - light);
        store3(from, shadows.origin, i), store3(to - from, shadows.direction, i);
    }
}

void weigh_emission(std::size_t count, const Row& scatter_pdf, const Row& light_pdf, Row& weight) {
    for (std::size_t i = 0; i < count; i += kLanes<Doubles>)
        store(power_heuristic(load<Doubles>(scatter_pdf + i), load<Doubles>(light_pdf + i)), weight + i);
}

}  // namespace limn::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::shade {

HWY_EXPORT(find_origins);
HWY_EXPORT(weigh_light);
HWY_EXPORT(weigh_emission);

void find_origins(const bsdf::Vertices& vertices, Rows3& origin) {
    HWY_DYNAMIC_DISPATCH(find_origins)(vertices, origin);
}

void weigh_light(const bsdf::Vertices& vertices, const lights::LightSamples& samples, const Rows3& emission,
                 const Row& odds, ShadowRays& shadows) {
    HWY_DYNAMIC_DISPATCH(weigh_light)(vertices, samples, emission, odds, shadows);
}

void weigh_emission(std::size_t count, const Row& scatter_pdf, const Row& light_pdf, Row& weight) {
    HWY_DYNAMIC_DISPATCH(weigh_emission)(count, scatter_pdf, light_pdf, weight);
}

}  // namespace limn::shade
#endif
