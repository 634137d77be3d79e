#include "accel/spatial_split.h"

#include <algorithm>
#include <cstring>

#include "accel/collapse.h"

namespace limn::accel {

namespace {

constexpr int kMaxBins = 16;
constexpr std::uint32_t kSample = 128;  // primitives that are cut to choose a plane, or some more

struct Bin {
    Bounds bounds = kEmpty;
    std::uint32_t begins = 0, ends = 0;  // primitives whose lowest, and whose highest bin it is
};

// Bins of space along one axis.
class Slices {
public:
    Slices(const Range& range, int axis)
        : axis_(axis),
          count_(std::min(static_cast<int>(range.size() / 16) + 3, kMaxBins)),
          origin_(range.bounds.lower[axis]),
          extent_(range.bounds.upper[axis] - origin_),
          scale_(static_cast<float>(count_) / extent_) {}

    bool exist() const { return extent_ > 0x1p-100f; }
    float plane(int bin) const { return origin_ + extent_ * (static_cast<float>(bin) / static_cast<float>(count_)); }
    int bin_of(float x) const { return std::min(count_ - 1, static_cast<int>((x - origin_) * scale_)); }

    // `is_sampled`: if planes go through it, the bins get what they make of it; else they only count it. Where rounding
    // puts bins and planes differently the choice is a little worse.
    void add(const BuildPrimitive& p, bool is_sampled, const Clip& clip) {
        const int first = bin_of(p.lower[axis_]), last = bin_of(p.upper[axis_]);
        ++bins_[first].begins;
        ++bins_[last].ends;
        if (first < last && !is_sampled) return;
        Bounds rest = p.bounds();
        for (int b = first; b < last; ++b) {
            const Clip::Parts parts = clip.cut(p.index(), to_box(rest), axis_, plane(b + 1));
            bins_[b].bounds.extend(to_bounds(parts.lower));
            rest = to_bounds(parts.upper);
        }
        bins_[last].bounds.extend(rest);
    }

    // Over the area of the range.
    Cut best(std::uint32_t leaf_width) const {
        double lower_cost[kMaxBins] = {};
        Bounds side = kEmpty;
        std::uint32_t count = 0;
        for (int b = 0; b + 1 < count_; ++b) {
            side.extend(bins_[b].bounds);
            count += bins_[b].begins;
            lower_cost[b + 1] = side_cost(side, count, leaf_width);
        }
        Cut best;
        side = kEmpty;
        count = 0;
        for (int b = count_ - 1; b > 0; --b) {
            side.extend(bins_[b].bounds);
            count += bins_[b].ends;
            const double cost = lower_cost[b] + side_cost(side, count, leaf_width);
            if (cost < best.cost) best = {cost, axis_, plane(b)};
        }
        return best;
    }

    // Infinite without a box.
    static double side_cost(const Bounds& side, std::uint32_t count, std::uint32_t leaf_width) {
        if (count == 0) return std::numeric_limits<double>::infinity();
        return half_area(to_box(side)) * ((count + leaf_width - 1) / leaf_width);
    }

private:
    int axis_, count_;
    float origin_, extent_, scale_;
    Bin bins_[kMaxBins];
};

Bounds joined(Bounds a, const Bounds& b) {
    a.extend(b);
    return a;
}

Bounds common(const Bounds& a, const Bounds& b) { return {max(a.lower, b.lower), min(a.upper, b.upper)}; }

struct Halves {
    Bounds below, above;
};

// What of a build primitive lies on either side of the plane.
Halves halves_of(const BuildPrimitive& p, const Cut& cut, const Clip& clip) {
    const Clip::Parts parts = clip.cut(p.index(), to_box(p.bounds()), cut.axis, cut.position);
    Halves halves{common(p.bounds(), to_bounds(parts.lower)), common(p.bounds(), to_bounds(parts.upper))};
    halves.below.upper[cut.axis] = std::min(halves.below.upper[cut.axis], cut.position);
    halves.above.lower[cut.axis] = std::max(halves.above.lower[cut.axis], cut.position);
    return halves;
}

// Gives one side all of a build primitive, and the other nothing, where that is cheaper. The counts have it on both.
void leave_whole(const BuildPrimitive& p, const Range& lower, std::uint32_t lower_count, const Range& upper,
                 std::uint32_t upper_count, Bounds& below, Bounds& above) {
    const auto cost = [&](const Bounds& l, std::uint32_t in_lower, const Bounds& u, std::uint32_t in_upper) {
        return half_area(to_box(l)) * in_lower + half_area(to_box(u)) * in_upper;
    };
    const double both = cost(joined(lower.bounds, below), lower_count, joined(upper.bounds, above), upper_count);
    const double all_below = cost(joined(lower.bounds, p.bounds()), lower_count, upper.bounds, upper_count - 1);
    const double all_above = cost(lower.bounds, lower_count - 1, joined(upper.bounds, p.bounds()), upper_count);
    if (!(all_below < both || all_above < both)) return;
    const bool is_below = all_below <= all_above;
    below = is_below ? p.bounds() : kEmpty, above = is_below ? kEmpty : p.bounds();
}

}  // namespace

double overlap(const BuildPrimitive* primitives, const Range& range, const Split& split) {
    Bounds lower = kEmpty, upper = kEmpty;
    for (std::uint32_t i = range.begin; i < range.end; ++i)
        (split.is_lower(primitives[i]) ? lower : upper).extend(primitives[i].bounds());
    const Bounds both = common(lower, upper);
    return is_empty(both) ? 0 : half_area(to_box(both));
}

Cut best_cut(const BuildPrimitive* primitives, const Range& range, std::uint32_t leaf_width, const Clip& clip) {
    const std::uint32_t step = 1 + range.size() / kSample;
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
        Slices slices(range, axis);
        if (!slices.exist()) continue;
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            slices.add(primitives[i], (i - range.begin) % step == 0, clip);
        const Cut cut = slices.best(leaf_width);
        if (cut.cost < best.cost) best = cut;
    }
    best.cost /= half_area(to_box(range.bounds));
    return best;
}

bool cut(const BuildPrimitive* primitives, BuildPrimitive* to, const Range& range, const Cut& cut, const Clip& clip,
         Range& lower, Range& upper) {
    lower = upper = Range();
    const auto is_below = [&](const BuildPrimitive& p) { return p.upper[cut.axis] <= cut.position; };
    const auto is_above = [&](const BuildPrimitive& p) { return p.lower[cut.axis] >= cut.position; };
    std::uint32_t lower_count = 0, upper_count = 0;  // with those across the plane, as long as both sides may get them
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const BuildPrimitive& p = primitives[i];
        const bool below = is_below(p), above = !below && is_above(p);
        if (below) lower.extend(p);
        if (above) upper.extend(p);
        lower_count += above ? 0 : 1, upper_count += below ? 0 : 1;
    }
    if (lower_count + upper_count - range.size() > range.room) return false;

    // The lower side is written from the near end of the room upwards, the upper one from the far end downwards.
    const std::uint32_t end = range.end + range.room;
    std::uint32_t lower_end = range.begin, upper_begin = end;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const BuildPrimitive& p = primitives[i];
        if (is_below(p)) {
            to[lower_end++] = p;
        } else if (is_above(p)) {
            to[--upper_begin] = p;
        } else {
            auto [below, above] = halves_of(p, cut, clip);
            if (!is_empty(below) && !is_empty(above))
                leave_whole(p, lower, lower_count, upper, upper_count, below, above);
            lower_count -= is_empty(below) ? 1 : 0, upper_count -= is_empty(above) ? 1 : 0;
            if (!is_empty(below)) lower.extend(to[lower_end++] = BuildPrimitive(below, p.index()));
            if (!is_empty(above)) upper.extend(to[--upper_begin] = BuildPrimitive(above, p.index()));
        }
    }
    const std::uint32_t size = range.size(), lower_size = lower_end - range.begin, upper_size = end - upper_begin;
    if (lower_size == 0 || upper_size == 0 || lower_size >= size || upper_size >= size) return false;
    share_room(to, range, lower_size, upper_begin, upper_size, lower, upper);
    return true;
}

void share_room(BuildPrimitive* to, const Range& range, std::uint32_t lower_size, std::uint32_t upper_begin,
                std::uint32_t upper_size, Range& lower, Range& upper) {
    const std::uint32_t size = lower_size + upper_size, room = range.size() + range.room - size;
    lower.begin = range.begin, lower.end = range.begin + lower_size;
    lower.room = static_cast<std::uint32_t>(std::uint64_t{room} * lower_size / size);
    upper.begin = lower.end + lower.room, upper.end = upper.begin + upper_size;
    upper.room = room - lower.room;
    std::memmove(to + upper.begin, to + upper_begin, upper_size * sizeof *to);
}

}  // namespace limn::accel
