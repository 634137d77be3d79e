// The filter of rays against spheres. The include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_SPHERE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_SPHERE_INL_H
#undef LIMN_GEOMETRY_SPHERE_INL_H
#else
#define LIMN_GEOMETRY_SPHERE_INL_H
#endif

#include "geometry/exact.h"
#include "geometry/ray_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The two roots of a sphere with bounds on their errors.
template <class N>
struct SphereRoots {
    Mask<N> missed;  // the line of the ray surely misses the sphere
    Mask<N> known;   // the roots and their bounds are set; undecided if neither is true
    N near, near_error, far, far_error;
};

// The filter of a sphere.
template <class N>
struct SpherePredicate {
    using Ray = RayOf<N>;
    static constexpr std::size_t kNumbers = 4;
    Vector<N> center;
    N radius;  // if negative, the outward normal points to the centre

    // Returns the sphere whose i-th number is number(i), i < kNumbers.
    template <class Number>
    HWY_INLINE static SpherePredicate from(const Number& number) {
        return {three<N>(number, 0), number(3)};
    }

    // Returns both roots.
    //
    // The method is that of Haines, Guenther, Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, Ray
    // Tracing Gems, ch. 7. The discriminant is computed from the foot point, the point of the line that is closest to
    // the centre. It does not cancel for small distant spheres. The root of smaller magnitude, which might cancel, is
    // computed from the product of the roots.
    //
    // Error of the foot point. Let o be the origin, d the direction, c the centre, r the radius, p = o - c, L >= |p|
    // (`reach`), and u = 2^-53. Let e be a bound on the length of the error of the origin (`absolute`). Let s be the
    // error of each coordinate of the direction, divided by its largest coordinate. The foot point relative to the
    // centre is
    //     F = p - (p.d / d.d) d.
    //   - p is off by u L + e;
    //   - (p.d / d.d) d is off by 8 u L;
    //   - the sum is rounded by u L;
    //   - the error of the direction is an angle of at most 2 s, which adds less than 8 s L.
    // So F is off by E = (10 u + 8 s) L + e.
    //
    // Error of the discriminant. r^2 - F.F is off by at most E (2 |F| + E) + 6 u (r^2 + F.F). Its sign is right if its
    // magnitude exceeds D = E (4 r + E) + 32 u (r^2 + F.F):
    //   - If |F| <= 2 r, then D is larger than the error.
    //   - If |F| > 2 r, the sign can only be wrong if E >= |F| - r. But then the magnitude F.F - r^2 does not exceed D,
    //     because E (4 r + E) >= (|F| - r) (|F| + 3 r) > (|F| - r) (|F| + r).
    //
    // Errors of the roots. They are t_F +- h with t_F = -p.d / d.d and h = sqrt((r^2 - F.F) / d.d).
    //   - t_F is off by E / |d|.
    //   - h has at most the relative error D / (r^2 - F.F), plus that of d.d, plus 4 u for rounding.
    //   - The product of the roots is (p.p - r^2) / d.d, where p.p - r^2 is off by 8 u (L^2 + r^2) + e (2 L + e).
    HWY_INLINE SphereRoots<N> roots(const Ray& ray) const {
        const Vector<N>& d = ray.direction;
        const N r = abs(radius), squared = dot(d, d), inverse_length = 1 / max_abs(d);  // at least 1 / |d|
        const N relative = (10 * kRoundoff + 8 * ray.direction_error * inverse_length) * (1 + 0x1p-30);
        const N absolute = 2 * ray.origin_error * (1 + 0x1p-30);
        const Vector<N> p = ray.origin - center;
        const N reach = sum_abs(p);
        const auto is_in_range =
            (squared > 0x1p-460) & (squared < 0x1p460) & (reach < 0x1p230) & (r < 0x1p230) & (r > 0x1p-230);

        // Compare the discriminant with the bound on its error.
        const N foot_t = -dot(p, d) / squared;
        const Vector<N> foot = p + foot_t * d;
        const N r2 = r * r, foot2 = dot(foot, foot), discriminant = r2 - foot2;
        const N foot_error = relative * reach + absolute;
        const N error = foot_error * (4 * r + foot_error) + 32 * kRoundoff * (r2 + foot2);
        const Mask<N> missed = is_in_range & (discriminant < -error), met = is_in_range & (discriminant > error);
        if (!any(met)) return {missed, met, N(0.0), N(0.0), N(0.0), N(0.0)};

        // Compute the root of larger magnitude.
        const N half_chord = sqrt(discriminant / squared);
        const N outer = foot_t + copy_sign(half_chord, foot_t), size = abs(outer);
        const N outer_error =
            foot_error * inverse_length + half_chord * (error / discriminant + relative) + 4 * kRoundoff * size;
        // Compute the other from the product of the roots. As `outer` is off by at most a quarter of itself where the
        // roots are known, the factors 2 cover the division by its approximation.
        const N power = dot(p, p) - r2;
        const N power_error = 8 * kRoundoff * (reach * reach + r2) + absolute * (2 * reach + absolute);
        const N inner = power / (squared * outer);
        const N inner_error =
            power_error / (squared * size) * 2 + abs(inner) * (2 * (outer_error / size) + 2 * relative);
        const auto outer_first = outer < inner;
        return {.missed = missed,
                .known = Mask<N>(met & (outer_error <= 0.25 * size)),
                .near = min(outer, inner),
                .near_error = select(outer_first, outer_error, inner_error),
                .far = max(outer, inner),
                .far_error = select(outer_first, inner_error, outer_error)};
    }

    // Returns the first root within the interval.
    HWY_INLINE FilterResult<N> filter(const Ray& ray, const Interval<N>& within) const {
        const SphereRoots<N> r = roots(ray);
        const Judgement<N> first = judge(r.near, r.near_error, within);
        const Mask<N> hit = r.known & first.hit();
        if (HWY_LIKELY(all(hit))) return {hit, r.missed, r.near, N(0.0), N(0.0)};
        const Mask<N> passed = r.known & first.miss();
        const Judgement<N> last = judge(r.far, r.far_error, within);
        return {.hit = Mask<N>(hit | (passed & last.hit())),
                .miss = Mask<N>(r.missed | (passed & last.miss())),
                .t = select(hit, r.near, r.far),
                .u = N(0.0),
                .v = N(0.0)};
    }

    bool exact(const RayFrame& frame, const Search& search, PlanarHit& hit) const {
        const SphereHits hits = exact_hits(frame, search);
        hit = {hits.near_found ? hits.near : hits.far, 0, 0};
        return hits.near_found || hits.far_found;
    }

    // Returns all roots within the search. The decisions are exact.
    SphereHits hits(const RayFrame& frame, const Search& search) const {
        const Interval<N> within{search.t_min, search.t_max};
        const SphereRoots<N> r = roots(ray_of<N>(frame));
        if (r.missed) return {};
        const Judgement<N> near = judge(r.near, r.near_error, within);
        const Judgement<N> far = judge(r.far, r.far_error, within);
        if (!r.known || !((near.beyond | near.accurate) & (far.beyond | far.accurate)))
            return exact_hits(frame, search);
        return {near.within && !near.beyond, far.within && !far.beyond, r.near, r.far};
    }

private:
    SphereHits exact_hits(const RayFrame& frame, const Search& search) const {
        const SphereRoots<N> r = roots(ray_of<N>(frame));
        const auto accurate = [&](const N& t, N error) {
            return r.known && judge(t, error, {search.t_min, search.t_max}).accurate ? &t : nullptr;
        };
        return exact_sphere({center.x, center.y, center.z}, std::abs(radius), frame, accurate(r.near, r.near_error),
                            accurate(r.far, r.far_error), search);
    }
};

// Returns the filter of one sphere in all lanes.
template <class N>
HWY_INLINE SpherePredicate<N> sphere_of(const Point3& center, double radius) {
    return {broadcast<N>(center), N(radius)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
