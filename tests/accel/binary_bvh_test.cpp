#include "accel/binary_bvh.h"

#include <algorithm>
#include <random>
#include <set>

#include "catch.h"

using namespace limn;
using accel::BinaryBvh;
using accel::build_binary_bvh;

namespace {

std::vector<Box> random_boxes(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const Point3 p{unit(random), unit(random), unit(random)};
        boxes.emplace_back(p, p + Vec3{unit(random) / 10, unit(random) / 10, unit(random) / 10});
    }
    return boxes;
}

// Depth of the deepest node; checks on the way that each child lies in its parent and each id in its leaf.
int check_node(const BinaryBvh& bvh, const std::vector<Box>& boxes, std::uint32_t row, std::vector<int>& seen) {
    const accel::BinaryNode& node = bvh.nodes[row];
    if (node.count > 0) {
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const std::uint32_t id = bvh.ids[node.first + i];
            REQUIRE(node.bounds.contains(boxes[id]));
            ++seen[id];
        }
        return 0;
    }
    int depth = 0;
    for (const std::uint32_t child : {node.first, node.first + 1}) {
        REQUIRE(node.bounds.contains(bvh.nodes[child].bounds));
        depth = std::max(depth, 1 + check_node(bvh, boxes, child, seen));
    }
    return depth;
}

// Returns the depth.
int check_tree(const std::vector<Box>& boxes) {
    const BinaryBvh bvh = build_binary_bvh(boxes);
    std::vector<int> seen(boxes.size(), 0);
    const int depth = bvh.nodes.empty() ? 0 : check_node(bvh, boxes, 0, seen);
    CHECK(depth < accel::kMaxDepth);
    for (std::size_t i = 0; i < boxes.size(); ++i) REQUIRE(seen[i] == (boxes[i].is_empty() ? 0 : 1));
    return depth;
}

}  // namespace

TEST_CASE("BinaryBvh: every box stands in exactly one leaf, inside all its ancestors", "[accel]") {
    for (const std::size_t count : {0u, 1u, 2u, 3u, 7u, 8u, 9u, 63u, 64u, 65u, 1000u, 20000u})
        check_tree(random_boxes(count, count));
}

TEST_CASE("BinaryBvh: equal, empty and unbounded boxes build", "[accel]") {
    check_tree(std::vector<Box>(5000, Box{{1, 2, 3}, {1, 2, 3}}));
    check_tree(std::vector<Box>(10));
    std::vector<Box> odd = random_boxes(100, 1);
    odd[3] = Box{};
    odd[50] = Box{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    odd[51] = Box{{-kInfinity, 0, 0}, {0, 0, kInfinity}};
    odd[52] = Box{{-1e308, -1e308, -1e308}, {1e308, 1e308, 1e308}};
    check_tree(odd);
}

TEST_CASE("BinaryBvh: boxes that part one by one do so down to depth 56, no deeper than the limit, on either side",
          "[accel]") {
    for (const double side : {1.0, -1.0}) {
        std::vector<Box> spread;
        for (int i = 0; i < 600; ++i) {
            const double x = std::ldexp(side, i - 300);
            Box box;
            box.extend(Point3{x, x, x});
            box.extend(Point3{1.1 * x, 1.1 * x, 1.1 * x});
            spread.push_back(box);
        }
        const int depth = check_tree(spread);
        CHECK((depth > 56 && depth <= 56 + 10));  // what is left, 2^10 at most, is halved
    }
}

TEST_CASE("BinaryBvh: the same boxes give the same tree", "[accel]") {
    const std::vector<Box> boxes = random_boxes(3000, 5);
    const BinaryBvh a = build_binary_bvh(boxes), b = build_binary_bvh(boxes);
    CHECK(a.ids == b.ids);
    REQUIRE(a.nodes.size() == b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) CHECK(a.nodes[i].bounds == b.nodes[i].bounds);
}

TEST_CASE("BinaryBvh: a ray visits every box that it meets, and far fewer than all", "[accel]") {
    const std::vector<Box> boxes = random_boxes(5000, 9);
    const BinaryBvh bvh = build_binary_bvh(boxes);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::size_t visits = 0;
    const int rays = 500;
    for (int r = 0; r < rays; ++r) {
        const Ray ray{{unit(random), unit(random), unit(random)}, {unit(random), unit(random), unit(random)}};
        std::set<std::uint32_t> visited;
        accel::for_each_met(bvh, accel::SlabRay(ray, bvh.extent), ray.t_max, [&](std::uint32_t id) {
            visited.insert(id);
            return ray.t_max;
        });
        visits += visited.size();
        const accel::SlabRay slab(ray, bvh.extent);
        for (std::uint32_t id = 0; id < boxes.size(); ++id) {
            double near = 0;
            if (slab.meets(boxes[id], ray.t_max, near)) REQUIRE(visited.count(id) == 1);
        }
    }
    CHECK(visits < boxes.size() / 20 * rays);
}

TEST_CASE("BinaryBvh: no leaf holds more than eight boxes, even of those that share a centre", "[accel]") {
    const std::vector<Box> equal(1000, Box{{1, 2, 3}, {4, 5, 6}});
    for (const std::vector<Box>& boxes : {equal, random_boxes(1000, 3)})
        for (const accel::BinaryNode& node : build_binary_bvh(boxes).nodes) CHECK(node.count <= 8);
}
