#include "flat/pack.h"

#include <algorithm>
#include <array>
#include <bit>

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
        for_all(0, bvh_.leaves.size(), kGrain, [&](std::size_t i) { sort_by_kind(bvh_.leaves[i]); });
        place_leaves();
        for_all(0, bvh_.leaves.size(), kGrain, [&](std::size_t i) { write_leaf(bvh_.leaves[i], places_[i]); });
        const bool is_lone = bvh_.nodes.size() == 1 && bvh_.nodes[0].child[1] == flat::kNothing;
        return is_lone ? leaf_at(0) : append_nodes();
    }

private:
    static constexpr std::size_t kGrain = 1024;  // nodes or leaves of one task

    // The place of a leaf in the tables.
    struct Place {
        std::size_t word;         // first word in Scene::blocks
        std::uint32_t reference;  // first row of Scene::references
    };

    // Returns the range of the primitive with the given index in the tree.
    const PrimitiveRange& range_of(std::uint32_t index) const { return scene_.ranges[references_[index].range]; }

    void sort_by_kind(const accel::Leaf& leaf) {
        const auto kind_of = [&](std::uint32_t index) { return range_of(index).kind; };
        const std::span indices = std::span(bvh_.indices).subspan(leaf.first, leaf.count);
        if (std::ranges::is_sorted(indices, {}, kind_of)) return;
        std::ranges::sort(indices, {}, [&](std::uint32_t index) { return std::pair(kind_of(index), index); });
    }

    // Returns the number of primitives of the block that begins at row `first` of the indices. `last` is the end of the
    // leaf.
    std::uint32_t block_size(std::uint32_t first, std::uint32_t last) const {
        const flat::Reference& reference = references_[bvh_.indices[first]];
        const PrimitiveKind kind = range_of(bvh_.indices[first]).kind;
        std::uint32_t end = first + 1;
        while (end < last && end - first < flat::kMaxBlock) {
            const flat::Reference& next = references_[bvh_.indices[end]];
            const bool same =
                kind == PrimitiveKind::mesh ? next.range == reference.range : scene_.ranges[next.range].kind == kind;
            if (!same) break;
            ++end;
        }
        return end - first;
    }

    // Calls visit(first row of the indices, count, kind) for each block of a leaf.
    template <class Visit>
    void for_each_block(const accel::Leaf& leaf, const Visit& visit) const {
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count;) {
            const std::uint32_t count = block_size(i, leaf.first + leaf.count);
            visit(i, count, range_of(bvh_.indices[i]).kind);
            i += count;
        }
    }

    // Sets the place of each leaf and enlarges the tables.
    void place_leaves() {
        std::size_t end = scene_.blocks.size(), references = scene_.references.size();
        if (end > 0) end -= flat::kSlackWords;
        places_.reserve(bvh_.leaves.size());
        for (const accel::Leaf& leaf : bvh_.leaves) {
            places_.push_back({end, static_cast<std::uint32_t>(references)});
            for_each_block(leaf, [&](std::uint32_t, std::uint32_t count, PrimitiveKind kind) {
                end += flat::words_of(kind, count);
                if (kind != PrimitiveKind::mesh) references += count;
            });
        }
        if (end / 2 >= flat::kLeaf || references >= flat::kNothing) throw ArgumentError("scene: too many primitives");
        scene_.blocks.resize(end + flat::kSlackWords);
        scene_.references.resize(references);
    }

    // Writes the blocks and references of a leaf.
    void write_leaf(const accel::Leaf& leaf, Place place) {
        std::size_t at = place.word;
        std::uint32_t reference = place.reference;
        for_each_block(leaf, [&](std::uint32_t first, std::uint32_t count, PrimitiveKind kind) {
            // Write the header.
            std::uint32_t* words = scene_.blocks.data() + at;
            const flat::Block header{kind, static_cast<std::uint8_t>(count), first + count == leaf.first + leaf.count,
                                     0, references_[bvh_.indices[first]].range};
            const auto head = std::bit_cast<std::array<std::uint32_t, 2>>(header);
            words[0] = head[0];
            words[1] = head[1];
            // Write the id and the rows of each primitive. Kinds without rows of their own have their box.
            std::uint32_t* ids = words + flat::kHeaderWords;
            const std::size_t row_count = flat::rows_of(kind);
            for (std::uint32_t i = 0; i < count; ++i) {
                const flat::Reference& r = references_[bvh_.indices[first + i]];
                ids[i] = kind == PrimitiveKind::mesh ? r.element : reference;
                if (kind != PrimitiveKind::mesh) scene_.references[reference++] = r;
                const accel::FloatBox& box = boxes_[bvh_.indices[first + i]];
                std::array<float, flat::kMostRows> rows{box.lower[0], box.lower[1], box.lower[2],
                                                        box.upper[0], box.upper[1], box.upper[2]};
                flat::with_primitive(scene_, scene_.ranges[r.range], r.element, [&](const auto& primitive) {
                    if constexpr (requires { primitive.pack(); }) std::ranges::copy(primitive.pack(), rows.begin());
                });
                for (std::size_t row = 0; row < row_count; ++row)
                    ids[count + row * count + i] = std::bit_cast<std::uint32_t>(rows[row]);
            }
            if (kind == PrimitiveKind::mesh) note_places(header.range, ids, count, at);
            at += flat::words_of(kind, count);
        });
    }

    // Writes the places of the triangles of a block to their mesh. Each triangle is in one leaf, so no two threads
    // write the same place.
    void note_places(std::uint32_t range, const std::uint32_t* ids, std::uint32_t count, std::size_t at) {
        std::vector<std::uint32_t>& places = scene_.meshes[scene_.ranges[range].first_row].places;
        for (std::uint32_t i = 0; i < count && !places.empty(); ++i)
            places[ids[i]] = static_cast<std::uint32_t>(at / 2 * flat::kMaxBlock + i);
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
                child = is_leaf ? leaf_at(child & ~flat::kLeaf) : root + child;
            }
        });
        return root;
    }

    flat::Child leaf_at(std::size_t row) const { return flat::kLeaf | static_cast<flat::Child>(places_[row].word / 2); }

    accel::WideBvh& bvh_;
    std::span<const accel::FloatBox> boxes_;
    std::span<const flat::Reference> references_;
    flat::Scene& scene_;
    std::vector<Place> places_;  // places of the leaves
};

}  // namespace

flat::Child pack_tree(accel::WideBvh bvh, std::span<const accel::FloatBox> boxes,
                      std::span<const flat::Reference> references, flat::Scene& scene) {
    return Packer(bvh, boxes, references, scene).pack();
}

}  // namespace limn::compiler
