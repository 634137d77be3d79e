// Where along a ray a medium is: through nested instances, and where surfaces of its boundary touch.
#include "catch.h"
#include "limn/scene/shape/constant_medium.h"
#include "render/media.h"
#include "support/pictures.h"

namespace limn::media_places_test {

using namespace test;

namespace {

Object smoke(const Object& boundary) { return std::make_shared<ConstantMedium>(boundary, 1.0, Color{1, 1, 1}); }

// How much of a ray lies in media of extinction 1.
double depth_along(const Ray& ray, const Object& object) {
    const CompiledScene scene = compile_with(sky(0), {object});
    transport::MediaAlongRay media;
    media.trace(scene.flat(), ray);
    return -std::log(media.transmittance());
}

// Of the ray from the origin along x, up to t.
double depth_up_to(double t, const Object& object) { return depth_along({{0, 0, 0}, {1, 0, 0}, 0, t}, object); }

}  // namespace

TEST_CASE("Media: through nested instances the outer one is applied last", "[render][media]") {
    const Object unit = smoke(sphere({0, 0, 0}, 1, nullptr));
    const Object ellipsoid = std::make_shared<Instance>(std::make_shared<Instance>(unit, Transform::scale(2, 1, 1)),
                                                        Transform::translate({5, 0, 0}));
    CHECK(depth_up_to(3, ellipsoid) == 0);
    CHECK(depth_up_to(4, ellipsoid) == Approx(1).epsilon(1e-12));
    CHECK(depth_up_to(9, ellipsoid) == Approx(4).epsilon(1e-12));
    CHECK(depth_along({{4, -3, 0}, {0, 1, 0}}, ellipsoid) == Approx(std::sqrt(3)).epsilon(1e-12));
}

TEST_CASE("Media: a ray that leaves just before an edge, and touches that, was inside before", "[render][media]") {
    const double size = 1e-5;
    const Object u = std::make_shared<Instance>(
        std::make_shared<Mesh>(u_shape(), nullptr),
        Transform::translate({1e3 * size, -1e3 * size, 5e2 * size}) * Transform::scale(size, size, size));
    const Ray ray{.origin = {0x1.48762d6f7940bp-7, -0x1.475f2b9a96b62p-7, 0x1.480c85c5cd5a2p-8},
                  .direction = {-0x1.d0d879d1ad624p-20, 0x1.3e7d763f064aep-24, -0x1.79c52bb049a4ep-21}};
    CHECK(depth_along(ray, smoke(u)) == Approx(8 * length(ray.direction)).epsilon(1e-9));
}

TEST_CASE("Media: a surface that is there twice bounds nothing", "[render][media]") {
    const Object ball = sphere({3, 0, 0}, 1, nullptr);
    const auto of = [&](std::vector<Object> copies) {
        return smoke(std::make_shared<HittableList>(std::move(copies)));
    };
    CHECK(depth_up_to(kInfinity, of({ball})) == Approx(2).epsilon(1e-12));
    CHECK(depth_up_to(kInfinity, of({ball, ball})) == 0);
    CHECK(depth_up_to(kInfinity, of({ball, ball, ball})) == Approx(2).epsilon(1e-12));
}

TEST_CASE("Media: the wall between two halves of a boundary is no border, and light scatters behind it",
          "[render][media]") {
    const Object halves = std::make_shared<HittableList>(
        std::vector<Object>{make_box({1, -1, -1}, {2, 1, 1}, nullptr), make_box({2, -1, -1}, {3, 1, 1}, nullptr)});
    CHECK(depth_up_to(kInfinity, smoke(halves)) == Approx(2).epsilon(1e-12));
    const CompiledScene scene = compile_with(sky(0), {smoke(halves)});
    transport::MediaAlongRay media;
    media.trace(scene.flat(), {{0, 0, 0}, {1, 0, 0}});
    const transport::FreeFlight flight = media.sample(1.5, 0.5);
    CHECK(flight.scatters);
    CHECK(flight.t == Approx(2.5).epsilon(1e-12));
    CHECK(flight.phase == scene.flat().medium_shapes[0].phase);
}

TEST_CASE("Media: a bubble that touches the skin from inside leaves outside outside", "[render][media]") {
    const auto skin = std::make_shared<HittableList>();
    skin->add(sphere({5, 0, 0}, 2, nullptr));
    skin->add(sphere({6, 0, 0}, -1, nullptr));  // from 5 to 7, where both end
    CHECK(depth_up_to(3, smoke(skin)) == 0);
    CHECK(depth_up_to(4, smoke(skin)) == Approx(1).epsilon(1e-12));
    CHECK(depth_up_to(9, smoke(skin)) == Approx(2).epsilon(1e-12));
}

}  // namespace limn::media_places_test
