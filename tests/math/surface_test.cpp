#include "limn/math/surface.h"

#include "catch.h"
#include "support/random_geometry.h"
#include "support/real.h"

namespace limn::surface_test {

using limn::test::Random;
using limn::test::Real;

namespace {

Surface random_surface(Random& random) {
    Surface s;
    s.position = Point3{} + random.in_cube(random.log_uniform(1e-4, 1e7));
    const double bound = random.log_uniform(1e-16, 1e-10) * length(s.position - Point3{});
    s.position_error = bound * limn::abs(random.in_cube());
    s.normal = Normal3(random.unit());
    if (random.chance(0.3)) {
        s.normal = {};
        (random.chance(0.5) ? s.normal.x : s.normal.z) = random.sign();
    }
    s.shading_normal = s.normal;
    return s;
}

}  // namespace

TEST_CASE("offset_origin: moves to the direction's side by at least the error bound along the normal",
          "[core][surface]") {
    Random random(12);
    for (int i = 0; i < 20000; ++i) {
        const Surface s = random_surface(random);
        const Vec3 direction = random.unit();
        const Point3 origin = offset_origin(s.position, s.position_error, s.normal, direction);
        const test::Real3 n(s.normal), moved = test::Real3(origin) - test::Real3(s.position);
        const Real side = dot(s.normal, direction) < 0 ? -1 : 1;
        const Real bound = test::absolute(n.x) * s.position_error.x + test::absolute(n.y) * s.position_error.y +
                           test::absolute(n.z) * s.position_error.z;
        // The farthest that the true surface can be is `bound` along the normal: the origin must be beyond it.
        CHECK(static_cast<double>(side * test::dot(n, moved) - bound * test::dot(n, n)) >= 0);
        // ... but not by more than the rounding of its coordinates.
        const double slack = 2 * static_cast<double>(bound) + 4e-16 * (length(s.position - Point3{}) + 1e-300);
        CHECK(length(origin - s.position) <= slack);
    }
}

TEST_CASE("offset_origin: along an axis to which the normal is perpendicular nothing moves, to the bit",
          "[core][surface]") {
    const Point3 p{0.1, 0.2, 0.3};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            Vec3 n;
            n[axis] = 1;
            const Point3 moved = offset_origin(p, {1e-16, 1e-16, 1e-16}, Normal3(n), side * n);
            for (std::size_t a = 0; a < 3; ++a) CHECK((moved[a] == p[a]) == (a != axis));
            CHECK(side * (moved[axis] - p[axis]) > 0);
        }
    // A direction in the surface leaves towards the side of the normal.
    CHECK(offset_origin(p, {1e-16, 1e-16, 1e-16}, {0, 0, 1}, {1, 0, 0}).z > p.z);
    // Without a normal, as in a medium, the origin is the position.
    CHECK(offset_origin(p, {1e-3, 1e-3, 1e-3}, {}, {1, 2, 3}) == p);
}

TEST_CASE("spawn_ray: keeps direction and time, and starts where offset_origin says", "[core][surface]") {
    Random random(13);
    for (int i = 0; i < 1000; ++i) {
        const Surface s = random_surface(random);
        const Vec3 direction = random.in_cube(3);
        const Ray ray = s.spawn_ray(direction, 0.25);
        CHECK(ray.origin == offset_origin(s.position, s.position_error, s.normal, direction));
        CHECK(ray.direction == direction);
        CHECK((ray.t_min == 0 && ray.t_max == kInfinity && ray.time == 0.25));
    }
}

TEST_CASE("spawn_ray_to: t is the fraction of the way, and the end is left out by a hair", "[core][surface]") {
    Random random(14);
    for (int i = 0; i < 5000; ++i) {
        const Surface s = random_surface(random);
        const double distance = random.log_uniform(1e-3, 1e3) * length(s.position - Point3{});
        const Point3 target = s.position + distance * random.unit();
        const Ray ray = s.spawn_ray_to(target, 0.5);
        CHECK(ray.time == 0.5);
        CHECK(ray.t_max < 1);
        CHECK(ray.t_max > 1 - 1e-9);
        CHECK(length(ray.at(1) - target) <= 1e-14 * (length(target - Point3{}) + length(s.position - Point3{})));
        CHECK(dot(s.normal, target - s.position) * dot(s.normal, ray.origin - s.position) >= 0);
    }
}

TEST_CASE("spawn_ray_to: where nothing lies between the ends there is no way to be blocked on", "[core][surface]") {
    Surface s;
    s.position = {1024, -7, 3};
    s.position_error = {1e-12, 1e-12, 1e-12};
    s.normal = {0, 0, 1};
    for (const double away : {0.0, 1e-13, 1e-12}) {  // less than coordinates of a thousand are known to
        const Ray ray = s.spawn_ray_to(s.position + Vec3{0, 0, away}, 0.5);
        CHECK((ray.t_min == 0 && ray.t_max == 0));
    }
    // Far enough away t_max leaves out what the target's own coordinates may be off by, and no more.
    for (const Point3 target : {Point3{1024, -7, 11}, Point3{1024, -7, -5}}) {
        const Ray ray = s.spawn_ray_to(target, 0.5);
        const double left_out = (1 - ray.t_max) * 8;
        CHECK((left_out >= gamma(8) * 1024 && left_out <= 32 * gamma(8) * 1024));
    }
    // The coordinates of either end count; the difference from 1 is itself rounded.
    Surface at_home;
    at_home.normal = {1, 0, 0};
    CHECK((1 - s.spawn_ray_to(Point3{0, 0, 0.5}, 0).t_max) >= 7.9 * gamma(8));
    CHECK((1 - at_home.spawn_ray_to(Point3{1024, 0, 0}, 0).t_max) >= 7.9 * gamma(8));
    // With nothing to leave out, as between points of small coordinates, the end is still left out.
    Surface origin;
    origin.normal = {0, 0, 1};
    CHECK(origin.spawn_ray_to(Point3{0, 0, 1}, 0).t_max < 1);
    CHECK(origin.spawn_ray_to(origin, 0).t_max <= 1 - gamma(16));
}

TEST_CASE("spawn_ray_to: a ray to another surface leaves both ends by their error bounds", "[core][surface]") {
    Random random(15);
    for (int i = 0; i < 5000; ++i) {
        const Surface from = random_surface(random);
        Surface to = random_surface(random);
        to.position = from.position + random.log_uniform(1e-2, 1e2) * length(from.position - Point3{}) * random.unit();
        // No computed point is known better than this.
        const double bound = gamma(16) * (length(from.position - Point3{}) + length(to.position - Point3{}));
        to.position_error = from.position_error + Vec3{bound, bound, bound};
        const Ray ray = from.spawn_ray_to(to, 0.75);
        CHECK(ray.time == 0.75);
        CHECK(ray.t_max <= 1);
        CHECK(ray.t_max > 1 - 1e-9);
        CHECK(dot(from.normal, ray.direction) * dot(from.normal, ray.origin - from.position) >= 0);
        // Its end lies on the near side of the other surface.
        const test::Real3 end = test::Real3(ray.origin) + test::Real3(ray.direction);
        const Real height = test::dot(test::Real3(to.normal), end - test::Real3(to.position));
        CHECK(dot(to.normal, ray.direction) * static_cast<double>(height) <= 0);
    }
}

}  // namespace limn::surface_test
