#include <span>

#include "catch.h"
#include "flat/scene.h"
#include "geometry/disk-inl.h"
#include "geometry/exact.h"
#include "limn/limn.h"
#include "support/pictures.h"
#include "support/random_geometry.h"
#include "support/real.h"
#include "support/tally.h"

namespace limn::disk_test {

using namespace test;

namespace {

Ray ray_to(const Point3& target, const Vec3& direction) {
    return {.origin = target - 3 * direction, .direction = direction};
}

}  // namespace

TEST_CASE("Disk: NaN, infinity, no normal and no radius are refused by name", "[shape][disk]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(Disk({nan, 0, 0}, {0, 0, 1}, 1, nullptr), Catch::Contains("center"));
    CHECK_THROWS_WITH(Disk({0, 0, 0}, {0, kInfinity, 1}, 1, nullptr), Catch::Contains("normal"));
    CHECK_THROWS_WITH(Disk({0, 0, 0}, {0, 0, 0}, 1, nullptr), Catch::Contains("normal"));
    for (const double radius : {0.0, -1.0, nan, kInfinity})
        CHECK_THROWS_WITH(Disk({0, 0, 0}, {0, 0, 1}, radius, nullptr), Catch::Contains("radius"));
    for (const double length : {1e-300, 1e-9, 1e9, 1e300}) {
        const Disk disk({1, 2, 3}, {0, 0, length}, 2, nullptr);
        const auto hit = disk.hit(ray_to({1, 3, 3}, {0, 0, -1}));
        REQUIRE(hit);
        CHECK(hit->t == 3);
        CHECK(hit->normal == Normal3{0, 0, 1});
        const Box box = disk.bounds();
        CHECK(box.contains(Box{{-1, 0, 3}, {3, 4, 3}}));
        CHECK(Box{{-1 - 1e-14, -1e-14, 3}, {3 + 1e-14, 4 + 1e-14, 3}}.contains(box));
    }
}

TEST_CASE("Disk: it is a closed set, its rim is hit, its plane is not", "[shape][disk]") {
    const Disk disk({1, 1, 0}, {0, 0, 2}, 5, nullptr);
    for (const Vec3 at : {Vec3{5, 0, 0}, Vec3{0, -5, 0}, Vec3{3, 4, 0}, Vec3{-4, 3, 0}, Vec3{0, 0, 0}})
        for (const Vec3 d : {Vec3{0, 0, -1}, Vec3{1, 2, 4}, Vec3{-2, 1, -4}}) {
            const auto hit = disk.hit(ray_to(Point3{1, 1, 0} + at, d));
            REQUIRE(hit);
            CHECK(hit->t == 3);
        }
    for (const Vec3 at : {Vec3{5 + 0x1p-40, 0, 0}, Vec3{3 + 0x1p-40, 4, 0}, Vec3{-4, 3 + 0x1p-40, 0}})
        CHECK_FALSE(disk.hit(ray_to(Point3{1, 1, 0} + at, {0, 0, -1})));
    for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{1, 1, 0}, Vec3{1, 0, -0.0}})
        for (const Point3 o : {Point3{-9, 1, 0}, Point3{1, 1, 0}, Point3{0, 0, 0}})
            CHECK_FALSE(disk.hit({.origin = o, .direction = d}));
}

TEST_CASE("Disk: the range is open at t_min and closed at t_max", "[shape][disk]") {
    const Disk disk({0, 0, 0}, {0, 0, 1}, 2, nullptr);
    const auto hits = [&](double t_min, double t_max) {
        return disk.hit({{1, 1, 8}, {0, 0, -2}, t_min, t_max, 0}).has_value();
    };
    CHECK(hits(0, 4));
    CHECK_FALSE(hits(0, std::nextafter(4, 0)));
    CHECK_FALSE(hits(4, kInfinity));
    CHECK(hits(std::nextafter(4, 0), kInfinity));
}

TEST_CASE("Disk: it is hit where 128 bits say so, and its box holds it", "[shape][disk]") {
    Random random(61);
    Tally tally;
    for (int i = 0; i < 20000; ++i) {
        const Point3 c = Point3{} + random.in_cube(random.log_uniform(1e-3, 1e4));
        const Vec3 n = random.log_uniform(1e-6, 1e6) * random.unit();
        const double r = random.log_uniform(1e-3, 1e3);
        const Frame frame(normalize(n));
        const double angle = random.uniform(0, 2 * kPi), away = random.chance(0.5) ? 1 : 2 * random.uniform();
        const Vec3 radial = std::cos(angle) * frame.x + std::sin(angle) * frame.y;
        const Point3 target = c + (r * away + random.chance(0.5) * r * random.log_uniform(1e-15, 1e-3)) * radial;
        const Point3 origin = target + random.log_uniform(1e-3, 1e3) * random.unit();
        const Ray ray{.origin = origin, .direction = target - origin};
        if (!is_usable(ray)) continue;
        const Real3 p = Real3(ray.origin) - Real3(c), d(ray.direction), normal(n);
        const Real b = dot(d, normal), t = -dot(p, normal) / b;
        const Real3 at = p + t * d;
        const Real beyond = dot(at, at) / (Real(r) * Real(r)) - 1;
        const Disk disk(c, n, r, nullptr);
        const auto hit = disk.hit(ray);
        ++tally.rays;
        if (b == 0 || (beyond < 1e-25 && beyond > -1e-25)) continue;
        if (hit.has_value() != (beyond < 0 && t > 0)) tally.fault(ray, "decision");
        if (!hit) continue;
        ++tally.hits;
        if (absolute(Real(hit->t) - t) > 1e-9 * absolute(t)) tally.fault(ray, "t");
        const Point3 position =
            c + Vec3{static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
        const Box box = grow(disk.bounds(), Vec3{1, 1, 1} * (1e-12 * (max_abs(c) + r)));
        if (!box.contains(position)) tally.fault(ray, "box");
    }
    INFO(tally.first);
    CHECK(tally.wrong == 0);
    CHECK(tally.hits > 5000);
}

TEST_CASE("Disk: what its filter decides is exactly so, in instances too", "[shape][disk]") {
    using namespace limn::HWY_NAMESPACE;
    const Transform m =
        Transform::translate({3, 1e3, -2}) * Transform::rotate({1, 2, 3}, 40) * Transform::scale(1, 0.01, 7);
    Random random(62);
    int decided = 0, hits = 0, wrong = 0, rays = 0;
    for (int i = 0; i < 40000; ++i) {
        Point3 c = Point3{} + random.in_cube(4);
        if (random.chance(0.5)) c = {std::round(c.x), std::round(c.y), std::round(c.z)};
        const Vec3 n = random.chance(0.5) ? Vec3{0, 3, 4} : random.unit();
        const double r = random.chance(0.5) ? 5 : random.log_uniform(1e-3, 1e3);
        const Frame frame(normalize(n));
        const Point3 target = c + r * (random.chance(0.5) ? frame.x : random.uniform() * frame.y);
        const Point3 origin = Point3{} + random.in_cube(random.log_uniform(1, 1e6));
        const Ray object{.origin = origin, .direction = random.log_uniform(1e-3, 1e3) * (target - origin)};
        RayFrame outer(object), inner(object);
        if (random.chance(0.5)) {
            outer.ray.origin = transform_point(m, object.origin);
            outer.ray.direction = transform_vector(m, object.direction);
            inner = RayFrame(outer, m);
        }
        ++rays;
        PlanarHit hit{};
        const bool exact = exact_disk(c, n, r, inner, {0, kInfinity}, hit);
        const auto f = disk_of<double>(c, n, r).filter(ray_of<double>(inner), {0, kInfinity});
        if (!f.hit && !f.miss) continue;
        ++decided;
        hits += f.hit;
        wrong += f.hit != exact || f.hit == f.miss || (exact && std::abs(f.t - hit.t) > kAccurate * std::abs(hit.t));
    }
    CHECK(wrong == 0);
    CHECK(hits > 5000);
    CHECK(decided > 15000);
    CHECK(decided < rays);
}

TEST_CASE("Disk: u and v are within 2^-26, from afar, at a slant and in flat instances", "[shape][disk]") {
    Random random(64);
    int wrong = 0, hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point3 c = Point3{} + random.in_cube(4);
        const Vec3 n = random.log_uniform(1e-3, 1e3) * random.unit();
        const double r = random.log_uniform(1e-2, 1e2), far = random.log_uniform(1, 1e12);
        const Frame axes(normalize(n));
        const Point3 target = c + r * (random.uniform(-1, 1) * axes.x + random.uniform(-1, 1) * axes.y);
        const Vec3 way = normalize(random.log_uniform(1e-6, 1) * axes.z + axes.to_world({random.uniform(), 1, 0}));
        const Ray ray{.origin = target - far * way, .direction = random.log_uniform(1e-3, 1e3) * way};
        PlanarHit hit;
        if (!intersect_disk(c, n, r, frame_of(ray), {0, kInfinity}, hit)) continue;
        ++hits;
        const Real3 p = Real3(ray.origin) - Real3(c), d(ray.direction), normal(n);
        const Real3 at = p - (dot(p, normal) / dot(d, normal)) * d;
        const auto is_off = [&](double found, const Vec3& axis) {
            return absolute(Real(found) - (dot(at, Real3(axis)) / Real(2 * r) + Real(0.5))) > kAccurateWeight;
        };
        wrong += is_off(hit.u, axes.x) || is_off(hit.v, axes.y);

        // Within rounding of singular. The exact fallback is that of the first part.
        const Transform m = Transform::rotate({1, 2, 3}, 40) * Transform::scale(1, 1, random.log_uniform(1e-14, 1));
        const RayFrame outer(
            {.origin = transform_point(m, ray.origin), .direction = transform_vector(m, ray.direction)});
        PlanarHit exact, found;
        if (!intersect_disk(c, n, r, RayFrame(outer, m), {0, kInfinity}, found)) continue;
        wrong += !exact_disk(c, n, r, RayFrame(outer, m), {0, kInfinity}, exact) ||
                 std::abs(found.u - exact.u) > kAccurateWeight || std::abs(found.v - exact.v) > kAccurateWeight;
    }
    CHECK(wrong == 0);
    CHECK(hits > 10000);
}

TEST_CASE("Disk: compiled it is hit as described, t bit for bit, in instances and beside others", "[shape][disk]") {
    Random random(63);
    const auto grey = std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5});
    std::vector<std::shared_ptr<Hittable>> objects;
    for (int i = 0; i < 40; ++i) {
        const Point3 c = Point3{} + random.in_cube(3);
        const Vec3 n = random.chance(0.3) ? Vec3{0, 1, 0} : random.unit();
        std::shared_ptr<Hittable> disk = std::make_shared<Disk>(c, n, random.uniform(0.1, 1), grey);
        if (i % 3 == 0)
            disk = std::make_shared<Instance>(disk, Transform::translate(random.in_cube(1)) *
                                                        Transform::rotate(random.unit(), random.uniform(0, 90)));
        if (i % 5 == 0) disk = std::make_shared<Sphere>(c, 0.3, grey);
        objects.push_back(disk);
    }
    Scene scene;
    for (const auto& object : objects) scene.add(object);
    const CompiledScene compiled = compile(scene);
    CHECK(compiled.features().find("disk") != std::string::npos);
    std::vector<Ray> rays;
    for (int i = 0; i < 256; ++i) {
        const Point3 origin = Point3{} + random.in_cube(6);
        rays.push_back({.origin = origin, .direction = Point3{} + random.in_cube(3) - origin});
    }
    std::vector<RayHit> batch(rays.size());
    compiled.closest_hit(std::span<const Ray>(rays), std::span(batch));
    int hits = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        std::optional<Hit> nearest;
        Ray rest = rays[i];
        for (const auto& object : objects)
            if (const auto hit = object->hit(rest)) nearest = hit, rest.t_max = hit->t;
        const auto found = compiled.closest_hit(rays[i]);
        wrong += found.has_value() != nearest.has_value() || (batch[i].t < kInfinity) != nearest.has_value() ||
                 compiled.any_hit(rays[i]) != nearest.has_value();
        if (!found || !nearest) continue;
        ++hits;
        wrong += found->t != nearest->t || batch[i].t != nearest->t;
        const Surface s = compiled.surface_at(rays[i], *found);
        wrong += std::abs(std::abs(dot(Vec3(s.normal), Vec3(nearest->normal))) - 1) > 1e-12;
        wrong += max_abs(s.position - rays[i].at(found->t)) > 1e-6;
        // Leaving it in either direction does not meet it again.
        for (const double side : {1.0, -1.0}) {
            const Vec3 out = side * Vec3(s.normal) + 0.5 * random.in_cube();
            const auto again = compiled.closest_hit(s.spawn_ray(out, 0));
            wrong += again && again->object == found->object && again->t < 1e-6;
        }
    }
    CHECK(hits > 100);
    CHECK(wrong == 0);
}

TEST_CASE("Disk: as a lamp it gives the light that a closed form says, by either estimator", "[shape][disk]") {
    // Over the middle, at height h: irradiance pi L r^2 / (r^2 + h^2); leaving a white surface, that over pi.
    const double r = 0.8, h = 1.5, radiance = 3, truth = radiance * r * r / (r * r + h * h);
    const Object white = std::make_shared<Disk>(Point3{0, 0, 0}, Vec3{0, 1, 0}, 1e-3, grey(1));
    const Object plain = std::make_shared<Disk>(Point3{0, h, 0}, Vec3{0, -2, 0}, r, lamp(radiance));
    const Object turned = std::make_shared<Instance>(
        std::make_shared<Disk>(Point3{0, 0, 0}, Vec3{1, 0, 0}, r / 2, lamp(radiance)),
        Transform::translate({0, h, 0}) * Transform::rotate({0, 0, 1}, 90) * Transform::scale(2, 2, 2));
    for (const Object& object : {plain, turned}) {
        const CompiledScene scene = compile_with(sky(0), {white, object});
        CHECK(scene.flat().lights.size() == 1);
        const Camera camera = camera_at({0, 0.3, 0.4}, {0, 0, 0}, 0.05);
        check_mean(measure(scene, camera, square(2, 64, 2)), truth, 0.01);
        check_mean(measure(scene, camera, square(2, 1024, 2, Estimator::naive)), truth, 0.01);
    }
}

}  // namespace limn::disk_test
