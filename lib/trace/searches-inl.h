// The searches, of which each instruction set has its own. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_SEARCHES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_SEARCHES_INL_H
#undef LIMN_TRACE_SEARCHES_INL_H
#else
#define LIMN_TRACE_SEARCHES_INL_H
#endif

#include <hwy/highway.h>

#include "trace/queries.h"
#include "trace/traverse.h"

// The searches of one ray: X(name, Query) for each.
#undef LIMN_FOR_EACH_SEARCH
#define LIMN_FOR_EACH_SEARCH(X)                   \
    X(search_closest, Closest)                    \
    X(search_any, Any)                            \
    X(search_every, Every)                        \
    X(search_passages, Passages)                  \
    X(search_filtered_closest, Filtered<Closest>) \
    X(search_filtered_any, Filtered<Any>)         \
    X(search_filtered_every, Filtered<Every>)     \
    X(search_filtered_passages, Filtered<Passages>)

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// A BLAS of primitives, numbered from `first` on, against a ray.
#define LIMN_DECLARE_SEARCH(name, Query)                                                                       \
    void name(const flat::Scene& scene, BlasId id, const Ray& ray, const RayFrame& frame, std::uint64_t first, \
              Query& query);
LIMN_FOR_EACH_SEARCH(LIMN_DECLARE_SEARCH)
#undef LIMN_DECLARE_SEARCH

// The whole scene against up to kMostRays rays.
void search_closest_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Closest* queries);
void search_any_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Any* queries);

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
