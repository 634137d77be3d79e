#include "limn/shape/bvh.h"

#include "accel/binary_bvh.h"
#include "core/float_environment.h"
#include "core/ray_frame.h"
#include "limn/shape/hittable_list.h"
#include "shape/arguments.h"

namespace limn {

struct Bvh::Tree {
    accel::BinaryBvh bvh;
};

Bvh::Bvh(std::vector<std::shared_ptr<const Hittable>> objects) : objects_(std::move(objects)) {
    const FloatEnvironment environment;
    std::vector<Box> boxes;
    std::uint64_t elements = 0;
    for (const auto& object : objects_) {
        require_not_null(object, "Bvh", "an object");
        boxes.push_back(object->bounds());
        first_element_.push_back(elements);
        elements += count_elements(*object);
    }
    tree_ = std::make_unique<const Tree>(Tree{accel::build_binary_bvh(boxes)});
}

Bvh::~Bvh() = default;

Box Bvh::bounds() const { return tree_->bvh.bounds(); }

std::optional<Hit> Bvh::hit(const Ray& ray) const {
    const FloatEnvironment environment;
    if (!is_usable(ray)) return std::nullopt;
    const RayFrame frame = frame_of(ray);
    const accel::SlabRay slab(ray, tree_->bvh.extent, frame.origin_error, frame.direction_error);
    std::optional<Hit> nearest;
    Ray rest = ray;
    accel::for_each_met(tree_->bvh, slab, ray.t_max, [&](std::uint32_t i) {
        std::optional<Hit> hit = objects_[i]->hit(rest);
        if (hit) {
            hit->element += first_element_[i];
            if (!nearest || hit->t < nearest->t || (hit->t == nearest->t && hit->element < nearest->element)) {
                rest.t_max = hit->t;
                nearest = hit;
            }
        }
        return rest.t_max;
    });
    return nearest;
}

void Bvh::lower(RecordSink& sink) const {
    for (const auto& object : objects_) object->lower(sink);
}

}  // namespace limn
