#include "geometry/bvh/walk.h"

#include <random>
#include <set>

#include "catch.h"
#include "geometry/bvh/float_box.h"
#include "property.h"
#include "support/grid.h"

namespace limn::walk_test {

using accel::build_wide_bvh;
using accel::FloatBox;
using accel::WideBvh;

namespace {

std::vector<Box> random_boxes(std::size_t count, double size) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> unit(0, size);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const Point3 p{unit(random), unit(random), unit(random)};
        boxes.emplace_back(p, p + Vec3{unit(random) / 10, unit(random) / 10, unit(random) / 10});
    }
    return boxes;
}

struct Scaled {
    WideBvh bvh;
    double extent = 0, scale = 1;

    explicit Scaled(const std::vector<Box>& boxes) {
        for (const Box& box : boxes) extent = std::max(extent, accel::finite_extent(box));
        scale = accel::scale_to_one(extent);
        std::vector<FloatBox> scaled;
        for (const Box& box : boxes) scaled.push_back(accel::to_float_box(box, scale));
        bvh = build_wide_bvh(scaled, {.leaf_width = 1});
    }

    template <class Visit>
    void walk(const Ray& ray, const Visit& visit) const {
        accel::for_each_met(bvh, scale, accel::SlabRay(ray, extent), ray.t_max, visit);
    }
};

}  // namespace

TEST_CASE("for_each_met: a ray visits every box that it meets, and far fewer than all, at any scale", "[accel]") {
    for (const double size : {1.0, 1e-300, 1e300}) {
        const std::vector<Box> boxes = random_boxes(3000, size);
        const Scaled tree(boxes);
        std::mt19937_64 random(2);
        std::uniform_real_distribution<double> unit(-1, 1);
        std::size_t visits = 0;
        const int rays = 200;
        for (int r = 0; r < rays; ++r) {
            const Ray ray{{size * unit(random), size * unit(random), size * unit(random)},
                          {unit(random), unit(random), unit(random)}};
            std::set<std::uint32_t> visited;
            tree.walk(ray, [&](std::uint32_t index) {
                visited.insert(index);
                return ray.t_max;
            });
            visits += visited.size();
            const accel::SlabRay slab(ray, tree.extent);
            for (std::uint32_t index = 0; index < boxes.size(); ++index) {
                double near = 0;
                if (slab.meets(boxes[index], ray.t_max, near)) REQUIRE(visited.count(index) == 1);
            }
        }
        CHECK(visits < boxes.size() / 20 * rays);
    }
}

TEST_CASE("for_each_met: nearer boxes are visited first, and none beyond what visit returns", "[accel]") {
    std::vector<Box> row;
    for (int i = 0; i < 64; ++i) row.emplace_back(Point3{2.0 * i, 0, 0}, Point3{2.0 * i + 1, 1, 1});
    const Scaled tree(row);
    for (const double way : {1.0, -1.0}) {
        for (const int from : {0, 20, 63}) {
            const Ray ray{.origin = {2.0 * from + 0.5 - way, 0.5, 0.5}, .direction = {way, 0, 0}};
            const int last = way > 0 ? 63 : 0;
            std::vector<std::uint32_t> visited;
            tree.walk(ray, [&](std::uint32_t index) {
                visited.push_back(index);
                return kInfinity;
            });
            std::vector<std::uint32_t> expected;
            for (int i = from; i != last + (way > 0 ? 1 : -1); i += way > 0 ? 1 : -1)
                expected.push_back(static_cast<std::uint32_t>(i));
            CHECK(visited == expected);
            std::size_t visits = 0;
            tree.walk(ray, [&](std::uint32_t) {  // the first box is hit at t = 0.5
                ++visits;
                return 0.5;
            });
            CHECK(visits == 1);
        }
    }
}

TEST_CASE("to_float_box: the box in float holds the box in double, and is no wider than an ulp on each side",
          "[accel]") {
    test::holds(
        [] {
            Box box;
            box.extend(Point3{} + test::draw_power_of_two(-100, 100) / 3 * test::draw_vec());
            box.extend(test::draw_point());
            const double scale = test::draw_power_of_two(-5, 5);
            const FloatBox f = accel::to_float_box(box, scale);
            for (std::size_t a = 0; a < 3; ++a) {
                RC_ASSERT(static_cast<double>(f.lower[a]) <= scale * box.lower[a]);
                RC_ASSERT(static_cast<double>(f.upper[a]) >= scale * box.upper[a]);
                RC_ASSERT(static_cast<double>(std::nextafter(f.lower[a], INFINITY)) > scale * box.lower[a]);
                RC_ASSERT(static_cast<double>(std::nextafter(f.upper[a], -INFINITY)) < scale * box.upper[a]);
            }
        },
        1000);
    CHECK(accel::scale_to_one(0) == 1);
    CHECK(accel::scale_to_one(3) == 0.25);
    CHECK(accel::scale_to_one(0x1p-1060) == 0x1p1000);
}

}  // namespace limn::walk_test
