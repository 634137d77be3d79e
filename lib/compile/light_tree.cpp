// A binary tree of lights, split where both halves are small, look the same way and shine alike: Conty Estevez and
// Kulla, Importance Sampling of Many Lights with Adaptive Tree Splitting, Proc. ACM Comput. Graph. Interact. Tech.
// 1(2), 2018, whose cost is the product of area, orientation measure and strength.
#include "compile/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/elementary.h"
#include "limn/core/math.h"

namespace limn::compiler {

namespace {

constexpr std::size_t kBins = 12;  // as many as pbrt-v4's
// Deeper than any sensible tree; from here on halves have as many lights, so that recursion ends.
constexpr int kDeepest = 48;
// Neighbours as near to each other as they are large are not worth a node each: what is gained by telling them apart
// is lost by the longer descent. Four are a factor of four in density at worst.
constexpr std::size_t kMostInLeaf = 4;
constexpr double kWidestLeaf = 3, kLeafCosine = 0.9;
// The least share of all strength: one that gets less could vanish in the sums.
constexpr double kLeastShare = 1e-6;

// The smallest cone of lines around two.
Cone merge(Cone a, Cone b) {
    if (a.cos_spread == flat::kNoNormals && b.cos_spread == flat::kNoNormals) return a;
    if (a.cos_spread <= 0 || b.cos_spread <= 0) return {a.axis, 0};
    if (dot(a.axis, b.axis) < 0) b.axis = -b.axis;
    const double spread_a = arc_cosine(a.cos_spread), spread_b = arc_cosine(b.cos_spread);
    const double between = arc_tangent(length(cross(a.axis, b.axis)), dot(a.axis, b.axis));
    if (between + spread_b <= spread_a) return a;
    if (between + spread_a <= spread_b) return b;
    const double spread = (spread_a + between + spread_b) / 2;
    if (spread >= kPi / 2) return {a.axis, 0};
    const double turn = spread - spread_a;  // from a towards b
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

// The integral over all directions, each weighed by the largest cosine that any normal within the cone makes with it.
double orientation_measure(double cos_spread) {
    if (cos_spread == flat::kNoNormals) return 4 * kPi;
    const double spread = arc_cosine(cos_spread), sine_spread = sine(spread);
    const double reach = std::min(spread + kPi / 2, kPi);
    return 2 * kPi * (1 - cos_spread) +
           kPi / 2 * (2 * reach * sine_spread - cosine(spread - 2 * reach) - 2 * spread * sine_spread + cos_spread);
}

double cost(const LightBounds& b) {
    return b.box.is_empty() ? 0 : b.strength * orientation_measure(b.cone.cos_spread) * surface_area(b.box);
}

class Builder {
public:
    Builder(std::span<LightItem> items, flat::LightTable& table) : items_(items), table_(table) {}

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
        // A few lights alone in the scene are told apart: that costs few nodes.
        if (count == 1 || (compact && items_.size() > kMostInLeaf)) return;
        const std::size_t middle = split(begin, end, all, depth);
        build(begin, middle, depth + 1);
        table_.nodes[node].right = static_cast<std::uint32_t>(table_.nodes.size());
        build(middle, end, depth + 1);
    }

private:
    static double center(const LightItem& item, std::size_t axis) { return item.bounds.box.center()[axis]; }

    // Sorts the lights into two halves and returns where the second begins.
    std::size_t split(std::size_t begin, std::size_t end, const LightBounds& all, int depth) {
        Box centers;
        for (std::size_t i = begin; i < end; ++i) centers.extend(items_[i].bounds.box.center());
        const Vec3 extent = centers.diagonal(), size = all.box.diagonal();
        double best = std::numeric_limits<double>::infinity();
        std::size_t best_axis = 0, best_bin = 0;
        for (std::size_t axis = 0; axis < 3 && depth < kDeepest; ++axis) {
            if (!(extent[axis] > 0) || !std::isfinite(extent[axis])) continue;
            std::array<LightBounds, kBins> bins;
            for (std::size_t i = begin; i < end; ++i) {
                LightBounds& bin = bins[bin_of(items_[i], axis, centers)];
                bin = merge(bin, items_[i].bounds);
            }
            std::array<double, kBins> below{};
            LightBounds sum;
            for (std::size_t b = 0; b + 1 < kBins; ++b) sum = merge(sum, bins[b]), below[b] = cost(sum);
            sum = {};
            // Thin slabs are to be cut across.
            const double thin = max_abs(size) / size[axis];
            for (std::size_t b = kBins - 1; b > 0; --b) {
                sum = merge(sum, bins[b]);
                const double c = thin * (below[b - 1] + cost(sum));
                if (c < best && below[b - 1] > 0 && !sum.box.is_empty()) best = c, best_axis = axis, best_bin = b;
            }
        }
        const auto first = items_.begin() + static_cast<std::ptrdiff_t>(begin),
                   last = items_.begin() + static_cast<std::ptrdiff_t>(end);
        auto middle = first;
        if (best_bin > 0)
            middle = std::partition(first, last,
                                    [&](const LightItem& item) { return bin_of(item, best_axis, centers) < best_bin; });
        if (middle == first || middle == last) {
            // All in one place, or in one line, whose boxes have no area: halves along the longest side.
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

    static flat::LightNode packed(const LightBounds& b, std::size_t end) {
        constexpr float kInf = std::numeric_limits<float>::infinity();
        flat::LightNode node{};
        for (std::size_t a = 0; a < 3; ++a) {
            node.center[a] = static_cast<float>(b.box.center()[a]);
            node.axis[a] = static_cast<float>(b.cone.axis[a]);
            // From the centre as rounded; a little more, for points that are computed at other times.
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

// Shares of the whole, which is returned; all alike if they cannot be told.
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
    if (items.empty()) return;
    table.strength = normalize_strengths(items);
    // Beside distant lights even a single one is weighed, by its node.
    if (items.size() > 1 || !table.distant.empty()) Builder(items, table).build(0, items.size(), 0);
    double before = 0;
    for (const LightItem& item : items) {
        if (item.number != LightItem::kNoPrimitive)
            table.by_number.push_back({item.number, static_cast<std::uint32_t>(table.refs.size())});
        table.refs.push_back(item.ref);
        table.strength_before.push_back(before);
        before += item.bounds.strength;
    }
    table.strength_before.push_back(before);
    std::uint32_t rank = 0;
    for (std::size_t k = 0; k <= items.size(); ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(items.size());
        while (rank + 1 < items.size() && table.strength_before[rank + 1] <= share) ++rank;
        table.guide.push_back(rank);
    }
    std::ranges::sort(table.by_number, {}, &flat::LightNumber::number);
}

}  // namespace limn::compiler
