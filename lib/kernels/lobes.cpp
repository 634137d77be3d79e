#include "kernels/lobes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lobes.cpp"
#include <hwy/foreach_target.h>

#include <limits>

#include "core/spawn.h"
#include "kernels/lights-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

HWY_INLINE std::uint32_t bits_at(Where where, std::size_t i) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Doubles(), where, bytes);
    return std::uint32_t{bytes[0]} << i;
}

// f |cos| over the albedo, which is the density too.
template <Lobe lobe>
HWY_INLINE W value(const W3& normal, const W3& shading_normal, const W3& in) {
    if (lobe == Lobe::isotropic) return all(1 / (4 * kPi));
    const W cosine = dot(in, shading_normal);
    const Where above = hn::And(hn::Gt(dot(in, normal), all(0.0)), hn::Gt(cosine, all(0.0)));
    return hn::IfThenElseZero(above, cosine / all(kPi));
}

// The next double towards the side that `by` goes to, as in core/spawn.h.
HWY_INLINE W moved(W at, W by) {
    const hn::Rebind<std::int64_t, Doubles> whole;
    const W zero = all(0.0), sum = at + by;
    const Where up = hn::Gt(by, zero), down = hn::Lt(by, zero);
    const Where moves = hn::Or(hn::And(up, hn::Lt(sum, all(kInfinity))), hn::And(down, hn::Gt(sum, all(-kInfinity))));
    const Where longer = hn::Or(hn::And(up, hn::Gt(sum, zero)), hn::And(down, hn::Lt(sum, zero)));
    const auto step = hn::IfThenElse(hn::RebindMask(whole, longer), hn::Set(whole, 1), hn::Set(whole, -1));
    const W next = hn::BitCast(Doubles(), hn::BitCast(whole, sum) + step);
    const W from_zero = hn::CopySign(all(std::numeric_limits<double>::denorm_min()), by);
    return choose(moves, choose(hn::Eq(sum, zero), from_zero, next), sum);
}

HWY_INLINE W3 offset_along(const W3& position, const W3& error, const W3& normal, const W3& direction) {
    const W distance = dot(abs(normal), error);
    const W3 by = choose(hn::Lt(dot(normal, direction), all(0.0)), hn::Neg(distance), distance) * normal;
    return {moved(position.x, by.x), moved(position.y, by.y), moved(position.z, by.z)};
}

struct Scattered {
    W3 direction;
    W pdf;
    Where any;
};

template <Lobe lobe>
HWY_INLINE Scattered scatter_around(const VertexLanes& v, std::size_t i, const W3& normal, W a, W b) {
    const W3 shading_normal = LoadLane(v.shading_normal, i);
    const W3 in =
        lobe == Lobe::isotropic ? uniform_cone(a, b, all(2.0)) : to_world(shading_normal, cosine_hemisphere(a, b));
    const W pdf = value<lobe>(normal, shading_normal, in);
    return {in, pdf, hn::Gt(pdf, all(0.0))};
}

HWY_INLINE W clamped_cosine(W x) {
    const W zero = all(0.0), one = all(1.0);
    return choose(hn::Lt(x, zero), zero, choose(hn::Gt(x, one), one, x));
}

// sample_dielectric (lib/bsdf), with the same names.
HWY_INLINE Scattered reflect_or_refract(const VertexLanes& v, std::size_t i, const W3& normal, W random) {
    const W zero = all(0.0), one = all(1.0), two = all(2.0);
    const W3 n = LoadLane(v.shading_normal, i), out = LoadLane(v.out, i);
    const W eta = LoadLane(v.eta + i);
    const Where no_interface = hn::Eq(eta, one), exact_fresnel = hn::Gt(LoadLane(v.exact_fresnel + i), zero);
    const W cos_i = clamped_cosine(dot(out, n));
    const W squared_t = ((eta - one) * (eta + one) + cos_i * cos_i) / (eta * eta);
    const W refracted = choose(hn::Gt(squared_t, zero), clamped_cosine(hn::Sqrt(squared_t)), zero);
    const W cos_t = choose(no_interface, cos_i, refracted);
    const W root = (one - eta) / (one + eta), at_normal = root * root, m = one - cos_i;
    W reflectance = at_normal + (one - at_normal) * (m * m * m * m * m);
    if (any(exact_fresnel)) {
        const W perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        const W parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        reflectance = choose(exact_fresnel, (perpendicular * perpendicular + parallel * parallel) / two, reflectance);
    }
    reflectance = choose(hn::Eq(cos_t, zero), one, reflectance);
    reflectance = choose(hn::And(exact_fresnel, no_interface), zero, reflectance);
    const Where reflects = hn::Lt(random, reflectance);
    const W3 mirrored = (two * dot(out, n)) * n - out;
    const W3 along_surface = cos_i * n - out;
    const W3 in = normalize(choose(reflects, mirrored, along_surface / eta - cos_t * n));
    const Where below = hn::Lt(dot(in, normal), zero);
    return {in, zero, hn::Xor(reflects, below)};
}

template <Lobe lobe>
HWY_INLINE void scatter_by(VertexLanes& v) {
    v.scattered = 0;
    for (std::size_t i = 0; i < v.count; i += hn::Lanes(Doubles())) {
        const W3 normal = LoadLane(v.normal, i);
        const W a = LoadLane(v.numbers[0] + i), b = LoadLane(v.numbers[1] + i);
        const Scattered s =
            lobe == Lobe::dielectric ? reflect_or_refract(v, i, normal, a) : scatter_around<lobe>(v, i, normal, a, b);
        v.scattered |= bits_at(s.any, i);
        StoreLane(s.pdf, v.pdf + i);
        StoreLane(s.direction, v.direction, i);
        StoreLane(offset_along(LoadLane(v.position, i), LoadLane(v.position_error, i), normal, s.direction), v.origin,
                  i);
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
    const W zero = all(0.0), one = all(1.0);
    const std::size_t n = hn::Lanes(Doubles());
    static constexpr flat::Light kNone{};
    v.lit = v.open = 0;
    for (std::size_t i = 0; i < v.count; i += n) {
        const flat::Light* chosen[8];
        for (std::size_t j = 0; j < n; ++j) chosen[j] = i + j < v.count && v.light[i + j] ? v.light[i + j] : &kNone;
        const LightLanes light(chosen);
        const W probability = LoadLane(v.probability + i);
        const Where wanted = hn::And(hn::Gt(probability, zero), hn::FirstN(Doubles(), v.count - i));
        const W3 position = LoadLane(v.position, i), normal = LoadLane(v.normal, i),
                 error = LoadLane(v.position_error, i);
        const W a = LoadLane(v.numbers[1] + i), b = LoadLane(v.numbers[2] + i);

        LightPoints s;
        const Where planar = hn::AndNot(light.sphere, wanted), round = hn::And(light.sphere, wanted);
        if (!any(round)) {
            s = sample_planar(light, position, a, b, planar);
        } else {
            s = sample_sphere(light, position, a, b);
            if (any(planar)) {
                const LightPoints p = sample_planar(light, position, a, b, planar);
                s.position = choose(planar, p.position, s.position), s.normal = choose(planar, p.normal, s.normal);
                s.direction = choose(planar, p.direction, s.direction), s.pdf = choose(planar, p.pdf, s.pdf);
                s.drawn = hn::Or(hn::And(planar, p.drawn), hn::AndNot(planar, s.drawn));
                s.open = hn::Or(hn::And(planar, p.open), hn::AndNot(planar, s.open));
            }
        }

        const W f = value<lobe>(normal, LoadLane(v.shading_normal, i), s.direction);
        const W pdf = s.pdf * probability;
        // The power heuristic, as in render/direct_light.h.
        const W ratio = f / pdf, weight = choose(hn::Lt(pdf, all(kInfinity)), one / (one + ratio * ratio), one);
        StoreLane((f * LoadLane(v.albedo, i)) * LoadLane(v.emission, i) * W3{weight / pdf, weight / pdf, weight / pdf},
                  v.arriving, i);
        const W3 from = offset_along(position, error, normal, s.position - position);
        const W3 to = offset_along(s.position, light.position_error, s.normal, from - s.position);
        StoreLane(from, v.shadow_origin, i);
        StoreLane(to - from, v.shadow_direction, i);
        const Where lit = hn::And(hn::And(wanted, s.drawn), hn::Gt(f, zero));
        v.lit |= bits_at(hn::AndNot(s.open, lit), i);
        v.open |= bits_at(hn::And(s.open, wanted), i);
    }
}

void sample_lights(Lobe lobe, VertexLanes& vertices) {
    if (lobe == Lobe::lambertian) return sample_lights_by<Lobe::lambertian>(vertices);
    sample_lights_by<Lobe::isotropic>(vertices);
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::kernels {

HWY_EXPORT(scatter);
HWY_EXPORT(sample_lights);

void scatter(Lobe lobe, VertexLanes& vertices) { HWY_DYNAMIC_DISPATCH(scatter)(lobe, vertices); }

void sample_lights(Lobe lobe, VertexLanes& vertices) { HWY_DYNAMIC_DISPATCH(sample_lights)(lobe, vertices); }

}  // namespace limn::kernels
#endif
