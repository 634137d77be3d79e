// Ray against disk. Per-target include guard, as Highway has it.
#if defined(LIMN_PREDICATES_DISK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_PREDICATES_DISK_INL_H
#undef LIMN_PREDICATES_DISK_INL_H
#else
#define LIMN_PREDICATES_DISK_INL_H
#endif

#include "predicates/disk.h"
#include "predicates/ray_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// Where a ray meets the plane of a disk, from its center: w / b, at t = -a / b; and what each is off by.
template <class N>
struct DiskCrossing {
    Vector<N> w;
    N a, b, w_error, a_error, b_error;
    Mask<N> known;  // else products may have overflowed, or underflowed by more than that
};

template <class N>
struct DiskPredicate {
    using Ray = RayOf<N>;
    static constexpr std::size_t kNumbers = 7;
    Vector<N> center, normal;  // the normal is as long as it likes
    N radius;

    // number(i): the i-th of kNumbers.
    template <class Number>
    HWY_INLINE static DiskPredicate from(const Number& number) {
        return {three<N>(number, 0), three<N>(number, 3), number(6)};
    }

    // With p = o - c, a = p.n, b = d.n the plane is met at t = -a / b, at c + w / b, w = b p - a d. Let P, D, M be the
    // largest coordinates of p, d, n, origin and direction be off by e and s, u = 2^-53. Then p is off by u P + e; a by
    // A = 12 u P M + 4 M e, b by B = 9 u D M + 4 M s; w by (15 u P D M + 3 D M e + 3 P M s) from each of its products
    // and 6 u P D M from their difference, by E = 40 u P D M + 7 D M e + 7 P M s in all.
    HWY_INLINE DiskCrossing<N> crossing(const Ray& ray) const {
        const Vector<N> p = ray.origin - center;
        const Vector<N>& d = ray.direction;
        const N a = dot(p, normal), b = dot(d, normal);
        const N reach = max_abs(p), along = max_abs(d), size = max_abs(normal);
        const auto is_in_range = [](N x) HWY_ATTR { return (x > 0x1p-100) & (x < 0x1p100); };
        return {.w = b * p - a * d,
                .a = a,
                .b = b,
                .w_error =
                    size * (along * (40 * kRoundoff * reach + 7 * ray.origin_error) + 7 * reach * ray.direction_error),
                .a_error = size * (12 * kRoundoff * reach + 4 * ray.origin_error),
                .b_error = size * (9 * kRoundoff * along + 4 * ray.direction_error),
                .known = Mask<N>(is_in_range(reach) & is_in_range(along) & is_in_range(size) & is_in_range(radius))};
    }

    // The rim belongs to the disk, a ray in its plane misses: inside is where w.w <= r^2 b^2. w.w is off by 6 |w| E + 3
    // E^2 and 8 u |w|^2, |w| the largest coordinate, and r^2 b^2 by r^2 B (2 |b| + B) and 3 u of itself. Where r^2 b^2
    // exceeds w.w by more than both, |b| > 2 B, and t is off by 2 (A + |t| B) / |b|, and u of itself.
    HWY_INLINE FilterResult<N> filter(const Ray& ray, const Interval<N>& within) const {
        const auto [w, a, b, w_error, a_error, b_error, known] = crossing(ray);
        const N across = max_abs(w), slope = abs(b);
        const N r2 = radius * radius, inside_by = r2 * (b * b) - dot(w, w);
        const N error = 3 * w_error * (2 * across + w_error) + r2 * b_error * (2 * slope + b_error) +
                        16 * kRoundoff * (across * across + r2 * (b * b));
        const N bound = error * (1 + 0x1p-30);
        const Mask<N> missed = known & (inside_by < -bound), inside = known & (inside_by > bound);
        if (!any(inside)) return {inside, missed, N(0.0), N(0.0), N(0.0)};

        const N t = -a / b;
        const N t_error = (2 * (a_error + abs(t) * b_error) / slope + 2 * kRoundoff * abs(t)) * (1 + 0x1p-30);
        const Judgement<N> j = judge(t, t_error, within);
        return {.hit = Mask<N>(inside & j.hit()),
                .miss = Mask<N>(missed | (inside & j.miss())),
                .t = t,
                .u = N(0.0),
                .v = N(0.0)};
    }

    bool exact(const RayFrame& frame, const Search& search, PlanarHit& hit) const {
        return exact_disk({center.x, center.y, center.z}, {normal.x, normal.y, normal.z}, radius, frame, search, hit);
    }
};

// The same in all lanes.
template <class N>
HWY_INLINE DiskPredicate<N> disk_of(const Point3& center, const Vec3& normal, double radius) {
    return {broadcast<N>(center), broadcast<N>(normal), N(radius)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
