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

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// A group of primitives, numbered from `first` on, against a ray.
void search_closest(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                    Closest& query);
void search_any(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                Any& query);
void search_every(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                  Every& query);
void search_passages(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                     Passages& query);
void search_filtered_closest(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame,
                             std::uint64_t first, Filtered<Closest>& query);
void search_filtered_any(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame,
                         std::uint64_t first, Filtered<Any>& query);
void search_filtered_every(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame,
                           std::uint64_t first, Filtered<Every>& query);
void search_filtered_passages(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame,
                              std::uint64_t first, Filtered<Passages>& query);

// The whole scene against up to kMostRays rays.
void search_closest_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Closest* queries);
void search_any_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Any* queries);

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
