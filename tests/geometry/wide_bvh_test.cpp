#include "geometry/bvh/wide_bvh.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "catch.h"
#include "wide_tree.h"

namespace limn::wide_bvh_test {

using accel::build_wide_bvh;
using accel::BuildSettings;
using accel::FloatBox;
using accel::Node;
using accel::WideBvh;
using test::check_tree;
using test::random_boxes;

namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("WideBvh: every box stands in exactly one leaf, inside all its ancestors", "[accel]") {
    for (std::size_t k = 1; k <= 1u << 16; k *= 2)
        for (const std::size_t count : {k - 1, k, k + 1}) check_tree(random_boxes(count, count));
}

TEST_CASE("WideBvh: leaves hold what the settings allow, whatever is tested at once", "[accel]") {
    for (const std::uint32_t max_leaf : {1u, 3u, 8u, 20u})
        for (const std::uint32_t leaf_width : {1u, 4u, 8u, 16u})
            check_tree(random_boxes(3000, 4), {.max_leaf = max_leaf, .leaf_width = leaf_width});
}

TEST_CASE("WideBvh: equal, flat, empty and unbounded boxes build", "[accel]") {
    check_tree({});
    check_tree(std::vector<FloatBox>(10, FloatBox{{0, 1, 0}, {1, 0, 1}}));
    check_tree(std::vector<FloatBox>(1, FloatBox{{1, 2, 3}, {1, 2, 3}}));
    for (const std::size_t count : {8u, 9u, 4096u, 4097u, 100'000u})
        check_tree(std::vector<FloatBox>(count, FloatBox{{1, 2, 3}, {1, 2, 3}}));
    for (const std::size_t count : {10u, 20'000u}) {
        std::vector<FloatBox> boxes = random_boxes(count, 1);
        for (FloatBox& b : boxes) b.lower[1] = b.upper[1] = 7;
        check_tree(boxes);
        for (FloatBox& b : boxes) b.lower[2] = b.upper[2] = b.lower[0] = b.upper[0];  // on a line
        check_tree(boxes);
        const float largest = std::numeric_limits<float>::max();
        boxes = random_boxes(count, 1);
        for (std::size_t i = 0; i + 3 < count; i += 7) {
            boxes[i] = {{kEndless, kEndless, kEndless}, {-kEndless, -kEndless, -kEndless}};
            boxes[i + 1] = {{-kEndless, 0, 0}, {0, 0, kEndless}};
            boxes[i + 2] = {{-largest, -largest, -largest}, {largest, largest, largest}};
            boxes[i + 3].lower[0] = std::nanf("");
        }
        check_tree(boxes);
        for (FloatBox& b : boxes) b.lower[0] = -kEndless;
        check_tree(boxes);
    }
}

TEST_CASE("WideBvh: what parts one by one, at every scale, does not make it deeper than its limit", "[accel]") {
    for (const float side : {1.0f, -1.0f})
        for (const std::size_t copies : {1u, 100u}) {
            std::vector<FloatBox> boxes;
            for (int power = -140; power < 120; ++power)
                for (std::size_t k = 0; k < copies; ++k) {
                    const float x = std::ldexp(side, power), y = 1.1f * x;
                    boxes.push_back({{std::min(x, y), std::min(x, y), std::min(x, y)},
                                     {std::max(x, y), std::max(x, y), std::max(x, y)}});
                }
            const int depth = check_tree(boxes, {.max_leaf = 1, .leaf_width = 1});
            CHECK(depth > 5);
        }
}

TEST_CASE("WideBvh: the same boxes give the same bits on any number of threads", "[accel]") {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 7);
    for (const std::size_t count : {100u, 5000u, 600'000u}) {
        const std::vector<FloatBox> boxes = random_boxes(count, 5);
        WideBvh first;
        for (const int threads : {1, 2, 7}) {
            tbb::task_arena arena(threads);
            const WideBvh bvh = arena.execute([&] { return build_wide_bvh(boxes); });
            if (threads == 1) first = bvh;
            CHECK(test::same_bits(first, bvh));
        }
    }
}

TEST_CASE("WideBvh: unbounded boxes stand apart, in leaves beside the tree of all others", "[accel]") {
    for (const std::size_t count : {3u, 50u, 10'000u}) {
        std::vector<FloatBox> boxes = random_boxes(count, 2);
        const WideBvh without = build_wide_bvh(boxes);
        boxes.insert(boxes.begin(), FloatBox{{-kEndless, 0, 0}, {5, 1, 1}});
        boxes.push_back({{-1, -3, 0}, {5, 1, kEndless}});
        const WideBvh with = build_wide_bvh(boxes);
        const auto last = static_cast<std::uint32_t>(boxes.size() - 1);
        int apart = 0;
        for (const accel::Leaf& leaf : with.leaves) {
            const std::vector<std::uint32_t> indices(with.indices.begin() + leaf.first,
                                                     with.indices.begin() + leaf.first + leaf.count);
            if (std::find(indices.begin(), indices.end(), 0u) != indices.end()) {
                CHECK(indices == std::vector<std::uint32_t>{0, last});
                ++apart;
            }
        }
        CHECK(apart == 1);
        CHECK(test::bounds_of(with).lower[0] == -kEndless);
        CHECK(test::bounds_of(with).upper[2] == kEndless);
        CHECK(test::bounds_of(with).lower[1] == -3);
        // A leaf, and at most a node, that every ray meets.
        CHECK(with.cost >= without.cost + 1 - 1e-9);
        CHECK(with.cost <= without.cost + 2 + 1e-9);
    }
}

TEST_CASE("WideBvh: children are ordered by where their centres lie along the octant's diagonal", "[accel]") {
    const WideBvh bvh = build_wide_bvh(random_boxes(5000, 3));
    for (const Node& node : bvh.nodes) {
        const auto present = static_cast<std::uint32_t>(
            std::count_if(node.child, node.child + 8, [](std::uint32_t c) { return c != accel::kNothing; }));
        for (std::uint32_t octant = 0; octant < 8; ++octant) {
            const auto slot = [&](std::uint32_t k) { return node.order[octant] >> 4 * (7 - k) & 15; };
            const auto along = [&](std::uint32_t c) {
                double sum = 0;
                for (std::uint32_t a = 0; a < 3; ++a)
                    sum += (octant >> a & 1 ? -1.0 : 1.0) * (double{node.planes[a][c]} + node.planes[3 + a][c]);
                return sum;
            };
            std::uint32_t seen = 0;
            for (std::uint32_t k = 0; k < 8; ++k) seen |= 1u << slot(k);
            REQUIRE(seen == 255);
            for (std::uint32_t k = 0; k < present; ++k) REQUIRE(slot(k) < present);
            for (std::uint32_t k = 1; k < present; ++k)
                REQUIRE(along(slot(k - 1)) <= along(slot(k)) + 1e-5);  // six coordinates up to 1.1, summed in float
        }
    }
}

}  // namespace limn::wide_bvh_test
