// The judge is judged: closed forms, and rationals that solve the equations by elimination instead of Cramer's rule.
#include <boost/multiprecision/cpp_int.hpp>

#include "hard/hard.h"
#include "support/random_geometry.h"

namespace limn::exact_truth_test {

using namespace test;

namespace {

using Rational = boost::multiprecision::cpp_rational;
using Rational3 = std::array<Rational, 3>;

template <class Triple>
Rational3 exact(const Triple& p) {
    return {Rational(p.x), Rational(p.y), Rational(p.z)};
}
Rational3 operator-(const Rational3& a, const Rational3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// x of the columns a, b, c times x = right, by Gauss-Jordan elimination; nothing where there is no one solution.
std::optional<Rational3> solve(const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& right) {
    std::array<std::array<Rational, 4>, 3> rows;
    for (std::size_t i = 0; i < 3; ++i) rows[i] = {a[i], b[i], c[i], right[i]};
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t pivot = i;
        while (pivot < 3 && rows[pivot][i] == 0) ++pivot;
        if (pivot == 3) return std::nullopt;
        std::swap(rows[i], rows[pivot]);
        for (std::size_t j = 0; j < 3; ++j) {
            if (j == i) continue;
            const Rational factor = rows[j][i] / rows[i][i];
            for (std::size_t k = i; k < 4; ++k) rows[j][k] -= factor * rows[i][k];
        }
    }
    return Rational3{rows[0][3] / rows[0][0], rows[1][3] / rows[1][1], rows[2][3] / rows[2][2]};
}

bool in_range(const Rational& t, const Ray& ray) {
    return (!std::isfinite(ray.t_min) || t > Rational(ray.t_min)) &&
           (!std::isfinite(ray.t_max) || t <= Rational(ray.t_max));
}

// The ray in the object's space.
struct Inward {
    Rational3 origin, direction;
};
Inward inward(const Ray& ray, Chain chain) {
    Inward local{exact(ray.origin), exact(ray.direction)};
    for (const Transform& m : chain) {
        const auto column = [&](std::size_t j) {
            return Rational3{Rational(m.rows[0][j]), Rational(m.rows[1][j]), Rational(m.rows[2][j])};
        };
        local.origin = *solve(column(0), column(1), column(2), local.origin - column(3));
        local.direction = *solve(column(0), column(1), column(2), local.direction);
    }
    return local;
}

bool near(Real value, const Rational& truth) {
    const double rounded = static_cast<double>(truth);
    return absolute(value - Real(rounded)) <= Real(0x1p-52) * absolute(Real(rounded)) + Real(0x1p-1074);
}

struct Verdicts {
    int rays = 0, hits = 0, wrong = 0;
};

void compare_planar(Verdicts& verdicts, const Point3& corner, const Vec3& eu, const Vec3& ev, bool is_triangle,
                    const Ray& ray, Chain chain, const ExactHit& given) {
    const Inward local = inward(ray, chain);
    const Rational3 minus_d = Rational3{} - local.direction;
    const auto uvt = solve(exact(eu), exact(ev), minus_d, local.origin - exact(corner));
    bool hit = uvt.has_value();
    if (hit) {
        const auto& [u, v, t] = *uvt;
        hit = u >= 0 && v >= 0 && (is_triangle ? u + v <= 1 : u <= 1 && v <= 1) && in_range(t, ray);
        if (hit && !(near(given.u, u) && near(given.v, v) && near(given.t, t))) ++verdicts.wrong;
    }
    ++verdicts.rays, verdicts.hits += hit, verdicts.wrong += hit != given.hit;
}

// Is a root of a t^2 + 2 b t + c in the interval? Bisection between the interval's ends and the foot of the
// perpendicular would not end; the signs at the ends do it, for each half of the parabola.
void compare_sphere(Verdicts& verdicts, const Point3& center, double radius, const Ray& ray, Chain chain,
                    const ExactHit& given) {
    const Inward local = inward(ray, chain);
    const Rational3 w = local.origin - exact(center);
    const auto value = [&](const Rational& t) {
        Rational sum = -Rational(radius) * Rational(radius);
        for (std::size_t i = 0; i < 3; ++i) {
            const Rational p = w[i] + t * local.direction[i];
            sum += p * p;
        }
        return sum;
    };
    Rational a = 0, b = 0;
    for (std::size_t i = 0; i < 3; ++i) a += local.direction[i] * local.direction[i], b += w[i] * local.direction[i];
    const Rational foot = -b / a;
    bool hit = false;
    if (value(foot) <= 0) {
        const bool low_end = std::isfinite(ray.t_min), high_end = std::isfinite(ray.t_max);
        const Rational low = low_end ? Rational(ray.t_min) : 0, high = high_end ? Rational(ray.t_max) : 0;
        const bool near_above = !low_end || (low < foot && value(low) > 0);
        const bool near_below = !high_end || high >= foot || value(high) <= 0;
        const bool far_above = !low_end || low < foot || value(low) < 0;
        const bool far_below = !high_end || (high >= foot && value(high) >= 0);
        hit = (near_above && near_below) || (far_above && far_below);
        // The root itself: the value changes sign, or touches zero, within 1e-15 of it.
        if (hit && given.hit) {
            const Rational t(static_cast<double>(given.t)), step = abs(t) * Rational(0x1p-50);
            const Rational before = value(t - step), after = value(t + step);
            const bool is_near_root = near_above && near_below;
            const bool touches = t - step <= foot && foot <= t + step;
            if (!touches && !(is_near_root ? before >= 0 && after <= 0 : before <= 0 && after >= 0)) ++verdicts.wrong;
        }
    }
    ++verdicts.rays, verdicts.hits += hit, verdicts.wrong += hit != given.hit;
}

void require_all_right(const Verdicts& verdicts, int rays) {
    CHECK(verdicts.wrong == 0);
    CHECK(verdicts.rays == rays);
    CHECK(verdicts.hits > rays / 20);
    CHECK(verdicts.hits < rays * 19 / 20);
}

// None, one, or two matrices, of entries between 2^-20 and 2^20.
std::vector<Transform> random_chain(Random& random, std::size_t length) {
    std::vector<Transform> chain(length);
    for (Transform& m : chain) {
        m = Transform::rotate(random.unit(), random.uniform(0, 360)) *
            Transform::scale(random.log_uniform(1e-6, 1e6), random.sign() * random.log_uniform(0.1, 10), 2);
        for (auto& row : m.rows) row[3] = random.uniform(-5, 5);
    }
    return chain;
}

Ray into_world(Chain chain, const Ray& local) {
    Ray ray = local;
    for (auto m = chain.rbegin(); m != chain.rend(); ++m) {
        ray.origin = transform_point(*m, ray.origin);
        ray.direction = transform_vector(*m, ray.direction);
    }
    return ray;
}

}  // namespace

TEST_CASE("Exact truth: planar hits are those of rational elimination, also at edges and through instances",
          "[hard][truth]") {
    Random random(500);
    Verdicts triangles, quads;
    for (int i = 0; i < 300; ++i) {
        const std::vector<Transform> chain = random_chain(random, static_cast<std::size_t>(i % 3));
        const Point3 a = Point3{} + random.in_cube(3);
        const Vec3 eu = random.in_cube(), ev = random.chance(0.2) ? 1e-9 * random.unit() + 2 * eu : random.in_cube();
        const Targets targets{{a - Vec3{2, 2, 2}, a + Vec3{2, 2, 2}}, {a, a + eu, a + ev, a + 0.5 * eu, a + 0.25 * ev}};
        const Ray ray = into_world(chain, random_ray(random, targets));
        compare_planar(triangles, a, (a + eu) - a, (a + ev) - a, true, ray, chain,
                       exact_triangle_hit(a, a + ((a + eu) - a), a + ((a + ev) - a), ray, chain));
        compare_planar(quads, a, eu, ev, false, ray, chain, exact_quad_hit(a, eu, ev, ray, chain));
    }
    require_all_right(quads, 300);
    require_all_right(triangles, 300);
}

TEST_CASE("Exact truth: sphere hits are those of a parabola in rationals", "[hard][truth]") {
    Random random(501);
    Verdicts verdicts;
    for (int i = 0; i < 300; ++i) {
        const std::vector<Transform> chain = random_chain(random, static_cast<std::size_t>(i % 3));
        const Point3 c = Point3{} + random.in_cube(3);
        const double r = random.sign() * random.log_uniform(1e-3, 10), s = std::abs(r);
        const Targets targets{{c - Vec3{s, s, s}, c + Vec3{s, s, s}},
                              {c, c + Vec3{s, 0, 0}, c - Vec3{0, s, 0}, c + Vec3{0, 0, s}, c + s * random.unit()}};
        const Ray ray = into_world(chain, random_ray(random, targets));
        compare_sphere(verdicts, c, r, ray, chain, exact_sphere_hit(c, r, ray, chain));
    }
    require_all_right(verdicts, 300);
}

TEST_CASE("Exact truth: roots of known spheres, tangents, and ends of the interval", "[hard][truth]") {
    const auto t_of = [](const Point3& c, double r, const Ray& ray) { return exact_sphere_hit(c, r, ray).t; };
    const auto close = [](Real value, Real expected) { return absolute(value - expected) <= Real(1e-30) * expected; };
    CHECK(t_of({0, 0, 1e7}, 1, {.origin = {0, 0, 0}, .direction = {0, 0, 1}}) == Real(9999999));
    CHECK(close(t_of({0, 0, 1e7}, 1, {.origin = {0, 0.5, 0}, .direction = {0, 0, 1}}),
                Real(10000000) - square_root(Real(0.75))));
    CHECK(close(t_of({0, 0, 0}, 1, {.origin = {0, 0, 3}, .direction = {0, 0, -0x1p-1000}}), Real(0x1p1000) * 2));
    CHECK(close(t_of({0, 0, 0}, 1e-300, {.origin = {0, 0, 3e-300}, .direction = {0, 0, -1e300}}),
                (Real(3e-300) - Real(1e-300)) / Real(1e300)));
    // 3-4-5: t = 7 and 13 along (0, 0, -1); tangent at 4 to the side of a radius of 4.
    const Ray down{.origin = {0, 4, 10}, .direction = {0, 0, -1}};
    const auto within = [&](double t_min, double t_max) {
        return exact_sphere_hit({0, 0, 0}, 5, {down.origin, down.direction, t_min, t_max, 0});
    };
    CHECK(within(0, 7).t == 7);
    CHECK_FALSE(within(0, std::nextafter(7, 0)).hit);
    CHECK(within(std::nextafter(7, 0), 8).t == 7);
    CHECK(within(7, 13).t == 13);
    CHECK_FALSE(within(7, std::nextafter(13, 0)).hit);
    CHECK(within(std::nextafter(13, 0), 20).t == 13);
    CHECK_FALSE(within(13, kInfinity).hit);
    CHECK(within(-kInfinity, kInfinity).t == 7);
    CHECK(exact_sphere_hit({0, 0, 0}, -4, down).t == 10);
    CHECK_FALSE(exact_sphere_hit({0, 0, 0}, std::nextafter(4, 0), down).hit);
    CHECK_FALSE(exact_sphere_hit({0, 0, 0}, 4, {{0, 4, 10}, {0, 0x1p-1074, -1}, 0, kInfinity, 0}).hit);
    CHECK(exact_sphere_hit({0, 0, 0}, 4, {{0, 4, 10}, {0, -0x1p-1074, -1}, 0, kInfinity, 0}).hit);
}

TEST_CASE("Exact truth: a triangle ends at its edges, to the last subnormal", "[hard][truth]") {
    const Point3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
    const auto hit = [&](const Point3& o, const Vec3& d) {
        return exact_triangle_hit(a, b, c, {.origin = o, .direction = d});
    };
    const ExactHit inside = hit({1, 1, 3}, {0, 0, -1e-300});
    CHECK((inside.hit && inside.u == Real(0.25) && inside.v == Real(0.25)));
    CHECK(absolute(inside.t * Real(1e-300) - 3) < Real(1e-30));
    CHECK(hit({0, 0, 3}, {0, 0, -1}).hit);
    CHECK(hit({2, 2, 3}, {0, 0, -1}).hit);
    CHECK_FALSE(hit({2, 2, 3}, {0x1p-1074, 0, -1}).hit);
    CHECK(hit({2, 2, 3}, {-0x1p-1074, 0, -1}).hit);
    CHECK_FALSE(hit({1, 0, 3}, {0, -0x1p-1074, -1e300}).hit);
    CHECK_FALSE(hit({-1, 1, 0}, {1, 0, 0}).hit);
    CHECK(hit({-1, 1, 0x1p-1074}, {1, 0, -0x1p-1074}).hit);
    CHECK_FALSE(hit({1, 1, std::nan("")}, {0, 0, -1}).hit);
}

TEST_CASE("Exact truth: an instance turns, stretches and moves what it holds", "[hard][truth]") {
    const Transform chain[] = {Transform::translate({10, 0, 0}), Transform::scale(1, 2, -4), Transform::rotate_z(90)};
    // (x, y, z) goes to (10 - y, 2 x, -4 z).
    const Ray ray{.origin = {9.75, 1, -8}, .direction = {0, 0, 2}};
    const ExactHit quad = exact_quad_hit({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, ray, chain);
    CHECK((quad.hit && quad.t == 2 && quad.u == Real(0.5) && quad.v == Real(0.25)));
    const ExactHit triangle = exact_triangle_hit({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, ray, chain);
    CHECK((triangle.hit && triangle.t == 2 && triangle.u == Real(0.5) && triangle.v == Real(0.25)));
    CHECK(exact_sphere_hit({0, 0, 0}, 1, {.origin = {10, 0, 9}, .direction = {0, 0, -1}}, chain).t == 5);
    CHECK(exact_sphere_hit({0, 0, 0}, 1, {.origin = {10, 9, 0}, .direction = {0, -1, 0}}, chain).t == 7);
    CHECK(exact_sphere_hit({0, 0, 0}, 1, {.origin = {11, 9, 0}, .direction = {0, -1, 0}}, chain).t == 9);
    CHECK_FALSE(exact_sphere_hit({0, 0, 0}, 1, {.origin = {11, 9, 0}, .direction = {0x1p-1074, -1, 0}}, chain).hit);
}

TEST_CASE("Exact truth: a box is closed, its sides may be flat or infinite, and so is the interval", "[hard][truth]") {
    const Box box{{0, 0, 0}, {1, 2, 4}};
    const auto hit = [](const Box& b, const Point3& o, const Vec3& d, double t_min = 0, double t_max = kInfinity) {
        return exact_box_hit(b, {o, d, t_min, t_max, 0});
    };
    CHECK(hit(box, {-1, 1, 1}, {1, 0, 0}, 0, 1));
    CHECK_FALSE(hit(box, {-1, 1, 1}, {1, 0, 0}, 0, std::nextafter(1, 0)));
    CHECK(hit(box, {-1, 1, 1}, {1, 0, 0}, 2));
    CHECK_FALSE(hit(box, {-1, 1, 1}, {1, 0, 0}, std::nextafter(2, 3)));
    CHECK(hit(box, {-1, 2, 0}, {1, -0.0, 0}));
    CHECK_FALSE(hit(box, {-1, std::nextafter(2, 3), 0}, {1, -0.0, 0}));
    CHECK(hit(box, {-1, 1, 2}, {1, 1, 0}));  // through the edge x = 0, y = 2
    CHECK_FALSE(hit(box, {-1, 1, 2}, {1, std::nextafter(1, 2), 0}));
    CHECK(hit(box, {-1, -1, -1}, {1e-300, 1e-300, 1e-300}));
    CHECK(hit({{1, 0, 0}, {1, 1, 1}}, {0, 0, 0}, {3, 1, 1}));
    CHECK(hit({{-kInfinity, 0, -kInfinity}, {kInfinity, 0, kInfinity}}, {5, 1, 5}, {1e300, -1e-300, 0}));
    CHECK_FALSE(hit({{-kInfinity, 0, -kInfinity}, {kInfinity, 0, kInfinity}}, {5, 1, 5}, {1, 1, 0}));
    CHECK_FALSE(hit(Box{}, {0, 0, 0}, {1, 1, 1}));
}

TEST_CASE("Exact truth: only three points on one line are flat", "[hard][truth]") {
    CHECK(exactly_flat({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
    CHECK_FALSE(exactly_flat({0, 0, 0}, {1, 1, 1}, {2, 2, std::nextafter(2, 3)}));
    CHECK(exactly_flat({0, 0, 0}, {1e-200, 0, 0}, {1e300, 0, 0}));
    CHECK_FALSE(exactly_flat({0, 0, 0}, {1e-300, 0, 0}, {0, 0x1p-1074, 0}));
    // 0.1, 0.2, 0.3 are not multiples of one double.
    CHECK_FALSE(exactly_flat({0, 0, 0}, {0.1, 0.2, 0}, {0.3, 0.6, 0x1p-60}));
}

TEST_CASE(
    "The judge notices what is missed, hit falsely, or at another t, u or v, and beside an end the reported t decides",
    "[hard][truth]") {
    const Ray ray{{0, 0, 3}, {0, 0, -1}, 0, kInfinity, 0};
    const auto faults = [](const Ray& r, const ExactHit& truth, const std::optional<Answer>& answer) {
        const auto within = [](double t, const Ray& asked) { return t > asked.t_min && t <= asked.t_max; };
        Tally tally;
        judge(
            tally, r,
            [&](const Ray& asked) {
                const bool inside = truth.hit && truth.t > Real(asked.t_min) && truth.t <= Real(asked.t_max);
                return inside ? truth : ExactHit{};
            },
            [&](const Ray& asked) { return answer && within(answer->t, asked) ? answer : std::nullopt; });
        return tally.wrong;
    };
    const ExactHit three{true, 3, Real(0.25), Real(0.5)};
    CHECK(faults(ray, three, Answer{3, 0.25, 0.5, 0}) == 0);
    CHECK(faults(ray, {}, std::nullopt) == 0);
    CHECK(faults(ray, three, std::nullopt) == 1);
    CHECK(faults(ray, {}, Answer{3, 0.25, 0.5, 0}) == 1);
    CHECK(faults(ray, three, Answer{3 + 3 * 0x1.1p-23, 0.25, 0.5, 0}) == 1);
    CHECK(faults(ray, three, Answer{3 + 3 * 0x0.fp-23, 0.25, 0.5, 0}) == 0);
    CHECK(faults(ray, three, Answer{3, 0.25 + 0x1.1p-23, 0.5, 0}) == 1);
    CHECK(faults(ray, three, Answer{3, 0.25, 0.5 - 0x1.1p-23, 0}) == 1);
    for (const double t : {3.0, std::nextafter(3, 0), std::nextafter(3, 4)}) {
        const Answer reported{t, 0.25, 0.5, 0};
        for (const double end : {2.0, std::nextafter(3, 0), 3.0, std::nextafter(3, 4), 4.0}) {
            CHECK(faults({ray.origin, ray.direction, 0, end, 0}, three, reported) == 0);
            CHECK(faults({ray.origin, ray.direction, end, kInfinity, 0}, three, reported) == 0);
        }
    }
    CHECK(faults({ray.origin, ray.direction, 0, 2, 0}, three, Answer{1, 0.25, 0.5, 0}) == 1);
    CHECK(faults({ray.origin, ray.direction, 2.9, 3, 0}, three, std::nullopt) == 1);
}

TEST_CASE("The judge goes on behind a hit at t_min by its rounding, however little the exact t is above",
          "[hard][truth]") {
    // To z = -1 and z = 1: the first t is -1 + 2^-1022, which is -1 as a Real, too.
    const Ray ray{{0, 0, -0x1p-1022}, {0, 0, 1}, -1, kInfinity, 0};
    const auto exact = [](const Ray& asked) {
        const ExactHit first = exact_quad_hit({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, asked);
        return first.hit ? first : exact_quad_hit({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, asked);
    };
    REQUIRE(exact(ray).t == -1);
    const auto faults = [&](const std::optional<Answer>& second) {
        Tally tally;
        judge(tally, ray, exact, [&](const Ray& asked) { return asked.t_min < -1 ? Answer{-1, 0.5, 0.5, 0} : second; });
        return tally.wrong;
    };
    CHECK(faults(Answer{1, 0.5, 0.5, 0}) == 0);
    CHECK(faults(Answer{1 + 0x1p-20, 0.5, 0.5, 0}) == 1);
    CHECK(faults(std::nullopt) == 1);
}

}  // namespace limn::exact_truth_test
