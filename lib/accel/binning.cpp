#include "accel/binning.h"

#include <algorithm>
#include <utility>

namespace limn::accel {

namespace {

struct Bins {
    Bounds bounds[3][BinMapping::kMaxBins];
    Int4 count[BinMapping::kMaxBins] = {};  // by axis

    void add(const Reference& reference, const BinMapping& mapping) {
        const Bounds box = bounds_of(reference);
        const Int4 place = mapping(center_of(box));
        for (int axis = 0; axis < 3; ++axis) {
            bounds[axis][place[axis]].extend(box);
            ++count[place[axis]][axis];
        }
    }
};

// Half the areas of three boxes. Sides are first multiplied by `scale`, for their products would overflow or vanish;
// and grow by a little, so that boxes without any area are told apart by their length.
Vec4 areas(const Bounds (&boxes)[3], Vec4 scale) {
    const auto sides = [&](const Bounds& b) { return (b.upper - b.lower) * scale + splat(0x1p-12f); };
    const Vec4 a = sides(boxes[0]), b = sides(boxes[1]), c = sides(boxes[2]);
    const Vec4 low = __builtin_shuffle(a, b, Int4{0, 4, 1, 5}), high = __builtin_shuffle(a, b, Int4{2, 6, 3, 7});
    const Vec4 x = __builtin_shuffle(low, c, Int4{0, 1, 4, 4}), y = __builtin_shuffle(low, c, Int4{2, 3, 5, 5}),
               z = __builtin_shuffle(high, c, Int4{0, 1, 6, 6});
    return x * (y + z) + y * z;
}

}  // namespace

BinMapping::BinMapping(const Range& range)
    : bins_(kMaxBins), origin_(range.centers.lower), scale_{}, last_(splat(kMaxBins - 1)) {
    const Vec4 extent = range.centers.upper - range.centers.lower;
    // An axis along which all centres are one, or the reciprocal would overflow, has one bin.
    for (int a = 0; a < 3; ++a)
        if (extent[a] > 0x1p-120f) scale_[a] = static_cast<float>(bins_) / extent[a];
}

Split best_split(std::span<const Reference> references, const Range& range, const BinMapping& mapping,
                 std::uint32_t leaf_width) {
    Bins bins;
    for (std::uint32_t i = range.begin; i < range.end; ++i) bins.add(references[i], mapping);

    const Vec4 sides = range.bounds.upper - range.bounds.lower;
    const Vec4 scale = splat(1 / std::max({sides[0], sides[1], sides[2], 0x1p-120f}));
    const Bounds whole[3] = {range.bounds, range.bounds, range.bounds};
    const Vec4 per_area = 1 / areas(whole, scale);
    const Vec4 up = splat(static_cast<float>(leaf_width - 1)), per_test = splat(1 / static_cast<float>(leaf_width));
    const auto cost = [&](const Bounds(&side)[3], Int4 count) {
        const Int4 tests = __builtin_convertvector((__builtin_convertvector(count, Vec4) + up) * per_test, Int4);
        return areas(side, scale) * __builtin_convertvector(tests, Vec4) * per_area;
    };

    Vec4 lower_cost[BinMapping::kMaxBins];
    Bounds side[3];
    Int4 count{};
    for (int b = 0; b + 1 < mapping.bins(); ++b) {
        for (int axis = 0; axis < 3; ++axis) side[axis].extend(bins.bounds[axis][b]);
        count += bins.count[b];
        lower_cost[b + 1] = cost(side, count);
    }
    for (Bounds& s : side) s = Bounds();
    count = Int4{};
    // An empty side costs infinity times nothing, which is not less than anything.
    Vec4 least = splat(std::numeric_limits<float>::infinity());
    Int4 where{};
    for (int b = mapping.bins() - 1; b > 0; --b) {
        for (int axis = 0; axis < 3; ++axis) side[axis].extend(bins.bounds[axis][b]);
        count += bins.count[b];
        const Vec4 both = lower_cost[b] + cost(side, count);
        const Int4 better = both < least;
        least = better ? both : least;
        where = better ? Int4{b, b, b, b} : where;
    }
    Split best;
    for (int axis = 0; axis < 3; ++axis)
        if (least[axis] < best.cost) best = {least[axis], axis, where[axis]};
    return best;
}

void partition(std::span<Reference> references, const Range& range, const BinMapping& mapping, const Split& split,
               Range& lower, Range& upper) {
    lower = upper = Range();
    std::uint32_t begin = range.begin, end = range.end;
    while (begin < end) {
        const Bounds box = bounds_of(references[begin]);
        if (mapping(center_of(box))[split.axis] < split.bin) {
            lower.add(box);
            ++begin;
        } else {
            upper.add(box);
            std::swap(references[begin], references[--end]);
        }
    }
    lower.begin = range.begin, lower.end = upper.begin = begin, upper.end = range.end;
}

void halve(std::span<const Reference> references, const Range& range, Range& lower, Range& upper) {
    lower = upper = Range();
    const std::uint32_t middle = range.begin + range.count() / 2;
    lower.begin = range.begin, lower.end = upper.begin = middle, upper.end = range.end;
    for (std::uint32_t i = range.begin; i < range.end; ++i) (i < middle ? lower : upper).add(bounds_of(references[i]));
}

}  // namespace limn::accel
