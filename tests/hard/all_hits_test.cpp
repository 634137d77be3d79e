// Every hit along a ray: against exact arithmetic for meshes, and for all else against asking again and again.
#include "hard/exact_mesh.h"
#include "hard/query_meshes.h"

namespace limn::all_hits_test {

using namespace test;

namespace {

bool by_t(const RayHit& a, const RayHit& b) { return a.t < b.t || (a.t == b.t && a.primitive < b.primitive); }

// Where t lies beside an end of the interval by less than it may be off, the reported one decides.
bool is_beside_an_end(const Ray& ray, Real t) {
    const auto is_beside = [&](double end) {
        return std::isfinite(end) && absolute(t - Real(end)) <= Real(0x1p-22) * absolute(t) + Real(0x1p-1050);
    };
    return is_beside(ray.t_min) || is_beside(ray.t_max);
}

void judge_all_hits(Tally& tally, const CompiledScene& scene, const ExactMesh& exact, const Ray& ray) {
    ++tally.rays, ++tally.judged;
    const std::vector<RayHit> hits = scene.all_hits(ray);
    if (!std::is_sorted(hits.begin(), hits.end(), by_t)) tally.fault(ray, "not sorted");
    const auto closest = scene.closest_hit(ray);
    if (closest.has_value() != !hits.empty() ||
        (closest && (closest->t != hits[0].t || closest->primitive != hits[0].primitive)))
        tally.fault(ray, "the first is not the closest");
    std::vector<int> found(exact.size(), 0);
    for (const RayHit& hit : hits) ++found[hit.primitive];
    Ray endless = ray;
    endless.t_min = -kInfinity, endless.t_max = kInfinity;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        if (found[i] == 0 && exact.passes_by(i, ray)) continue;
        const ExactHit truth = exact.hit_of(i, endless);
        const bool is_within = truth.hit && truth.t > Real(ray.t_min) && truth.t <= Real(ray.t_max);
        if (truth.hit && is_beside_an_end(ray, truth.t)) {
            if (found[i] > 1) tally.fault(ray, "twice");
        } else if (found[i] != (is_within ? 1 : 0)) {
            tally.fault(ray, "element " + std::to_string(i) + " found " + std::to_string(found[i]) + " times");
        }
        if (truth.hit) ++tally.hits;
    }
    for (const RayHit& hit : hits) {
        const ExactHit truth = exact.hit_of(hit.element, endless);
        const std::string fault = detail::fault_of(truth, Answer{hit.t, hit.u, hit.v, hit.element}, {});
        if (!fault.empty()) tally.fault(ray, fault);
    }
}

// One by one, as the described object answers.
std::vector<RayHit> walk(const Hittable& object, Ray ray) {
    std::vector<RayHit> hits;
    while (const auto hit = object.hit(ray)) {
        hits.push_back({.t = hit->t, .primitive = hit->element});
        ray.t_min = hit->t;
    }
    return hits;
}

}  // namespace

TEST_CASE("All hits of meshes: random, vertex, edge and in-plane rays meet exactly the triangles that they meet",
          "[hard][all-hits]") {
    Random random(601);
    for (const QueryMesh& mesh : query_meshes(random)) {
        const CompiledScene scene = compiled_mesh(mesh.data);
        const ExactMesh exact(mesh.data);
        Tally tally;
        for (int i = 0; i < count(1e7 / 50); ++i) judge_all_hits(tally, scene, exact, query_ray(random, mesh.data));
        check(tally, mesh.name);
        CHECK(tally.hits > tally.rays);
    }
}

TEST_CASE("All hits: as if each object was asked again and again, for every kind of shape, listed and in trees",
          "[hard][all-hits]") {
    Random random(602);
    for (const std::size_t count_of_shapes : {1u, 20u, 100u}) {
        std::vector<Object> objects;
        for (std::size_t i = 0; i < count_of_shapes; ++i) {
            const Object shape = i % 6 == 5 ? std::make_shared<Disk>(Point3{} + random.in_cube(5), random.unit(),
                                                                     random.log_uniform(1, 3), nullptr)
                                            : random_shape(random, i % 5);
            objects.push_back(i % 4 == 3 ? random_instance(random, shape) : shape);
        }
        if (count_of_shapes == 100) objects.push_back(ball({0, -1e3, 0}, 998));  // listed beside the tree
        const ZooScene zoo = zoo_of("shapes", objects);
        const CompiledScene scene = compile(zoo.scene);
        Tally tally;
        for (int n = 0; n < count(1e6) / 5; ++n) {
            const Ray ray = random_ray(random, zoo.targets);
            ++tally.rays, ++tally.judged;
            std::size_t expected = 0;
            const std::vector<RayHit> hits = scene.all_hits(ray);
            for (std::uint32_t o = 0; o < objects.size(); ++o) {
                std::vector<RayHit> own;
                std::ranges::copy_if(hits, std::back_inserter(own), [&](const RayHit& h) { return h.object == o; });
                const std::vector<RayHit> truth = walk(*objects[o], ray);
                // A walk passes over what is met at the same t.
                std::size_t next = 0;
                for (const RayHit& hit : own) {
                    if (next < truth.size() && hit.t > truth[next].t) ++next;
                    if (next == truth.size() || hit.t != truth[next].t) tally.fault(ray, "another t");
                }
                if (!truth.empty() && (own.empty() || next + 1 != truth.size())) tally.fault(ray, "lost");
                expected += truth.size();
            }
            tally.hits += expected;
        }
        check(tally, number(static_cast<double>(count_of_shapes)) + " shapes");
        CHECK(tally.hits > tally.rays / 2);
    }
}

TEST_CASE("All hits: a touched sphere once, the boundaries of media flagged, an unusable ray nothing",
          "[hard][all-hits]") {
    Scene scene;
    scene.add(ball({0, 0, 0}, 1));
    scene.add(std::make_shared<ConstantMedium>(ball({0, 0, 0}, 2), 1, Color{1, 1, 1}));
    const CompiledScene compiled = compile(scene);
    const auto through = compiled.all_hits(towards({-4, 0, 0}, {1, 0, 0}));
    REQUIRE(through.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(through[i].t == 2.0 + static_cast<double>(i) + (i > 1 ? 1 : 0));
        CHECK(through[i].index_matched == (i == 0 || i == 3));
        CHECK(through[i].object == (i == 0 || i == 3 ? 1u : 0u));
    }
    const auto touched = compiled.all_hits(towards({-4, 1, 0}, {1, 0, 0}));
    REQUIRE(touched.size() == 3);
    CHECK((touched[1].t == 4 && touched[1].object == 0));
    for (const Ray& ray : unusable_rays()) CHECK(compiled.all_hits(ray).empty());
}

}  // namespace limn::all_hits_test
