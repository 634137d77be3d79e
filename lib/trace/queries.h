// Queries receive the hits of a search. Each has these constants and functions:
//   - kNearest is true if only the nearest hit counts, kFirstHit if any hit ends the search, kEveryHit if all count.
//   - kMoved is true if passages of the moved ray are reported (geometry/passage.h), not hits.
//   - kFewKinds is true if the search isn't compiled for each set of kinds.
//   - limit() returns a t beyond which no hit counts.
//   - passes() returns true if a hit of a user-defined shape is ignored.
//   - report() receives a hit and returns true to end the search; ended() returns true after that.
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
    double t_max;         // lowered with each hit, or to a bound on its t
    Hit* best = nullptr;  // the caller's, at first a miss. Copying it at the end would wait for its last stores.

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
    bool passes_boundaries = false;  // true if index-matched boundaries are ignored
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

// Counts passages of the moved ray, or lists them. Disks and user-defined shapes have no rule for such a ray, so their
// hits count.
struct Passages : PassageCount {
    static constexpr bool kNearest = false, kEveryHit = true, kFirstHit = false, kMoved = true, kFewKinds = true;
    double t_max;
    std::vector<Crossing>* crossings = nullptr;  // the list, or null
    bool wants_touched = false;                  // true if `touched` is to be set

    double limit() const { return t_max; }
    bool ended() const { return false; }
    bool passes(const UserDefinedHit&) const { return false; }
    void touch(std::uint64_t number) { touched = std::min(touched, number); }
    bool report(const PlanarHit& hit, std::uint64_t number, bool inward, bool matched = false) {
        ++count;
        outward += inward ? -1 : 1;
        if (crossings != nullptr) crossings->push_back({hit.t, inward, matched, number, hit.u, hit.v});
        return false;
    }
};

// A query that ignores some primitives. A sure hit doesn't count before the filter has accepted it. Therefore each is
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
