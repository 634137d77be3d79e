#include "geometry/bvh/gather.h"

#include <algorithm>

#include "math/parallel.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kChunk = 1 << 15;  // primitives of one task; the tree doesn't depend on it
constexpr float kBounded = 0x1p125f;       // largest coordinate of a bounded box; the sum of two is finite

// Divides [begin, end) into chunks. Their bounds are still empty.
std::vector<Range> chunks_of(std::uint32_t begin, std::uint32_t end) {
    std::vector<Range> chunks;
    for (; begin < end; begin += kChunk) chunks.push_back({begin, std::min(begin + kChunk, end)});
    return chunks;
}

// Writes the build primitives of the chunk's bounded boxes to `primitives`, from chunk.begin on. Appends the indices of
// its unbounded boxes to `unbounded`. Returns the range that was written.
Range fill(std::span<const FloatBox> boxes, const Range& chunk, BuildPrimitive* primitives,
           std::vector<std::uint32_t>& unbounded) {
    const auto everywhere = [](Int4 test) { return (test[0] & test[1] & test[2]) != 0; };
    Range range;  // a local copy, which the compiler keeps in registers
    std::uint32_t at = chunk.begin;
    for (std::uint32_t i = chunk.begin; i < chunk.end; ++i) {
        const Bounds bounds = to_bounds(boxes[i]);
        const Int4 some = bounds.lower <= bounds.upper;
        if (!everywhere(some & (bounds.lower >= splat(-kBounded)) & (bounds.upper <= splat(kBounded)))) {
            if (everywhere(some)) unbounded.push_back(i);
            continue;
        }
        const BuildPrimitive p(bounds, i);
        primitives[at++] = p;
        range.extend(p);
    }
    return {chunk.begin, at, range.bounds, range.centers};
}

}  // namespace

Gathered gather(std::span<const FloatBox> boxes) {
    // Fill the chunks in parallel.
    Gathered all{allocate_primitives(boxes.size()), {}, {}};
    BuildPrimitive* primitives = all.primitives.get();
    std::vector<Range> chunks = chunks_of(0, static_cast<std::uint32_t>(boxes.size()));
    std::vector<std::vector<std::uint32_t>> unbounded(chunks.size());
    for_all(0, chunks.size(), 1, [&](std::size_t i) { chunks[i] = fill(boxes, chunks[i], primitives, unbounded[i]); });
    // Close the gaps that skipped boxes left between the chunks.
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        const Range& chunk = chunks[i];
        if (chunk.begin != all.range.end)
            std::copy(primitives + chunk.begin, primitives + chunk.end, primitives + all.range.end);
        all.range.end += chunk.size();
        all.range.extend(chunk);
        all.unbounded.insert(all.unbounded.end(), unbounded[i].begin(), unbounded[i].end());
    }
    return all;
}

Range range_over_many(const BuildPrimitive* primitives, std::uint32_t begin, std::uint32_t end) {
    std::vector<Range> chunks = chunks_of(begin, end);
    for_all(0, chunks.size(), 1,
            [&](std::size_t i) { chunks[i] = range_over(primitives, chunks[i].begin, chunks[i].end); });
    Range all{begin, end};
    for (const Range& chunk : chunks) all.extend(chunk);
    return all;
}

}  // namespace limn::accel
