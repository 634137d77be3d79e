#include "geometry/bvh/binning.h"

#include <algorithm>

namespace limn::accel {

namespace {

// The largest number of bins, as in Embree. Small ranges have fewer, because most of their bins would be empty.
constexpr int kMaxBins = 32;

// For each axis and bin, the bounds and the number of the primitives whose centres are in it.
struct Bins {
    Bounds bounds[3][kMaxBins];
    Int4 count[kMaxBins];  // a lane for each axis
    int bins;
    Vec4 origin, scale, last;

    explicit Bins(const Range& range)
        : bins(std::clamp(static_cast<int>(range.size() / 4) + 8, 8, kMaxBins)),
          origin(range.centers.lower),
          scale{},
          last(splat(static_cast<float>(bins - 1))) {
        for (int b = 0; b < bins; ++b) {
            for (int axis = 0; axis < 3; ++axis) bounds[axis][b] = kEmpty;
            count[b] = Int4{};
        }
        const Vec4 extent = range.centers.upper - origin;
        // Use a single bin along an axis if all centres agree or differ by so little that the reciprocal could
        // overflow.
        for (int axis = 0; axis < 3; ++axis)
            if (extent[axis] > 0x1p-120f) scale[axis] = static_cast<float>(bins) / extent[axis];
    }

    void add(const BuildPrimitive& p) {
        const Int4 place = __builtin_convertvector(min((p.center() - origin) * scale, last), Int4);
        const auto weight = static_cast<std::int32_t>(p.weight());
        for (int axis = 0; axis < 3; ++axis) {
            bounds[axis][place[axis]].extend(p);
            count[place[axis]][axis] += weight;
        }
    }
};

// Returns half the areas of three boxes. Sides are first multiplied by `scale`, because their products could overflow
// or underflow. Then 2^-12 is added to each, so that boxes without area are compared by their length.
Vec4 areas(const Bounds (&boxes)[3], Vec4 scale) {
    const auto sides = [&](const Bounds& b) { return (b.upper - b.lower) * scale + splat(0x1p-12f); };
    const Vec4 a = sides(boxes[0]), b = sides(boxes[1]), c = sides(boxes[2]);
    const Vec4 low = __builtin_shufflevector(a, b, 0, 4, 1, 5), high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Vec4 x = __builtin_shufflevector(low, c, 0, 1, 4, 4), y = __builtin_shufflevector(low, c, 2, 3, 5, 5),
               z = __builtin_shufflevector(high, c, 0, 1, 6, 6);
    return x * (y + z) + y * z;
}

}  // namespace

Split best_split(const BuildPrimitive* primitives, const Range& range, std::uint32_t leaf_width) {
    // Fill the bins.
    Bins bins(range);
    for (std::uint32_t i = range.begin; i < range.end; ++i) bins.add(primitives[i]);

    // Define the cost of one side of a split, a lane for each axis.
    const Vec4 sides = range.bounds.upper - range.bounds.lower;
    const Vec4 scale = splat(1 / std::max({sides[0], sides[1], sides[2], 0x1p-120f}));
    const Vec4 up = splat(static_cast<float>(leaf_width - 1)), per_test = splat(1 / static_cast<float>(leaf_width));
    const auto cost = [&](const Bounds(&side)[3], Int4 count) {
        const Int4 tests = __builtin_convertvector((__builtin_convertvector(count, Vec4) + up) * per_test, Int4);
        return areas(side, scale) * __builtin_convertvector(tests, Vec4);
    };

    // Compute the cost of the lower side of every split.
    Vec4 lower_cost[kMaxBins];
    Bounds side[3] = {kEmpty, kEmpty, kEmpty};
    Int4 count{};
    for (int b = 0; b + 1 < bins.bins; ++b) {
        for (int axis = 0; axis < 3; ++axis) side[axis].extend(bins.bounds[axis][b]);
        count += bins.count[b];
        lower_cost[b + 1] = cost(side, count);
    }
    // Add the cost of the upper side and find the cheapest split along each axis. The cost of an empty side is
    // infinity * 0 = NaN, which never compares as less.
    for (Bounds& s : side) s = kEmpty;
    count = Int4{};
    Vec4 least = kEndless;
    Int4 where{};
    for (int b = bins.bins - 1; b > 0; --b) {
        for (int axis = 0; axis < 3; ++axis) side[axis].extend(bins.bounds[axis][b]);
        count += bins.count[b];
        const Vec4 both = lower_cost[b] + cost(side, count);
        const Int4 better = both < least;
        least = better ? both : least;
        where = better ? Int4{b, b, b, b} : where;
    }
    // Choose the axis.
    const Bounds whole[3] = {range.bounds, range.bounds, range.bounds};
    const float area = areas(whole, scale)[0];
    Split best;
    for (int axis = 0; axis < 3; ++axis)
        if (least[axis] / area < best.cost)
            best = {least[axis] / area, axis, bins.origin[axis], bins.scale[axis], static_cast<float>(where[axis])};
    return best;
}

std::uint32_t partition(const BuildPrimitive* from, BuildPrimitive* to, const Range& range, const Split& split) {
    // Write each primitive to both ends of the free rows, then move the end of its side. This takes no branch, so none
    // is mispredicted.
    std::uint32_t begin = range.begin, end = range.end;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const BuildPrimitive r = from[i];
        to[begin] = to[end - 1] = r;
        const bool lower = split.is_lower(r);
        begin += lower ? 1 : 0;
        end -= lower ? 0 : 1;
    }
    return begin;
}

}  // namespace limn::accel
