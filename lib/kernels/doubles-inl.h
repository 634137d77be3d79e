// Vectors of doubles, and points and directions made of them, with the operations of lib/core in the same order.
// Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_DOUBLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_DOUBLES_INL_H
#undef LIMN_KERNELS_DOUBLES_INL_H
#else
#define LIMN_KERNELS_DOUBLES_INL_H
#endif

#include <hwy/highway.h>

#include "kernels/lobes.h"
#include "limn/core/vec.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using W = hn::Vec<Doubles>;
using Where = hn::Mask<Doubles>;

HWY_INLINE W all(double x) { return hn::Set(Doubles(), x); }
HWY_INLINE W choose(Where where, W yes, W no) { return hn::IfThenElse(where, yes, no); }
HWY_INLINE bool any(Where where) { return !hn::AllFalse(Doubles(), where); }
HWY_INLINE W squared(W x) { return x * x; }

HWY_INLINE W LoadLane(const double* from) { return hn::LoadU(Doubles(), from); }
HWY_INLINE void StoreLane(W x, double* to) { hn::StoreU(x, Doubles(), to); }

struct W3 {
    W x, y, z;
};

HWY_INLINE W3 LoadLane(const Lanes3& lanes, std::size_t i) {
    return {LoadLane(lanes.x + i), LoadLane(lanes.y + i), LoadLane(lanes.z + i)};
}
HWY_INLINE void StoreLane(const W3& v, Lanes3& lanes, std::size_t i) {
    StoreLane(v.x, lanes.x + i), StoreLane(v.y, lanes.y + i), StoreLane(v.z, lanes.z + i);
}

HWY_INLINE W3 operator+(const W3& a, const W3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE W3 operator-(const W3& a, const W3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE W3 operator*(W s, const W3& a) { return {s * a.x, s * a.y, s * a.z}; }
HWY_INLINE W3 operator*(const W3& a, const W3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
HWY_INLINE W3 operator/(const W3& a, W s) { return {a.x / s, a.y / s, a.z / s}; }
HWY_INLINE W3 operator-(const W3& a) { return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)}; }
HWY_INLINE W3 abs(const W3& a) { return {hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)}; }
HWY_INLINE W dot(const W3& a, const W3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE W length_squared(const W3& a) { return dot(a, a); }
HWY_INLINE W3 cross(const W3& a, const W3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE W3 choose(Where where, const W3& yes, const W3& no) {
    return {choose(where, yes.x, no.x), choose(where, yes.y, no.y), choose(where, yes.z, no.z)};
}
HWY_INLINE W3 all(const Vec3& a) { return {all(a.x), all(a.y), all(a.z)}; }

// Where limn::normalize divides by the length at once; elsewhere it is not for vectors.
HWY_INLINE Where is_ordinary(W squared_length) {
    return hn::And(hn::Gt(squared_length, all(1e-200)), hn::Lt(squared_length, all(1e200)));
}
HWY_INLINE W3 normalize(const W3& a) { return a / hn::Sqrt(dot(a, a)); }

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
