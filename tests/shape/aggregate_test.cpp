// HittableList and Bvh: the same hits, whatever they hold.
#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/shape/bvh.h"
#include "limn/scene/shape/constant_medium.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"
#include "support/meshes.h"
#include "support/random_geometry.h"
#include "support/tally.h"

namespace limn::aggregate_test {

using limn::test::Random;
using limn::test::Tally;
using Objects = std::vector<std::shared_ptr<const Hittable>>;

namespace {

// Counts as a user's own empty object does: no box, no hits.
class Nothing final : public Hittable {
public:
    Box bounds() const override { return {}; }
    std::optional<Hit> hit(const Ray&) const override { return std::nullopt; }
};

Objects random_objects(Random& random, std::size_t count) {
    Objects objects;
    for (std::size_t i = 0; i < count; ++i) {
        const Point3 p = Point3{} + random.in_cube(5);
        switch (random.index(4)) {
            case 0: objects.push_back(std::make_shared<Sphere>(p, random.uniform(0.1, 1), nullptr)); break;
            case 1: objects.push_back(std::make_shared<Sphere>(p, p + random.in_cube(2), 0.4, nullptr)); break;
            case 2:
                objects.push_back(std::make_shared<Triangle>(p, p + random.in_cube(2), p + random.in_cube(2), nullptr));
                break;
            default: objects.push_back(std::make_shared<Quad>(p, random.in_cube(2), random.in_cube(2), nullptr)); break;
        }
        if (random.chance(0.1)) objects.push_back(objects[random.index(objects.size())]);  // exact duplicates
    }
    return objects;
}

void compare(const Objects& objects, Random& random, int rays) {
    const HittableList list(objects);
    const Bvh bvh(objects);
    CHECK(bvh.bounds() == list.bounds());
    test::Targets targets{list.bounds(), {}};
    if (targets.region.is_empty()) targets.region = {{0, 0, 0}, {1, 1, 1}};
    for (const auto& object : objects)
        targets.points.push_back(object->bounds().is_empty() ? Point3{} : object->bounds().center());
    if (targets.points.empty()) targets.points.push_back({});
    Tally tally;
    for (int i = 0; i < rays; ++i) {
        const Ray ray = random_ray(random, targets);
        const auto a = list.hit(ray), b = bvh.hit(ray);
        if (a.has_value() != b.has_value() ||
            (a && (a->t != b->t || a->element != b->element || !(a->normal == b->normal))))
            tally.fault(ray, "list and Bvh differ");
        tally.hits += a.has_value();
    }
    INFO(objects.size() << " objects: " << tally.first);
    CHECK(tally.wrong == 0);
    CHECK((objects.size() < 20 || tally.hits > 0));
}

}  // namespace

TEST_CASE("Bvh: hit for hit the same as a list, for 0, 1, 2, 3 and 2^k +- 1 objects", "[shape][bvh]") {
    Random random(80);
    for (const std::size_t count :
         {0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 15u, 16u, 17u, 31u, 33u, 63u, 64u, 65u, 127u, 129u, 255u, 257u})
        compare(random_objects(random, count), random, 2000);
}

TEST_CASE("Bvh: hit for hit the same as a list with lists, meshes, media and empty objects in it", "[shape][bvh]") {
    Random random(81);
    Objects objects = random_objects(random, 20);
    objects.push_back(std::make_shared<Mesh>(test::icosphere(1, 2), nullptr));
    objects.push_back(std::make_shared<HittableList>(random_objects(random, 5)));
    objects.push_back(std::make_shared<Nothing>());
    objects.push_back(std::make_shared<HittableList>());
    objects.push_back(
        std::make_shared<ConstantMedium>(std::make_shared<Sphere>(Point3{1, 1, 1}, 2.0, nullptr), 1, Color{}));
    objects.push_back(std::make_shared<Bvh>(random_objects(random, 9)));
    compare(objects, random, 20000);
}

TEST_CASE("Bvh: a flat box far from the origin loses no ray", "[shape][bvh]") {
    Random random(82);
    // Axis-aligned quads at 1e5: their boxes have no thickness.
    Objects walls;
    for (int i = 0; i < 50; ++i)
        walls.push_back(
            std::make_shared<Quad>(Point3{1e5, static_cast<double>(i), 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, nullptr));
    const Bvh bvh(walls);
    int misses = 0;
    for (int i = 0; i < 50000; ++i) {
        const Point3 aim{1e5, random.uniform(0, 50), random.uniform(0, 1)};
        const Point3 origin =
            i % 2 ? Point3{1e5 - 10, aim.y, aim.z}
                  : aim + random.uniform(0.1, 100) * normalize(Vec3{-1, random.uniform(-1, 1), random.uniform(-1, 1)});
        const Vec3 d = i % 2 ? Vec3{1, 0, -0.0} : aim - origin;
        // The rounded direction may pass beside the wall's border; the middle of it may not be lost.
        if (aim.y < 0.001 || aim.y > 49.999 || aim.z < 0.001 || aim.z > 0.999) continue;
        misses += !bvh.hit({.origin = origin, .direction = d});
    }
    CHECK(misses == 0);
}

TEST_CASE("HittableList: elements are numbered through, and equal hits go to the lowest", "[shape][list]") {
    const auto triangle = std::make_shared<Triangle>(Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}, nullptr);
    const auto mesh = std::make_shared<Mesh>(test::cube_mesh(1, {5, 0, 0}), nullptr);
    HittableList list;
    list.add(triangle);
    list.add(mesh);
    list.add(triangle);
    list.add(std::make_shared<Sphere>(Point3{0, 0, -5}, 1.0, nullptr));
    CHECK(count_elements(list) == 15);
    CHECK(list.hit({.origin = {0.25, 0.25, 1}, .direction = {0, 0, -1}})->element == 0);
    const auto cube = list.hit({.origin = {5.25, 0.625, 3}, .direction = {0, 0, -1}});
    CHECK(cube->element == 1 + mesh->hit({.origin = {5.25, 0.625, 3}, .direction = {0, 0, -1}})->element);
    CHECK(list.hit({.origin = {0, 0, -2}, .direction = {0, 0, -1}})->element == 14);

    HittableList outer;
    outer.add(std::make_shared<Sphere>(Point3{100, 0, 0}, 1.0, nullptr));
    outer.add(std::make_shared<HittableList>(list));
    CHECK(outer.hit({.origin = {0, 0, -2}, .direction = {0, 0, -1}})->element == 15);
    CHECK(outer.bounds().contains(list.bounds()));
}

TEST_CASE("HittableList and Bvh: whoever is asked later is asked for nothing farther than what is found",
          "[shape][list]") {
    class Recorder final : public Hittable {
    public:
        Box bounds() const override { return {{-1, -1, -9}, {1, 1, 9}}; }
        std::optional<Hit> hit(const Ray& ray) const override {
            farthest = ray.t_max;
            return std::nullopt;
        }
        mutable double farthest = 0;
    };
    const auto recorder = std::make_shared<Recorder>();
    // Its box begins before the ball and ends behind it.
    const Objects objects{std::make_shared<Sphere>(Point3{0, 0, 0}, 8.5, nullptr), recorder};
    const Ray ray{.origin = {0, 0, 20}, .direction = {0, 0, -1}, .t_max = 30};
    CHECK(HittableList(objects).hit(ray)->t == 11.5);
    CHECK(recorder->farthest == 11.5);
    CHECK(HittableList({recorder, objects[0]}).hit(ray)->t == 11.5);
    CHECK(recorder->farthest == 30);
    const Objects nested{std::make_shared<HittableList>(objects), recorder};
    CHECK(Bvh(nested).hit(ray)->t == 11.5);
    CHECK(recorder->farthest == 11.5);
}

TEST_CASE("Bvh: of equal hits in leaves apart the lowest number wins, whichever is asked first", "[shape][bvh]") {
    // An L in one plane: only its corner belongs to both.
    const auto wide = std::make_shared<Quad>(Point3{0, 0, 0}, Vec3{100, 0, 0}, Vec3{0, 1, 0}, nullptr);
    const auto high = std::make_shared<Quad>(Point3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 100, 0}, nullptr);
    for (const double side : {1.0, -1.0}) {
        const Ray ray{.origin = {0.5, 0.5, side}, .direction = {0, 0, -side}};
        CHECK(Bvh({wide, high}).hit(ray)->element == 0);
        CHECK(Bvh({high, wide}).hit(ray)->element == 0);
    }
}

TEST_CASE("HittableList: one that holds itself is refused", "[shape][list]") {
    const auto list = std::make_shared<HittableList>();
    CHECK_THROWS_AS(list->add(list), ArgumentError);
    CHECK(list->bounds().is_empty());
}

TEST_CASE("HittableList and Bvh: a null object is refused, an empty list hits nothing", "[shape][list]") {
    HittableList list;
    CHECK_THROWS_AS(list.add(nullptr), ArgumentError);
    CHECK_THROWS_AS(HittableList(Objects{nullptr}), ArgumentError);
    CHECK_THROWS_AS(Bvh(Objects{nullptr}), ArgumentError);
    CHECK(list.bounds().is_empty());
    CHECK_FALSE(list.hit({.origin = {}, .direction = {1, 0, 0}}));
    CHECK(count_elements(list) == 0);
    CHECK(Bvh(Objects{}).bounds().is_empty());
}

TEST_CASE("HittableList and Bvh: an unusable ray misses", "[shape][list]") {
    const Objects objects{std::make_shared<Sphere>(Point3{}, 1.0, nullptr)};
    for (const Ray& ray : test::unusable_rays()) {
        CHECK_FALSE(HittableList(objects).hit(ray));
        CHECK_FALSE(Bvh(objects).hit(ray));
    }
}

}  // namespace limn::aggregate_test
