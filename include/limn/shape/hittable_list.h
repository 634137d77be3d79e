/// \file
/// Objects in a row.
#pragma once

#include <vector>

#include "limn/shape/hittable.h"

namespace limn {

/// Objects in a row. Elements are counted through: those of the first object, then those of the second, ...
class HittableList final : public Hittable {
public:
    HittableList() = default;  ///< empty: never hit
    /// \throws ArgumentError if an object is null
    explicit HittableList(std::vector<std::shared_ptr<const Hittable>> objects);
    /// Not thread-safe, and not once the list is in use. \throws ArgumentError if the object is null or the list itself
    void add(std::shared_ptr<const Hittable> object);

    Box bounds() const override { return bounds_; }
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    std::vector<std::shared_ptr<const Hittable>> objects_;
    std::vector<std::uint64_t> first_element_;
    std::uint64_t elements_ = 0;
    Box bounds_;
};

/// The number of primitives that `object` lowers to, which is the number of its elements.
std::uint64_t count_elements(const Hittable& object);

}  // namespace limn
