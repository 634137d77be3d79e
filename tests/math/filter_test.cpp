// The filters against the exact stage: whatever a filter decides is so, and its numbers are as good as it says.
#include "catch.h"
#include "geometry/quad-inl.h"
#include "geometry/sphere-inl.h"
#include "geometry/sphere_side.h"
#include "geometry/triangle-inl.h"
#include "support/random_geometry.h"

namespace limn::filter_test {

using namespace HWY_NAMESPACE;
using test::Random;

namespace {

constexpr int kRays = 40000;

// A point of few bits, so that edges, vertices and planes are met exactly, or of all bits; near or far.
Point3 some_point(Random& random) {
    Point3 p = Point3{} + random.in_cube(4);
    if (random.chance(0.5)) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
    if (random.chance(0.1)) p = p + random.log_uniform(1, 1e6) * random.unit();
    return p;
}

Ray ray_at(Random& random, const Point3& target) {
    const Point3 origin = some_point(random);
    Vec3 to = target - origin;
    if (random.chance(0.8)) to = to + random.log_uniform(1e-18, 10) * random.in_cube();
    if (to == Vec3{}) to = {0, 0, 1};
    const double t_min = random.chance(0.2) ? random.uniform(-2, 2) : -kInfinity;
    return {.origin = origin, .direction = random.log_uniform(1e-3, 1e3) * to, .t_min = t_min};
}

// The ray itself, or as an instance sees it.
struct Seen {
    Transform m = Transform::translate({3, 1e3, -2}) * Transform::rotate({1, 2, 3}, 40) * Transform::scale(1, 0.01, 7);
    RayFrame outer, inner;

    Seen(const Ray& object_ray, bool instanced) : outer(object_ray), inner(object_ray) {
        if (!instanced) return;
        outer.ray.origin = transform_point(m, object_ray.origin);
        outer.ray.direction = transform_vector(m, object_ray.direction);
        inner = RayFrame(outer, m);
    }
    Seen(const Seen&) = delete;
};

struct Count {
    int decided = 0, hits = 0, wrong = 0;

    void judge(const FilterResult<double>& answer, bool exact, const PlanarHit& hit) {
        if (!answer.hit && !answer.miss) return;
        ++decided;
        if (exact != answer.hit || answer.hit == answer.miss) {
            ++wrong;
        } else if (exact) {
            ++hits;
            wrong += std::abs(answer.t - hit.t) > kAccurate * std::abs(hit.t) ||
                     std::abs(answer.u - hit.u) > kAccurateWeight || std::abs(answer.v - hit.v) > kAccurateWeight;
        }
    }
    void check() const {
        CHECK(wrong == 0);
        CHECK(hits > 500);
        CHECK(decided > 5000);
        CHECK(decided < kRays);  // there are rays that it must leave open
    }
};

template <class Shape>
FilterResult<double> filtered(const Shape& shape, const RayFrame& frame, const Search& search) {
    return shape.filter(typename Shape::Ray(ray_of<double>(frame)), {search.t_min, search.t_max});
}

}  // namespace

TEST_CASE("filter_triangle: what it decides is exactly so", "[core][filter]") {
    for (const bool instanced : {false, true}) {
        Random random(41);
        Count count;
        for (int i = 0; i < kRays; ++i) {
            const Point3 a = some_point(random), b = some_point(random), c = some_point(random);
            const double u = random.chance(0.3) ? 0 : random.uniform(), v = random.chance(0.3) ? 0 : 1 - u;
            const Seen seen(ray_at(random, a + (u * (b - a) + v * (c - a))), instanced);
            const Search search{seen.inner.ray.t_min, kInfinity};
            PlanarHit hit{};
            const bool exact = exact_triangle(a, b, c, seen.inner, search, hit);
            count.judge(filtered(triangle_of<double>(a, b, c), seen.inner, search), exact, hit);
        }
        count.check();
    }
}

TEST_CASE("filter_quad: what it decides is exactly so", "[core][filter]") {
    for (const bool instanced : {false, true}) {
        Random random(42);
        Count count;
        for (int i = 0; i < kRays; ++i) {
            const Point3 q = some_point(random);
            const Vec3 e = some_point(random) - q, f = some_point(random) - q;
            const double u = random.chance(0.3) ? 0 : random.uniform(), v = random.chance(0.3) ? 1 : random.uniform();
            const Seen seen(ray_at(random, q + (u * e + v * f)), instanced);
            const Search search{seen.inner.ray.t_min, kInfinity};
            PlanarHit hit{};
            const bool exact = exact_quad(q, e, f, seen.inner, search, hit);
            count.judge(filtered(quad_of<double>(q, e, f), seen.inner, search), exact, hit);
        }
        count.check();
    }
}

TEST_CASE("is_beyond: planes that it says a search ends before are met exactly after that", "[core][filter]") {
    Random random(44);
    int beyond = 0, told = 0, wrong = 0;
    for (int i = 0; i < kRays; ++i) {
        const Point3 q = some_point(random);
        const Vec3 e = some_point(random) - q, f = some_point(random) - q, normal = cross(e, f);
        const Point3 target = q + (random.uniform(0.1, 0.9) * e + random.uniform(0.1, 0.9) * f);
        // Many along the plane, as seen from a ceiling that a lamp hangs under.
        const Vec3 away = random.uniform(-1, 1) * e + random.uniform(-1, 1) * f;
        const Point3 origin = target + away + random.log_uniform(1e-9, 1) * random.sign() * normal;
        const RayFrame frame(Ray{.origin = origin, .direction = target - origin});
        const Vec3 d = frame.ray.direction;
        const double along = dot(normal, d);
        PlanarHit hit{};
        if (!(std::abs(along) > 1e-12 * max_abs(normal) * max_abs(d))) continue;  // its sign is in doubt
        if (!exact_quad(q, e, f, frame, {0, kInfinity}, hit)) continue;
        const double t_max = hit.t * (1 + random.sign() * std::exp2(-random.uniform(20, 56)));
        const bool is_beyond_it = !exact_quad(q, e, f, frame, {0, t_max}, hit);
        const ShearedRay<double> ray(ray_of<double>(frame));
        const auto seen = [&](const Vec3& v) { return ray.axes.permuted(broadcast<double>(v)); };
        const bool says_so = is_beyond(ray, seen(e), seen(f), seen(q - origin), t_max, along < 0);
        beyond += is_beyond_it, told += says_so, wrong += says_so && !is_beyond_it;
    }
    CHECK(wrong == 0);
    CHECK(told > beyond / 4);
    CHECK(told < beyond);  // it must leave those open that end within rounding of the plane
    CHECK(beyond > kRays / 4);
}

TEST_CASE("side_of: spheres that it says a ray leaves or ends before are not met, and what is within is",
          "[core][filter]") {
    Random random(45);
    int missed = 0, inside = 0, unknown = 0, wrong = 0;
    for (int i = 0; i < kRays; ++i) {
        const Point3 c = some_point(random);
        const double r = random.chance(0.5) ? random.uniform(0.5, 3) : random.log_uniform(1e-6, 1e6);
        const auto near_surface = [&] {
            const double off = random.chance(0.2) ? 0 : random.sign() * random.log_uniform(1e-17, 1e-3);
            return c + (r * (1 + off)) * random.unit();
        };
        const bool leaves = random.chance(0.5);
        Ray ray{.origin = leaves ? near_surface() : some_point(random), .direction = {}, .t_min = 0};
        ray.direction = (leaves ? some_point(random) : near_surface()) - ray.origin;
        if (random.chance(0.3))
            ray.direction = ray.direction - dot(ray.direction, normalize(ray.origin - c)) * normalize(ray.origin - c);
        if (!leaves || random.chance(0.5)) ray.t_max = 1 - random.log_uniform(1e-16, 1e-6);
        if (!is_usable(ray)) continue;
        const RayFrame frame(ray);
        const SphereHits exact = exact_sphere(c, r, frame, nullptr, nullptr, {0, ray.t_max});
        const SphereHits ever = exact_sphere(c, r, frame, nullptr, nullptr, {-kInfinity, kInfinity});
        PlanarHit hit{};
        switch (side_of(c, r, ray)) {
            case Side::missed:
                ++missed;
                wrong += exact.near_found || exact.far_found;
                wrong += intersect(sphere_of<double>(c, r), frame, {0, ray.t_max}, hit);
                break;
            case Side::inside:
                ++inside;
                wrong += !ever.near_found || !ever.far_found || ever.near > 0 || ever.far < 0;
                break;
            case Side::unknown: ++unknown; break;
        }
    }
    CHECK(wrong == 0);
    CHECK(missed > kRays / 10);
    CHECK(inside > kRays / 10);
    CHECK(unknown > kRays / 10);
}

TEST_CASE("filter_sphere: what it decides is exactly so, and its roots lie within their bounds", "[core][filter]") {
    for (const bool instanced : {false, true}) {
        Random random(43);
        Count count;
        for (int i = 0; i < kRays; ++i) {
            const Point3 c = some_point(random);
            const double r = random.chance(0.5) ? random.uniform(0.5, 3) : random.log_uniform(1e-6, 1e6);
            Vec3 out = random.unit();
            if (random.chance(0.3)) out = {0, random.sign(), 0};
            // At a point of the surface, or along it.
            Ray ray = ray_at(random, c + r * out);
            if (random.chance(0.5)) ray.direction = ray.direction - dot(ray.direction, out) * out;
            if (random.chance(0.3)) ray.origin = c + r * out;
            if (ray.direction == Vec3{}) continue;
            const Seen seen(ray, instanced);
            const SphereRoots<double> roots = sphere_of<double>(c, r).roots(ray_of<double>(seen.inner));
            const SphereHits exact = exact_sphere(c, r, seen.inner, nullptr, nullptr, {-kInfinity, kInfinity});
            if (!roots.known && !roots.missed) continue;
            ++count.decided;
            if (exact.near_found != roots.known || roots.known == roots.missed) {
                ++count.wrong;
            } else if (exact.near_found) {
                ++count.hits;
                const auto is_off = [](double t, double error, double truth) {
                    return !(std::abs(t - truth) <= error + kRoundoff * std::abs(truth));
                };
                count.wrong +=
                    is_off(roots.near, roots.near_error, exact.near) || is_off(roots.far, roots.far_error, exact.far);
            }
        }
        count.check();
    }
}

TEST_CASE("The exact fallback knows the answers of textbook cases", "[core][filter]") {
    const RayFrame down(Ray{.origin = {0.25, 0.25, 3}, .direction = {0, 0, -2}});
    const Search search{0, kInfinity};
    PlanarHit hit{};
    REQUIRE(exact_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, down, search, hit));
    CHECK((hit.t == 1.5 && hit.u == 0.25 && hit.v == 0.25));
    REQUIRE(exact_quad({0, 0, 1}, {1, 0, 0}, {0, 0.5, 0}, down, search, hit));
    CHECK((hit.t == 1 && hit.u == 0.25 && hit.v == 0.5));
    CHECK_FALSE(exact_quad({0, 0, 1}, {1, 0, 0}, {0, 0.2, 0}, down, search, hit));
    CHECK_FALSE(exact_quad({0, 0, 1}, {1, 0, 0}, {0, 0, 1}, down, search, hit));  // along the ray
    const SphereHits hits = exact_sphere({0.25, 0.25, 0}, 1, down, nullptr, nullptr, search);
    CHECK((hits.near_found && hits.far_found && hits.near == 1 && hits.far == 2));
    const SphereHits touch = exact_sphere({0.25, 1.25, 0}, 1, down, nullptr, nullptr, search);
    CHECK((touch.near_found && touch.far_found && touch.near == 1.5 && touch.far == 1.5));
    CHECK_FALSE(exact_sphere({0.25, 1.25, 0}, std::nextafter(1, 0), down, nullptr, nullptr, search).near_found);
    const SphereHits behind = exact_sphere({0.25, 0.25, 3}, 1, down, nullptr, nullptr, search);
    CHECK((!behind.near_found && behind.far_found && behind.far == 0.5));
}

}  // namespace limn::filter_test
