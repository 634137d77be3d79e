/// \file
/// A bounding volume hierarchy over objects.
#pragma once

#include <memory>
#include <vector>

#include "limn/scene/shape/hittable.h"

namespace limn {

/// A bounding volume hierarchy over objects. It returns the same hits as a HittableList of the objects, faster. It is
/// useful only if you call `hit` yourself: compile() builds a hierarchy of its own over all primitives.
class Bvh final : public BuiltInShape {
public:
    /// \throws ArgumentError if an object is null
    explicit Bvh(std::vector<std::shared_ptr<const Hittable>> objects);
    ~Bvh() override;
    void lower(RecordSink& sink) const override;

private:
    Box box() const override;
    std::optional<Hit> intersect(const Ray& ray) const override;

    struct Tree;
    std::vector<std::shared_ptr<const Hittable>> objects_;
    std::vector<std::uint64_t> first_element_;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace limn
