/// \file
/// The interface of every shape.
#pragma once

#include <memory>
#include <optional>

#include "limn/math/box.h"
#include "limn/math/ray.h"
#include "limn/math/surface.h"
#include "limn/records/record_sink.h"
#include "limn/scene/material/material.h"

namespace limn {

/// The intersection of a ray with a Hittable. Queries of a CompiledScene return RayHit instead.
struct Hit {
    double t = kInfinity;                ///< ray parameter, in units of the ray's direction
    Normal3 normal;                      ///< geometric normal, outward, unit
    double u = 0;                        ///< surface parameter, which the shape defines
    double v = 0;                        ///< surface parameter, which the shape defines
    const Material* material = nullptr;  ///< not owning; null: black
    std::uint64_t element = 0;           ///< index of the primitive within the object
    Normal3 shading_normal{};            ///< interpolated normal, unit; zero: same as `normal`
    std::optional<Uv> uv{};              ///< texture coordinates; unset: u and v
    Vec3 position_error{};       ///< bound on the hit point's error along each axis, beyond the rounding of ray.at(t)
    bool index_matched = false;  ///< true for the boundary of a medium: light goes straight through
};

/// The interface of every object that a ray can hit. A subclass overrides `bounds` and `hit`. Rays find it through the
/// same BVH as the built-in shapes. CompiledScene::closest_point throws ArgumentError if the scene has a user-defined
/// shape. Implementations are thread-safe, and immutable once they are added to a scene.
class Hittable {
public:
    virtual ~Hittable() = default;

    /// Returns a box around the object at all times from 0 to 1, always the same. A hit outside the box may be missed,
    /// so the box must be rounded outward. Its sides may be infinite.
    virtual Box bounds() const = 0;

    /// Returns the nearest hit with t in (t_min, t_max], or std::nullopt if there is none.
    ///
    /// - If several hits are equally near, it returns the one with the lowest element.
    /// - The function is pure. Every interval that contains this hit and no nearer one gives the same bits.
    /// - Shapes are closed sets: a ray hits them at a tangent, an edge or a vertex too.
    /// - An unusable ray (see is_usable) misses.
    /// - A shape that intersects other shapes passes them the ray itself or a copy of it (see Ray::frame).
    virtual std::optional<Hit> hit(const Ray& ray) const = 0;

    /// Writes the records of the object's primitives, in the order of its elements. The default writes one record of a
    /// user-defined shape: the compiled scene calls `hit`. A user-defined shape is a single element. It must leave
    /// Hit::element at 0.
    virtual void lower(RecordSink& sink) const;
};

/// The base of limn's own shapes. Its two functions give the same bits in every floating-point environment of the
/// calling thread: they set the one that the shapes' error bounds assume.
class BuiltInShape : public Hittable {
public:
    Box bounds() const final;
    std::optional<Hit> hit(const Ray& ray) const final;

private:
    virtual Box box() const = 0;                                     // computes the result of `bounds`
    virtual std::optional<Hit> intersect(const Ray& ray) const = 0;  // computes that of `hit`; \pre is_usable(ray)
};

}  // namespace limn
