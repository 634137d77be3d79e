// Where to cut a range of boxes in two: the surface-area heuristic over bins of their centres (Wald, On Fast
// Construction of SAH-based Bounding Volume Hierarchies, 2007).
#pragma once

#include <span>

#include "accel/reference.h"

namespace limn::accel {

// Boxes that stand together, and what surrounds them and their centres (of twice the size).
struct Range {
    std::uint32_t begin = 0, end = 0;
    Bounds bounds, centers;

    std::uint32_t count() const { return end - begin; }
    void add(const Bounds& b) {
        bounds.extend(b);
        const Vec4 center = center_of(b);
        centers.extend({center, center});
    }
};

// The bin of a centre on each axis.
class BinMapping {
public:
    static constexpr int kMaxBins = 16;

    explicit BinMapping(const Range& range);
    int bins() const { return bins_; }
    Int4 operator()(Vec4 center) const {
        return __builtin_convertvector(min((center - origin_) * scale_, last_), Int4);
    }

private:
    int bins_;
    Vec4 origin_, scale_, last_;
};

struct Split {
    float cost = std::numeric_limits<float>::infinity();  // of both sides: area over the range's times leaf tests
    int axis = 0;
    int bin = 0;  // the first of the upper side

    bool exists() const { return cost < std::numeric_limits<float>::infinity(); }
};

// The cheapest one. Where there is any, neither side is empty.
Split best_split(std::span<const Reference> references, const Range& range, const BinMapping& mapping,
                 std::uint32_t leaf_width);

// Puts what is below the split first.
void partition(std::span<Reference> references, const Range& range, const BinMapping& mapping, const Split& split,
               Range& lower, Range& upper);

// Cuts by number alone.
void halve(std::span<const Reference> references, const Range& range, Range& lower, Range& upper);

}  // namespace limn::accel
