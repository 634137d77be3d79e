#include "flat/pack.h"

#include <algorithm>
#include <array>
#include <bit>

#include "geometry/bvh/collapse.h"
#include "geometry/bvh/float_box.h"
#include "geometry/mesh_triangle.h"
#include "limn/math/error.h"
#include "math/parallel.h"

namespace limn::compiler {

namespace {

// Packs one tree.
class Packer {
public:
    Packer(accel::WideBvh& bvh, std::span<const accel::FloatBox> boxes, std::span<const flat::Reference> references,
           flat::Scene& scene)
        : bvh_(bvh), boxes_(boxes), references_(references), scene_(scene) {}

    flat::Child pack() {
        if (bvh_.nodes.empty()) return flat::kNothing;
        const bool is_lone = bvh_.nodes.size() == 1 && bvh_.nodes[0].child[1] == flat::kNothing;
        first_leaf_node_ = scene_.nodes.size() + (is_lone ? 0 : bvh_.nodes.size());
        for_all(0, bvh_.leaves.size(), kGrain, [&](std::size_t i) { sort_by_form(bvh_.leaves[i]); });
        place_leaves();
        for_all(0, bvh_.leaves.size(), kGrain, [&](std::size_t i) { write_leaf(bvh_.leaves[i], places_[i]); });
        if (!is_lone) return append_nodes();
        scene_.nodes.insert(scene_.nodes.end(), leaf_nodes_.begin(), leaf_nodes_.end());
        return places_[0].child;
    }

private:
    static constexpr std::size_t kGrain = 1024;  // nodes or leaves of one task

    // The place of a leaf in the tables.
    struct Place {
        flat::Child child;        // the block; if there are several, the node whose children are the blocks
        std::size_t line;         // first row of Scene::lines
        std::uint32_t reference;  // first row of Scene::references
    };
    // Primitives of one block: `count` entries of the indices from `first` on.
    struct Block {
        std::uint32_t first, count;
        flat::Form form;
    };

    // Returns the range of the primitive with the given index in the tree.
    const PrimitiveRange& range_of(std::uint32_t index) const { return scene_.ranges[references_[index].range]; }

    // Returns the indices of the primitives of a leaf or block.
    std::span<std::uint32_t> indices_of(const auto& part) const {
        return std::span(bvh_.indices).subspan(part.first, part.count);
    }

    // Returns the form of a primitive in a leaf. Beside moving spheres, a still sphere is packed like them.
    flat::Form form_in(const accel::Leaf& leaf, std::uint32_t index) const {
        const flat::Form form = flat::form_of(range_of(index).kind);
        if (form != flat::Form::spheres) return form;
        const bool moves = std::ranges::any_of(
            indices_of(leaf), [&](std::uint32_t i) { return range_of(i).kind == PrimitiveKind::moving_sphere; });
        return moves ? flat::Form::moving_spheres : form;
    }

    void sort_by_form(const accel::Leaf& leaf) {
        const auto key = [&](std::uint32_t index) { return std::pair(form_in(leaf, index), index); };
        if (!std::ranges::is_sorted(indices_of(leaf), {}, key)) std::ranges::sort(indices_of(leaf), {}, key);
    }

    // Calls visit(block) for each block of a leaf.
    template <class Visit>
    void for_each_block(const accel::Leaf& leaf, const Visit& visit) const {
        for (std::uint32_t i = leaf.first, end = leaf.first + leaf.count; i < end;) {
            Block block{i, 0, form_in(leaf, bvh_.indices[i])};
            while (i < end && form_in(leaf, bvh_.indices[i]) == block.form) ++i;
            block.count = i - block.first;
            visit(block);
        }
    }

    std::uint64_t number_of(std::uint32_t index) const {
        return range_of(index).first_number + references_[index].element;
    }
    // Returns true if a primitive's id is a row of Scene::references.
    bool has_reference(std::uint32_t index) const {
        return range_of(index).kind != PrimitiveKind::mesh || number_of(index) >= flat::kReference;
    }

    // Sets the place of each leaf and enlarges the tables.
    void place_leaves() {
        std::size_t end = scene_.lines.size(), references = scene_.references.size();
        std::size_t nodes = first_leaf_node_;
        places_.reserve(bvh_.leaves.size());
        for (const accel::Leaf& leaf : bvh_.leaves) {
            Place place{flat::kNothing, end, static_cast<std::uint32_t>(references)};
            std::size_t blocks = 0;
            for_each_block(leaf, [&](const Block& block) {
                place.child = flat::leaf_child(block.form, end);
                end += flat::lines_of(block.form);
                ++blocks;
            });
            for (const std::uint32_t index : indices_of(leaf)) references += has_reference(index) ? 1 : 0;
            if (blocks > 1) place.child = static_cast<flat::Child>(nodes++);
            places_.push_back(place);
        }
        if (end > flat::kPlaceMask || references > flat::kReference) throw ArgumentError("scene: too many primitives");
        scene_.lines.resize(end);
        scene_.references.resize(references);
        leaf_nodes_.resize(nodes - first_leaf_node_);
    }

    // Writes the blocks and references of a leaf. Several blocks get a node.
    void write_leaf(const accel::Leaf& leaf, Place place) {
        std::array<accel::SplitNode, flat::kForms> blocks;
        std::array<flat::Child, flat::kForms> children;
        accel::Slots slots;
        const flat::Child child = place.child;
        for_each_block(leaf, [&](const Block& block) {
            write_block(block, place);
            accel::SplitNode& above = blocks[slots.count];
            for (const std::uint32_t index : indices_of(block)) above.box.extend(accel::to_bounds(boxes_[index]));
            children[slots.count] = flat::leaf_child(block.form, place.line);
            slots.node[slots.count++] = &above;
            place.line += flat::lines_of(block.form);
        });
        if ((child & flat::kLeaf) != 0) return;
        flat::Node& node = leaf_nodes_[child - first_leaf_node_] = accel::node_over(slots);
        std::copy_n(children.begin(), slots.count, node.child);
    }

    // Writes a block to place.line, and its references from place.reference on.
    void write_block(const Block& block, Place& place) {
        float* const out = scene_.lines[place.line].rows[0];
        const std::size_t row_count = flat::kRowsOf[static_cast<std::size_t>(block.form)];
        for (std::uint32_t i = 0; i < flat::kMaxBlock; ++i) {
            const bool is_copy = i >= block.count;
            const std::uint32_t index = bvh_.indices[block.first + (is_copy ? block.count - 1 : i)];
            const std::array<float, flat::kMostRows> rows = rows_of(index, block.form);
            for (std::size_t row = 0; row < row_count; ++row) out[row * flat::kWidth + i] = rows[row];
            out[row_count * flat::kWidth + i] = std::bit_cast<float>(is_copy ? flat::kNothing : id_of(index, place));
            if (!is_copy) note_place(index, place.line * flat::kMaxBlock + i);
        }
    }

    // Returns the rows of a primitive. Kinds without rows of their own have their box.
    std::array<float, flat::kMostRows> rows_of(std::uint32_t index, flat::Form form) const {
        const accel::FloatBox& box = boxes_[index];
        std::array<float, flat::kMostRows> rows{box.lower[0], box.lower[1], box.lower[2],
                                                box.upper[0], box.upper[1], box.upper[2]};
        const auto put = [&]<class Kind>(const Kind& primitive) {
            if constexpr (requires { primitive.pack(); }) {
                const auto packed = primitive.pack();
                auto end = std::ranges::copy(packed, rows.begin()).out;
                // A still sphere beside moving ones has its centre twice.
                if constexpr (Kind::kKind == PrimitiveKind::sphere)
                    if (form == flat::Form::moving_spheres)
                        end = std::copy(packed.begin(), packed.end(), rows.begin() + 3);
                if constexpr ((flat::bit(Kind::kKind) & flat::kRoundKinds) != 0)
                    *end = accel::round_up(4 * primitive.packed_error());
            }
        };
        flat::with_primitive(scene_, range_of(index), references_[index].element, put);
        return rows;
    }

    // Returns the id of a primitive. If it needs a reference, takes the next one.
    std::uint32_t id_of(std::uint32_t index, Place& place) {
        if (!has_reference(index)) return static_cast<std::uint32_t>(number_of(index));
        scene_.references[place.reference] = references_[index];
        return flat::kReference | place.reference++;
    }

    // Stores the place of a triangle in its mesh. Each triangle is in one leaf, so no two threads write the same place.
    void note_place(std::uint32_t index, std::size_t place) {
        if (range_of(index).kind != PrimitiveKind::mesh) return;
        std::vector<std::uint32_t>& places = scene_.meshes[range_of(index).first_row].places;
        if (!places.empty()) places[references_[index].element] = static_cast<std::uint32_t>(place);
    }

    // Appends the nodes to the scene and makes their references absolute. Returns the root.
    flat::Child append_nodes() {
        const auto root = static_cast<flat::Child>(scene_.nodes.size());
        if (root == 0)
            scene_.nodes = std::move(bvh_.nodes);
        else
            scene_.nodes.insert(scene_.nodes.end(), bvh_.nodes.begin(), bvh_.nodes.end());
        for_all(root, scene_.nodes.size(), kGrain, [&](std::size_t i) {
            for (flat::Child& child : scene_.nodes[i].child) {
                if (child == flat::kNothing) continue;
                const bool is_leaf = (child & flat::kLeaf) != 0;
                child = is_leaf ? places_[child & ~flat::kLeaf].child : root + child;
            }
        });
        scene_.nodes.insert(scene_.nodes.end(), leaf_nodes_.begin(), leaf_nodes_.end());
        return root;
    }

    accel::WideBvh& bvh_;
    std::span<const accel::FloatBox> boxes_;
    std::span<const flat::Reference> references_;
    flat::Scene& scene_;
    std::vector<Place> places_;           // places of the leaves
    std::vector<flat::Node> leaf_nodes_;  // nodes of leaves with several blocks
    std::size_t first_leaf_node_ = 0;     // row of Scene::nodes of the first of these
};

}  // namespace

flat::Child pack_tree(accel::WideBvh bvh, std::span<const accel::FloatBox> boxes,
                      std::span<const flat::Reference> references, flat::Scene& scene) {
    return Packer(bvh, boxes, references, scene).pack();
}

}  // namespace limn::compiler
