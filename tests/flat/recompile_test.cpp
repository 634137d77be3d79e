// Scenes whose instances have moved: as if they had been compiled where they stand now.
#include <cstring>

#include "catch.h"
#include "flat/scene.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "support/pictures.h"

namespace limn::recompile_test {

using namespace test;

namespace {

// Objects, and of instances the place of each, to be described again elsewhere.
struct Description {
    std::vector<Object> objects;  // of an instance what it shows
    std::vector<std::optional<MovedObject>> places;

    void add(Object object) { objects.push_back(std::move(object)), places.emplace_back(); }
    void add(Object object, const Transform& m, const std::optional<Transform>& at_time1 = {}) {
        places.emplace_back(MovedObject{objects.size(), m, at_time1});
        objects.push_back(std::move(object));
    }
    Scene scene() const {
        Scene scene;
        scene.background = sky(0.5);
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const auto& place = places[i];
            scene.add(!place ? objects[i]
                             : std::make_shared<Instance>(objects[i], place->world_from_object,
                                                          place->at_time1.value_or(place->world_from_object)));
        }
        return scene;
    }
};

Description random_description(Random& random, std::size_t size) {
    MeshData data = icosphere(1, 2);
    data.triangles.push_back({0, 0, 1});  // without area
    const Object lamp_mesh = std::make_shared<Mesh>(icosphere(0, 0.5), std::vector{lamp(2)});
    const Object medium = std::make_shared<ConstantMedium>(ball({}, 1), 0.5, Color{1, 1, 1});
    Description d;
    if (random.chance(0.5)) d.add(std::make_shared<Mesh>(data, std::vector{grey(0.5)}));
    d.add(std::make_shared<HittableList>(std::vector<Object>{}), {});  // shows nothing
    const Object shared = random_object(random, 2);
    for (std::size_t i = 0; i < size; ++i) {
        const Transform m = random_pose(random);
        switch (random.index(6)) {
            case 0: d.add(random_object(random, 1)); break;
            case 1: d.add(random_object(random, 2), m, moved_pose(random, m)); break;
            case 2: d.add(lamp_mesh, m); break;
            case 3: d.add(medium, m); break;
            case 4: d.add(random_shape(random, random.index(5)), m); break;
            default: d.add(shared, m);
        }
    }
    return d;
}

// Other places for some of the instances that show something.
std::vector<MovedObject> move_some(Random& random, Description& d, const CompiledScene& compiled) {
    std::vector<MovedObject> moved;
    const flat::Scene& s = compiled.flat();
    for (std::size_t i = 0; i < d.objects.size(); ++i) {
        const std::uint64_t end = i + 1 < d.objects.size() ? s.first_of_object[i + 1] : s.primitives;
        if (!d.places[i] || end == s.first_of_object[i] || random.chance(0.4)) continue;
        const Transform m = random_pose(random);
        moved.push_back({i, m, random.chance(0.3) ? std::optional(moved_pose(random, m)) : std::nullopt});
        d.places[i] = moved.back();
    }
    return moved;
}

template <class Table>
bool same_bytes(const Table& a, const Table& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

void check_same(const CompiledScene& a, const CompiledScene& b) {
    CHECK(a.digest() == b.digest());
    CHECK(a.features() == b.features());
    CHECK(a.stats().stored_primitives == b.stats().stored_primitives);
    CHECK(a.stats().degenerate == b.stats().degenerate);
    CHECK(a.stats().lights == b.stats().lights);
    CHECK(a.stats().memory_bytes == b.stats().memory_bytes);
    const flat::Scene &s = a.flat(), &t = b.flat();
    CHECK(same_bytes(s.nodes, t.nodes));
    CHECK(same_bytes(s.lines, t.lines));
    CHECK(same_bytes(s.references, t.references));
    CHECK(same_bytes(s.lights.nodes, t.lights.nodes));
    CHECK(s.kinds == t.kinds);
    CHECK(s.list.planar == t.list.planar);
    CHECK(s.list.round == t.list.round);
    CHECK(s.media.size() == t.media.size());
}

void check_same_answers(const CompiledScene& a, const CompiledScene& b, const Scene& scene, Random& random) {
    ZooScene zoo{"moved", scene, {}};
    aim_at_boxes(zoo);
    for (int i = 0; i < 200; ++i) {
        const Ray ray = random_ray(random, zoo.targets);
        const auto x = a.closest_hit(ray), y = b.closest_hit(ray);
        REQUIRE(x.has_value() == y.has_value());
        CHECK(a.any_hit(ray) == y.has_value());
        if (!x) continue;
        CHECK(x->t == y->t);
        CHECK(x->primitive == y->primitive);
        CHECK(a.surface_at(ray, *x).position == b.surface_at(ray, *y).position);
    }
}

}  // namespace

TEST_CASE("Recompiling: a scene whose instances have moved is the one that was described so", "[compile][recompile]") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        Description d = random_description(random, seed % 4 == 0 ? 3 : 40);
        CompiledScene scene = compile(d.scene());
        for (int step = 0; step < 3; ++step) {
            const std::vector<MovedObject> moved = move_some(random, d, scene);
            scene = recompile(std::move(scene), moved);
            const CompiledScene anew = compile(d.scene());
            check_same(scene, anew);
            check_same_answers(scene, anew, d.scene(), random);
        }
    }
}

TEST_CASE("Recompiling: what cannot be moved is refused, and the scene stays as it is", "[compile][recompile]") {
    Description d;
    d.add(ball({}, 1));
    d.add(ball({}, 1), Transform::translate({3, 0, 0}));
    d.add(std::make_shared<HittableList>(std::vector<Object>{}), {});
    CompiledScene scene = compile(d.scene());
    const Hash128 before = scene.digest();
    const Transform flat = Transform::scale(1, 0, 1);
    const auto refused = [&](const std::vector<MovedObject>& moved, const std::string& message) {
        CHECK_THROWS_WITH(recompile(std::move(scene), moved), message);
        CHECK(scene.digest() == before);
        CHECK(scene.any_hit({{3, 0, 5}, {0, 0, -1}}));
    };
    refused({{3, {}}}, "recompile: object 3: there is no such object");
    refused({{0, {}}}, "recompile: object 0: it is no Instance of something");
    refused({{2, {}}}, "recompile: object 2: it is no Instance of something");
    refused({{1, {}}, {1, {}}}, "recompile: object 1 is moved twice");
    refused({{1, flat}}, "recompile: object 1: Instance: the matrix is singular");
    refused({{1, {}, Transform::scale(-1, 1, 1)}},
            "recompile: object 1: Instance: the moving transform is singular at some time of the shutter");
    scene = recompile(std::move(scene), std::vector<MovedObject>{{1, Transform::translate({0, 0, 9})}});
    CHECK_FALSE(scene.any_hit({{3, 0, 5}, {0, 0, -1}}));
    CHECK(scene.any_hit({{0, 0, 20}, {0, 0, -1}}));
}

}  // namespace limn::recompile_test
