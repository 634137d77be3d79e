#include "limn/scene/scene.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/shape/sphere.h"

namespace limn::scene_test {

TEST_CASE("Scene: objects are numbered in the order of add, and null is refused", "[scene]") {
    Scene scene;
    const auto a = std::make_shared<Sphere>(Point3{0, 0, 0}, 1.0, nullptr),
               b = std::make_shared<Sphere>(Point3{9, 0, 0}, 1.0, nullptr);
    CHECK(scene.bounds().is_empty());
    CHECK(scene.add(a) == 0);
    CHECK(scene.add(b) == 1);
    CHECK(scene.add(a) == 2);
    CHECK(scene.objects().size() == 3);
    CHECK(scene.objects()[1] == b);
    CHECK_THROWS_AS(scene.add(nullptr), ArgumentError);
    CHECK(scene.objects().size() == 3);
    CHECK(scene.bounds() == merge(a->bounds(), b->bounds()));
}

}  // namespace limn::scene_test
