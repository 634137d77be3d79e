// Scenes that nest, repeat and reach without end.
#include "catch.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"

namespace limn::odd_scenes_test {

namespace {

std::shared_ptr<Sphere> ball(const Point3& center) { return std::make_shared<Sphere>(center, 1.0, nullptr); }

// Stands for another object, which it does not own: a cycle without a leak.
class Mirror final : public Hittable {
public:
    explicit Mirror(const Hittable& other) : other_(other) {}
    Box bounds() const override { return {}; }
    std::optional<Hit> hit(const Ray&) const override { return std::nullopt; }
    void lower(RecordSink& sink) const override { other_.lower(sink); }

private:
    const Hittable& other_;
};

}  // namespace

TEST_CASE("compile: a list that contains itself is refused", "[compile]") {
    const auto list = std::make_shared<HittableList>();
    list->add(std::make_shared<Mirror>(*list));
    Scene scene;
    scene.add(list);
    CHECK_THROWS_AS(compile(scene), ArgumentError);
}

TEST_CASE("compile: instances of instances cost what is stored, not what is seen", "[compile]") {
    std::shared_ptr<const Hittable> object = ball({0, 0, 0});
    for (int level = 0; level < 8; ++level) {
        const auto copies = std::make_shared<HittableList>();
        for (int i = 0; i < 30; ++i)
            copies->add(std::make_shared<Instance>(object, Transform::translate({3.0 * i, 0, 0})));
        object = copies;
    }
    Scene scene;
    scene.add(object);
    const CompiledScene compiled = compile(scene);
    CHECK(compiled.stats().primitives == 656'100'000'000u);
    CHECK(compiled.stats().stored_primitives == 1);
    const auto hit = compiled.closest_hit({.origin = {0, 0, 5}, .direction = {0, 0, -1}});
    REQUIRE(hit);
    CHECK(hit->t == 4);
    CHECK(hit->element == 0);
}

// Of n by n objects in a plane, the ray meets that in the middle; one is listed, many are in a tree.
template <class Make>
void check_endlessly_far(int n, const Make& make) {
    const Ray ray{.origin = {0, 0, 0}, .direction = {0, 0, 1e-300}};
    Scene scene;
    for (int i = 0; i < n * n; ++i) scene.add(make(Point3{3e9 * (i % n - n / 2), 3e9 * (i / n - n / 2), 1e10}));
    for (const auto& object : scene.objects()) CHECK_FALSE(object->hit(ray));
    const CompiledScene compiled = compile(scene);
    CHECK_FALSE(compiled.closest_hit(ray));
    CHECK_FALSE(compiled.any_hit(ray));
    Ray nearer = ray;
    nearer.direction.z = 1e-290;
    CHECK(compiled.closest_hit(nearer));
    CHECK(compiled.any_hit(nearer));
}

TEST_CASE("compile: a hit endlessly far away is a miss", "[compile]") {
    for (const int n : {1, 31}) {
        check_endlessly_far(n, [](const Point3& p) { return std::make_shared<Sphere>(p, 1e9, nullptr); });
        check_endlessly_far(n, [](const Point3& p) {
            return std::make_shared<Quad>(p - Vec3{1e9, 1e9, 0}, Vec3{2e9, 0, 0}, Vec3{0, 2e9, 0}, nullptr);
        });
        check_endlessly_far(n, [](const Point3& p) {
            return std::make_shared<Triangle>(p - Vec3{1e9, 1e9, 0}, p + Vec3{2e9, 0, 0}, p + Vec3{0, 2e9, 0}, nullptr);
        });
    }
}

}  // namespace limn::odd_scenes_test
