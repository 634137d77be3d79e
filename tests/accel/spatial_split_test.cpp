#include "accel/spatial_split.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <random>

#include "accel/clip_triangle.h"
#include "catch.h"
#include "property.h"
#include "support/grid.h"
#include "wide_tree.h"

using namespace limn;
using accel::FloatBox;
using accel::Node;
using accel::WideBvh;

namespace {

// Sums and products of the tests' numbers, of 24 bits, are exact in it.
using Exact = __float128;

struct Corners {
    float at[3][3];
};

struct Triangles final : accel::Clip {
    std::vector<Corners> corners;

    std::vector<FloatBox> boxes() const {
        std::vector<FloatBox> boxes;
        for (const Corners& c : corners) {
            std::vector<FloatBox> points;
            for (const auto& p : c.at) points.push_back({{p[0], p[1], p[2]}, {p[0], p[1], p[2]}});
            boxes.push_back(test::merged(points));
        }
        return boxes;
    }
    Parts cut(std::uint32_t primitive, const FloatBox& box, int axis, float position) const override {
        return accel::clip_triangle(corners[primitive].at, box, axis, position);
    }
};

// Long and thin, in all directions.
Triangles needles(std::size_t count) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    Triangles triangles;
    for (std::size_t i = 0; i < count; ++i) {
        Corners& c = triangles.corners.emplace_back();
        for (std::size_t a = 0; a < 3; ++a) {
            const float center = unit(random), along = unit(random) / 3;
            c.at[0][a] = center - along, c.at[1][a] = center + along, c.at[2][a] = center + unit(random) / 500;
        }
    }
    return triangles;
}

float draw_float() {
    const auto mantissa = static_cast<float>(test::draw_int(-(1 << 24), 1 << 24));
    return std::ldexp(mantissa, test::draw_int(-26, -22));
}

bool holds_point(const FloatBox& box, const std::array<Exact, 3>& numerator, Exact denominator) {
    for (std::size_t a = 0; a < 3; ++a)
        if (numerator[a] < box.lower[a] * denominator || numerator[a] > box.upper[a] * denominator) return false;
    return true;
}

}  // namespace

TEST_CASE("clip_triangle: no point of the triangle in the box is lost, in exact arithmetic", "[accel]") {
    int crossings = 0;
    test::holds(
        [&] {
            Corners c;
            for (auto& corner : c.at)
                for (float& x : corner) x = draw_float();
            FloatBox box;
            for (std::size_t a = 0; a < 3; ++a) {
                const float p = draw_float(), q = draw_float();
                box.lower[a] = std::min(p, q), box.upper[a] = std::max(p, q);
                if (test::draw_int(0, 1)) box.lower[a] = -4, box.upper[a] = 4;  // the world
            }
            const auto axis = static_cast<std::size_t>(test::draw_int(0, 2));
            const float position = test::draw_int(0, 3) ? draw_float() : c.at[0][axis];
            const accel::Clip::Parts parts = accel::clip_triangle(c.at, box, static_cast<int>(axis), position);
            const auto check = [&](const std::array<Exact, 3>& point, Exact denominator) {
                if (!holds_point(box, point, denominator)) return;
                if (point[axis] <= position * denominator) RC_ASSERT(holds_point(parts.lower, point, denominator));
                if (point[axis] >= position * denominator) RC_ASSERT(holds_point(parts.upper, point, denominator));
            };
            for (int i = 0; i <= 8; ++i)
                for (int j = 0; i + j <= 8; ++j) {
                    std::array<Exact, 3> point{};
                    for (std::size_t a = 0; a < 3; ++a)
                        point[a] = Exact(i) * c.at[0][a] + Exact(j) * c.at[1][a] + Exact(8 - i - j) * c.at[2][a];
                    check(point, 8);
                }
            for (std::size_t i = 0; i < 3; ++i) {  // where edges cross the plane
                const float* low = c.at[i];
                const float* high = c.at[(i + 1) % 3];
                if (low[axis] > high[axis]) std::swap(low, high);
                if (!(low[axis] < position && position < high[axis])) continue;
                const Exact length = Exact(high[axis]) - low[axis], before = Exact(position) - low[axis];
                std::array<Exact, 3> point{};
                for (std::size_t a = 0; a < 3; ++a) point[a] = low[a] * length + before * (Exact(high[a]) - low[a]);
                check(point, length);
                ++crossings;
            }
        },
        3000);
    CHECK(crossings > 1000);
}

TEST_CASE("clip_triangle: parts are what the plane leaves, hardly wider, and empty on a side where nothing is",
          "[accel]") {
    const Corners c{{{0, 0, 0}, {4, 0, 0}, {0, 4, 2}}};
    const FloatBox all{{0, 0, 0}, {4, 4, 2}};
    const auto is_near = [](const FloatBox& part, const FloatBox& expected) {
        for (std::size_t a = 0; a < 3; ++a)
            if (!(std::abs(part.lower[a] - expected.lower[a]) < 1e-5f &&
                  std::abs(part.upper[a] - expected.upper[a]) < 1e-5f))
                return false;
        return test::contains(part, expected);
    };
    const auto [left, right] = accel::clip_triangle(c.at, all, 0, 1);
    CHECK(is_near(left, {{0, 0, 0}, {1, 4, 2}}));
    CHECK(is_near(right, {{1, 0, 0}, {4, 3, 1.5f}}));
    CHECK(left.upper[0] == 1);
    CHECK(right.lower[0] == 1);
    const auto [low, high] = accel::clip_triangle(c.at, {{0, 0, 0}, {4, 1, 2}}, 2, 1);
    CHECK(is_near(low, {{0, 0, 0}, {4, 1, 1}}));
    CHECK(test::is_empty(high));  // above z = 1 it has y >= 2
    CHECK(test::is_empty(accel::clip_triangle(c.at, all, 0, -1).lower));
    CHECK(is_near(accel::clip_triangle(c.at, all, 0, 0).lower, {{0, 0, 0}, {0, 4, 2}}));
    CHECK(is_near(accel::clip_triangle(c.at, all, 0, 4).upper, {{4, 0, 0}, {4, 0, 0}}));
}

TEST_CASE("WideBvh: with spatial splits every point of a triangle is in a leaf that lists it", "[accel]") {
    const Triangles triangles = needles(3000);
    const std::vector<FloatBox> boxes = triangles.boxes();
    const WideBvh bvh = accel::build_wide_bvh(boxes, {}, &triangles);
    std::vector<std::vector<FloatBox>> leaves(boxes.size());  // of each triangle
    for (const Node& node : bvh.nodes)
        for (std::size_t slot = 0; slot < accel::kWidth; ++slot) {
            if (node.child[slot] == accel::kNothing || (node.child[slot] & accel::kLeaf) == 0) continue;
            const accel::Leaf leaf = bvh.leaves[node.child[slot] & ~accel::kLeaf];
            for (std::uint32_t i = 0; i < leaf.count; ++i)
                leaves[bvh.indices[leaf.first + i]].push_back(test::box_of(node, slot));
        }
    for (std::size_t index = 0; index < boxes.size(); ++index)
        for (int i = 0; i <= 32; ++i)
            for (const int j : {0, (32 - i) / 2, 32 - i}) {
                std::array<Exact, 3> point{};
                const auto& at = triangles.corners[index].at;
                for (std::size_t a = 0; a < 3; ++a)
                    point[a] = Exact(i) * at[0][a] + Exact(j) * at[1][a] + Exact(32 - i - j) * at[2][a];
                const auto holds = [&](const FloatBox& box) { return holds_point(box, point, 32); };
                REQUIRE(std::any_of(leaves[index].begin(), leaves[index].end(), holds));
            }
}

TEST_CASE("WideBvh: spatial splits make trees cheaper, with no more primitives than there is room for", "[accel]") {
    for (const std::size_t count : {500u, 20'000u}) {
        const Triangles triangles = needles(count);
        const std::vector<FloatBox> boxes = triangles.boxes();
        const accel::BuildSettings settings{.leaf_width = 4, .room = 0.25};
        const WideBvh bvh = accel::build_wide_bvh(boxes, settings, &triangles);
        test::TreeCheck(bvh, boxes, settings, true).run();
        std::size_t in_leaves = 0;
        for (const accel::Leaf& leaf : bvh.leaves) in_leaves += leaf.count;
        CHECK(in_leaves > count);
        CHECK(in_leaves <= count + count / 4);
        CHECK(bvh.cost < 0.97 * accel::build_wide_bvh(boxes, {.leaf_width = 4}).cost);
    }
}

TEST_CASE("WideBvh: spatial splits give the same bits on any number of threads", "[accel]") {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 7);
    const Triangles triangles = needles(20'000);
    std::vector<FloatBox> boxes = triangles.boxes();
    boxes[77].lower[0] = -INFINITY;
    WideBvh first;
    for (const int threads : {1, 2, 7}) {
        tbb::task_arena arena(threads);
        const WideBvh bvh = arena.execute([&] { return accel::build_wide_bvh(boxes, {}, &triangles); });
        if (threads == 1) first = bvh;
        CHECK(test::same_bits(first, bvh));
    }
}
