// Cuts a polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/math/vec.h"

namespace limn {

// Returns the normal of a polygon with twice its area as the length (Newell's method: Sutherland, Sproull, Schumacker,
// A Characterization of Ten Hidden-Surface Algorithms, 1974). It is zero if parts of opposite orientation cancel.
// \pre at least one corner
Vec3 newell_normal(std::span<const Float3> polygon);

// Cuts polygons by ear clipping (Meisters, Polygons Have Ears, 1975), projected along an axis. Every corner is used,
// also one within a straight edge, so that there are no gaps to adjacent faces. If a polygon crosses itself and no ear
// is left, the rest is cut as a fan. The object keeps its memory between polygons. A "dent" is a corner that is not
// convex.
class PolygonCutter {
public:
    // Sets `triangles` to the corner_count - 2 triangles, as indices into `polygon`, with the orientation of the
    // polygon. Returns false if the work exceeds kMaxTests. \pre at least three corners
    bool cut(std::span<const Float3> polygon, std::vector<Index3>& triangles);

    // The limit of point-in-triangle tests for one polygon, some seconds of work. A circle of 300,000 corners takes a
    // twentieth of it: rounded to float32, it has many tiny dents.
    static constexpr std::uint64_t kMaxTests = 1'000'000'000;

private:
    using Place = std::uint32_t;  // the index of a corner
    using Point = std::array<double, 2>;
    // A corner that may be an ear. It is out of date if the version of the corner has changed.
    struct Candidate {
        Place place;
        std::uint32_t version;
    };

    bool project(std::span<const Float3> polygon);
    void fill_grid();
    std::size_t cell(std::size_t axis, double place) const;
    double turn(Place a, Place b, Place c) const;
    bool is_ear(Place i);
    bool holds_a_dent(Place a, Place i, Place b);
    void clip(Place i, std::vector<Index3>& triangles);
    void touch(Place i);
    Place without_area(Place start) const;

    std::vector<Point> points_;
    std::vector<Place> previous_, next_;  // the neighbours of each corner on the ring
    std::vector<char> is_dent_;           // true for a corner that is on the ring and not convex
    std::vector<std::uint32_t> version_;
    std::vector<Candidate> candidates_;  // a queue
    std::size_t remaining_ = 0;          // number of corners on the ring
    std::uint64_t tests_ = 0;
    // A square grid over the polygon, with side_ cells along each axis. The dents in cell c are dents_[cell_start_[c]]
    // up to dents_[cell_start_[c + 1]], not included.
    std::size_t side_ = 0;
    Point lower_{}, upper_{};
    std::vector<Place> cell_start_, dents_;
};

}  // namespace limn
