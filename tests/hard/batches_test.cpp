// Batches on threads, against single queries.
#include "hard/query_meshes.h"
#include "limn/math/error.h"

namespace limn::batches_test {

using namespace test;

TEST_CASE("Batches: on any number of threads as one by one, unusable rays counted", "[hard][filters]") {
    Random random(633);
    const ZooScene zoo = zoo_to_filter(random);
    const CompiledScene scene = compile(zoo.scene);
    std::vector<Ray> rays = unusable_rays();
    while (rays.size() < 5003) rays.push_back(random_ray(random, zoo.targets));
    const std::size_t n = rays.size(), unusable = unusable_rays().size();
    std::vector<std::uint64_t> without(n), counts(n, 7), counts_of_rest(n, 7);
    for (std::size_t i = 0; i < n; ++i) without[i] = random.index(scene.stats().primitives);
    const RayFilter filter{.without_each = without};
    Tally tally;
    for (const int threads : {1, 0, 3}) {
        std::vector<RayHit> hits(n, RayHit{.t = 7}), filtered(n, RayHit{.t = 7});
        std::vector<std::uint8_t> occluded(n, 7), occluded_by_rest(n, 7);
        RayHits all, rest;
        CHECK(scene.closest_hit(rays, hits, threads) == unusable);
        CHECK(scene.closest_hit(rays, filtered, threads, filter) == unusable);
        CHECK(scene.any_hit(rays, occluded, threads) == unusable);
        CHECK(scene.any_hit(rays, occluded_by_rest, threads, filter) == unusable);
        CHECK(scene.all_hits(rays, all, threads) == unusable);
        CHECK(scene.all_hits(rays, rest, threads, filter) == unusable);
        CHECK(scene.count_intersections(rays, counts, threads) == unusable);
        CHECK(scene.count_intersections(rays, counts_of_rest, threads, filter) == unusable);
        REQUIRE((all.first.size() == n + 1 && all.first.back() == all.hits.size()));
        for (std::size_t i = 0; i < n; ++i) {
            ++tally.rays, ++tally.judged;
            const auto judge_hit = [&](const std::optional<RayHit>& single, const RayHit& hit,
                                       std::uint8_t occluded_i) {
                if (single ? !same(*single, hit) : hit.t != kInfinity) tally.fault(rays[i], "closest");
                if (occluded_i != (single ? 1 : 0)) tally.fault(rays[i], "any");
            };
            judge_hit(scene.closest_hit(rays[i]), hits[i], occluded[i]);
            if (!std::ranges::equal(scene.all_hits(rays[i]), all.of(i), same)) tally.fault(rays[i], "all");
            if (counts[i] != scene.count_intersections(rays[i])) tally.fault(rays[i], "count");
            const RayFilter own{.without = without[i]};
            judge_hit(scene.closest_hit(rays[i], own), filtered[i], occluded_by_rest[i]);
            if (!std::ranges::equal(scene.all_hits(rays[i], own), rest.of(i), same)) tally.fault(rays[i], "rest");
            if (counts_of_rest[i] != scene.count_intersections(rays[i], own)) tally.fault(rays[i], "count of rest");
        }
    }
    check(tally, "rays");
    std::vector<RayHit> too_few(n - 1);
    CHECK_THROWS_AS(scene.closest_hit(rays, too_few), ArgumentError);
    CHECK_THROWS_AS(scene.count_intersections(rays, counts, -1), ArgumentError);
    CHECK_THROWS_AS(scene.count_intersections(rays, counts, 1025), ArgumentError);
    without.pop_back();
    std::vector<RayHit> hits(n);
    CHECK_THROWS_AS(scene.closest_hit(rays, hits, 1, {.without_each = without}), ArgumentError);
    RayHits none;
    CHECK(scene.all_hits(std::span<const Ray>{}, none, 0) == 0);
    CHECK((none.hits.empty() && none.first.size() == 1));
}

TEST_CASE("Batches of points: on any number of threads as one by one", "[hard][filters]") {
    Random random(634);
    const MeshData data = icosphere(3);
    const CompiledScene scene = compiled_mesh(data);
    std::vector<Point3> points;
    while (points.size() < 3001) points.push_back(point_of(random, data, random.index(3)) + random.in_cube(0.1));
    const std::size_t n = points.size();
    int differing = 0;
    for (const int threads : {1, 0, 2}) {
        std::vector<PointLocation> locations(n);
        std::vector<std::uint8_t> inside(n, 7);
        std::vector<ClosestPoint> nearest(n);
        std::vector<double> distances(n);
        scene.locate(points, locations, threads);
        scene.contains(points, inside, threads);
        scene.closest_point(points, nearest, threads);
        scene.signed_distance(points, distances, threads);
        for (std::size_t i = 0; i < n; ++i) {
            differing += locations[i].winding_number != scene.locate(points[i]).winding_number;
            differing += inside[i] != (scene.contains(points[i]) ? 1 : 0);
            const auto single = scene.closest_point(points[i]);
            differing += single->distance != nearest[i].distance || single->primitive != nearest[i].primitive;
            differing += distances[i] != scene.signed_distance(points[i]);
        }
    }
    CHECK(differing == 0);
    std::vector<double> short_one(n - 1);
    CHECK_THROWS_AS(scene.signed_distance(points, short_one), ArgumentError);
}

}  // namespace limn::batches_test
