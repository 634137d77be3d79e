#include "limn/math/transform.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/math/math.h"
#include "property.h"
#include "support/grid.h"
#include "support/random_geometry.h"

namespace limn::transform_test {

using limn::test::Random;

namespace {

Transform random_transform(Random& random) {
    const Transform turn = Transform::rotate(random.unit(), random.uniform(-360, 360));
    const Vec3 s{random.sign() * random.log_uniform(0.1, 10), random.log_uniform(0.1, 10), random.log_uniform(0.1, 10)};
    return Transform::translate(random.in_cube(100)) * turn * Transform::scale(s.x, s.y, s.z);
}

double difference(const Transform& a, const Transform& b) {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) largest = std::max(largest, std::abs(a.rows[i][j] - b.rows[i][j]));
    return largest;
}

// Whole numbers: products of three are exact.
Transform draw_whole() {
    Transform m;
    for (auto& row : m.rows)
        for (double& entry : row) entry = test::draw_int(-100, 100);
    return m;
}

// Of determinant 1 or -1, so that its inverse is whole as well: shears, a permutation and mirrors one after the other.
Transform draw_unimodular() {
    Transform m = Transform::scale(test::draw_int(0, 1) ? 1 : -1, 1, 1);
    for (int i = 0; i < 4; ++i) {
        Transform shear;
        const int a = test::draw_int(0, 2), b = (a + test::draw_int(1, 2)) % 3;
        shear.rows[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = test::draw_int(-4, 4);
        m = shear * Transform::rotate_z(90) * Transform::rotate_x(90) * m;
    }
    return Transform::translate({double(test::draw_int(-99, 99)), double(test::draw_int(-99, 99)), 7}) * m;
}

Transform singular(int kind) {
    Transform m;
    if (kind == 0) m = Transform::scale(1, 0, 1);
    if (kind == 1) m.rows = {{{1, 2, 3, 0}, {2, 4, 6, 0}, {0, 0, 1, 0}}};
    if (kind == 2) m = Transform::scale(0, 0, 0);
    if (kind == 3) m.rows[1][2] = std::numeric_limits<double>::quiet_NaN();
    if (kind == 4) m.rows[0][3] = kInfinity;
    return m;
}

}  // namespace

TEST_CASE("Transform: a product applies its right factor first", "[core][transform]") {
    const Transform m = Transform::translate({10, 0, 0}) * Transform::rotate_y(90);
    CHECK(transform_point(m, {0, 0, 1}) == Point3{11, 0, 0});
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        const Transform a = random_transform(random), b = random_transform(random);
        const Point3 p = Point3{} + random.in_cube(10);
        const Vec3 v = random.in_cube(10);
        CHECK(length(transform_point(a * b, p) - transform_point(a, transform_point(b, p))) <= 1e-11);
        CHECK(length(transform_vector(a * b, v) - transform_vector(a, transform_vector(b, v))) <= 1e-11);
    }
}

TEST_CASE("Transform: translate moves points and no vectors, scale stretches each axis by its own factor",
          "[core][transform]") {
    const Transform moved = Transform::translate({1, -2, 4}), scaled = Transform::scale(2, -4, 8);
    for (const Vec3 v : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{-3, 5, 7}}) {
        CHECK(transform_point(moved, Point3{} + v) == Point3{1, -2, 4} + v);
        CHECK(transform_vector(moved, v) == v);
        CHECK(transform_vector(scaled, v) == Vec3{2 * v.x, -4 * v.y, 8 * v.z});
        CHECK(transform_point(scaled, Point3{} + v) == Point3{2 * v.x, -4 * v.y, 8 * v.z});
    }
    CHECK(moved.translation() == Vec3{1, -2, 4});
}

TEST_CASE("Transform: quarter turns are exact, right-handed permutations", "[core][transform]") {
    const Point3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    CHECK(transform_point(Transform::rotate_x(90), y) == z);
    CHECK(transform_point(Transform::rotate_y(90), z) == x);
    CHECK(transform_point(Transform::rotate_z(90), x) == y);
    for (const auto rotate : {&Transform::rotate_x, &Transform::rotate_y, &Transform::rotate_z}) {
        for (int turns = -8; turns <= 8; ++turns) {
            const Transform m = rotate(90.0 * turns);
            for (const auto& row : m.rows)
                for (const double entry : row) CHECK((entry == 0 || entry == 1 || entry == -1));
            CHECK(rotate(90.0 * turns + 360) == m);
            CHECK(m * rotate(-90.0 * turns) == Transform{});
        }
    }
    CHECK(Transform::rotate({0, 0, 2}, 90) == Transform::rotate_z(90));
}

TEST_CASE("Transform: rotations keep lengths, angles add up, and the axis stays", "[core][transform]") {
    Random random(7);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 axis = random.log_uniform(1e-3, 1e3) * random.unit(), v = random.in_cube();
        const double a = random.uniform(-400, 400), b = random.uniform(-400, 400);
        const Transform m = Transform::rotate(axis, a);
        CHECK(length(transform_vector(m, v)) == Approx(length(v)).epsilon(1e-14));
        CHECK(length(transform_vector(m, axis) - axis) <= 1e-14 * length(axis));
        CHECK(difference(m * Transform::rotate(axis, b), Transform::rotate(axis, a + b)) <= 1e-14);
        CHECK(determinant(m) == Approx(1).epsilon(1e-14));
    }
    CHECK(difference(Transform::rotate({0, 1, 0}, 33), Transform::rotate_y(33)) <= 1e-15);
    CHECK_THROWS_AS(Transform::rotate({0, 0, 0}, 30), ArgumentError);
    CHECK_THROWS_AS(Transform::rotate({0, kInfinity, 0}, 30), ArgumentError);
}

TEST_CASE("Transform: products of whole matrices are associative, determinants multiply, points follow, to the bit",
          "[core][transform]") {
    test::holds([] {
        const Transform a = draw_whole(), b = draw_whole(), c = draw_whole();
        RC_ASSERT((a * b) * c == a * (b * c));
        RC_ASSERT((a * Transform{} == a && Transform{} * a == a));
        RC_ASSERT(determinant(a * b) == determinant(a) * determinant(b));
        const Point3 p = test::draw_point(), q = test::draw_point();
        RC_ASSERT(transform_point(a * b, p) == transform_point(a, transform_point(b, p)));
        RC_ASSERT(transform_vector(a * b, p - q) == transform_vector(a, transform_vector(b, p - q)));
        RC_ASSERT(transform_point(a, p) - transform_point(a, q) == transform_vector(a, p - q));
    });
}

TEST_CASE("inverse: that of a whole matrix of determinant 1 or -1 is exact, and turns products around",
          "[core][transform]") {
    test::holds([] {
        const Transform a = draw_unimodular(), b = draw_unimodular();
        const double s = test::draw_power_of_two(-90, 90);
        RC_ASSERT((a * inverse(a) == Transform{} && inverse(a) * a == Transform{}));
        RC_ASSERT(inverse(inverse(a)) == a);
        RC_ASSERT(inverse(a * b) == inverse(b) * inverse(a));
        RC_ASSERT(inverse(Transform::scale(s, s, s) * a) == inverse(a) * Transform::scale(1 / s, 1 / s, 1 / s));
        // Normals: M^-T n meets M v as n meets v.
        const Vec3 n = test::draw_vec(), v = test::draw_vec();
        RC_ASSERT(dot(transform_normal(inverse(a), Normal3(n)), transform_vector(a, v)) == dot(n, v));
    });
}

TEST_CASE("inverse: undoes the transform on both sides, at every scale", "[core][transform]") {
    Random random(8);
    for (int i = 0; i < 2000; ++i) {
        const Transform m = random_transform(random), inv = inverse(m);
        CHECK(difference(m * inv, Transform{}) <= 1e-11);
        CHECK(difference(inv * m, Transform{}) <= 1e-11);
    }
    for (const double s : {1e-150, 1e-100, 1e-30, 1e30, 1e100, 1e150}) {
        const Transform inv = inverse(Transform::scale(s, -2 * s, 4 * s));
        CHECK(inv.rows[0][0] == Approx(1 / s).epsilon(1e-15));
        CHECK(inv.rows[1][1] == Approx(-0.5 / s).epsilon(1e-15));
        CHECK(inv.rows[2][2] == Approx(0.25 / s).epsilon(1e-15));
    }
    const Transform lopsided = inverse(Transform::scale(1, 1e-3, 1e3));
    CHECK(lopsided.rows[1][1] == Approx(1e3).epsilon(1e-15));
}

TEST_CASE("inverse: a singular or non-finite matrix is refused", "[core][transform]") {
    for (int kind = 0; kind < 5; ++kind) CHECK_THROWS_AS(inverse(singular(kind)), ArgumentError);
}

TEST_CASE("determinant: that of a product is the product, a mirror turns its sign", "[core][transform]") {
    Random random(9);
    for (int i = 0; i < 500; ++i) {
        const Transform a = random_transform(random), b = random_transform(random);
        CHECK(determinant(a * b) == Approx(determinant(a) * determinant(b)).epsilon(1e-11));
    }
    CHECK(determinant(Transform::scale(-1, 1, 1)) == -1);
    CHECK(determinant(Transform::translate({5, 6, 7})) == 1);
}

TEST_CASE("transform_normal: stays perpendicular to every transformed tangent", "[core][transform]") {
    Random random(10);
    for (int i = 0; i < 1000; ++i) {
        Transform m = random_transform(random);
        m.rows[0][1] += random.uniform(-1, 1);  // a shear
        const Vec3 tangent = random.unit(), other = random.unit();
        const Normal3 n(normalize(cross(tangent, other)));
        const Normal3 image = transform_normal(inverse(m), n);
        CHECK(std::abs(dot(image, transform_vector(m, tangent))) <= 1e-12 * length(Vec3(image)) * 20);
        CHECK(std::abs(dot(image, transform_vector(m, other))) <= 1e-12 * length(Vec3(image)) * 20);
        CHECK(dot(image, transform_vector(m, Vec3(n))) > 0);
    }
}

TEST_CASE("interpolate: bit-exact at both ends, clamped outside, linear between", "[core][transform]") {
    Random random(11);
    for (int i = 0; i < 1000; ++i) {
        const Transform a = random_transform(random), b = random_transform(random);
        CHECK(interpolate(a, b, 0) == a);
        CHECK(interpolate(a, b, 1) == b);
        CHECK(interpolate(a, b, -2) == a);
        CHECK(interpolate(a, b, 3) == b);
        const double t = random.uniform();
        const Transform m = interpolate(a, b, t);
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 4; ++c)
                CHECK(m.rows[r][c] == Approx(a.rows[r][c] + t * (b.rows[r][c] - a.rows[r][c])).margin(1e-12));
    }
}

}  // namespace limn::transform_test
