#include "limn/scene/shape/hittable_list.h"

#include "math/float_environment.h"
#include "scene/shape/arguments.h"

namespace limn {

HittableList::HittableList(std::vector<std::shared_ptr<const Hittable>> objects) {
    for (auto& object : objects) add(std::move(object));
}

void HittableList::add(std::shared_ptr<const Hittable> object) {
    const FloatEnvironment environment;
    require_not_null(object, "HittableList", "an object");
    if (object.get() == this) throw ArgumentError("HittableList: a list cannot contain itself");
    first_element_.push_back(elements_);
    elements_ += count_elements(*object);
    bounds_.extend(object->bounds());
    objects_.push_back(std::move(object));
}

std::optional<Hit> HittableList::intersect(const Ray& ray) const {
    std::optional<Hit> nearest;
    Ray rest = ray;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        std::optional<Hit> hit = objects_[i]->hit(rest);
        if (!hit || (nearest && hit->t >= nearest->t)) continue;
        hit->element += first_element_[i];
        rest.t_max = hit->t;
        nearest = hit;
    }
    return nearest;
}

void HittableList::lower(RecordSink& sink) const {
    sink.enter(this);
    for (const auto& object : objects_) object->lower(sink);
    sink.leave(this);
}

std::uint64_t count_elements(const Hittable& object) {
    RecordSink sink;
    object.lower(sink);
    return sink.primitives();
}

}  // namespace limn
