#include "geometry/bvh/grid.h"

#include <algorithm>

#include "geometry/bvh/binning.h"
#include "geometry/bvh/subtree.h"
#include "math/parallel.h"

namespace limn::accel {

namespace {

constexpr int kMaxBits = 15;               // bits of a cell's number; the table of cells fits in the second-level cache
constexpr std::uint32_t kChunk = 1 << 18;  // primitives that share a table of cells; the tree doesn't depend on it
constexpr std::uint32_t kMaxChunks = 64;   // limits the memory of the tables
constexpr float kMinExtent = 0x1p-110f;    // the number of cells divided by this is finite
constexpr std::uint32_t kMinCells = 8;     // a range over fewer cells isn't split here; it gets a grid of its own

// A grid of 2^bits cells over the centres of a range. Cells are as close to cubes as powers of two allow.
class Grid {
public:
    Grid(const Range& range, int bits) : origin_(range.centers.lower), scale_{} {
        const Vec4 extent = range.centers.upper - origin_;
        float side[3] = {extent[0], extent[1], extent[2]};
        for (; bits > 0; --bits) {
            const auto longest = std::max_element(side, side + 3) - side;
            ++bits_[longest];
            side[longest] /= 2;
        }
        for (int a = 0; a < 3; ++a) {
            const auto cells = static_cast<float>(1 << bits_[a]);
            scale_[a] = extent[a] > kMinExtent ? cells / extent[a] : 0;
            last_[a] = cells - 1;
        }
    }

    std::uint32_t cell_of(const BuildPrimitive& p) const {
        const Int4 place = __builtin_convertvector(min((p.center() - origin_) * scale_, last_), Int4);
        return static_cast<std::uint32_t>(place[0] | place[1] << bits_[0] | place[2] << (bits_[0] + bits_[1]));
    }

private:
    int bits_[3] = {};
    Vec4 origin_, scale_, last_{};
};

// Consecutive primitives that one task counts and moves.
struct Chunk {
    std::uint32_t begin, end;
    std::vector<Bounds> bounds;        // bounds of the primitives of each cell
    std::vector<std::uint32_t> count;  // number of primitives of each cell; for the second pass it's replaced by the
                                       // row of the next primitive of each leaf
};

// Builds the tree over the cells that have primitives. A node is split if it has more than kSubtree primitives and
// enough cells.
struct CellTree {
    const BuildSettings& settings;
    std::deque<SplitNodes>& nodes;
    std::vector<std::uint32_t>& leaf_of_cell;
    std::uint32_t next;  // the first row of the next leaf
    std::vector<SplitNode*> leaves = {};

    void split(BuildPrimitive* cells, BuildPrimitive* spare, std::uint32_t begin, std::uint32_t end,
               std::uint32_t min_cells, SplitNode& node) {
        // Fill in the node.
        const Range range = range_over(cells, begin, end);
        node.box = range.bounds;
        node.begin = node.end = next;
        for (std::uint32_t i = begin; i < end; ++i) node.end += cells[i].weight();
        // Find the best split.
        Split best;
        if (node.size() > kSubtree && range.size() >= min_cells && may_split(node))
            best = best_split(cells, range, settings.leaf_width);
        // Make a leaf if there is none.
        if (!best.exists()) {
            for (std::uint32_t i = begin; i < end; ++i)
                leaf_of_cell[cells[i].index()] = static_cast<std::uint32_t>(leaves.size());
            leaves.push_back(&node);
            next = node.end;
            return;
        }
        // Split the cells.
        const std::uint32_t middle = partition(cells, spare, range, best);
        auto& [left, right] = add_children(node, nodes);
        split(spare, cells, begin, middle, kMinCells, left);
        split(spare, cells, middle, end, kMinCells, right);
    }
};

}  // namespace

bool has_extent(const Range& range) {
    const Vec4 extent = range.centers.upper - range.centers.lower;
    return std::max({extent[0], extent[1], extent[2]}) > kMinExtent;
}

std::vector<SplitNode*> split_by_grid(const BuildPrimitive* from, BuildPrimitive* to, const Range& range,
                                      const BuildSettings& settings, SplitNode& root, std::deque<SplitNodes>& nodes) {
    // Choose the grid.
    const int bits = std::clamp(static_cast<int>(std::bit_width(range.size())) - 2, 6, kMaxBits);
    const std::size_t cells = std::size_t{1} << bits;
    const Grid grid(range, bits);

    // First pass: count and bound the primitives of each cell, in parallel for each chunk.
    std::vector<Chunk> chunks(std::clamp(range.size() / kChunk, 1u, kMaxChunks));
    for_all(0, chunks.size(), 1, [&](std::size_t c) {
        Chunk& chunk = chunks[c];
        const auto bound = [&](std::size_t i) {
            return static_cast<std::uint32_t>(range.begin + std::uint64_t{range.size()} * i / chunks.size());
        };
        chunk.begin = bound(c);
        chunk.end = bound(c + 1);
        chunk.bounds.assign(cells, kEmpty);
        chunk.count.assign(cells, 0);
        for (std::uint32_t i = chunk.begin; i < chunk.end; ++i) {
            const std::uint32_t cell = grid.cell_of(from[i]);
            chunk.bounds[cell].extend(from[i]);
            ++chunk.count[cell];
        }
    });

    // Add up the chunks.
    std::vector<BuildPrimitive> filled;
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
        Bounds bounds = kEmpty;
        std::uint32_t count = 0;
        for (const Chunk& chunk : chunks) {
            bounds.extend(chunk.bounds[cell]);
            count += chunk.count[cell];
        }
        if (count > 0) filled.emplace_back(bounds, cell, count);
    }
    // Build the tree over the cells.
    std::vector<BuildPrimitive> spare(filled.size());
    std::vector<std::uint32_t> leaf_of_cell(cells, 0);
    CellTree tree{settings, nodes, leaf_of_cell, range.begin};
    tree.split(filled.data(), spare.data(), 0, static_cast<std::uint32_t>(filled.size()), 2, root);

    // Find the row of each chunk's first primitive in each leaf. Within a leaf primitives keep their order.
    std::vector<std::uint32_t> next;
    for (const SplitNode* leaf : tree.leaves) next.push_back(leaf->begin);
    for (Chunk& chunk : chunks) {
        std::vector<std::uint32_t> first = next;
        for (std::size_t cell = 0; cell < cells; ++cell) next[leaf_of_cell[cell]] += chunk.count[cell];
        chunk.count = std::move(first);
    }
    // Second pass: move the primitives, in parallel for each chunk.
    for_all(0, chunks.size(), 1, [&](std::size_t c) {
        Chunk& chunk = chunks[c];
        for (std::uint32_t i = chunk.begin; i < chunk.end; ++i)
            to[chunk.count[leaf_of_cell[grid.cell_of(from[i])]]++] = from[i];
    });
    return std::move(tree.leaves);
}

}  // namespace limn::accel
