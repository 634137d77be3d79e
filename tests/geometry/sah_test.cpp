// What the builder chooses: the splits of least cost by the surface-area heuristic, and the wide nodes of least cost.
#include <algorithm>
#include <array>
#include <cmath>

#include "catch.h"
#include "geometry/bvh/binning.h"
#include "property.h"
#include "support/grid.h"
#include "wide_tree.h"

namespace limn::sah_test {

using accel::build_wide_bvh;
using accel::FloatBox;
using test::draw_int;
using test::half_area;
using test::merged;

namespace {

// Boxes whose centres stand on 0, 1, ..., n - 1 along each axis, in an order of its own: bins, spread over n <= 10 such
// places, hold one each, so that no split is overlooked.
std::vector<FloatBox> draw_boxes(int count) {
    std::vector<FloatBox> boxes(static_cast<std::size_t>(count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<int> places(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const auto j = static_cast<std::size_t>(draw_int(0, static_cast<int>(i)));
            places[i] = places[j];
            places[j] = static_cast<int>(i);
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const float half = static_cast<float>(draw_int(0, 512)) / 64, place = static_cast<float>(places[i]);
            boxes[i].lower[axis] = place - half, boxes[i].upper[axis] = place + half;
        }
    }
    return boxes;
}

struct Cut {
    double cost;
    FloatBox lower, upper;
};

FloatBox to_box(const accel::Bounds& b) {
    return {{b.lower[0], b.lower[1], b.lower[2]}, {b.upper[0], b.upper[1], b.upper[2]}};
}

// The cost of cutting after the first `middle` in the order of centres along an axis, times the area of all.
Cut cut_at(std::vector<FloatBox> boxes, std::size_t axis, std::size_t middle, std::uint32_t leaf_width) {
    std::sort(boxes.begin(), boxes.end(), [&](const FloatBox& a, const FloatBox& b) {
        return a.lower[axis] + a.upper[axis] < b.lower[axis] + b.upper[axis];
    });
    const FloatBox lower = merged({boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(middle)}),
                   upper = merged({boxes.begin() + static_cast<std::ptrdiff_t>(middle), boxes.end()});
    const auto tests = [&](std::size_t n) { return std::ceil(static_cast<double>(n) / leaf_width); };
    return {half_area(lower) * tests(middle) + half_area(upper) * tests(boxes.size() - middle), lower, upper};
}

}  // namespace

TEST_CASE("best_split: of all splits along all axes it takes the one of least cost, counted in leaf tests",
          "[accel][sah]") {
    test::holds(
        [] {
            const int count = draw_int(2, 10);
            const auto leaf_width = static_cast<std::uint32_t>(draw_int(1, 4));
            const std::vector<FloatBox> boxes = draw_boxes(count);
            std::vector<accel::BuildPrimitive> primitives;
            for (const FloatBox& b : boxes) primitives.emplace_back(accel::to_bounds(b), 7 + primitives.size());
            const accel::Range range = accel::range_over(primitives.data(), 0, static_cast<std::uint32_t>(count));
            const accel::Split split = accel::best_split(primitives.data(), range, leaf_width);
            double least = INFINITY;
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t middle = 1; middle < boxes.size(); ++middle)
                    least = std::min(least, cut_at(boxes, axis, middle, leaf_width).cost);
            RC_ASSERT(split.exists());
            std::vector<accel::BuildPrimitive> sorted(primitives.size());
            const std::uint32_t middle = accel::partition(primitives.data(), sorted.data(), range, split);
            const Cut chosen = cut_at(boxes, static_cast<std::size_t>(split.axis), middle, leaf_width);
            // All that is said of sides, the builder says of sides longer by 2^-12 of the longest; its rounding is
            // less.
            double longest = 0;
            for (std::size_t a = 0; a < 3; ++a)
                longest = std::max(longest, double{range.bounds.upper[a]} - range.bounds.lower[a]);
            const double slack = std::ceil(double(count) / leaf_width + 1) * 7 * 0x1p-12 * longest * longest;
            RC_ASSERT(chosen.cost <= least + slack);
            RC_ASSERT(std::abs(split.cost * half_area(to_box(range.bounds)) - least) <= 2 * slack + 1e-3 * least);
            std::uint32_t numbers = 0;
            for (std::uint32_t i = 0; i < sorted.size(); ++i) {
                const FloatBox box = to_box(sorted[i]);
                RC_ASSERT(test::contains(i < middle ? chosen.lower : chosen.upper, box));
                numbers |= 1u << (sorted[i].index() - 7);
            }
            RC_ASSERT(numbers == (1u << count) - 1);
        },
        1000);
}

TEST_CASE("WideBvh: boxes in a row cost a ray the logarithm of their number, not the number", "[accel][sah]") {
    for (int levels = 3; levels <= 15; levels += 3) {
        std::vector<FloatBox> row;
        for (int i = 0; i < 1 << levels; ++i) {
            const auto x = static_cast<float>(2 * i);
            row.push_back({{x, 0, 0}, {x + 1, 1, 1}});
        }
        // n boxes in a row have an area of 4 n - 1 or so. Cut in eight down to single ones, a level costs no more than
        // one node, and the boxes less than one test; another level for what bins cut beside the middle.
        CHECK(build_wide_bvh(row, {.max_leaf = 1, .leaf_width = 1}).cost <= levels / 3 + 2);
    }
}

TEST_CASE("WideBvh: its cost is the sum over its nodes and leaves, weighted as the settings say", "[accel][sah]") {
    for (const std::size_t count : {5u, 300u, 20'000u})
        for (const accel::BuildSettings& settings :
             {accel::BuildSettings{},
              accel::BuildSettings{.max_leaf = 5, .leaf_width = 2, .node_cost = 3, .leaf_cost = 2}}) {
            const accel::WideBvh bvh = build_wide_bvh(test::random_boxes(count, 1), settings);
            const double sum = test::expected_cost(bvh, settings);
            CHECK(std::abs(bvh.cost - sum) <= 1e-5 * sum);  // the builder's areas are larger by up to 3 * 2^-20
        }
}

TEST_CASE("WideBvh: dear nodes make larger leaves, dear leaves smaller ones", "[accel][sah]") {
    const std::vector<FloatBox> boxes = test::random_boxes(5000, 1);
    const auto leaves = [&](double node_cost, double leaf_cost) {
        return build_wide_bvh(boxes, {.leaf_width = 1, .node_cost = node_cost, .leaf_cost = leaf_cost}).leaves.size();
    };
    CHECK(leaves(10, 1) < leaves(1, 1));
    CHECK(leaves(1, 1) < leaves(1, 10));
}

TEST_CASE("WideBvh: it costs no more than what a full sweep with greedy collapse gives, but for a twentieth",
          "[accel][sah]") {
    std::vector<FloatBox> wavy;
    for (int i = 0; i < 100; ++i)
        for (int j = 0; j < 100; ++j) {
            const auto at = [](int p, int q) {
                return static_cast<float>(10 * std::sin(0.1 * p) * std::cos(0.07 * q));
            };
            const float heights[3] = {at(i, j), at(i + 1, j), at(i, j + 1)};
            const auto x = static_cast<float>(i), y = static_cast<float>(j);
            wavy.push_back({{x, y, *std::min_element(heights, heights + 3)},
                            {x + 1, y + 1, *std::max_element(heights, heights + 3)}});
        }
    for (const std::vector<FloatBox>& boxes : {wavy, test::random_boxes(10'000, 7)}) {
        const double cost = build_wide_bvh(boxes).cost;
        CHECK(cost <= 1.05 * test::reference_cost(boxes));
    }
}

}  // namespace limn::sah_test
