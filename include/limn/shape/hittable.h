/// \file
/// The interface of every shape.
#pragma once

#include <memory>
#include <optional>

#include "limn/core/box.h"
#include "limn/core/ray.h"
#include "limn/core/surface.h"
#include "limn/material/material.h"
#include "limn/record_sink.h"

namespace limn {

/// Where a ray meets a described object.
struct Hit {
    double t = kInfinity;                ///< in units of the ray's direction
    Normal3 normal;                      ///< geometric, outward, unit
    double u = 0;                        ///< surface parameter; see the shape
    double v = 0;                        ///< surface parameter; see the shape
    const Material* material = nullptr;  ///< not owning; null: black
    std::uint64_t element = 0;           ///< the index of the primitive within the object
    Normal3 shading_normal{};            ///< interpolated, unit; zero: same as normal
    std::optional<Uv> uv{};              ///< texture coordinates where they differ from u, v
    Vec3 position_error{};       ///< bound on the hit point's error along each axis, beyond the rounding of ray.at(t)
    bool index_matched = false;  ///< the boundary of a medium: light passes straight through
};

/// What a ray can hit. A subclass needs `bounds` and `hit`; rays then find it through the same BVH as the built-in
/// shapes. CompiledScene::closest_point and save refuse scenes that have one. Implementations are immutable once added
/// to a scene, and safe to call from any thread.
class Hittable {
public:
    virtual ~Hittable() = default;

    /// A box around the object over the whole shutter, 0 <= time <= 1. Hits outside it may be missed, so that rounding
    /// must go outward; sides may be infinite. Constant.
    virtual Box bounds() const = 0;

    /// The nearest hit with t in (t_min, t_max]; of equally near ones the lowest element. Pure: any other interval that
    /// holds this hit, and no nearer one, gives the same bits. Shapes are closed sets: a tangent, an edge, a vertex is
    /// a hit. An unusable ray (see is_usable) misses. A shape that intersects other shapes passes them the ray or a
    /// copy (see Ray::frame).
    virtual std::optional<Hit> hit(const Ray& ray) const = 0;

    /// Writes what the object consists of. The default writes one record of a user-defined shape, through which the
    /// compiled scene calls `hit`. It counts as one element, so that Hit::element is to be 0: lists count on from it.
    virtual void lower(RecordSink& sink) const;
};

}  // namespace limn
