// Loads and stores between rows and vectors. The include guard is per target, as Highway requires.
#if defined(LIMN_MATH_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_ROWS_INL_H
#undef LIMN_MATH_ROWS_INL_H
#else
#define LIMN_MATH_ROWS_INL_H
#endif

#include "math/compress-inl.h"
#include "math/rows.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// Returns the elements i to i + kLanes<N> - 1 of the rows.
template <class N, std::size_t n>
HWY_INLINE Vector<N> load3(const sampling::Rows3Of<n>& rows, std::size_t i) {
    return {load<N>(rows.x + i), load<N>(rows.y + i), load<N>(rows.z + i)};
}
// Stores all lanes of v from element i on.
template <class N, std::size_t n>
HWY_INLINE void store3(const Vector<N>& v, sampling::Rows3Of<n>& rows, std::size_t i) {
    store(v.x, rows.x + i);
    store(v.y, rows.y + i);
    store(v.z, rows.z + i);
}

// Stores the lanes that `kept` selects from element i on. Up to kSlack elements behind them are overwritten with
// unspecified numbers.
template <std::size_t n>
HWY_INLINE void compress3(const Vector<Doubles>& v, const Compress<Doubles>& kept, sampling::Rows3Of<n>& rows,
                          std::size_t i) {
    store3<Doubles>({kept(v.x), kept(v.y), kept(v.z)}, rows, i);
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
