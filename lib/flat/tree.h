// The tree that rays traverse: nodes of eight boxes, and leaves made of blocks, in which primitives are packed for
// SIMD.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/bvh/node.h"
#include "geometry/bvh/wide_bvh.h"
#include "geometry/mesh_triangle.h"
#include "geometry/registry.h"
#include "limn/records/records.h"

namespace limn::flat {

// Boxes are multiplied by Blas::scale and rounded outward to float. The Child of a leaf is the sum of
// - kLeaf
// - the form of its block, shifted left by kFormShift
// - the place of its block: its first row of Scene::lines.
using accel::Node, accel::Child, accel::kLeaf, accel::kNothing, accel::kWidth;

// The forms in which primitives are packed into blocks, and the rows of floats of each:
// - triangles and quads: the x y z of three vertices or corners
// - spheres: the centre, the radius, and four times the error of packing the centre
// - moving spheres: both centres, the radius and that error; a still sphere may be packed like that
// - any other primitive: its box, as in a node
enum class Form : std::uint32_t { triangles, quads, spheres, moving_spheres, boxes };
inline constexpr std::size_t kForms = 5, kMostRows = 9;
inline constexpr std::array<std::uint32_t, kForms> kRowsOf{9, 9, 5, 8, 6};

constexpr Form form_of(PrimitiveKind kind) {
    switch (kind) {
        case PrimitiveKind::mesh:
        case PrimitiveKind::triangle: return Form::triangles;
        case PrimitiveKind::quad: return Form::quads;
        case PrimitiveKind::sphere: return Form::spheres;
        case PrimitiveKind::moving_sphere: return Form::moving_spheres;
        default: return Form::boxes;
    }
}

// 64 bytes of a block: two of its rows. A block has up to kMaxBlock primitives of one form. It consists of rows with a
// number for each primitive:
// - the rows of floats of its form
// - a row of ids
// - a row of padding if the number of rows is odd
// An id is the number of a mesh's triangle in its BLAS. All other primitives, and triangles whose number is too large,
// have kReference | a row of Scene::references. A block with fewer primitives repeats the last one; the ids of these
// copies are kNothing.
struct alignas(64) Line {
    float rows[2][kWidth];  // ids are stored by their bits
};
inline constexpr std::size_t kMaxBlock = kWidth;
inline constexpr std::uint32_t kReference = 0x40000000u;

inline constexpr unsigned kFormShift = 28;
inline constexpr Child kPlaceMask = (Child{1} << kFormShift) - 1;
constexpr Form form_of(Child leaf) { return static_cast<Form>(leaf >> kFormShift & 7); }
constexpr Child leaf_child(Form form, std::size_t place) {
    return kLeaf | static_cast<Child>(form) << kFormShift | static_cast<Child>(place);
}

// Returns the number of lines of a block.
constexpr std::size_t lines_of(Form form) { return (kRowsOf[static_cast<std::size_t>(form)] + 2) / 2; }

// The most entries of a stack of children: a visit of a node pushes at most 7, and a whole vector is written. The
// blocks of a leaf with several forms add a level (pack.cpp).
inline constexpr std::size_t kMaxStack = (accel::kMaxWideDepth + 1) * (kWidth - 1) + kWidth;

// Returns the bit of a kind in a set of kinds.
constexpr unsigned bit(PrimitiveKind kind) { return 1u << static_cast<unsigned>(kind); }

inline constexpr unsigned kPlanarKinds =
    bit(PrimitiveKind::triangle) | bit(PrimitiveKind::quad) | bit(PrimitiveKind::mesh);

inline constexpr unsigned kRoundKinds = bit(PrimitiveKind::sphere) | bit(PrimitiveKind::moving_sphere);

// Returns the set of the forms of a set of kinds: bit i is Form i.
constexpr unsigned forms_of(unsigned kinds) {
    unsigned forms = 0;
    for (unsigned kind = 0; kind < 32; ++kind)
        if ((kinds >> kind & 1) != 0) forms |= 1u << static_cast<unsigned>(form_of(static_cast<PrimitiveKind>(kind)));
    return forms;
}

// Gives access to a block.
struct BlockView {
    const float* rows;

    explicit BlockView(const Line* first) : rows(first->rows[0]) {}

    const float* row(std::size_t r) const { return rows + kWidth * r; }
    const float* ids(Form form) const { return row(kRowsOf[static_cast<std::size_t>(form)]); }
    std::uint32_t id(Form form, std::size_t i) const { return std::bit_cast<std::uint32_t>(ids(form)[i]); }
    // Returns the number of primitives.
    std::size_t count(Form form) const {
        std::size_t n = kMaxBlock;
        while (id(form, n - 1) == kNothing) --n;
        return n;
    }
    // Returns triangle i. \pre the form is `triangles`
    TriangleVertices triangle(std::size_t i) const {
        const auto vertex = [&](std::size_t r) { return Point3{row(r)[i], row(r + 1)[i], row(r + 2)[i]}; };
        return {vertex(0), vertex(3), vertex(6)};
    }
};

}  // namespace limn::flat
