#pragma once

#include <vector>

#include "accel/wide_bvh.h"
#include "compile/list.h"
#include "flat/scene.h"

namespace limn::compiler {

// Collects the primitives of one group, then builds the tree over them: the BLAS of an instance, or the scene's own.
class GroupTree {
public:
    explicit GroupTree(flat::Scene& scene) : scene_(scene) {}

    // `row` of Scene::ranges. The groups of instances are built already. \throws ArgumentError if there are too many
    void add(const PrimitiveRange& range, std::uint32_t row);

    // Sets the group's root, bounds, extent and scale; of the scene itself Scene::list, too.
    void finish(flat::Group& group);

private:
    void measure_mesh(const PrimitiveRange& range, std::size_t first);
    void list();
    double note_what_is_left();
    Candidate measure(const PrimitiveRange& range, const flat::Reference& reference) const;
    void scale_boxes(double scale);

    flat::Scene& scene_;
    // By the index that the tree knows a primitive by.
    std::vector<flat::Reference> references_;
    std::vector<accel::FloatBox> boxes_;
    std::vector<Candidate> others_;  // what is not in a mesh, its box not yet in float; empty where it is listed
    Box bounds_, mesh_bounds_;
    double extent_ = 0;  // the largest finite coordinate
};

}  // namespace limn::compiler
