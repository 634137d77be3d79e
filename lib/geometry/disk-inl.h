// The filter of rays against disks. The include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_DISK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_DISK_INL_H
#undef LIMN_GEOMETRY_DISK_INL_H
#else
#define LIMN_GEOMETRY_DISK_INL_H
#endif

#include "geometry/exact_disk.h"
#include "geometry/ray_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The intersection of a ray with the plane of a disk: the point center + w / b, at t = -a / b. Each of the numbers has
// a bound on its error.
template <class N>
struct DiskCrossing {
    Vector<N> w;
    N a, b, w_error, a_error, b_error;
    Mask<N> known;  // false if products may have overflowed, or underflowed by more than the bounds
};

// The filter of a disk. Its rim belongs to it; a ray in its plane misses.
template <class N>
struct DiskPredicate {
    using Ray = RayOf<N>;
    static constexpr std::size_t kNumbers = 7;
    Vector<N> center, normal;  // the normal may have any length but 0
    N radius;

    // Returns the disk whose i-th number is number(i), i < kNumbers.
    template <class Number>
    HWY_INLINE static DiskPredicate from(const Number& number) {
        return {three<N>(number, 0), three<N>(number, 3), number(6)};
    }

    // Returns the intersection with the plane of the disk.
    //
    // Let o be the ray's origin, d its direction, c the centre, n the normal, and p = o - c, a = p.n, b = d.n. The ray
    // crosses the plane at t = -a / b, in the point c + w / b, where w = b p - a d.
    //
    // Let P, D and M be the largest magnitudes of the coordinates of p, d and n. Let each coordinate of the origin be
    // off by e, each of the direction by s, and u = 2^-53. Then
    //   - each coordinate of p is off by u P + e;
    //   - a is off by A = 12 u P M + 4 M e;
    //   - b is off by B = 9 u D M + 4 M s;
    //   - b p is off by 15 u P D M + 3 D M e + 4 P M s;
    //   - a d is off by 15 u P D M + 4 D M e + 3 P M s;
    //   - their difference is at most 6 P D M, so its rounding adds 6 u P D M.
    // The last three add up to E = 40 u P D M + 7 D M e + 7 P M s, the bound on the error of each coordinate of w.
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

    // Returns the hits and misses that double precision can prove.
    //
    // The disk is hit if w.w <= r^2 b^2 and b is not 0. Let |w| be the largest magnitude of the coordinates of w. Then
    //   - w.w is off by 6 |w| E + 3 E^2 because of the error of w, and by 8 u |w|^2 because of its own rounding;
    //   - r^2 b^2 is off by r^2 B (2 |b| + B) because of the error of b, and by 3 u r^2 b^2 because of its own
    //     rounding.
    // If r^2 b^2 exceeds w.w by more than both errors, then r^2 b^2 > r^2 B (2 |b| + B), and so |b| > 2 B. Then the
    // magnitude of the exact b is at least |b| / 2, and t is off by at most 2 (A + |t| B) / |b| plus its own rounding u
    // |t|.
    HWY_INLINE FilterResult<N> filter(const Ray& ray, const Interval<N>& within) const {
        const auto [w, a, b, w_error, a_error, b_error, known] = crossing(ray);
        // Compare w.w with r^2 b^2.
        const N across = max_abs(w), slope = abs(b);
        const N r2 = radius * radius, inside_by = r2 * (b * b) - dot(w, w);
        const N error = 3 * w_error * (2 * across + w_error) + r2 * b_error * (2 * slope + b_error) +
                        16 * kRoundoff * (across * across + r2 * (b * b));
        const N bound = error * (1 + 0x1p-30);
        const Mask<N> missed = known & (inside_by < -bound), inside = known & (inside_by > bound);
        if (!any(inside)) return {inside, missed, N(0.0), N(0.0), N(0.0)};

        // Compare t with the interval.
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

// Returns the filter of one disk in all lanes.
template <class N>
HWY_INLINE DiskPredicate<N> disk_of(const Point3& center, const Vec3& normal, double radius) {
    return {broadcast<N>(center), broadcast<N>(normal), N(radius)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
