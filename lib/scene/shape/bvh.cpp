#include "limn/scene/shape/bvh.h"

#include "geometry/bvh/float_box.h"
#include "geometry/bvh/walk.h"
#include "geometry/ray_frame.h"
#include "limn/scene/shape/hittable_list.h"
#include "math/float_environment.h"
#include "scene/shape/arguments.h"

namespace limn {

namespace {

// A node has eight boxes to test. An object takes a virtual call, which costs about half as much.
constexpr accel::BuildSettings kSettings{.leaf_width = 1, .node_cost = 2};

}  // namespace

struct Bvh::Tree {
    Box bounds;
    double extent = 0;  // the largest finite coordinate
    double scale = 1;   // multiplies the coordinates of the boxes in `bvh`
    accel::WideBvh bvh;
};

Bvh::Bvh(std::vector<std::shared_ptr<const Hittable>> objects) : objects_(std::move(objects)) {
    const FloatEnvironment environment;
    Tree tree;
    std::vector<Box> boxes;
    std::uint64_t elements = 0;
    for (const auto& object : objects_) {
        require_not_null(object, "Bvh", "an object");
        const Box& box = boxes.emplace_back(object->bounds());
        if (!box.is_empty()) tree.bounds.extend(box);
        tree.extent = std::max(tree.extent, box.is_empty() ? 0 : accel::finite_extent(box));
        first_element_.push_back(elements);
        elements += count_elements(*object);
    }
    tree.scale = accel::scale_to_one(tree.extent);
    std::vector<accel::FloatBox> scaled;
    for (const Box& box : boxes) scaled.push_back(accel::to_float_box(box, tree.scale));
    tree.bvh = accel::build_wide_bvh(scaled, kSettings);
    tree_ = std::make_unique<const Tree>(std::move(tree));
}

Bvh::~Bvh() = default;

Box Bvh::box() const { return tree_->bounds; }

std::optional<Hit> Bvh::intersect(const Ray& ray) const {
    const RayFrame frame = frame_of(ray);
    const accel::SlabRay slab(ray, tree_->extent, frame.origin_error, frame.direction_error);
    std::optional<Hit> nearest;
    Ray rest = ray;
    accel::for_each_met(tree_->bvh, tree_->scale, slab, ray.t_max, [&](std::uint32_t i) {
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
