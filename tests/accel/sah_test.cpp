// What the builder chooses: the split of least cost, by the surface-area heuristic with a node as dear as a box.
#include <algorithm>
#include <array>

#include "accel/binary_bvh.h"
#include "catch.h"
#include "property.h"
#include "support/grid.h"

using namespace limn;
using accel::BinaryBvh;
using accel::BinaryNode;
using accel::build_binary_bvh;
using test::draw_int;

namespace {

// Boxes whose centres stand on 0, 1, ..., n - 1 along each axis, in an order of its own: sixteen bins, spread over
// n <= 16 such places, hold one each, so that no split is overlooked.
std::vector<Box> draw_boxes(int count) {
    std::vector<Box> boxes(static_cast<std::size_t>(count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<int> places(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const auto j = static_cast<std::size_t>(draw_int(0, static_cast<int>(i)));
            places[i] = places[j];
            places[j] = static_cast<int>(i);
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const double half = draw_int(0, 512) / 64.0;
            boxes[i].lower[axis] = places[i] - half, boxes[i].upper[axis] = places[i] + half;
        }
    }
    return boxes;
}

double cost(const std::vector<Box>& boxes, const std::vector<std::uint32_t>& left,
            const std::vector<std::uint32_t>& right) {
    Box l, r;
    for (const std::uint32_t i : left) l.extend(boxes[i]);
    for (const std::uint32_t i : right) r.extend(boxes[i]);
    return 1 +
           (surface_area(l) * static_cast<double>(left.size()) + surface_area(r) * static_cast<double>(right.size())) /
               surface_area(merge(l, r));
}

// Of all splits by the order of centres along an axis.
double least_cost(const std::vector<Box>& boxes, std::vector<std::uint32_t> ids) {
    double least = kInfinity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::sort(ids.begin(), ids.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return boxes[a].center()[axis] < boxes[b].center()[axis]; });
        for (auto cut = ids.begin() + 1; cut != ids.end(); ++cut)
            least = std::min(least, cost(boxes, {ids.begin(), cut}, {cut, ids.end()}));
    }
    return least;
}

std::vector<std::uint32_t> ids_under(const BinaryBvh& bvh, std::uint32_t row) {
    const BinaryNode& node = bvh.nodes[row];
    if (node.count > 0) return {bvh.ids.begin() + node.first, bvh.ids.begin() + node.first + node.count};
    std::vector<std::uint32_t> ids = ids_under(bvh, node.first), right = ids_under(bvh, node.first + 1);
    ids.insert(ids.end(), right.begin(), right.end());
    return ids;
}

// What a random ray through the root is expected to cost.
double expected_cost(const BinaryBvh& bvh, std::uint32_t row = 0) {
    const BinaryNode& node = bvh.nodes[row];
    if (node.count > 0) return node.count;
    const double left = surface_area(bvh.nodes[node.first].bounds),
                 right = surface_area(bvh.nodes[node.first + 1].bounds);
    return 1 + (left * expected_cost(bvh, node.first) + right * expected_cost(bvh, node.first + 1)) /
                   surface_area(node.bounds);
}

}  // namespace

TEST_CASE("BinaryBvh: the root is the split of least cost, or a leaf where none is cheaper than testing all",
          "[accel][sah]") {
    int leaves = 0;
    test::holds(
        [&] {
            const int count = draw_int(2, 16);
            const std::vector<Box> boxes = draw_boxes(count);
            const BinaryBvh bvh = build_binary_bvh(boxes);
            std::vector<std::uint32_t> all(boxes.size());
            for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
            const double least = least_cost(boxes, all);
            const BinaryNode& root = bvh.nodes[0];
            if (root.count > 0) {
                ++leaves;
                RC_ASSERT((count <= 8 && least >= count));  // more than eight are parted whatever it costs
                return;
            }
            RC_ASSERT((count > 8 || least < count));
            const double chosen = cost(boxes, ids_under(bvh, root.first), ids_under(bvh, root.first + 1));
            RC_ASSERT(std::abs(chosen - least) <= 1e-12 * least);
        },
        1000);
    CHECK(leaves > 10);
}

TEST_CASE("BinaryBvh: boxes in a leaf stand in the order of their numbers", "[accel][sah]") {
    test::holds([] {
        const BinaryBvh bvh = build_binary_bvh(draw_boxes(draw_int(1, 16)));
        for (const BinaryNode& node : bvh.nodes)
            if (node.count > 0)
                RC_ASSERT(std::is_sorted(bvh.ids.begin() + node.first, bvh.ids.begin() + node.first + node.count));
    });
}

TEST_CASE("BinaryBvh: nothing parts boxes of one centre but their number, down to eight a leaf", "[accel][sah]") {
    for (const std::uint32_t count : {8u, 9u, 16u, 17u, 100u}) {
        const BinaryBvh bvh = build_binary_bvh(std::vector<Box>(count, Box{{1, 2, 3}, {4, 5, 6}}));
        std::uint32_t seen = 0, largest = 0;
        for (const BinaryNode& node : bvh.nodes) seen += node.count, largest = std::max(largest, node.count);
        CHECK(seen == count);
        CHECK(largest <= 8);
        CHECK((bvh.nodes.size() == 1) == (count == 8));
    }
}

TEST_CASE("BinaryBvh: boxes in a row cost a ray the logarithm of their number, not the number", "[accel][sah]") {
    for (int levels = 4; levels <= 12; levels += 4) {
        const int count = 1 << levels;
        std::vector<Box> row;
        for (int i = 0; i < count; ++i) row.emplace_back(Point3{2.0 * i, 0, 0}, Point3{2.0 * i + 1, 1, 1});
        // n boxes in a row have an area of 8 n - 2. Halved down to single ones, a level costs less than one node and
        // the boxes less than one test; another level for what bins cut beside the middle.
        CHECK(expected_cost(build_binary_bvh(row)) <= levels + 2);
    }
}

TEST_CASE("BinaryBvh: unbounded boxes stand apart, in a leaf beside the tree of all others", "[accel][sah]") {
    const Box endless{{-kInfinity, 0, 0}, {kInfinity, 1, 1}}, a{{0, 0, 0}, {1, 1, 1}}, b{{9, 9, 9}, {10, 10, 10}};
    for (const bool low : {true, false}) {
        Box ray = endless;  // unbounded on one side only
        (low ? ray.upper.x : ray.lower.x) = 5;
        const BinaryBvh bvh = build_binary_bvh(std::vector<Box>{a, ray, b, endless});
        REQUIRE(bvh.nodes.size() >= 3);
        CHECK(bvh.nodes[0].count == 0);
        CHECK(ids_under(bvh, 2) == std::vector<std::uint32_t>{1, 3});
        CHECK(bvh.nodes[1].bounds == merge(a, b));
        CHECK(bvh.bounds() == merge(merge(a, b), endless));
        CHECK(bvh.extent == 10);
    }
    const BinaryBvh only = build_binary_bvh(std::vector<Box>{endless, Box{}, endless});
    REQUIRE(only.nodes.size() == 1);
    CHECK(ids_under(only, 0) == std::vector<std::uint32_t>{0, 2});
    CHECK(only.bounds() == endless);
    CHECK(only.extent == 1);
}

TEST_CASE("BinaryBvh: its extent is the largest finite coordinate, of either sign, on any side and axis",
          "[accel][sah]") {
    CHECK(build_binary_bvh(std::vector<Box>{}).extent == 0);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double far : {-7.0, 7.0}) {
            Box box{{0, 0, 0}, {1, 1, 1}};
            (far < 0 ? box.lower : box.upper)[axis] = far;
            CHECK(build_binary_bvh(std::vector<Box>{Box{}, box, Box{{0, 0, 0}, {2, 2, 2}}}).extent == 7);
        }
}

TEST_CASE("for_each_met: nearer boxes are visited first, and none beyond what visit returns", "[accel][sah]") {
    std::vector<Box> row;
    for (int i = 0; i < 64; ++i) row.emplace_back(Point3{2.0 * i, 0, 0}, Point3{2.0 * i + 1, 1, 1});
    const BinaryBvh bvh = build_binary_bvh(row);
    for (const double way : {1.0, -1.0}) {
        for (const int from : {0, 20, 63}) {
            const Ray ray{.origin = {2.0 * from + 0.5 - way, 0.5, 0.5}, .direction = {way, 0, 0}};
            const int last = way > 0 ? 63 : 0;
            std::vector<std::uint32_t> visited;
            accel::for_each_met(bvh, accel::SlabRay(ray, bvh.extent), ray.t_max, [&](std::uint32_t id) {
                visited.push_back(id);
                return kInfinity;
            });
            std::vector<std::uint32_t> expected;
            for (int i = from; i != last + (way > 0 ? 1 : -1); i += way > 0 ? 1 : -1)
                expected.push_back(static_cast<std::uint32_t>(i));
            CHECK(visited == expected);
            std::size_t visits = 0;
            accel::for_each_met(bvh, accel::SlabRay(ray, bvh.extent), ray.t_max,
                                [&](std::uint32_t) {  // the first box is hit at t = 0.5
                                    ++visits;
                                    return 0.5;
                                });
            CHECK(visits == 1);
        }
    }
}
