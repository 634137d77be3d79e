// The tree that rays traverse: nodes of eight boxes, and leaves made of blocks, in which primitives are packed for
// SIMD.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/bvh/node.h"
#include "geometry/mesh_triangle.h"
#include "geometry/registry.h"
#include "limn/records/records.h"

namespace limn::flat {

// Boxes are multiplied by Blas::scale and rounded outward to float. The Child of a leaf is kLeaf | the place of its
// first block in Scene::blocks, in pairs of words.
using accel::Node, accel::Child, accel::kLeaf, accel::kNothing, accel::kWidth;

// The header of a block. A block has up to kMaxBlock primitives of a leaf, all of one kind. It consists of 32-bit
// words:
// - this header
// - an id for each primitive: the triangle of a mesh, or a row of Scene::references for other kinds
// - rows of floats, with one number for each primitive in a row
// - a word of padding if the number of words is odd
// SIMD loads read past the end of a row, so kSlackWords follow the last block.
struct Block {
    PrimitiveKind kind;
    std::uint8_t count;
    bool last;  // true for the last block of its leaf
    std::uint8_t unused;
    std::uint32_t range;  // row of Scene::ranges; used for meshes
};
static_assert(sizeof(Block) == 8);

inline constexpr std::size_t kHeaderWords = sizeof(Block) / 4, kSlackWords = 16, kMaxBlock = 8;

// The number of rows of each kind. The rows hold:
// - x y z of the three vertices of a triangle, or of three corners of a quad
// - the centre and radius of a sphere; both centres and the radius of a moving sphere
// - the box of any other primitive, as in a node
inline constexpr std::size_t kBoxRows = 6, kMostRows = 9;
inline constexpr auto kRowsOf = [] {
    std::array<std::uint8_t, 32> rows;  // indexed by kind
    rows.fill(kBoxRows);
    rows[static_cast<std::size_t>(PrimitiveKind::mesh)] = kMostRows;
    primitives::for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
        if constexpr (requires(Kind k) { k.pack(); })
            rows[static_cast<std::size_t>(Kind::kKind)] = std::tuple_size_v<decltype(std::declval<Kind>().pack())>;
    });
    return rows;
}();
constexpr std::size_t rows_of(PrimitiveKind kind) { return kRowsOf[static_cast<std::size_t>(kind)]; }

// Returns the number of words of a block with `count` primitives.
constexpr std::size_t words_of(PrimitiveKind kind, std::size_t count) {
    return (kHeaderWords + count * (1 + rows_of(kind)) + 1) / 2 * 2;
}

// Returns the bit of a kind in a set of kinds.
constexpr unsigned bit(PrimitiveKind kind) { return 1u << static_cast<unsigned>(kind); }

inline constexpr unsigned kPlanarKinds =
    bit(PrimitiveKind::triangle) | bit(PrimitiveKind::quad) | bit(PrimitiveKind::mesh);

// Gives access to a block in Scene::blocks.
struct BlockView {
    const std::uint32_t* words;

    // Reads the header field by field. In scenes with shapes beside meshes, this saves 2 to 5 instructions a ray
    // compared with reading words.
    Block header() const {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(words);
        return {static_cast<PrimitiveKind>(bytes[offsetof(Block, kind)]), bytes[offsetof(Block, count)],
                bytes[offsetof(Block, last)] != 0, 0, words[1]};
    }
    std::uint32_t id(std::size_t i) const { return words[kHeaderWords + i]; }
    const std::uint32_t* rows(std::size_t count) const { return words + kHeaderWords + count; }
    // Returns a number of primitive i. \pre `count` is that of the header
    float number(std::size_t count, std::size_t row, std::size_t i) const {
        return std::bit_cast<float>(rows(count)[row * count + i]);
    }
};

// Returns triangle i of a block of a mesh. \pre `count` is that of the header
inline TriangleVertices packed_triangle(const BlockView& block, std::size_t count, std::size_t i) {
    const auto vertex = [&](std::size_t row) {
        return Point3{block.number(count, row, i), block.number(count, row + 1, i), block.number(count, row + 2, i)};
    };
    return {vertex(0), vertex(3), vertex(6)};
}

}  // namespace limn::flat
