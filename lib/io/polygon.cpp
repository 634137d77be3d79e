#include "io/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "geometry/mesh_triangle.h"

namespace limn {

Vec3 newell_normal(std::span<const Float3> polygon) {
    const Point3 origin = to_point(polygon[0]);
    Vec3 normal;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        normal = normal + cross(to_point(polygon[i]) - origin, to_point(polygon[i + 1]) - origin);
    return normal;
}

bool PolygonCutter::cut(std::span<const Float3> polygon, std::vector<Index3>& triangles) {
    // Make a fan of a triangle, and of a polygon that cannot be projected.
    triangles.clear();
    const Place count = static_cast<Place>(polygon.size());
    if (count == 3 || !project(polygon)) {
        for (Place i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
        return true;
    }
    // Link the corners into a ring, and make each of them a candidate. Begin at corner 1, so that a quadrilateral is
    // cut between 0 and 2.
    previous_.resize(count);
    next_.resize(count);
    version_.assign(count, 0);
    is_dent_.assign(count, false);
    candidates_.clear();
    for (Place i = 0; i < count; ++i) {
        previous_[i] = i == 0 ? count - 1 : i - 1;
        next_[i] = i + 1 == count ? 0 : i + 1;
        is_dent_[i] = turn(previous_[i], i, next_[i]) <= 0;
        candidates_.push_back({next_[i], 0});
    }
    fill_grid();
    remaining_ = count;
    tests_ = 0;

    // Clip ears until a triangle is left.
    Place on_ring = 0;
    bool progress = false;
    for (std::size_t head = 0; remaining_ > 3; ++head) {
        // When all candidates have been tested, make all corners of the ring candidates again.
        if (head == candidates_.size()) {
            tests_ += remaining_;
            // If no ear was found since the last time, clip a corner of zero area. If there is none, the polygon
            // crosses itself.
            if (!progress) on_ring = without_area(on_ring);
            if (!progress && turn(previous_[on_ring], on_ring, next_[on_ring]) != 0) break;
            if (!progress) {
                clip(on_ring, triangles);
                on_ring = next_[on_ring];
            }
            candidates_.clear();
            head = 0;
            progress = false;
            for (std::size_t i = 0; i < remaining_; ++i, on_ring = next_[on_ring])
                candidates_.push_back({on_ring, version_[on_ring]});
        }
        // Test the next candidate. Skip it if it was queued again or clipped since.
        const auto [i, version] = candidates_[head];
        if (version != version_[i]) continue;
        if (is_ear(i)) {
            clip(i, triangles);
            on_ring = next_[i];
            progress = true;
        }
        if (tests_ > kMaxTests) return false;
    }
    // Cut the rest as a fan.
    for (; remaining_ >= 3; on_ring = next_[on_ring]) clip(on_ring, triangles);
    return true;
}

// Projects the polygon along the axis where its normal is largest, so that it turns left in the plane of the other two.
// Returns false if the normal is zero or NaN.
bool PolygonCutter::project(std::span<const Float3> polygon) {
    const Vec3 normal = newell_normal(polygon), size = abs(normal);
    const std::size_t axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    if (!(size[axis] > 0)) return false;
    std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(x, y);
    points_.clear();
    for (const Float3& p : polygon) points_.push_back({to_point(p)[x], to_point(p)[y]});
    return true;
}

// Sorts the dents into the cells of the grid.
void PolygonCutter::fill_grid() {
    // Choose a grid with about one dent a cell.
    const std::size_t dents = static_cast<std::size_t>(std::count(is_dent_.begin(), is_dent_.end(), true));
    side_ = static_cast<std::size_t>(std::sqrt(static_cast<double>(dents)));
    if (dents == 0) return;
    lower_ = upper_ = points_[0];
    for (const Point& p : points_) {
        lower_ = {std::min(lower_[0], p[0]), std::min(lower_[1], p[1])};
        upper_ = {std::max(upper_[0], p[0]), std::max(upper_[1], p[1])};
    }
    // Count the dents in each cell, sum up the counts, and put each dent into its place.
    const auto cell_of = [this](Place i) { return cell(1, points_[i][1]) * side_ + cell(0, points_[i][0]); };
    cell_start_.assign(side_ * side_ + 1, 0);
    for (Place i = 0; i < points_.size(); ++i)
        if (is_dent_[i]) ++cell_start_[cell_of(i)];
    for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
    dents_.resize(dents);
    for (Place i = 0; i < points_.size(); ++i)
        if (is_dent_[i]) dents_[--cell_start_[cell_of(i)]] = i;
}

// Returns the row or column of the grid for a coordinate along an axis.
std::size_t PolygonCutter::cell(std::size_t axis, double place) const {
    const double cells = (place - lower_[axis]) / (upper_[axis] - lower_[axis]) * static_cast<double>(side_);
    return std::min(static_cast<std::size_t>(cells), side_ - 1);
}

// Returns twice the signed area of a triangle. It is positive if the triangle turns left.
double PolygonCutter::turn(Place a, Place b, Place c) const {
    const Point p = points_[a], q = points_[b], r = points_[c];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

// Returns true if corner i can be clipped: it is at the same point as a neighbour, or it is convex and its triangle
// holds no dent.
bool PolygonCutter::is_ear(Place i) {
    const Place a = previous_[i], b = next_[i];
    if (points_[i] == points_[a] || points_[i] == points_[b]) return true;
    return turn(a, i, b) > 0 && !holds_a_dent(a, i, b);
}

// Returns true if another part of the ring reaches into the closed triangle. It is enough to test the dents: if any
// part is inside, a dent is. A dent at the same point as a corner of the triangle does not count, because it is the end
// of a cut that leads to a hole.
bool PolygonCutter::holds_a_dent(Place a, Place i, Place b) {
    if (side_ == 0) return false;
    const auto [x0, x1] = std::minmax({points_[a][0], points_[i][0], points_[b][0]});
    const auto [y0, y1] = std::minmax({points_[a][1], points_[i][1], points_[b][1]});
    for (std::size_t y = cell(1, y0); y <= cell(1, y1); ++y) {
        const std::size_t first = cell_start_[y * side_ + cell(0, x0)], last = cell_start_[y * side_ + cell(0, x1) + 1];
        for (std::size_t k = first; k < last; ++k) {
            const Place d = dents_[k];
            ++tests_;
            if (!is_dent_[d] || turn(a, i, d) < 0 || turn(i, b, d) < 0 || turn(b, a, d) < 0) continue;
            if (points_[d] != points_[a] && points_[d] != points_[i] && points_[d] != points_[b]) return true;
        }
    }
    return false;
}

// Removes corner i from the ring and adds its triangle, which begins with its lowest corner.
void PolygonCutter::clip(Place i, std::vector<Index3>& triangles) {
    const Place a = previous_[i], b = next_[i];
    const Place lowest = std::min({a, i, b});
    triangles.push_back(lowest == a ? Index3{a, i, b} : lowest == i ? Index3{i, b, a} : Index3{b, a, i});
    next_[a] = b;
    previous_[b] = a;
    is_dent_[i] = false;
    ++version_[i];
    --remaining_;
    touch(a);
    touch(b);
}

// Updates a corner that has a new neighbour, and moves it to the end of the queue. Ears are therefore cut all around
// the polygon before an ear beside a cut one is. This keeps the triangles small.
void PolygonCutter::touch(Place i) {
    is_dent_[i] = is_dent_[i] && turn(previous_[i], i, next_[i]) <= 0;
    candidates_.push_back({i, ++version_[i]});
}

// Returns the next corner on the ring that is on a line with its neighbours; `start` if there is none.
PolygonCutter::Place PolygonCutter::without_area(Place start) const {
    Place i = start;
    do {
        if (turn(previous_[i], i, next_[i]) == 0) return i;
        i = next_[i];
    } while (i != start);
    return start;
}

}  // namespace limn
