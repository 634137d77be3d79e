// Rays that pass primitives over, against all hits with those taken out; and batches on threads, against single
// queries.
#include "hard/query_meshes.h"
#include "limn/math/error.h"

namespace limn::filters_test {

using namespace test;

TEST_CASE("Filters: as if all hits were found first and those passed over taken out", "[hard][filters]") {
    Random random(631);
    const ZooScene zoo = zoo_to_filter(random);
    const CompiledScene scene = compile(zoo.scene);
    std::vector<std::uint8_t> objects(zoo.scene.objects().size(), 1);
    Tally tally;
    std::uint64_t left_out = 0;
    for (int i = 0; i < count(1e7 / 10); ++i) {
        const Ray ray = random_ray(random, zoo.targets);
        const std::vector<RayHit> all = scene.all_hits(ray);
        RayFilter filter;
        if (random.chance(0.5) && !all.empty()) filter.without = all[random.index(all.size())].primitive;
        if (random.chance(0.5)) filter.faces = random.chance(0.5) ? Faces::front : Faces::back;
        if (random.chance(0.5)) {
            for (auto& o : objects) o = random.chance(0.7) ? 1 : 0;
            filter.objects = objects;
        }
        ++tally.rays, ++tally.judged;
        std::vector<RayHit> rest;
        bool is_grazing = false;
        for (const RayHit& hit : all) {
            Ray last = ray;  // a user-defined shape is asked once more, for its first hit
            last.t_min = std::nextafter(hit.t, -kInfinity);
            const Surface surface = scene.surface_at(last, hit);
            const bool is_front = surface.front_face;
            is_grazing = is_grazing || dot(Vec3(surface.normal), normalize(ray.direction)) > -1e-6;
            const bool is_side = filter.faces == Faces::both || (filter.faces == Faces::front) == is_front;
            if (hit.primitive != filter.without && is_side && (filter.objects.empty() || objects[hit.object]))
                rest.push_back(hit);
        }
        if (is_grazing && filter.faces != Faces::both) continue;  // where a sphere is touched both sides are met
        left_out += all.size() - rest.size();
        if (!std::ranges::equal(rest, scene.all_hits(ray, filter), same)) tally.fault(ray, "all hits");
        const auto closest = scene.closest_hit(ray, filter);
        if (closest.has_value() != !rest.empty() || (closest && !same(*closest, rest[0]))) tally.fault(ray, "closest");
        if (scene.any_hit(ray, filter) != !rest.empty()) tally.fault(ray, "any");
        if (closest) ++tally.hits;
        if (filter.faces == Faces::both) {
            std::vector<RayCrossing> every = scene.crossings(ray);
            std::erase_if(every, [&](const RayCrossing& c) {
                return c.primitive == filter.without || !(filter.objects.empty() || objects[c.object]);
            });
            if (!std::ranges::equal(every, scene.crossings(ray, filter), same)) tally.fault(ray, "crossings");
            if (scene.count_intersections(ray, filter) != every.size()) tally.fault(ray, "count");
            std::int64_t outward = 0;
            for (const RayCrossing& c : every) outward += c.inward ? -1 : 1;
            if (scene.winding_number(ray, filter) != outward) tally.fault(ray, "winding");
        }
    }
    check(tally, "filters");
    CHECK(left_out > tally.rays / 10);
    CHECK(tally.hits > tally.rays / 10);
    const std::vector<std::uint8_t> few(3, 1);
    CHECK_THROWS_AS(scene.any_hit(towards({0, 0, 0}, {1, 0, 0}), {.objects = few}), ArgumentError);
}

TEST_CASE("Filters: a ray that leaves the triangle it starts on, through its vertices and edges too",
          "[hard][filters]") {
    const MeshData data = icosphere(3);
    const CompiledScene scene = compiled_mesh(data);
    Random random(632);
    Tally tally;
    for (int i = 0; i < count(1e6); ++i) {
        const Ray in = towards(Point3{} + 3 * random.unit(), random.in_cube(0.3));
        const Ray ray{.origin = in.origin, .direction = Point3{} + random.in_cube(0.3) - in.origin};
        const auto first = scene.closest_hit(ray);
        if (!first) continue;
        ++tally.rays, ++tally.judged, ++tally.hits;
        const auto all = scene.all_hits(ray);
        const auto next = scene.closest_hit(ray, {.without = first->primitive});
        if (!next || next->primitive != all[1].primitive) tally.fault(ray, "not the second");
        const auto behind = scene.closest_hit(ray, {.faces = Faces::back});
        if (!behind || behind->t < first->t || scene.closest_hit(ray, {.faces = Faces::front})->t != first->t)
            tally.fault(ray, "faces");
    }
    check(tally, "leaving");
}

}  // namespace limn::filters_test
