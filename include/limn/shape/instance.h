/// \file
/// Objects placed, turned, scaled, moving.
#pragma once

#include "limn/core/transform.h"
#include "limn/shape/hittable.h"

namespace limn {

/// An object seen through an affine transform, still or moving between two. The matrices are interpolated entry by
/// entry over the shutter. t, u, v and element are the object's own: the direction is not normalised.
/// Instances nest. A mirroring transform keeps outside outside.
class Instance final : public Hittable {
public:
    /// \throws ArgumentError if the object is null, a matrix is not finite, or it is singular at some time of the
    /// shutter
    ///@{
    Instance(std::shared_ptr<const Hittable> object, const Transform& world_from_object);
    Instance(std::shared_ptr<const Hittable> object, const Transform& at_time0, const Transform& at_time1);
    ///@}
    Box bounds() const override;
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Hittable> object_;
    Transform world_from_object0_, world_from_object1_;
    bool moving_;
};

}  // namespace limn
