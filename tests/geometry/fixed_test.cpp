// Integers of fixed size, the first stage of the exact fallback: they give the same answers, bit for bit, as integers
// of any length.
#include "geometry/fixed.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "catch.h"
#include "geometry/exact.h"
#include "support/random_geometry.h"

namespace limn::fixed_test {

using test::Random;

namespace {

Dyadic to_dyadic(std::int64_t x) {
    const std::int64_t high = x >> 32;
    return Dyadic(static_cast<double>(high)) * Dyadic(0x1p32) + Dyadic(static_cast<double>(x - (high << 32)));
}
Dyadic unsigned_to_dyadic(std::uint64_t x) {
    return to_dyadic(static_cast<std::int64_t>(x >> 1)) * Dyadic(2.0) + Dyadic(static_cast<double>(x & 1));
}
Dyadic to_dyadic(const Int192& x) {
    const auto middle = static_cast<std::uint64_t>(x.high);
    return to_dyadic(static_cast<std::int64_t>(x.high >> 64)) * Dyadic(0x1p128) +
           unsigned_to_dyadic(middle) * Dyadic(0x1p64) + unsigned_to_dyadic(x.low);
}
Dyadic3 to_dyadic(const Int64x3& v) { return {to_dyadic(v.x), to_dyadic(v.y), to_dyadic(v.z)}; }

// Returns a whole number of at most `bits` bits besides the sign, often one with only its first or last bits set.
std::int64_t some_whole(Random& random, int bits) {
    const std::int64_t most = (std::int64_t{1} << bits) - 1;
    const auto size = static_cast<std::int64_t>(random.log_uniform(1, 0x1p52)) << random.index(10);
    const std::int64_t values[] = {0,    1,   most, most - 1, std::int64_t{1} << 32, (std::int64_t{1} << 32) - 1,
                                   size, size};
    return (values[random.index(8)] & most) * (random.chance(0.5) ? 1 : -1);
}
Int64x3 some_vector(Random& random, int bits) {
    const std::int64_t x = some_whole(random, bits), y = some_whole(random, bits);
    return {x, y, some_whole(random, bits)};
}

// A triangle, and a ray that often starts on it, is in its plane or passes through an edge.
struct Case {
    Point3 a, b, c;
    Ray ray;

    explicit Case(Random& random) {
        const double size = std::ldexp(1.0, static_cast<int>(random.index(80)) - 40);
        const auto corner = [&] {
            const Vec3 v = size * random.in_cube();
            const auto rounded = [&](double x) { return static_cast<double>(static_cast<float>(x)); };
            return random.chance(0.8) ? Point3{rounded(v.x), rounded(v.y), rounded(v.z)} : Point3{} + v;
        };
        a = corner();
        b = corner();
        c = corner();
        const double u = random.chance(0.5) ? 0 : random.uniform(), v = random.chance(0.3) ? 1 - u : 0.5 * (1 - u);
        const Point3 at = a + (u * (b - a) + v * (c - a));
        const Point3 starts[] = {a, b, a + 0.5 * (b - a), at, corner(), corner()};
        ray.origin = starts[random.index(6)];
        const Vec3 directions[] = {size * random.unit(), b - a, at - ray.origin,
                                   random.uniform(-2, 2) * (at - ray.origin)};
        ray.direction = directions[random.index(4)];
        if (ray.direction == Vec3{}) ray.direction = random.unit();
        if (random.chance(0.1)) ray.direction = 0x1p-300 * ray.direction;
        if (random.chance(0.2)) ray.t_min = random.uniform(-3, 0.5);
    }
};

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Calls exact(frame, hit) for a ray as it is, which integers of fixed size decide if they hold its numbers, and for its
// image by the identity, which integers of any length decide. Returns 1 for a hit, 0 for a miss, 2 if they differ.
template <class Exact>
int decide_twice(const Ray& ray, const Exact& exact) {
    const RayFrame as_it_is(ray);
    const Transform identity;
    const RayFrame inside(as_it_is, identity);
    PlanarHit fixed{}, dyadic{};
    const bool is_hit = exact(as_it_is, fixed);
    if (is_hit != exact(inside, dyadic)) return 2;
    const bool same = same_bits(fixed.t, dyadic.t) && same_bits(fixed.u, dyadic.u) && same_bits(fixed.v, dyadic.v);
    return !is_hit ? 0 : same ? 1 : 2;
}

}  // namespace

TEST_CASE("Integers of fixed size: triple products are exact up to the ends of their range", "[geometry][fixed]") {
    Random random(1);
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const Int64x3 a = some_vector(random, 62), b = some_vector(random, 62), c = some_vector(random, 62);
        const Int192 fixed = dot(cross(a, b), c);
        const Dyadic exact = dot(cross(to_dyadic(a), to_dyadic(b)), to_dyadic(c));
        const Int192 negative = Int192{} - fixed;
        wrong += fixed.sign() != exact.sign() || !(to_dyadic(fixed) == exact);
        wrong += negative.sign() != -exact.sign() || !(to_dyadic(negative) == -exact);
        wrong += (fixed + negative).sign() != 0;
        const Int192 other = dot(cross(b, c), c - a);
        if (exact.sign() != 0) wrong += ratio(other, fixed) != ratio(to_dyadic(other), exact);
    }
    CHECK(wrong == 0);
}

TEST_CASE("Integers of fixed size: a grid says whether it holds a number exactly", "[geometry][fixed]") {
    FixedGrid grid(3.5);
    CHECK(grid(3.5) == std::int64_t{7} << 58);
    CHECK(grid(-0x1p-58) == -2);
    CHECK(grid.is_exact());
    grid(0x1p-60);
    CHECK_FALSE(grid.is_exact());
    for (const double unusual : {0.0, 0x1p-1000, 0x1p60, kInfinity, std::numeric_limits<double>::quiet_NaN()})
        CHECK_FALSE(FixedGrid(unusual).is_exact());
}

TEST_CASE("Integers of fixed size: triangles and quads are decided as with integers of any length, to the bit",
          "[geometry][fixed]") {
    Random random(2);
    int hits = 0, misses = 0, wrong = 0;
    const auto add = [&](int result) { ++(result == 0 ? misses : result == 1 ? hits : wrong); };
    for (int i = 0; i < 20000; ++i) {
        const Case of(random);
        const Search search{of.ray.t_min, of.ray.t_max};
        add(decide_twice(of.ray, [&](const RayFrame& frame, PlanarHit& hit) {
            return exact_triangle(of.a, of.b, of.c, frame, search, hit);
        }));
        add(decide_twice(of.ray, [&](const RayFrame& frame, PlanarHit& hit) {
            return exact_quad(of.a, of.b - of.a, of.c - of.a, frame, search, hit);
        }));
    }
    CHECK(wrong == 0);
    CHECK(hits > 4000);
    CHECK(misses > 4000);
}

}  // namespace limn::fixed_test
