// Declares the searches, which are compiled for each instruction set. The include guard is per target, as Highway
// requires.
#if defined(LIMN_TRACE_SEARCHES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_SEARCHES_INL_H
#undef LIMN_TRACE_SEARCHES_INL_H
#else
#define LIMN_TRACE_SEARCHES_INL_H
#endif

#include <hwy/highway.h>

#include "trace/queries.h"
#include "trace/traverse.h"

// Calls X(name, Query) for each search with one ray.
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

// Search the scene with a ray, and a BLAS with the ray of a frame. The primitives of the BLAS are numbered from `first`
// on.
#define LIMN_DECLARE_SEARCH(name, Query)                               \
    void name(const flat::Scene& scene, const Ray& ray, Query& query); \
    void name##_in(const flat::Scene& scene, BlasId id, const RayFrame& frame, std::uint64_t first, Query& query);
LIMN_FOR_EACH_SEARCH(LIMN_DECLARE_SEARCH)
#undef LIMN_DECLARE_SEARCH

// Search the scene with up to kMostRays rays.
void search_closest_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Closest* queries);
void search_any_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Any* queries);

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
