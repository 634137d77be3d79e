// Disks as primitives.
#pragma once

#include <tuple>

#include "geometry/exact_disk.h"
#include "geometry/primitive.h"
#include "limn/math/frame.h"
#include "limn/math/warp.h"

namespace limn::primitives {

struct Disk : DiskRecord, Primitive {
    static constexpr PrimitiveKind kKind = PrimitiveKind::disk;
    static constexpr const char* kName = "disk";
    static constexpr auto kRecords = &SceneRecords::disks;
    static constexpr double kShare = kPi / 4;
    static Uv weights(double u, double v) {
        const Vec3 p = sample_uniform_disc(u, v);
        return {0.5 + 0.5 * p.x, 0.5 + 0.5 * p.y};
    }
    static auto fields(const DiskRecord& d) { return std::tie(d.center, d.normal, d.radius, d.material); }

    explicit Disk(const DiskRecord& d) : DiskRecord(d) {}

    Box bounds() const { return disk_bounds(center, normal, radius); }
    bool intersect(const RayFrame& frame, const Search& search, PlanarHit& hit) const {
        return intersect_disk(center, normal, radius, frame, search, hit);
    }
    Patch patch() const {
        const Frame axes(normalize(normal));
        return {center - (radius * axes.x + radius * axes.y), 2 * radius * axes.x, 2 * radius * axes.y};
    }
    void surface(const Ray&, const PlanarHit& found, bool, Surface& s) const {
        const Patch all = patch();
        on_patch(all, Normal3(normalize(normal)), planar_error(all.corner, all.edge_u, all.edge_v), found, s);
    }
};

}  // namespace limn::primitives
