// Makes a WalkRay with vectors. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_WALK_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_WALK_RAY_INL_H
#undef LIMN_TRACE_WALK_RAY_INL_H
#else
#define LIMN_TRACE_WALK_RAY_INL_H
#endif

#include <cmath>
#include <cstddef>

#include "math/lanes-inl.h"
#include "trace/walk_ray.h"

#if HWY_MAX_BYTES >= 32

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

using Doubles4 = hn::FixedTag<double, 4>;
using Floats4 = hn::FixedTag<float, 4>;

// Returns the four doubles from byte kOffset of a ray on. They are loaded as bytes, because they aren't an array.
template <std::size_t kOffset>
HWY_INLINE hn::Vec<Doubles4> load_from(const Ray& ray) {
    static_assert(kOffset + 4 * sizeof(double) <= sizeof(Ray));
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&ray);
    return hn::BitCast(Doubles4(), hn::LoadU(hn::Repartition<std::uint8_t, Doubles4>(), bytes + kOffset));
}

// The cyclic permutations of the axes. kAxes[z] makes z the third axis.
alignas(16) inline constexpr std::int32_t kAxes[3][4] = {{1, 2, 0, 3}, {2, 0, 1, 3}, {0, 1, 2, 3}};
// The longest axis, by three bits: y > x, z > y and x > z.
inline constexpr std::uint8_t kLongest[8] = {0, 1, 2, 2, 0, 1, 0, 0};

HWY_INLINE hn::Vec<Floats4> permuted(hn::Vec<Floats4> v, std::size_t z) {
    const Floats4 d;
    return hn::TableLookupLanes(v, hn::IndicesFromVec(d, hn::Load(hn::RebindToSigned<Floats4>(), kAxes[z])));
}
HWY_INLINE float largest_of_three(hn::Vec<Floats4> v) {
    return hn::GetLane(hn::Max(v, hn::Max(permuted(v, 0), permuted(v, 1))));
}
HWY_INLINE unsigned bits_of_three(hn::Mask<Floats4> mask) { return bits(WideMask<Floats4>{mask}) & 7u; }

// A ray in the space of a BLAS, in double. The fourth lanes are ignored.
struct RayInSpace {
    hn::Vec<Doubles4> origin, direction;
    float origin_error = 0, direction_error = 0;  // bounds on the error of each coordinate: see RayFrame
};

HWY_INLINE RayInSpace ray_in_world(const Ray& ray) {
    return {load_from<offsetof(Ray, origin)>(ray), load_from<offsetof(Ray, direction)>(ray)};
}
HWY_INLINE RayInSpace ray_in_space(const RayFrame& frame) {
    RayInSpace ray = ray_in_world(frame.ray);
    ray.origin_error = static_cast<float>(smaller(frame.origin_error, 0x1p100));
    ray.direction_error = static_cast<float>(smaller(frame.direction_error, 0x1p100));
    return ray;
}

// The inverse of a matrix. `error` bounds the error of its product with a vector, divided by the largest coordinate of
// the vector.
struct InverseMatrix {
    hn::Vec<Doubles4> columns[3];
    double error;
};

// Returns the inverse of the matrix with these rows, whose fourth lanes are ignored. Its columns are the cross products
// of the rows, divided by the determinant. The bound on the error is that of inverse_error(). With the sums K of the
// magnitudes of the products in a cofactor, and P of those in the determinant, it is 24 u (P / |det|) times the largest
// sum of K / |det| in a row. It is infinite if the determinant is uncertain.
//
// Unlike in inverse_error() the matrix isn't scaled, so products may underflow, by 2^-1074 each. The entries are below
// 2^200 here and |det| exceeds 2^-800. So the determinant is off by less than 2^-870 for that, which is far less than u
// |det|. Some K is at least 2^-1002, so u K is larger than what a cofactor is off by.
HWY_INLINE InverseMatrix inverse_of(const hn::Vec<Doubles4> (&rows)[3]) {
    const Doubles4 d;
    alignas(32) static constexpr std::int64_t kNext[4] = {1, 2, 0, 3}, kLast[4] = {2, 0, 1, 3};
    const auto next = hn::SetTableIndices(d, kNext), last = hn::SetTableIndices(d, kLast);
    const auto largest = [&](hn::Vec<Doubles4> v) HWY_ATTR {
        return hn::GetLane(hn::Max(v, hn::Max(hn::TableLookupLanes(v, next), hn::TableLookupLanes(v, last))));
    };
    const auto sum = [&](hn::Vec<Doubles4> v) HWY_ATTR {
        return hn::GetLane(hn::Add(v, hn::Add(hn::TableLookupLanes(v, next), hn::TableLookupLanes(v, last))));
    };
    // Compute the cofactors, and their sums of magnitudes.
    InverseMatrix inverse;
    hn::Vec<Doubles4> size[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const auto a = rows[(i + 1) % 3], b = rows[(i + 2) % 3];
        const auto left = hn::Mul(hn::TableLookupLanes(a, next), hn::TableLookupLanes(b, last));
        const auto right = hn::Mul(hn::TableLookupLanes(a, last), hn::TableLookupLanes(b, next));
        inverse.columns[i] = hn::Sub(left, right);
        size[i] = hn::Add(hn::Abs(left), hn::Abs(right));
    }
    // Divide by the determinant.
    const double det = sum(hn::Mul(rows[0], inverse.columns[0])), permanent = sum(hn::Mul(hn::Abs(rows[0]), size[0]));
    for (auto& column : inverse.columns) column = hn::Div(column, hn::Set(d, det));
    // Compute the bound.
    const double row_sum = largest(hn::Add(size[0], hn::Add(size[1], size[2])));
    const double entry = largest(hn::Max(hn::Abs(rows[0]), hn::Max(hn::Abs(rows[1]), hn::Abs(rows[2]))));
    const bool is_certain = std::abs(det) > 32 * kRoundoff * permanent + 0x1p-800 && entry < 0x1p200;
    inverse.error = is_certain ? 24 * kRoundoff * (permanent / std::abs(det)) * (row_sum / std::abs(det)) : kInfinity;
    return inverse;
}

// Returns the matrix from world to object space, as RayFrame uses it but for rounding. Sets `translation` to that of
// the matrix from object to world space.
HWY_INLINE InverseMatrix object_from_world(const flat::Instance& instance, double time, Vec3& translation) {
    const Doubles4 d;
    const auto row = [&](const Transform& m, std::size_t i) HWY_ATTR { return hn::LoadU(d, m.rows[i].data()); };
    if (HWY_UNLIKELY(instance.moving)) {
        // Interpolate, with the operations of interpolate(), and invert.
        const double t1 = larger(0.0, smaller(1.0, time));
        hn::Vec<Doubles4> rows[3];
        alignas(32) double ends[3][4];
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at0 = row(instance.world_from_object0, i), at1 = row(instance.world_from_object1, i);
            rows[i] = hn::Add(hn::Mul(hn::Set(d, 1 - t1), at0), hn::Mul(hn::Set(d, t1), at1));
            hn::Store(rows[i], d, ends[i]);
        }
        translation = {ends[0][3], ends[1][3], ends[2][3]};
        return inverse_of(rows);
    }
    // Transpose the inverse that is stored.
    translation = instance.world_from_object0.translation();
    const auto row0 = row(instance.object_from_world, 0), row1 = row(instance.object_from_world, 1),
               row2 = row(instance.object_from_world, 2);
    const auto even01 = hn::InterleaveLower(d, row0, row1), odd01 = hn::InterleaveUpper(d, row0, row1);
    const auto even2 = hn::InterleaveLower(d, row2, row2), odd2 = hn::InterleaveUpper(d, row2, row2);
    return {{hn::ConcatLowerLower(d, even2, even01), hn::ConcatLowerLower(d, odd2, odd01),
             hn::ConcatUpperUpper(d, even2, even01)},
            instance.object_from_world_error.error};
}

// Returns a ray in world space as it is in the space of an instance. The bounds on its errors are those of RayFrame,
// rounded up.
HWY_INLINE RayInSpace ray_in_instance(const Ray& ray, const flat::Instance& instance) {
    const Doubles4 d;
    Vec3 translation;
    const InverseMatrix m = object_from_world(instance, ray.time, translation);
    const Vec3 v = (ray.origin - Point3{}) - translation;
    const auto transformed = [&](const Vec3& a) HWY_ATTR {
        const auto x = hn::Mul(m.columns[0], hn::Set(d, a.x)), y = hn::Mul(m.columns[1], hn::Set(d, a.y));
        return hn::Add(hn::Add(x, y), hn::Mul(m.columns[2], hn::Set(d, a.z)));
    };
    const auto bound = [&](const Vec3& a) {
        return static_cast<float>(smaller(m.error * (1 + 0x1p-20) * max_abs(a) + 0x1p-120, 0x1p100));
    };
    return {transformed(v), transformed(ray.direction), bound(v), bound(ray.direction)};
}

// The distance, in extents of a BLAS, up to which an ordinary ray may start. It is larger in instances, because nearly
// all rays start far from an instance.
inline constexpr float kFar = 8, kFarInside = 256;

// Makes the WalkRay of a ray. t_min, t_max and time are those of `limits`. If kIsExact, the ray's errors are 0. Returns
// false if the ray is not ordinary:
//   - its direction is too long or too short;
//   - it starts more than `far` extents away;
//   - t_min is negative;
//   - or it is unusable.
template <unsigned kKinds, bool kIsExact = false>
HWY_INLINE bool set_up(const RayInSpace& ray, const Ray& limits, const flat::Blas& blas, float far, WalkRay& out) {
    const Doubles4 wide;
    const Floats4 d;
    const auto all = [&](float x) HWY_ATTR { return hn::Set(d, x); };
    // Round to float. Check that the ray is ordinary; a NaN fails the comparisons.
    const auto high = hn::DemoteTo(d, ray.origin), along = hn::DemoteTo(d, ray.direction);
    const auto size = hn::Abs(along), from = hn::Abs(high);
    const auto extent = static_cast<float>(blas.extent);
    const unsigned fits = bits_of_three(hn::And(hn::Lt(size, all(0x1p10f)), hn::Lt(from, all((far - 1) * extent))));
    const unsigned is_long = bits_of_three(hn::Gt(size, all(0x1p-10f)));
    const bool is_usual = limits.t_min >= 0 && limits.t_min <= limits.t_max && limits.t_min < 0x1p100;
    if (HWY_UNLIKELY(fits != 7 || is_long == 0 || !is_usual || !(std::abs(limits.time) < kInfinity) || blas.scale != 1))
        return false;
    // Find the longest axis, and how far the errors may move the ray.
    const std::size_t z = kLongest[bits_of_three(hn::Gt(permuted(size, 0), size))];
    const float reach = largest_of_three(from) + extent;
    const auto inverse = hn::Div(all(1.0f), hn::CopySign(hn::Max(size, all(WalkRay::kLeast)), along));
    const auto inverse_z = hn::Broadcast<2>(permuted(inverse, z));
    const float shortest_inverse = std::abs(hn::GetLane(inverse_z));
    const float origin_error = kIsExact ? 0 : ray.origin_error * (1 + 0x1p-20f);
    const float direction_error = kIsExact ? 0 : 2 * ray.direction_error * shortest_inverse;
    const float moved = 2 * (origin_error + 2 * direction_error * reach);
    if (!kIsExact && HWY_UNLIKELY(!(direction_error < 0x1p-10f && moved + WalkRay::kWider * reach < reach)))
        return false;
    // Set the numbers for boxes.
    const auto wider = hn::Mul(hn::Add(from, all(extent)), all(WalkRay::kWider));
    const auto widening = hn::Mul(kIsExact ? wider : hn::Add(wider, all(moved)), hn::Abs(inverse));
    hn::Store(inverse, d, out.inverse);
    hn::Store(hn::NegMulSub(high, inverse, widening), d, out.near_shift);
    hn::Store(hn::NegMulAdd(high, inverse, widening), d, out.far_shift);
    out.octant = bits_of_three(hn::MaskFromVec(hn::And(along, hn::SignBit(d))));
    out.t_min = static_cast<float>(limits.t_min) + 0.0f;  // not -0
    out.excludes_behind = true;
    // Set the numbers for leaves. The origin is the sum of `high` and `low`.
    const auto low = hn::DemoteTo(d, hn::Sub(ray.origin, hn::PromoteTo(wide, high)));
    const float rounding = 0x1p-44f * reach + 0x1p-45f, least = kIsExact ? rounding : 4 * origin_error + rounding;
    if constexpr ((kKinds & flat::kPlanarKinds) != 0) {
        const auto low_p = permuted(low, z), shear = hn::Mul(permuted(along, z), inverse_z);
        const float relative = 16 * 0x1p-24f + (kIsExact ? 0 : 4.04f * direction_error);
        const float absolute = least + 4 * blas.packed_error;
        const float farthest = relative * 2 * reach + absolute, slope = 4.001f * farthest;
        hn::Store(permuted(high, z), d, out.planar);
        hn::Store(low_p, d, out.planar + 4);
        hn::Store(shear, d, out.planar + 8);
        hn::Store(hn::NegMulAdd(shear, hn::Broadcast<2>(low_p), low_p), d, out.planar + 12);
        out.planar[3] = relative;
        out.planar[7] = absolute;
        out.planar[10] = -hn::GetLane(inverse_z);
        out.planar[11] = 4 * direction_error;
        out.planar[14] = slope;
        out.planar[15] = slope * farthest;
        for (std::size_t a = 0; a < 3; ++a) out.rows[a] = static_cast<std::uint32_t>(kAxes[z][a]);
    }
    if constexpr ((kKinds & flat::kRoundKinds) != 0) {
        const auto squares = hn::Mul(along, along);
        const auto two = hn::Add(squares, permuted(squares, 0));
        hn::Store(high, d, out.round);
        hn::Store(low, d, out.round + 4);
        hn::Store(along, d, out.round + 8);
        out.round[3] = 1 / hn::GetLane(hn::Add(two, permuted(squares, 1)));
        out.round[7] = shortest_inverse * (1 + 0x1p-20f);
        out.round[11] = 48 * 0x1p-24f + (kIsExact ? 0 : 16 * direction_error);
        out.round[12] = least;
    }
    return true;
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#endif
