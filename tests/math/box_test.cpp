#include "limn/math/box.h"

#include <array>

#include "catch.h"
#include "limn/math/transform.h"
#include "property.h"
#include "support/random_geometry.h"
#include "support/real.h"

namespace limn::box_test {

using limn::test::Random;

namespace {

Box random_box(Random& random, double center, double size) {
    Box box;
    const Point3 p = Point3{} + random.in_cube(center);
    box.extend(p);
    box.extend(p + random.in_cube(size));
    return box;
}

}  // namespace

TEST_CASE("Box: a default box is empty, contains nothing and changes nothing that it is merged with", "[core][box]") {
    const Box empty, unit{{0, 0, 0}, {1, 1, 1}};
    CHECK(empty.is_empty());
    CHECK_FALSE(unit.is_empty());
    CHECK_FALSE(empty.contains(Point3{}));
    CHECK(merge(empty, unit) == unit);
    CHECK(merge(unit, empty) == unit);
    CHECK(unit.contains(empty));
    CHECK(surface_area(empty) == 0);
    CHECK(surface_area(Box{{0, 0, 0}, {1, 2, 3}}) == 22);
    CHECK(grow(empty, {1, 1, 1}).is_empty());
    CHECK(transform_box(Transform::translate({1, 2, 3}), empty).is_empty());
}

TEST_CASE("Box: one point and a flat box are not empty, and the border belongs to the box", "[core][box]") {
    const Box point{{1, 2, 3}, {1, 2, 3}};
    CHECK_FALSE(point.is_empty());
    CHECK(point.contains(Point3{1, 2, 3}));
    CHECK(point.center() == Point3{1, 2, 3});
    CHECK(Box({1, 0, 0}, {0, 1, 1}).is_empty());
    const double big = std::numeric_limits<double>::max();
    CHECK(Box({big, 0, 0}, {big, 1, 1}).center().x == big);  // no overflow on the way
}

TEST_CASE("Box: each of its six sides bounds it, for points and for boxes", "[core][box]") {
    const Box box{{0, 10, 20}, {1, 12, 24}};
    CHECK(box.center() == Point3{0.5, 11, 22});
    CHECK(box.diagonal() == Vec3{1, 2, 4});
    CHECK(surface_area(box) == 2 * (1 * 2 + 2 * 4 + 4 * 1));
    CHECK((box.contains(box) && box.contains(Box{box.center(), box.upper})));
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Point3 border = box.center(), beyond = border;
            border[axis] = side < 0 ? box.lower[axis] : box.upper[axis];
            beyond[axis] = std::nextafter(border[axis], side * kInfinity);
            CHECK(box.contains(border));
            CHECK_FALSE(box.contains(beyond));
            Box wider = box, turned = box;
            wider.extend(beyond);
            CHECK_FALSE(box.contains(wider));
            CHECK(wider.contains(box));
            CHECK((wider.lower[axis] == box.lower[axis]) == (side > 0));
            CHECK((wider.upper[axis] == box.upper[axis]) == (side < 0));
            (side < 0 ? turned.lower : turned.upper)[axis] = side < 0 ? 100 : -100;
            CHECK(turned.is_empty());
            CHECK(box.contains(turned));  // nothing is in it that is not in any other
            CHECK(surface_area(turned) == 0);
            Box nan = box;
            (side < 0 ? nan.lower : nan.upper)[axis] = std::nan("");
            CHECK(nan.is_empty());
        }
}

TEST_CASE("Box: merging gives the smallest box around both, in either order", "[core][box]") {
    using Corner = std::array<double, 3>;
    const auto spanned = [](const Corner& p, const Corner& q) {
        Box box;
        box.extend(Point3{p[0], p[1], p[2]});
        box.extend(Point3{q[0], q[1], q[2]});
        return box;
    };
    test::holds([&](const Corner& p, const Corner& q, const Corner& r, const Corner& s) {
        const Box a = spanned(p, q), b = spanned(r, s), m = merge(a, b);
        RC_ASSERT((m.contains(a) && m.contains(b)));
        RC_ASSERT(m == merge(b, a));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            RC_ASSERT((m.lower[axis] == a.lower[axis] || m.lower[axis] == b.lower[axis]));
            RC_ASSERT((m.upper[axis] == a.upper[axis] || m.upper[axis] == b.upper[axis]));
        }
    });
}

TEST_CASE("grow: every face moves strictly outward by at least the amount", "[core][box]") {
    Random random(4);
    for (int i = 0; i < 5000; ++i) {
        const Box box = random_box(random, random.log_uniform(1e-6, 1e9), random.log_uniform(1e-6, 1e3));
        const Vec3 amount = limn::abs(random.in_cube(random.chance(0.3) ? 0 : random.log_uniform(1e-18, 1)));
        const Box grown = grow(box, amount);
        for (std::size_t a = 0; a < 3; ++a) {
            CHECK(test::Real(grown.lower[a]) <= test::Real(box.lower[a]) - test::Real(amount[a]));
            CHECK(test::Real(grown.upper[a]) >= test::Real(box.upper[a]) + test::Real(amount[a]));
            CHECK(grown.lower[a] < box.lower[a]);
            CHECK(grown.upper[a] > box.upper[a]);
        }
    }
}

TEST_CASE("transform_box: contains the exact image of every point of the box, and is tight", "[core][box]") {
    Random random(5);
    for (int i = 0; i < 3000; ++i) {
        Transform m;
        for (auto& row : m.rows)
            for (double& entry : row)
                entry = random.sign() * random.log_uniform(1e-3, 1e3) * (random.chance(0.2) ? 0 : 1);
        for (auto& row : m.rows) row[3] *= random.log_uniform(1, 1e6);
        const Box box = random_box(random, random.log_uniform(1e-3, 1e6), random.log_uniform(1e-3, 1e3));
        const Box image = transform_box(m, box);
        test::Real lower[3], upper[3];
        bool all_inside = true;
        for (int corner = 0; corner < 8; ++corner) {
            const test::Real3 p{corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                                corner & 4 ? box.upper.z : box.lower.z};
            const test::Real3 q = test::transform_point(m, p);
            const test::Real at[3] = {q.x, q.y, q.z};
            for (std::size_t a = 0; a < 3; ++a) {
                all_inside = all_inside && at[a] >= test::Real(image.lower[a]) && at[a] <= test::Real(image.upper[a]);
                lower[a] = corner == 0 ? at[a] : std::min(lower[a], at[a]);
                upper[a] = corner == 0 ? at[a] : std::max(upper[a], at[a]);
            }
        }
        CHECK(all_inside);
        for (std::size_t a = 0; a < 3; ++a) {
            double magnitude = std::abs(m.rows[a][3]) + 1e-300;  // a row of zeros still grows to the next double
            for (std::size_t j = 0; j < 3; ++j)
                magnitude += std::abs(m.rows[a][j]) * std::max(std::abs(box.lower[j]), std::abs(box.upper[j]));
            CHECK(static_cast<double>(lower[a] - test::Real(image.lower[a])) <= 1e-14 * magnitude);
            CHECK(static_cast<double>(test::Real(image.upper[a]) - upper[a]) <= 1e-14 * magnitude);
        }
    }
}

TEST_CASE("transform_box: the box of something unbounded stays unbounded", "[core][box]") {
    // An infinite floor, as a user's own shape may have it.
    const Box floor{{-kInfinity, 0, -kInfinity}, {kInfinity, 0, kInfinity}};
    for (const Transform& m : {Transform::translate({1, 2, 3}), Transform::rotate_y(90), Transform::scale(2, 3, 4)}) {
        const Box image = transform_box(m, floor);
        CHECK(image.contains(transform_point(m, {1e30, 0, -1e30})));
        CHECK(image.contains(transform_point(m, {0, 0, 0})));
    }
}

}  // namespace limn::box_test
