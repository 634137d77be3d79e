/// \file
/// Many described objects, traced fast.
#pragma once

#include <memory>
#include <vector>

#include "limn/shape/hittable.h"

namespace limn {

/// A bounding volume hierarchy over objects: the same hits as a HittableList of them, faster. The compiled scene builds
/// its own hierarchy over all primitives, so this one is for those who trace described objects.
class Bvh final : public Hittable {
public:
    /// \throws ArgumentError if an object is null
    explicit Bvh(std::vector<std::shared_ptr<const Hittable>> objects);
    ~Bvh() override;
    Box bounds() const override;
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    struct Tree;
    std::vector<std::shared_ptr<const Hittable>> objects_;
    std::vector<std::uint64_t> first_element_;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace limn
