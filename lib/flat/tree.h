// The tree that rays walk through: nodes of eight boxes, and leaves of blocks in which primitives are packed for SIMD.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "accel/node.h"
#include "limn/records.h"
#include "predicates/mesh_triangle.h"
#include "primitives/registry.h"

namespace limn::flat {

// Boxes are scaled by Blas::scale and rounded outward to float. A leaf is named by where its first block starts, in
// pairs of words.
using accel::Node, accel::Child, accel::kLeaf, accel::kNothing, accel::kWidth;

// The primitives of a leaf, or some of them, all of one kind. In words of 32 bits: this header; an id for each; rows of
// floats, one number for each primitive in a row; a word of padding if the sum is odd. SIMD reads past the end of a
// row, so kSlackWords follow the last block.
//
// mesh: id is the triangle, `range` the mesh's. Others: id is the row of Scene::references.
struct Block {
    PrimitiveKind kind;
    std::uint8_t count;
    bool last;  // of its leaf
    std::uint8_t unused;
    std::uint32_t range;
};
static_assert(sizeof(Block) == 8);

inline constexpr std::size_t kHeaderWords = sizeof(Block) / 4, kSlackWords = 16, kMaxBlock = 8;

// Rows of a kind: the three vertices of a triangle or of half a quad, x y z of each; a sphere's centre and radius, a
// moving one's two centres and radius; of others the box, as in a node.
inline constexpr std::size_t kBoxRows = 6, kMostRows = 9;
inline constexpr auto kRowsOf = [] {
    std::array<std::uint8_t, 32> rows;  // by kind
    rows.fill(kBoxRows);
    rows[static_cast<std::size_t>(PrimitiveKind::mesh)] = kMostRows;
    primitives::for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
        if constexpr (requires(Kind k) { k.pack(); })
            rows[static_cast<std::size_t>(Kind::kKind)] = std::tuple_size_v<decltype(std::declval<Kind>().pack())>;
    });
    return rows;
}();
constexpr std::size_t rows_of(PrimitiveKind kind) { return kRowsOf[static_cast<std::size_t>(kind)]; }

constexpr std::size_t words_of(PrimitiveKind kind, std::size_t count) {
    return (kHeaderWords + count * (1 + rows_of(kind)) + 1) / 2 * 2;
}

// Sets of kinds: a bit for each.
constexpr unsigned bit(PrimitiveKind kind) { return 1u << static_cast<unsigned>(kind); }

inline constexpr unsigned kPlanarKinds =
    bit(PrimitiveKind::triangle) | bit(PrimitiveKind::quad) | bit(PrimitiveKind::mesh);

// A block where it lies among the words.
struct BlockView {
    const std::uint32_t* words;

    // Part by part: the walk takes 2 to 5 instructions a ray less than by words, where there are shapes beside meshes.
    Block header() const {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(words);
        return {static_cast<PrimitiveKind>(bytes[offsetof(Block, kind)]), bytes[offsetof(Block, count)],
                bytes[offsetof(Block, last)] != 0, 0, words[1]};
    }
    std::uint32_t id(std::size_t i) const { return words[kHeaderWords + i]; }
    const std::uint32_t* rows(std::size_t count) const { return words + kHeaderWords + count; }
    // \pre count is the header's
    float number(std::size_t count, std::size_t row, std::size_t i) const {
        return std::bit_cast<float>(rows(count)[row * count + i]);
    }
};

// A triangle of a mesh.
inline TriangleVertices packed_triangle(const BlockView& block, std::size_t count, std::size_t i) {
    const auto vertex = [&](std::size_t row) {
        return Point3{block.number(count, row, i), block.number(count, row + 1, i), block.number(count, row + 2, i)};
    };
    return {vertex(0), vertex(3), vertex(6)};
}

}  // namespace limn::flat
