/// \file
/// Lists of objects.
#pragma once

#include <vector>

#include "limn/scene/shape/hittable.h"

namespace limn {

/// A list of objects that is an object itself. Its elements are numbered consecutively: those of the first object, then
/// those of the second, and so on.
class HittableList final : public BuiltInShape {
public:
    HittableList() = default;  ///< makes an empty list, which no ray hits
    /// \throws ArgumentError if an object is null
    explicit HittableList(std::vector<std::shared_ptr<const Hittable>> objects);
    /// Adds an object at the end. Not thread-safe. Must not be called once the list is in a scene or in another object.
    ///
    /// \throws ArgumentError if the object is null or the list itself
    void add(std::shared_ptr<const Hittable> object);

    void lower(RecordSink& sink) const override;

private:
    Box box() const override { return bounds_; }
    std::optional<Hit> intersect(const Ray& ray) const override;

    std::vector<std::shared_ptr<const Hittable>> objects_;
    std::vector<std::uint64_t> first_element_;
    std::uint64_t elements_ = 0;
    Box bounds_;
};

/// Returns the number of elements of `object`: the number of primitives that Hittable::lower writes.
std::uint64_t count_elements(const Hittable& object);

}  // namespace limn
