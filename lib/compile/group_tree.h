#pragma once

#include <vector>

#include "accel/wide_bvh.h"
#include "compile/list.h"
#include "flat/scene.h"

namespace limn::compiler {

// Collects the primitives of one group, then builds the tree over them.
class GroupTree {
public:
    explicit GroupTree(flat::Scene& scene) : scene_(scene) {}

    // `row` of Scene::ranges. The groups of instances are built already. \throws ArgumentError if there are too many
    void add(const PrimitiveRange& range, std::uint32_t row);

    // Sets the group's root, bounds, extent and scale; of the scene itself Scene::list, too.
    void finish(flat::Group& group, bool cut_triangles);

private:
    // The boxes of a range, from boxes_[first] on.
    struct Part {
        PrimitiveRange range;
        std::size_t first = 0, count = 0;
    };

    void measure_mesh(const Part& part);
    void list();
    void note_what_is_left();
    Box bounds_of(const PrimitiveRange& range, std::uint32_t element) const;
    double packed_error_of(const PrimitiveRange& range, std::uint32_t element) const;
    void scale_boxes(double scale);

    flat::Scene& scene_;
    std::vector<Part> parts_;
    std::vector<flat::Reference> references_;
    std::vector<accel::FloatBox> boxes_;
    std::vector<Candidate> others_;  // what is not in a mesh, its box not yet in float; empty where it is listed
    Box bounds_, mesh_bounds_;
    double extent_ = 0;  // the largest finite coordinate
    double packed_error_ = 0;
};

}  // namespace limn::compiler
