// Triangles and quads of a block against a ray, in float, several at once. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_PLANAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_PLANAR_INL_H
#undef LIMN_KERNELS_PLANAR_INL_H
#else
#define LIMN_KERNELS_PLANAR_INL_H
#endif

#include "kernels/lanes-inl.h"
#include "kernels/leaf_rays.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// The vertices are A, B, C; a quad is A + u (B - A) + v (C - A). Edge values as in filter_triangle, each off by at most
// e: all beyond e on one side are a hit, two beyond it on different sides a miss. The edges of a quad are wb, wc, wa +
// wb and wa + wc, the sums off by 3 e.
//
// Where a hit is certain its weights are off by 5 e / |det|, so z by twice that times the depth, by E, and by 24
// roundings of z, of which there are 64 in 4 E; t by that, and the bounds' own rounding. Where it is not, z lies
// between that of the vertices, for a quad as far again.
//
// A ray that leaves a surface has t close to 0 there, which these bounds seldom tell from 0: the side of the plane that
// the origin is on does. n.q, n the normal and q from the origin to a vertex, is off by 16 u of the sum of the
// magnitudes of its products: 5 u from the products of the edges, which are seen from no origin, 2 u from q, and the
// sum's own; and, as in is_behind, by what edges and q are off beside that, `absolute`.

// The vertices as a ray sees them: x and y sheared, z as it is.
template <class T>
struct SeenVertices {
    T ax, ay, az, bx, by, bz, cx, cy, cz;
};

template <class T>
struct EdgeValues {
    T wa, wb, wc, least, most;  // the last two of all that have to have one sign
    T across;                   // the largest x or y
};

template <bool kQuad, class D, class T = hn::Vec<D>>
HWY_INLINE EdgeValues<T> edge_values(D d, const SeenVertices<T>& p) {
    EdgeValues<T> w;
    w.wa = hn::MulSub(p.cx, p.by, hn::Mul(p.cy, p.bx));
    w.wb = hn::MulSub(p.ax, p.cy, hn::Mul(p.ay, p.cx));
    w.wc = hn::MulSub(p.bx, p.ay, hn::Mul(p.by, p.ax));
    w.least = hn::Min(w.wb, w.wc), w.most = hn::Max(w.wb, w.wc);
    if constexpr (kQuad) {
        const auto third = hn::Set(d, 0.333f);
        const auto ab = hn::Mul(third, hn::Add(w.wa, w.wb)), ac = hn::Mul(third, hn::Add(w.wa, w.wc));
        w.least = hn::Min(w.least, hn::Min(ab, ac)), w.most = hn::Max(w.most, hn::Max(ab, ac));
    } else {
        w.least = hn::Min(w.least, w.wa), w.most = hn::Max(w.most, w.wa);
    }
    w.across = hn::Max(max_abs(p.ax, p.bx, p.cx), max_abs(p.ay, p.by, p.cy));
    return w;
}

// What the edge values say with an error of e.
template <class T>
HWY_INLINE auto is_missed(const EdgeValues<T>& w, T e) {
    return hn::And(hn::Lt(w.least, hn::Neg(e)), hn::Gt(w.most, e));
}

// Where the plane is met.
template <class D, class T = hn::Vec<D>>
struct PlaneMeeting {
    hn::Mask<D> missed, certain;
    T det, near, far;  // the last two: bounds on t
};

// `slope`: t / z; `relative`, `absolute`, `direction_error`: PlanarRay's.
template <bool kQuad, class D, class T = hn::Vec<D>>
HWY_INLINE PlaneMeeting<D> meet_plane(D d, const SeenVertices<T>& p, const EdgeValues<T>& w, T relative, T absolute,
                                      T direction_error, T slope) {
    PlaneMeeting<D> m;
    const auto coordinate_error = hn::MulAdd(relative, hn::Add(w.across, max_abs(p.az, p.bz, p.cz)), absolute);
    const auto e = hn::Mul(hn::Mul(hn::Set(d, 4.0f), hn::Add(w.across, coordinate_error)), coordinate_error);
    m.missed = is_missed(w, e);
    m.certain = hn::Or(hn::Gt(w.least, e), hn::Lt(w.most, hn::Neg(e)));
    m.det = hn::Add(w.wa, hn::Add(w.wb, w.wc));
    const auto inverse = hn::Div(hn::Set(d, 1.0f), m.det);
    const auto mean = hn::Mul(hn::MulAdd(w.wa, p.az, hn::MulAdd(w.wb, p.bz, hn::Mul(w.wc, p.cz))), inverse);
    const auto lowest = hn::Min(p.az, hn::Min(p.bz, p.cz)), highest = hn::Max(p.az, hn::Max(p.bz, p.cz));
    const auto depth = hn::Sub(highest, lowest);
    const auto weight_error = hn::Mul(hn::Mul(hn::Set(d, 10.0f), e), hn::Abs(inverse));
    const auto e4 = hn::Mul(hn::Set(d, 4.0f), coordinate_error);
    const auto z_error = hn::MulAdd(weight_error, depth, hn::MulAdd(direction_error, hn::Abs(mean), e4));
    auto z_low = hn::Sub(lowest, e4), z_high = hn::Add(highest, e4);
    if constexpr (kQuad) z_low = hn::Sub(z_low, depth), z_high = hn::Add(z_high, depth);
    const auto t1 = hn::Mul(slope, hn::IfThenElse(m.certain, hn::Sub(mean, z_error), z_low));
    const auto t2 = hn::Mul(slope, hn::IfThenElse(m.certain, hn::Add(mean, z_error), z_high));
    m.near = hn::Min(t1, t2), m.far = hn::Max(t1, t2);
    return m;
}

template <bool kQuad>
HWY_INLINE Candidates test_planar(const flat::BlockView& block, std::size_t count, const PlanarRay& ray, float t_min,
                                  float t_max) {
    const Lanes d;
    const std::uint32_t* const rows = block.rows(count);
    const auto high_x = hn::Set(d, ray.high[0]), low_x = hn::Set(d, ray.low[0]);
    const auto high_y = hn::Set(d, ray.high[1]), low_y = hn::Set(d, ray.low[1]);
    const auto high_z = hn::Set(d, ray.high[2]), low_z = hn::Set(d, ray.low[2]);
    const auto shear_x = hn::Set(d, ray.shear_x), shear_y = hn::Set(d, ray.shear_y);
    const std::uint32_t *x = rows + ray.x * count, *y = rows + ray.y * count, *z = rows + ray.z * count;
    const std::size_t vertex = 3 * count;

    Candidates found;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto seen = [&](const std::uint32_t* row, auto high, auto low) {
            return hn::Sub(hn::Sub(load_floats(row + i), high), low);
        };
        SeenVertices<V> p;
        p.az = seen(z, high_z, low_z), p.bz = seen(z + vertex, high_z, low_z);
        p.cz = seen(z + 2 * vertex, high_z, low_z);
        p.ax = hn::NegMulAdd(shear_x, p.az, seen(x, high_x, low_x));
        p.bx = hn::NegMulAdd(shear_x, p.bz, seen(x + vertex, high_x, low_x));
        p.cx = hn::NegMulAdd(shear_x, p.cz, seen(x + 2 * vertex, high_x, low_x));
        p.ay = hn::NegMulAdd(shear_y, p.az, seen(y, high_y, low_y));
        p.by = hn::NegMulAdd(shear_y, p.bz, seen(y + vertex, high_y, low_y));
        p.cy = hn::NegMulAdd(shear_y, p.cz, seen(y + 2 * vertex, high_y, low_y));
        const EdgeValues<V> w = edge_values<kQuad>(d, p);
        // The bound for vertices as far away as there are any tells most misses, sooner.
        const auto coarse = hn::MulAdd(hn::Set(d, ray.coarse_slope), w.across, hn::Set(d, ray.coarse));
        auto open = hn::AndNot(is_missed(w, coarse), hn::FirstN(d, count - i));
        if (HWY_LIKELY(hn::AllFalse(d, open))) continue;

        const auto slope = hn::Set(d, ray.t_from_z);
        const auto [missed, certain, det, near, far] = meet_plane<kQuad>(
            d, p, w, hn::Set(d, ray.relative), hn::Set(d, ray.absolute), hn::Set(d, ray.direction_error), slope);
        // Where nothing is known there is a NaN, and no comparison drops it.
        const auto dropped = hn::Or(hn::Gt(near, hn::Set(d, t_max)), hn::Lt(far, hn::Set(d, t_min)));
        open = hn::AndNot(hn::Or(missed, dropped), open);
        if (ray.starts_at_origin && !hn::AllFalse(d, hn::And(open, hn::Lt(near, hn::Zero(d))))) {
            const auto load = [&](const std::uint32_t* row) HWY_ATTR { return load_floats(row + i); };
            const auto ux = hn::Sub(load(x + vertex), load(x)), vx = hn::Sub(load(x + 2 * vertex), load(x)),
                       uy = hn::Sub(load(y + vertex), load(y)), vy = hn::Sub(load(y + 2 * vertex), load(y)),
                       uz = hn::Sub(load(z + vertex), load(z)), vz = hn::Sub(load(z + 2 * vertex), load(z));
            const auto qx = seen(x, high_x, low_x), qy = seen(y, high_y, low_y);
            auto product = hn::Zero(d), size = hn::Zero(d);
            const auto add = [&](auto u1, auto v2, auto u2, auto v1, auto q) HWY_ATTR {
                const auto left = hn::Mul(u1, v2), right = hn::Mul(u2, v1);
                product = hn::MulAdd(hn::Sub(left, right), q, product);
                size = hn::MulAdd(hn::Add(hn::Abs(left), hn::Abs(right)), hn::Abs(q), size);
            };
            add(uy, vz, uz, vy, qx);
            add(uz, vx, ux, vz, qy);
            add(ux, vy, uy, vx, p.az);
            const auto edge = hn::Max(max_abs(ux, uy, uz), max_abs(vx, vy, vz)), q = max_abs(qx, qy, p.az);
            const auto moved = hn::Mul(hn::Mul(edge, hn::Set(d, ray.absolute)),
                                       hn::MulAdd(hn::Set(d, 16.0f), q, hn::Mul(hn::Set(d, 3.0f), edge)));
            const auto error = hn::MulAdd(size, hn::Set(d, 16 * 0x1p-24f), hn::Add(moved, hn::Set(d, 0x1p-120f)));
            // The normal is against the ray where det and the direction's z have the same sign; then what is behind has
            // a positive product.
            const auto sign = hn::Xor(product, hn::Xor(det, slope));
            const auto is_positive = hn::Gt(hn::CopySign(hn::Set(d, 1.0f), sign), hn::Zero(d));
            const auto behind = hn::And(hn::Gt(hn::Abs(product), error), is_positive);
            open = hn::AndNot(hn::And(certain, behind), open);
        }
        found.add(open, certain, near, far, i);
    }
    return found;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
