// Implements the queries for batches of rays and points. The batches without a filter of closest_hit and any_hit are in
// compiled_scene.cpp.
#include <atomic>
#include <vector>

#include "limn/query/compiled_scene.h"
#include "math/float_environment.h"
#include "query/filters.h"
#include "query/results.h"
#include "query/threads.h"

namespace limn {

using query::check_length, query::for_all_parts, query::kPart;

namespace {

// Calls work(i) for each usable ray i and refuse(i) for each unusable one. Returns the number of unusable rays.
template <class Work, class Refuse>
std::size_t for_each_ray(std::span<const Ray> rays, int threads, const char* who, const Work& work,
                         const Refuse& refuse) {
    std::atomic<std::size_t> unusable = 0;
    for_all_parts(rays.size(), threads, who, [&](std::size_t first, std::size_t count) {
        const FloatEnvironment environment;
        for (std::size_t i = first; i < first + count; ++i) {
            if (query::is_fit(rays[i])) {
                work(i);
            } else {
                refuse(i);
                ++unusable;
            }
        }
    });
    return unusable;
}

// Calls work(i) for each point i.
template <class Work>
void for_each_point(std::size_t count, int threads, const char* who, const Work& work) {
    for_all_parts(count, threads, who, [&](std::size_t first, std::size_t some) {
        for (std::size_t i = first; i < first + some; ++i) work(i);
    });
}

// Returns the filter of ray i. `all` is the checked filter of the whole batch.
trace::Filter filter_of(trace::Filter all, const RayFilter& filter, std::size_t i) {
    if (!filter.without_each.empty()) all.without = filter.without_each[i];
    return all;
}

// Converts the filter of a batch of `rays` rays.
// \throws ArgumentError if the filter does not fit the scene or the batch; the message begins with `who`
trace::Filter checked(const flat::Scene& scene, const RayFilter& filter, std::size_t rays, const char* who) {
    if (!filter.without_each.empty() && filter.without_each.size() != rays)
        throw ArgumentError(std::string(who) + ": filter.without_each must be empty or as long as there are rays");
    return query::checked(scene, filter, who);
}

}  // namespace

std::size_t CompiledScene::closest_hit(std::span<const Ray> rays, const RayFilter& filter, std::span<RayHit> hits,
                                       int threads) const {
    check_length(rays.size(), hits.size(), "closest_hit: rays and hits differ in length");
    const trace::Filter all = checked(*scene_, filter, rays.size(), "closest_hit");
    return for_each_ray(
        rays, threads, "closest_hit",
        [&](std::size_t i) {
            const trace::Hit hit = trace::closest_hit(*scene_, rays[i], filter_of(all, filter, i));
            hits[i] = hit.primitive == kNoPrimitive ? RayHit{} : query::complete(*scene_, hit);
        },
        [&](std::size_t i) { hits[i] = {}; });
}

std::size_t CompiledScene::any_hit(std::span<const Ray> rays, const RayFilter& filter, std::span<std::uint8_t> occluded,
                                   int threads) const {
    check_length(rays.size(), occluded.size(), "any_hit: rays and occluded differ in length");
    const trace::Filter all = checked(*scene_, filter, rays.size(), "any_hit");
    return for_each_ray(
        rays, threads, "any_hit",
        [&](std::size_t i) { occluded[i] = trace::any_hit(*scene_, rays[i], filter_of(all, filter, i)) ? 1 : 0; },
        [&](std::size_t i) { occluded[i] = 0; });
}

std::size_t CompiledScene::all_hits(std::span<const Ray> rays, RayHits& hits, int threads) const {
    // Collect the hits of each part of the batch, and store the number of hits of ray i in hits.first[i + 1].
    const std::size_t part = threads == 1 ? std::max<std::size_t>(rays.size(), 1) : kPart;
    std::vector<std::vector<RayHit>> parts((rays.size() + part - 1) / part);
    hits.first.assign(rays.size() + 1, 0);
    std::atomic<std::size_t> unusable = 0;
    for_all_parts(rays.size(), threads, "all_hits", [&](std::size_t first, std::size_t count) {
        std::vector<RayHit> of_ray;
        std::vector<RayHit>& here = parts[first / part];
        for (std::size_t i = first; i < first + count; ++i) {
            if (!query::is_fit(rays[i])) ++unusable;
            all_hits(rays[i], of_ray);
            here.insert(here.end(), of_ray.begin(), of_ray.end());
            hits.first[i + 1] = of_ray.size();
        }
    });
    // Sum up the numbers of hits, and concatenate the hits of all parts.
    for (std::size_t i = 0; i < rays.size(); ++i) hits.first[i + 1] += hits.first[i];
    hits.hits.clear();
    hits.hits.reserve(hits.first.back());
    for (const std::vector<RayHit>& here : parts) hits.hits.insert(hits.hits.end(), here.begin(), here.end());
    return unusable;
}

std::size_t CompiledScene::count_intersections(std::span<const Ray> rays, std::span<std::uint64_t> counts,
                                               int threads) const {
    check_length(rays.size(), counts.size(), "count_intersections: rays and counts differ in length");
    return for_each_ray(
        rays, threads, "count_intersections",
        [&](std::size_t i) { counts[i] = trace::passages(*scene_, rays[i], false, nullptr).count; },
        [&](std::size_t i) { counts[i] = 0; });
}

void CompiledScene::locate(std::span<const Point3> points, std::span<PointLocation> locations, int threads) const {
    check_length(points.size(), locations.size(), "locate: points and locations differ in length");
    for_each_point(points.size(), threads, "locate", [&](std::size_t i) { locations[i] = locate(points[i]); });
}

void CompiledScene::contains(std::span<const Point3> points, std::span<std::uint8_t> inside, int threads) const {
    check_length(points.size(), inside.size(), "contains: points and inside differ in length");
    for_each_point(points.size(), threads, "contains", [&](std::size_t i) { inside[i] = contains(points[i]) ? 1 : 0; });
}

void CompiledScene::closest_point(std::span<const Point3> points, std::span<ClosestPoint> nearest, int threads) const {
    check_length(points.size(), nearest.size(), "closest_point: points and nearest differ in length");
    for_each_point(points.size(), threads, "closest_point",
                   [&](std::size_t i) { nearest[i] = closest_point(points[i]).value_or(ClosestPoint{}); });
}

void CompiledScene::signed_distance(std::span<const Point3> points, std::span<double> distances, int threads) const {
    check_length(points.size(), distances.size(), "signed_distance: points and distances differ in length");
    for_each_point(points.size(), threads, "signed_distance",
                   [&](std::size_t i) { distances[i] = signed_distance(points[i]); });
}

}  // namespace limn
