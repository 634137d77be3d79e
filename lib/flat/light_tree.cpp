// Builds a binary tree of lights. A node is split where the cost of both halves is least; the cost is the product of
// surface area, orientation measure and strength (Conty Estevez and Kulla, Importance Sampling of Many Lights with
// Adaptive Tree Splitting, Proc. ACM Comput. Graph. Interact. Tech. 1(2), 2018).
#include "flat/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "limn/math/math.h"
#include "math/elementary.h"

namespace limn::compiler {

namespace {

using flat::Cone, flat::LightBounds;

constexpr std::size_t kBins = 12;  // as in pbrt-v4
// From this depth on, nodes are halved by the number of their lights, so that the recursion ends. Usual trees are less
// deep.
constexpr int kDeepest = 48;
// A leaf has up to kMostInLeaf lights that are about as close to each other as they are large and have similar normals.
// A node for each of them would cost more than it gains. The probability of choosing a light differs by at most a
// factor of four from that of separate nodes.
constexpr std::size_t kMostInLeaf = 4;
constexpr double kWidestLeaf = 3, kLeafCosine = 0.9;
// The least strength of a light, relative to the mean. A smaller one could be rounded away in the sums.
constexpr double kLeastShare = 1e-6;

// Returns the smallest double cone that contains both.
Cone merge(Cone a, Cone b) {
    // Handle spheres and cones that contain all directions.
    if (a.cos_spread == flat::kNoNormals && b.cos_spread == flat::kNoNormals) return a;
    if (a.cos_spread <= 0 || b.cos_spread <= 0) return {a.axis, 0};
    // Return the larger cone if it contains the other.
    if (dot(a.axis, b.axis) < 0) b.axis = -b.axis;
    const double spread_a = arc_cosine(a.cos_spread), spread_b = arc_cosine(b.cos_spread);
    const double between = arc_tangent(length(cross(a.axis, b.axis)), dot(a.axis, b.axis));
    if (between + spread_b <= spread_a) return a;
    if (between + spread_a <= spread_b) return b;
    // Turn the axis of the first towards the second.
    const double spread = (spread_a + between + spread_b) / 2;
    if (spread >= kPi / 2) return {a.axis, 0};
    const double turn = spread - spread_a;
    const Vec3 aside = normalize(cross(cross(a.axis, b.axis), a.axis));
    if (!is_finite(aside)) return {a.axis, cosine(spread)};
    const auto [s, c] = sine_cosine(turn);
    return {normalize(c * a.axis + s * aside), cosine(spread)};
}

LightBounds merge(const LightBounds& a, const LightBounds& b) {
    if (a.box.is_empty()) return b;
    if (b.box.is_empty()) return a;
    return {merge(a.box, b.box), merge(a.cone, b.cone), a.strength + b.strength};
}

// Returns the integral over all directions of the largest cosine between the direction and any normal in the cone.
double orientation_measure(double cos_spread) {
    if (cos_spread == flat::kNoNormals) return 4 * kPi;
    const double spread = arc_cosine(cos_spread), sine_spread = sine(spread);
    const double reach = std::min(spread + kPi / 2, kPi);
    return 2 * kPi * (1 - cos_spread) +
           kPi / 2 * (2 * reach * sine_spread - cosine(spread - 2 * reach) - 2 * spread * sine_spread + cos_spread);
}

// Returns the cost of a node.
double cost(const LightBounds& b) {
    return b.box.is_empty() ? 0 : b.strength * orientation_measure(b.cone.cos_spread) * surface_area(b.box);
}

// Builds the nodes and sorts the lights in the order of the leaves.
class Builder {
public:
    Builder(std::span<LightItem> items, flat::LightTable& table) : items_(items), table_(table) {}

    // Builds the node of lights [begin, end) and its subtree.
    void build(std::size_t begin, std::size_t end, int depth) {
        LightBounds all;
        double largest = 0;
        for (std::size_t i = begin; i < end; ++i) {
            all = merge(all, items_[i].bounds);
            largest = std::max(largest, length(items_[i].bounds.box.diagonal()));
        }
        const std::size_t node = table_.nodes.size();
        table_.nodes.push_back(packed(all, end));
        const std::size_t count = end - begin;
        const bool compact = count <= kMostInLeaf && length(all.box.diagonal()) <= kWidestLeaf * largest &&
                             all.cone.cos_spread >= kLeafCosine;
        // Make a leaf. If the scene has only a few lights, each has its own, because that costs few nodes.
        if (count == 1 || (compact && items_.size() > kMostInLeaf)) return;
        const std::size_t middle = split(begin, end, all, depth);
        build(begin, middle, depth + 1);
        table_.nodes[node].right = static_cast<std::uint32_t>(table_.nodes.size());
        build(middle, end, depth + 1);
    }

private:
    static double center(const LightItem& item, std::size_t axis) { return item.bounds.box.center()[axis]; }

    // Sorts lights [begin, end) into two halves. Returns the beginning of the second.
    std::size_t split(std::size_t begin, std::size_t end, const LightBounds& all, int depth) {
        Box centers;
        for (std::size_t i = begin; i < end; ++i) centers.extend(items_[i].bounds.box.center());
        const Vec3 extent = centers.diagonal(), size = all.box.diagonal();
        double best = std::numeric_limits<double>::infinity();
        std::size_t best_axis = 0, best_bin = 0;
        // Find the cheapest split between bins.
        for (std::size_t axis = 0; axis < 3 && depth < kDeepest; ++axis) {
            if (!(extent[axis] > 0) || !std::isfinite(extent[axis])) continue;
            std::array<LightBounds, kBins> bins;
            for (std::size_t i = begin; i < end; ++i) {
                LightBounds& bin = bins[bin_of(items_[i], axis, centers)];
                bin = merge(bin, items_[i].bounds);
            }
            std::array<double, kBins> below{};
            LightBounds sum;
            for (std::size_t b = 0; b + 1 < kBins; ++b) {
                sum = merge(sum, bins[b]);
                below[b] = cost(sum);
            }
            sum = {};
            // Prefer to split the longest axis.
            const double thin = max_abs(size) / size[axis];
            for (std::size_t b = kBins - 1; b > 0; --b) {
                sum = merge(sum, bins[b]);
                const double c = thin * (below[b - 1] + cost(sum));
                if (c < best && below[b - 1] > 0 && !sum.box.is_empty()) {
                    best = c;
                    best_axis = axis;
                    best_bin = b;
                }
            }
        }
        // Sort the lights by the split.
        const auto first = items_.begin() + static_cast<std::ptrdiff_t>(begin),
                   last = items_.begin() + static_cast<std::ptrdiff_t>(end);
        auto middle = first;
        if (best_bin > 0)
            middle = std::partition(first, last,
                                    [&](const LightItem& item) { return bin_of(item, best_axis, centers) < best_bin; });
        if (middle == first || middle == last) {
            // If all centres are at one point, or all boxes on a line without area, halve the lights by their number
            // along the longest axis.
            const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
            middle = first + (last - first) / 2;
            std::nth_element(first, middle, last, [&](const LightItem& a, const LightItem& b) {
                const double x = center(a, axis), y = center(b, axis);
                return x != y ? x < y : a.number < b.number;
            });
        }
        return static_cast<std::size_t>(middle - items_.begin());
    }

    static std::size_t bin_of(const LightItem& item, std::size_t axis, const Box& centers) {
        const double from = centers.lower[axis], to = centers.upper[axis];
        const double fraction = (center(item, axis) - from) / (to - from);
        return std::min(static_cast<std::size_t>(std::max(0.0, fraction) * kBins), kBins - 1);
    }

    // Returns the node in float, with its box rounded outward. Its `right` is set later.
    static flat::LightNode packed(const LightBounds& b, std::size_t end) {
        constexpr float kInf = std::numeric_limits<float>::infinity();
        flat::LightNode node{};
        for (std::size_t a = 0; a < 3; ++a) {
            node.center[a] = static_cast<float>(b.box.center()[a]);
            node.axis[a] = static_cast<float>(b.cone.axis[a]);
            // Compute the half side from the rounded centre. Add 9000 roundings (2^-53) of the largest coordinate: a
            // point of a moving light is rounded fewer than 100 times.
            const double off =
                std::max(b.box.upper[a] - double{node.center[a]}, double{node.center[a]} - b.box.lower[a]);
            const double most = std::max(std::abs(b.box.upper[a]), std::abs(b.box.lower[a]));
            node.half[a] = std::nextafter(static_cast<float>(off + 1e-12 * most), kInf);
        }
        node.cos_spread = static_cast<float>(b.cone.cos_spread);
        node.strength = static_cast<float>(b.strength);
        node.end = static_cast<std::uint32_t>(end);
        return node;
    }

    std::span<LightItem> items_;
    flat::LightTable& table_;
};

// Divides the strengths by their sum, and returns it. If the sum isn't positive and finite, all strengths become equal.
double normalize_strengths(std::vector<LightItem>& items) {
    double total = 0;
    for (const LightItem& item : items) total += item.bounds.strength;
    const double count = static_cast<double>(items.size());
    double sum = 0;
    for (LightItem& item : items) {
        double& share = item.bounds.strength;
        share = std::isfinite(total) && total > 0 ? std::max(share / total, kLeastShare / count) : 1 / count;
        sum += share;
    }
    for (LightItem& item : items) item.bounds.strength /= sum;
    return total;
}

}  // namespace

void build_light_tree(std::vector<LightItem> items, flat::LightTable& table) {
    // Build the nodes. A single light needs one only if there are distant lights, to compare it with them.
    if (items.empty()) return;
    table.strength = normalize_strengths(items);
    if (items.size() > 1 || !table.distant.empty()) Builder(items, table).build(0, items.size(), 0);
    // Write the tables by rank.
    double before = 0;
    for (const LightItem& item : items) {
        if (item.number != LightItem::kNoPrimitive)
            table.by_number.push_back({item.number, static_cast<std::uint32_t>(table.refs.size())});
        table.refs.push_back(item.ref);
        table.strength_before.push_back(before);
        before += item.bounds.strength;
    }
    table.strength_before.push_back(before);
    // Write the guide and sort the numbers.
    std::uint32_t rank = 0;
    for (std::size_t k = 0; k <= items.size(); ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(items.size());
        while (rank + 1 < items.size() && table.strength_before[rank + 1] <= share) ++rank;
        table.guide.push_back(rank);
    }
    std::ranges::sort(table.by_number, {}, &flat::LightNumber::number);
}

}  // namespace limn::compiler
