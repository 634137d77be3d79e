// Cutting a polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/core/vec.h"

namespace limn {

// Twice the area of a polygon, as a vector along its normal (Newell's method: Sutherland, Sproull, Schumacker, A
// Characterization of Ten Hidden-Surface Algorithms, 1974); zero where parts of opposite sense cancel.
Vec3 newell_normal(std::span<const Float3> polygon);

// Ear clipping (Meisters, Polygons Have Ears, 1975) of the polygon as seen along its Newell normal. Every corner is
// used, those within a straight edge too, so that neighbours stay joined. Where a polygon crosses itself and no ear is
// left, the rest is cut as a fan. Keeps its memory between polygons.
class PolygonCutter {
public:
    // The corner_count - 2 triangles as places in `polygon`, which turn the way it does; false if the work exceeds
    // kMaxTests. \pre at least three corners
    bool cut(std::span<const Float3> polygon, std::vector<Index3>& triangles);

    // Point-in-triangle tests for one polygon: some seconds of work. 300,000 corners around a circle, which rounding to
    // float32 fills with tiny dents, take a twentieth of it.
    static constexpr std::uint64_t kMaxTests = 1'000'000'000;

private:
    using Place = std::uint32_t;
    using Point = std::array<double, 2>;
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
    std::vector<Place> previous_, next_;
    std::vector<char> is_dent_;  // on the ring, and not convex
    std::vector<std::uint32_t> version_;
    std::vector<Candidate> candidates_;
    std::size_t remaining_ = 0;
    std::uint64_t tests_ = 0;
    // A square grid over the polygon, and the dents in each of its cells.
    std::size_t side_ = 0;
    Point lower_{}, upper_{};
    std::vector<Place> cell_start_, dents_;
};

}  // namespace limn
