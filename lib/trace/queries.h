// What to do with hits; kMoved: with passages of the moved ray; kFewKinds: without code for each set of kinds. `limit`
// is the t beyond which nothing matters; `report` returns true to end the search.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "flat/scene.h"
#include "geometry/filter.h"
#include "trace/traverse.h"

namespace limn::trace {

struct Closest {
    static constexpr bool kNearest = true, kEveryHit = false, kFirstHit = false, kMoved = false, kFewKinds = false;
    double t_max;         // lowered as hits are known, be it by their bounds
    Hit* best = nullptr;  // the caller's, at first a miss; copying it out would wait for what was stored in parts

    double limit() const { return t_max; }
    void lower_limit(double t) { t_max = smaller(t_max, t); }
    bool ended() const { return false; }
    bool passes(const UserDefinedHit&) const { return false; }
    bool report(const PlanarHit& hit, std::uint64_t number, bool /*inward*/, bool matched = false) {
        if (hit.t < best->t || (hit.t == best->t && number < best->primitive))
            *best = {{hit.t, number}, hit.u, hit.v, matched};
        lower_limit(hit.t);
        return false;
    }
};

struct Any {
    static constexpr bool kNearest = false, kEveryHit = false, kFirstHit = true, kMoved = false, kFewKinds = false;
    double t_max;
    bool passes_boundaries = false;  // index-matched ones
    bool found = false;

    double limit() const { return t_max; }
    bool ended() const { return found; }
    bool passes(const UserDefinedHit& hit) const { return passes_boundaries && hit.index_matched; }
    bool report(const PlanarHit&, std::uint64_t, bool, bool = false) { return found = true; }
};

struct Every {
    static constexpr bool kNearest = false, kEveryHit = true, kFirstHit = false, kMoved = false, kFewKinds = false;
    double t_max;
    std::vector<Crossing>& crossings;

    double limit() const { return t_max; }
    bool ended() const { return false; }
    bool passes(const UserDefinedHit&) const { return false; }
    bool report(const PlanarHit& hit, std::uint64_t number, bool inward, bool matched = false) {
        crossings.push_back({hit.t, inward, matched, number, hit.u, hit.v});
        return false;
    }
};

// Passages of the moved ray (geometry/passage.h). What has no such rule, disks and user-defined shapes, counts as it
// does for hits.
struct Passages : PassageCount {
    static constexpr bool kNearest = false, kEveryHit = true, kFirstHit = false, kMoved = true, kFewKinds = true;
    double t_max;
    std::vector<Crossing>* crossings = nullptr;  // where they are listed
    bool wants_touched = false;                  // which primitives the origin lies on

    double limit() const { return t_max; }
    bool ended() const { return false; }
    bool passes(const UserDefinedHit&) const { return false; }
    void touch(std::uint64_t number) { touched = std::min(touched, number); }
    bool report(const PlanarHit& hit, std::uint64_t number, bool inward, bool matched = false) {
        ++count, outward += inward ? -1 : 1;
        if (crossings != nullptr) crossings->push_back({hit.t, inward, matched, number, hit.u, hit.v});
        return false;
    }
};

// A query that passes some primitives over. No sure hit counts before the filter has accepted it, so each is
// intersected at once.
template <class Query>
struct Filtered : Query {
    static constexpr bool kNearest = false, kEveryHit = true, kFirstHit = false, kFewKinds = true;
    const Filter* filter;

    void touch(std::uint64_t number) {
        if (filter->accepts(number)) Query::touch(number);
    }
    bool report(const PlanarHit& hit, std::uint64_t number, bool inward, bool matched = false) {
        return filter->accepts(number, inward) && Query::report(hit, number, inward, matched);
    }
};

}  // namespace limn::trace
