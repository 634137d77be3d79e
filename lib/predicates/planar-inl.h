// What the filters of flat shapes share. Per-target include guard, as Highway has it.
#if defined(LIMN_PREDICATES_PLANAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_PREDICATES_PLANAR_INL_H
#undef LIMN_PREDICATES_PLANAR_INL_H
#else
#define LIMN_PREDICATES_PLANAR_INL_H
#endif

#include "predicates/ray_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The permutation of axes that makes a direction largest along z.
template <class N>
class Axes {
public:
    HWY_INLINE explicit Axes(const Vector<N>& direction) {
        const N x = abs(direction.x), y = abs(direction.y);
        x_over_y_ = x > y;
        z_longest_ = !(select(x_over_y_, x, y) > abs(direction.z));
    }
    HWY_INLINE Vector<N> permuted(const Vector<N>& v) const {
        return {select(z_longest_, v.x, select(x_over_y_, v.y, v.z)),
                select(z_longest_, v.y, select(x_over_y_, v.z, v.x)),
                select(z_longest_, v.z, select(x_over_y_, v.x, v.y))};
    }

private:
    Mask<N> x_over_y_, z_longest_;
};
// In a vector of one lane: branches could not be predicted.
template <>
class Axes<double> {
public:
    HWY_INLINE explicit Axes(const Vector<double>& direction) : axes_(broadcast<Lane>(direction)) {}
    HWY_INLINE Vector<double> permuted(const Vector<double>& v) const {
        const Vector<Lane> p = axes_.permuted(broadcast<Lane>(v));
        return {first_of_lanes(p.x), first_of_lanes(p.y), first_of_lanes(p.z)};
    }

private:
    using Lane = Wide<hn::CappedTag<double, 1>>;
    Axes<Lane> axes_;
};

// The axes are permuted so that the direction is largest along z; shearing maps it onto z, so that a triangle is hit
// where the origin lies inside its projection (Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2(1),
// 2013; here in double).
//
// Error of a sheared coordinate p = fl(A_x - fl(S A_z)), where A = fl(a - o) has no coordinate above M, |S| <= 1, u =
// 2^-53, the origin is off by e and S by s: u M + e from A_x; (u + s) M + (u M + e) from S A_z; u M from that product;
// 2 u M from the difference: (6 u + s) M + 2 e in all. Products of two such coordinates, no larger than P, and their
// difference lose 2 u P^2 each; P <= 2 M. So with E = (8 u + s) M + 2 e every 2x2 determinant is off by at most 4 (P +
// E) E. An edge vector, which is not a difference, loses less.
template <class N>
struct ShearedRay {
    Axes<N> axes;
    Vector<N> origin, direction;  // permuted
    N shear_x, shear_y;
    N relative, absolute;  // E = relative M + absolute
    N direction_error;     // of direction.z, relative

    HWY_INLINE explicit ShearedRay(const RayOf<N>& ray)
        : axes(ray.direction), origin(axes.permuted(ray.origin)), direction(axes.permuted(ray.direction)) {
        shear_x = direction.x / direction.z, shear_y = direction.y / direction.z;
        // |d_x / d_z - (d_x + e) / (d_z + e')| <= 2 e / (|d_z| - e); 4 e / |d_z| as long as that is below 1/2.
        const N error = 4 * ray.direction_error / abs(direction.z);
        direction_error = select(error < 0.5, error, N(kInfinity));
        relative = (8 * kRoundoff + direction_error) * (1 + 0x1p-30);
        absolute = 2 * ray.origin_error * (1 + direction_error) * (1 + 0x1p-30);  // |S| <= 1 + s
    }

    // z is left as it is: dividing by direction.z turns it into t.
    HWY_INLINE Vector<N> sheared(const Vector<N>& v) const { return {v.x - shear_x * v.z, v.y - shear_y * v.z, v.z}; }

    // Of a sheared coordinate, and of a 2x2 determinant of them: E and 4 (P + E) E. `reach`: the largest coordinate
    // before shearing; `across`: the largest x or y after it. Infinite, so that nothing is decided, where products of
    // three coordinates could overflow, or underflow by more than the bound.
    HWY_INLINE N coordinate_error(N reach) const { return relative * reach + absolute; }
    HWY_INLINE N determinant_error(N reach, N across) const {
        const N e = coordinate_error(reach);
        return select((reach > 0x1p-300) & (reach < 0x1p300), 4 * (across + e) * e + 0x1p-600, N(kInfinity));
    }
};

// The largest x or y.
template <class N>
HWY_INLINE N across(const Vector<N>& a, const Vector<N>& b, const Vector<N>& c) {
    return max(max(abs(a.x), max(abs(b.x), abs(c.x))), max(abs(a.y), max(abs(b.y), abs(c.y))));
}

// A flat shape where its inside is hit: the depth z as a weighted mean, computed by at most 8 operations. Its weights
// are off by `weight_error`, u and v among them. Over the shape z varies by `depth`.
template <class N>
struct InsideHit {
    N z, u, v;
    N coordinate_error, weight_error, depth;
};

template <class N>
HWY_INLINE FilterResult<N> judged(const ShearedRay<N>& ray, const Interval<N>& within, Mask<N> missed, Mask<N> inside,
                                  const InsideHit<N>& h) {
    const N z_error = 2 * (h.weight_error * h.depth + h.coordinate_error) + ray.direction_error * abs(h.z);
    const N t = h.z / ray.direction.z;
    Judgement<N> j = judge(t, z_error / abs(ray.direction.z), within);
    j.accurate = j.accurate & (h.weight_error <= kAccurateWeight);
    const Mask<N> hit = inside & j.hit();
    if (HWY_LIKELY(all(hit))) return {hit, missed, t, h.u, h.v};
    return {.hit = hit, .miss = Mask<N>(missed | (inside & j.miss())), .t = t, .u = h.u, .v = h.v};
}

// Whether a plane lies behind the ray's origin: a surface behind the ray that leaves it, which the t of a search, close
// to 0, seldom tells. The plane is spanned by the edges u and v, off by at most `edge_error` each, q goes from the
// origin to a point of it, and `against` says whether n.d < 0, n = u x v. Let `edge` be their largest coordinate: then
// n is off by 4 edge edge_error + 4 u edge^2 and less than a third of the former, and n.q by three times that times
// |q|, 6 edge^2 (u |q| + e) from q, and 18 u edge^2 |q| from the products.
template <class N>
HWY_INLINE Mask<N> is_behind(const Vector<N>& u, const Vector<N>& v, const Vector<N>& q, N edge_error, N origin_error,
                             Mask<N> against) {
    const N edge = max(max_abs(u), max_abs(v)), way = max_abs(q), product = dot(cross(u, v), q);
    const N error =
        edge * (16 * edge_error * way + edge * (36 * kRoundoff * way + 6 * origin_error)) * (1 + 0x1p-30) + 0x1p-900;
    return (abs(product) > error) & ((product < 0.0) ^ against);
}

// Whether a plane lies beyond the end of a search: that of a lamp, whose shadow rays end just before it, and which from
// beside it the t of a search does not tell. The end is seen from q; the edges u and v are off by their own rounding, q
// - t_max d by 3 u (|q| + t_max |d|), the rest is as above. That is far more than what t is rounded by. Only for rays
// as they were given.
template <class N>
HWY_INLINE Mask<N> is_beyond(const ShearedRay<N>& ray, const Vector<N>& u, const Vector<N>& v, const Vector<N>& q,
                             N t_max, Mask<N> against) {
    const Vector<N> way = t_max * ray.direction, rest = q - way;
    const N edge = max(max_abs(u), max_abs(v)), product = dot(cross(u, v), rest);
    const N error =
        edge * edge * kRoundoff * (52 * max_abs(rest) + 18 * (max_abs(q) + max_abs(way))) * (1 + 0x1p-30) + 0x1p-900;
    const auto is_as_given = (ray.absolute == 0.0) & (ray.direction_error == 0.0) & (t_max < kInfinity);
    return is_as_given & (abs(product) > error) & !((product < 0.0) ^ against);
}

// Both, for what a filter leaves undecided of rays that start at t = 0 or later.
template <class N>
HWY_INLINE void tell_by_side(const ShearedRay<N>& ray, const Interval<N>& within, Mask<N> inside, const Vector<N>& u,
                             const Vector<N>& v, const Vector<N>& q, N edge_error, Mask<N> against,
                             FilterResult<N>& result) {
    if (HWY_LIKELY(all(result.hit))) return;
    const auto undecided = inside & !(result.hit | result.miss);
    if (HWY_LIKELY(!any(undecided))) return;
    const auto behind = is_behind(u, v, q, edge_error, 0.5 * ray.absolute, against);
    const auto beyond = is_beyond(ray, u, v, q, within.t_max, against);
    result.miss = result.miss | (undecided & (behind | beyond) & (within.t_min >= 0.0));
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
