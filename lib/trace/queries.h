// What to do with hits. `limit` is the t beyond which nothing matters; `report` returns true to end the search.
#pragma once

#include <cstdint>
#include <vector>

#include "flat/scene.h"
#include "predicates/filter.h"
#include "trace/traverse.h"

namespace limn::trace {

struct Closest {
    static constexpr bool kNearest = true, kEveryHit = false, kFirstHit = false;
    double t_max;  // lowered as hits are known, be it by their bounds
    Hit best = {};

    double limit() const { return t_max; }
    void lower_limit(double t) { t_max = smaller(t_max, t); }
    bool ended() const { return false; }
    bool passes(const ForeignHit&) const { return false; }
    bool report(const PlanarHit& hit, std::uint64_t number, bool /*inward*/, bool matched = false) {
        if (hit.t < best.t || (hit.t == best.t && number < best.primitive))
            best = {{hit.t, number}, hit.u, hit.v, matched};
        lower_limit(hit.t);
        return false;
    }
};

struct Any {
    static constexpr bool kNearest = false, kEveryHit = false, kFirstHit = true;
    double t_max;
    bool passes_boundaries = false;  // index-matched ones
    bool found = false;

    double limit() const { return t_max; }
    bool ended() const { return found; }
    bool passes(const ForeignHit& hit) const { return passes_boundaries && hit.index_matched; }
    bool report(const PlanarHit&, std::uint64_t, bool, bool = false) { return found = true; }
};

struct Every {
    static constexpr bool kNearest = false, kEveryHit = true, kFirstHit = false;
    double t_max;
    std::vector<Crossing>& crossings;

    double limit() const { return t_max; }
    bool ended() const { return false; }
    bool passes(const ForeignHit&) const { return false; }
    bool report(const PlanarHit& hit, std::uint64_t number, bool inward, bool matched = false) {
        crossings.push_back({hit.t, inward, matched, number, hit.u, hit.v});
        return false;
    }
};

}  // namespace limn::trace
