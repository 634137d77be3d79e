// Primitives of a leaf against rays in float: several with one ray. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_LEAF_INL_H
#undef LIMN_TRACE_LEAF_INL_H
#else
#define LIMN_TRACE_LEAF_INL_H
#endif

#include <bit>

#include "geometry/coordinate.h"
#include "geometry/planar_float-inl.h"
#include "geometry/sphere_float-inl.h"
#include "trace/box_ray.h"
#include "trace/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

using Floats = Wide<Lanes>;

// What the origin and packed coordinates, which are off by coordinate_error, may add to the error of a difference,
// twice: for 2^-46 of the origin is what two floats leave out. Infinite, so that the float forms decide nothing, where
// products may overflow or underflow.
HWY_INLINE float absolute_error(const BoxRay& ray, float coordinate_error) {
    const bool is_in_range = ray.extent > 0x1p-30f && ray.extent < 0x1p50f && ray.origin_error < 0x1p50f;
    const float error = 4 * (ray.origin_error + coordinate_error) + 0x1p-44f * ray.reach + 0x1p-45f;
    return is_in_range ? error : std::numeric_limits<float>::infinity();
}

// Without branches, which could not be predicted: magnitudes compare as their bits do.
HWY_INLINE unsigned longest_axis(const float* v) {
    const auto magnitude = [&](std::size_t a) { return std::bit_cast<std::uint32_t>(v[a]) << 1; };
    const unsigned is_y = magnitude(1) > magnitude(0), over_x = magnitude(2) > magnitude(0),
                   over_y = magnitude(2) > magnitude(1);
    const unsigned is_z = over_x & over_y;
    return is_z * 2 + (is_y & ~is_z);
}

// A ray as triangles and quads see it: BoxRay's t, but space as it is.
struct PlanarRay {
    unsigned axes[3];  // permuted
    bool leaves;       // t_min is not negative: nothing behind the origin counts
    PlanarFloatRay<float> numbers;

    // `vertex_error`: how far packed coordinates are from those that they stand for.
    HWY_INLINE PlanarRay(const BoxRay& ray, float vertex_error) {
        const unsigned z = longest_axis(ray.direction);
        axes[0] = 9u >> (2 * z) & 3;   // 1 2 0
        axes[1] = 18u >> (2 * z) & 3;  // 2 0 1
        axes[2] = z;
        leaves = ray.t_min >= 0 && ray.t_start == 0;
        const auto permuted = [&](const float* v) HWY_ATTR {
            return Vector<float>{v[axes[0]], v[axes[1]], v[axes[2]]};
        };
        const float inverse = ray.inverse[z], direction_error = 4 * ray.direction_error;
        const float relative = 16 * 0x1p-24f + 1.01f * direction_error, absolute = absolute_error(ray, vertex_error);
        const float farthest = relative * 2 * ray.reach + absolute, slope = 4.001f * farthest;
        numbers = {.high = permuted(ray.high),
                   .low = permuted(ray.low),
                   .shear_x = ray.direction[axes[0]] * inverse,
                   .shear_y = ray.direction[axes[1]] * inverse,
                   .relative = relative,
                   .absolute = absolute,
                   .direction_error = direction_error,
                   .t_from_z = ray.scale * inverse,
                   .coarse_slope = slope,
                   .coarse = slope * farthest};
    }
};

// A ray as spheres see it.
HWY_INLINE SphereFloatRay<float> sphere_ray(const BoxRay& ray, float center_error) {
    const float* const d = ray.direction;
    const float x = std::abs(ray.inverse[0]), y = std::abs(ray.inverse[1]), z = std::abs(ray.inverse[2]);
    const float xy = x < y ? x : y;
    return {.high = {ray.high[0], ray.high[1], ray.high[2]},
            .low = {ray.low[0], ray.low[1], ray.low[2]},
            .direction = {d[0], d[1], d[2]},
            .inverse_squared = 1 / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]),
            .inverse_length = (xy < z ? xy : z) * (1 + 0x1p-20f),  // along the longest
            .relative = 48 * 0x1p-24f + 16 * ray.direction_error,
            .absolute = absolute_error(ray, center_error),
            .t_scale = ray.scale};
}

// A ray's numbers, the same in all lanes.
template <template <class> class RayNumbers>
HWY_INLINE RayNumbers<Floats> in_all_lanes(const RayNumbers<float>& ray) {
    return RayNumbers<Floats>::from([&](std::size_t i) HWY_ATTR { return Floats(number_of<float>(ray, i)); });
}

// Primitives of a block that the ray may hit, or hits for sure, by bit, and bounds on the t of each.
struct Candidates {
    std::uint32_t possible = 0, certain = 0;
    HWY_ALIGN float near[flat::kMaxBlock], far[flat::kMaxBlock];

    HWY_INLINE void add(const FloatHits<Floats>& hits, std::size_t at) {
        possible |= bits(hits.possible) << at;
        certain |= bits(hits.certain & hits.possible) << at;
        store(hits.near, near + at), store(hits.far, far + at);
    }
};

// Whether a vector starts at primitive i of a block. Where one holds a whole block there is no loop, before which what
// a ray has in all lanes would be kept in memory.
HWY_INLINE bool has_vector(std::size_t i, std::size_t count) {
    return kLanes<Floats> >= flat::kMaxBlock ? i == 0 : i < count;
}

HWY_INLINE Floats load_row(const std::uint32_t* words) { return load_floats(words); }

template <bool kQuad>
HWY_INLINE Candidates test_planar(const flat::BlockView& block, std::size_t count, const PlanarRay& ray, float t_min,
                                  float t_max) {
    const std::uint32_t* const rows = block.rows(count);
    const std::uint32_t *const x = rows + ray.axes[0] * count, *const y = rows + ray.axes[1] * count,
                               *const z = rows + ray.axes[2] * count;
    Candidates found;
    for (std::size_t i = 0; has_vector(i, count); i += kLanes<Floats>) {
        const auto vertex = [&](std::size_t k) HWY_ATTR {
            const std::size_t at = 3 * k * count + i;
            return Vector<Floats>{load_row(x + at), load_row(y + at), load_row(z + at)};
        };
        const auto leaving = first_lanes<Floats>(ray.leaves ? kLanes<Floats> : 0);
        const auto hits = test_planar<kQuad>(vertex, in_all_lanes(ray.numbers), first_lanes<Floats>(count - i), leaving,
                                             {t_min, t_max});
        if (any(hits.possible)) found.add(hits, i);
    }
    return found;
}

template <bool kMoving>
HWY_INLINE Candidates test_spheres(const flat::BlockView& block, std::size_t count, const SphereFloatRay<float>& ray,
                                   float time, float t_min, float surely_after, float t_max) {
    const std::uint32_t* const rows = block.rows(count);
    Candidates found;
    for (std::size_t i = 0; has_vector(i, count); i += kLanes<Floats>) {
        const auto row = [&](std::size_t r) HWY_ATTR { return load_row(rows + r * count + i); };
        const auto coordinate = [&](std::size_t a) HWY_ATTR {
            const Floats at0 = row(a);
            if constexpr (kMoving) return mul_add(time, row(3 + a) - at0, at0);
            return at0;
        };
        const auto roots = float_roots(three<Floats>(coordinate, 0), row(kMoving ? 6 : 3), in_all_lanes(ray));
        if (HWY_LIKELY(!any(!roots.missed))) continue;
        auto hits = first_root(roots, Floats(surely_after), {t_min, t_max});
        hits.possible = hits.possible & first_lanes<Floats>(count - i);
        found.add(hits, i);
    }
    return found;
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
