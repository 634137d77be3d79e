#include "shade/lobes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/lobes.cpp"
#include <hwy/foreach_target.h>

#include <limits>

#include "core/spawn.h"
#include "shade/lights-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::shade::HWY_NAMESPACE {

// f |cos| over the albedo, which is the density too.
template <Lobe lobe>
HWY_INLINE Doubles value(const Vector<Doubles>& normal, const Vector<Doubles>& shading_normal,
                         const Vector<Doubles>& in) {
    if (lobe == Lobe::isotropic) return 1 / (4 * kPi);
    const Doubles cosine = dot(in, shading_normal);
    const Mask<Doubles> above = (dot(in, normal) > 0.0) & (cosine > 0.0);
    return select(above, cosine / kPi, Doubles(0.0));
}

// The next double towards the side that `by` goes to, as in core/spawn.h.
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

struct Scattered {
    Vector<Doubles> direction;
    Doubles pdf;
    Mask<Doubles> any;
};

template <Lobe lobe>
HWY_INLINE Scattered scatter_around(const VertexLanes& v, std::size_t i, const Vector<Doubles>& normal, Doubles a,
                                    Doubles b) {
    const Vector<Doubles> shading_normal = load3(v.shading_normal, i);
    const Vector<Doubles> in =
        lobe == Lobe::isotropic ? uniform_cone(a, b, 2.0) : to_world(shading_normal, cosine_hemisphere(a, b));
    const Doubles pdf = value<lobe>(normal, shading_normal, in);
    return {in, pdf, (pdf > 0.0)};
}

HWY_INLINE Doubles clamped_cosine(Doubles x) {
    const Doubles zero = 0.0, one = 1.0;
    return select(x < zero, zero, select(x > one, one, x));
}

// sample_dielectric (lib/bsdf), with the same names.
HWY_INLINE Scattered reflect_or_refract(const VertexLanes& v, std::size_t i, const Vector<Doubles>& normal,
                                        Doubles random) {
    const Doubles zero = 0.0, one = 1.0, two = 2.0;
    const Vector<Doubles> n = load3(v.shading_normal, i), out = load3(v.out, i);
    const Doubles eta = load<Doubles>(v.eta + i);
    const Mask<Doubles> no_interface = (eta == one), exact_fresnel = (load<Doubles>(v.exact_fresnel + i) > zero);
    const Doubles cos_i = clamped_cosine(dot(out, n));
    const Doubles squared_t = ((eta - one) * (eta + one) + cos_i * cos_i) / (eta * eta);
    const Doubles refracted = select(squared_t > zero, clamped_cosine(sqrt(squared_t)), zero);
    const Doubles cos_t = select(no_interface, cos_i, refracted);
    const Doubles root = (one - eta) / (one + eta), at_normal = root * root, m = one - cos_i;
    Doubles reflectance = at_normal + (one - at_normal) * (m * m * m * m * m);
    if (any(exact_fresnel)) {
        const Doubles perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        const Doubles parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        reflectance = select(exact_fresnel, (perpendicular * perpendicular + parallel * parallel) / two, reflectance);
    }
    reflectance = select(cos_t == zero, one, reflectance);
    reflectance = select(exact_fresnel & no_interface, zero, reflectance);
    const Mask<Doubles> reflects = random < reflectance;
    const Vector<Doubles> mirrored = (two * dot(out, n)) * n - out;
    const Vector<Doubles> along_surface = cos_i * n - out;
    const Vector<Doubles> in = normalize(select(reflects, mirrored, along_surface / eta - cos_t * n));
    const Mask<Doubles> below = dot(in, normal) < zero;
    return {in, zero, (reflects ^ below)};
}

template <Lobe lobe>
HWY_INLINE void scatter_by(VertexLanes& v) {
    v.scattered = 0;
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const Vector<Doubles> normal = load3(v.normal, i);
        const Doubles a = load<Doubles>(v.numbers[0] + i), b = load<Doubles>(v.numbers[1] + i);
        const Scattered s =
            lobe == Lobe::dielectric ? reflect_or_refract(v, i, normal, a) : scatter_around<lobe>(v, i, normal, a, b);
        v.scattered |= bits(s.any) << i;
        store(s.pdf, v.pdf + i);
        store3(s.direction, v.direction, i);
        store3(offset_along(load3(v.position, i), load3(v.position_error, i), normal, s.direction), v.origin, i);
    }
}

void scatter(Lobe lobe, VertexLanes& vertices) {
    switch (lobe) {
        case Lobe::lambertian: return scatter_by<Lobe::lambertian>(vertices);
        case Lobe::isotropic: return scatter_by<Lobe::isotropic>(vertices);
        case Lobe::dielectric: return scatter_by<Lobe::dielectric>(vertices);
    }
}

template <Lobe lobe>
HWY_INLINE void sample_lights_by(VertexLanes& v) {
    const Doubles zero = 0.0, one = 1.0;
    const std::size_t n = kLanes<Doubles>;
    static constexpr flat::Light kNone{};
    v.lit = v.open = 0;
    for (std::size_t i = 0; i < v.count; i += n) {
        const flat::Light* chosen[8];
        for (std::size_t j = 0; j < n; ++j) chosen[j] = i + j < v.count && v.light[i + j] ? v.light[i + j] : &kNone;
        const LightLanes light(chosen);
        const Doubles probability = load<Doubles>(v.probability + i);
        const Mask<Doubles> wanted = (probability > zero) & (first_lanes<Doubles>(v.count - i));
        const Vector<Doubles> position = load3(v.position, i), normal = load3(v.normal, i),
                              error = load3(v.position_error, i);
        const Doubles a = load<Doubles>(v.numbers[1] + i), b = load<Doubles>(v.numbers[2] + i);

        LightPoints s;
        const Mask<Doubles> planar = (!light.sphere) & wanted, round = light.sphere & wanted;
        if (!any(round)) {
            s = sample_planar(light, position, a, b, planar);
        } else {
            s = sample_sphere(light, position, a, b);
            if (any(planar)) {
                const LightPoints p = sample_planar(light, position, a, b, planar);
                s.position = select(planar, p.position, s.position), s.normal = select(planar, p.normal, s.normal);
                s.direction = select(planar, p.direction, s.direction), s.pdf = select(planar, p.pdf, s.pdf);
                s.drawn = select(planar, p.drawn, s.drawn);
                s.open = select(planar, p.open, s.open);
            }
        }

        const Doubles f = value<lobe>(normal, load3(v.shading_normal, i), s.direction);
        const Doubles pdf = s.pdf * probability;
        // The power heuristic, as in render/direct_light.h.
        const Doubles ratio = f / pdf, weight = select(pdf < kInfinity, one / (one + ratio * ratio), one);
        store3((weight / pdf) * ((f * load3(v.albedo, i)) * load3(v.emission, i)), v.arriving, i);
        const Vector<Doubles> from = offset_along(position, error, normal, s.position - position);
        const Vector<Doubles> to = offset_along(s.position, light.position_error, s.normal, from - s.position);
        store3(from, v.shadow_origin, i);
        store3(to - from, v.shadow_direction, i);
        const Mask<Doubles> lit = (wanted & s.drawn) & (f > zero);
        v.lit |= bits((!s.open) & lit) << i;
        v.open |= bits((s.open & wanted)) << i;
    }
}

void sample_lights(Lobe lobe, VertexLanes& vertices) {
    if (lobe == Lobe::lambertian) return sample_lights_by<Lobe::lambertian>(vertices);
    sample_lights_by<Lobe::isotropic>(vertices);
}

}  // namespace limn::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::shade {

HWY_EXPORT(scatter);
HWY_EXPORT(sample_lights);

void scatter(Lobe lobe, VertexLanes& vertices) { HWY_DYNAMIC_DISPATCH(scatter)(lobe, vertices); }

void sample_lights(Lobe lobe, VertexLanes& vertices) { HWY_DYNAMIC_DISPATCH(sample_lights)(lobe, vertices); }

}  // namespace limn::shade
#endif
