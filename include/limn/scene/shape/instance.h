/// \file
/// Instances of objects.
#pragma once

#include "limn/math/transform.h"
#include "limn/scene/shape/hittable.h"

namespace limn {

/// An object placed by an affine transform. A moving instance has two matrices, which are interpolated entry by entry
/// from time 0 to time 1.
///
/// - Hit::t, Hit::u, Hit::v and Hit::element are those of the object. The direction of the ray isn't normalised in the
///   space of the object, so t is the same in both spaces.
/// - The outside of the object stays outside if the transform is a reflection.
/// - Instances nest. compile() throws ArgumentError if they nest deeper than 16.
class Instance final : public BuiltInShape {
public:
    /// \throws ArgumentError if the object is null, a matrix is not finite, or the matrix is singular at some time from
    /// 0 to 1
    ///@{
    Instance(std::shared_ptr<const Hittable> object, const Transform& world_from_object);
    Instance(std::shared_ptr<const Hittable> object, const Transform& at_time0, const Transform& at_time1);
    ///@}
    void lower(RecordSink& sink) const override;

private:
    Box box() const override;
    std::optional<Hit> intersect(const Ray& ray) const override;

    std::shared_ptr<const Hittable> object_;
    Transform world_from_object0_, world_from_object1_;
    bool moving_;
};

}  // namespace limn
