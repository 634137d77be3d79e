// Definitions that the filters of triangles and quads share. The include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_PLANAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_PLANAR_INL_H
#undef LIMN_GEOMETRY_PLANAR_INL_H
#else
#define LIMN_GEOMETRY_PLANAR_INL_H
#endif

#include "geometry/ray_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The cyclic permutation of the axes after which the largest coordinate of a direction is z.
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
// One double is permuted as a vector of one lane. This avoids branches, which could not be predicted.
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

// A ray in the frame of Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013, here in double. The
// axes are permuted so that the largest coordinate of the direction is z. A shear maps the direction onto the z axis.
// Then the ray hits a triangle if the origin is inside the triangle's projection along z.
//
// Error of a sheared coordinate. Let p = fl(A_x - fl(S A_z)) be the coordinate, where A = fl(a - o) is the vertex a
// relative to the origin o, M the largest magnitude of its coordinates, S the shear with |S| <= 1, and u = 2^-53. Let
// each coordinate of the origin be off by e, and S by s besides its rounding. The error of p is the sum of
//   - u M + e, the error of A_x;
//   - (u + s) M, the error of S times A_z;
//   - u M + e, the error of A_z times S;
//   - u M, the rounding of the product;
//   - 2 u M, the rounding of the difference, which is at most 2 M.
// This is (6 u + s) M + 2 e = E', say.
//
// Error of a 2x2 determinant of sheared coordinates. Let P be their largest magnitude, P <= 2 M. The determinant is a
// difference of two products. Its error is the sum of
//   - 2 (2 P E' + E'^2), the errors of the factors of both products;
//   - 2 u P^2, the rounding of both products;
//   - 2 u P^2, the rounding of their difference.
// The last two are 4 P (u P) <= 4 P (2 u M). With E = E' + 2 u M = (8 u + s) M + 2 e the sum is at most 4 (P + E) E.
//
// The coordinates of an edge vector are not differences from the origin, so their error is smaller.
template <class N>
struct ShearedRay {
    Axes<N> axes;
    Vector<N> origin, direction;  // permuted
    N shear_x, shear_y;
    N relative, absolute;  // E = relative M + absolute
    N direction_error;     // bound on the relative error of direction.z, and on s

    HWY_INLINE explicit ShearedRay(const RayOf<N>& ray)
        : axes(ray.direction), origin(axes.permuted(ray.origin)), direction(axes.permuted(ray.direction)) {
        shear_x = direction.x / direction.z;
        shear_y = direction.y / direction.z;
        // Let d be the direction and e the bound on its error. As |d_x| <= |d_z|, for all |e1|, |e2| <= e: |d_x / d_z -
        // (d_x + e1) / (d_z + e2)| <= 2 e / (|d_z| - e). This is at most 4 e / |d_z| if that is below 1/2.
        const N error = 4 * ray.direction_error / abs(direction.z);
        direction_error = select(error < 0.5, error, N(kInfinity));
        relative = (8 * kRoundoff + direction_error) * (1 + 0x1p-30);
        absolute = 2 * ray.origin_error * (1 + direction_error) * (1 + 0x1p-30);  // the exact |S| is at most 1 + s
    }

    // Returns the sheared vector. Its z is not scaled: divided by direction.z it is t.
    HWY_INLINE Vector<N> sheared(const Vector<N>& v) const { return {v.x - shear_x * v.z, v.y - shear_y * v.z, v.z}; }

    // These return the bound E on the error of a sheared coordinate, and the bound 4 (P + E) E on that of a 2x2
    // determinant. `reach` is M, the largest magnitude of a coordinate before shearing. `across` is P, the largest
    // magnitude of x and y after shearing. If products of three coordinates could overflow, or underflow by more than
    // the bound, it is infinite: then nothing is decided.
    HWY_INLINE N coordinate_error(N reach) const { return relative * reach + absolute; }
    HWY_INLINE N determinant_error(N reach, N across) const {
        const N e = coordinate_error(reach);
        return select((reach > 0x1p-300) & (reach < 0x1p300), 4 * (across + e) * e + 0x1p-600, N(kInfinity));
    }
};

// Returns the largest magnitude of x and y in these vectors.
template <class N>
HWY_INLINE N across(const Vector<N>& a, const Vector<N>& b, const Vector<N>& c) {
    return max(max(abs(a.x), max(abs(b.x), abs(c.x))), max(abs(a.y), max(abs(b.y), abs(c.y))));
}

// A hit of the inside of a flat shape. z is the weighted mean of the sheared z of the vertices, computed by at most 8
// operations.
template <class N>
struct InsideHit {
    N z, u, v;
    N coordinate_error;  // bound on the error of a sheared coordinate: E
    N weight_error;      // bound on the error of each weight of the mean, u and v included
    N depth;             // difference between the largest and the smallest z of the shape
};

// Compares the t of hits of the inside with the interval, and returns the result of the filter.
//
// The errors of the weights change z by at most 2 weight_error depth, since the weights add up to 1. The errors of the
// vertices' z and the 8 operations change z by at most 2 E, because E >= 8 u M. The relative error of direction.z is
// also one of t.
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

// Returns true if a plane is surely behind the ray's origin. A ray that starts on a surface needs this test for that
// surface: the t of the hit is so close to 0 that its error bound seldom excludes t > 0.
//
// The plane is spanned by the edges u and v, whose coordinates are off by at most `edge_error`. The vector q goes from
// the origin, which is off by `origin_error`, to a point of the plane. `against` is n.d < 0, where n = u x v and d is
// the direction. The plane is behind the origin if n.q and n.d have opposite signs.
//
// Error of n.q. Let U (`edge` in the code) be the largest magnitude of the coordinates of both edges, |q| (`way`) that
// of q, a the edge_error, e the origin_error, and r = 2^-53.
//   - A coordinate of n is off by (4/3) 4 U a + 4 r U^2. The factor 4/3 covers terms in a^2. This adds three times as
//     much times |q| to the error: 16 U a |q| + 12 r U^2 |q|.
//   - A coordinate of q is off by r |q| + e, and one of n is at most 2 U^2. This adds 6 U^2 (r |q| + e).
//   - The rounding of the three products and of their sum adds 18 r U^2 |q|.
// The sum is U (16 a |q| + U (36 r |q| + 6 e)).
template <class N>
HWY_INLINE Mask<N> is_behind(const Vector<N>& u, const Vector<N>& v, const Vector<N>& q, N edge_error, N origin_error,
                             Mask<N> against) {
    const N edge = max(max_abs(u), max_abs(v)), way = max_abs(q), product = dot(cross(u, v), q);
    const N error =
        edge * (16 * edge_error * way + edge * (36 * kRoundoff * way + 6 * origin_error)) * (1 + 0x1p-30) + 0x1p-900;
    return (abs(product) > error) & ((product < 0.0) ^ against);
}

// Returns true if a plane is surely beyond the end of a search. A shadow ray needs this test for the plane of its
// light: it ends just before the light, and at a grazing angle the error bound of t is too large to decide.
//
// The parameters are those of is_behind(). `rest` = q - t_max d is the vector from the end of the search to a point of
// the plane. The plane is beyond the end if n.rest and n.d have the same sign.
//
// The error of n.rest follows as in is_behind(), with a = r U, the rounding of the edges, and e = 3 r (|q| + t_max
// |d|), the rounding of `rest`. It is r U^2 (52 |rest| + 18 (|q| + t_max |d|)). This bound is far larger than the
// rounding of the t that would be reported, which is therefore beyond t_max too.
//
// The test only holds for rays in world space, whose origin and direction are exact. It returns false for others.
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

// Adds the misses that is_behind() and is_beyond() find to the result of a filter. They are tried only if the inside is
// hit, the filter has not decided, and t_min >= 0.
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
