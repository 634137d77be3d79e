#include "accel/gather.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace limn::accel {

namespace {

constexpr std::uint32_t kChunk = 1 << 15;
constexpr float kBounded = 0x1p125f;

struct Chunk {
    Range range;  // of its references, from its own first box on
    std::vector<std::uint32_t> unbounded;
};

bool is_empty(const FloatBox& b) {
    return !(b.lower[0] <= b.upper[0] && b.lower[1] <= b.upper[1] && b.lower[2] <= b.upper[2]);
}

// Runs function(chunk, begin, end) over the numbers from begin to end.
template <class Function>
void for_each_chunk(std::uint32_t begin, std::uint32_t end, const Function& function) {
    const std::uint32_t chunks = (end - begin + kChunk - 1) / kChunk;
    const auto run = [&](std::uint32_t c) {
        const std::uint32_t first = begin + c * kChunk;
        function(c, first, first + std::min(kChunk, end - first));
    };
    if (chunks == 1) return run(0);
    tbb::parallel_for(std::uint32_t{0}, chunks, run);
}

Chunk fill(std::span<const FloatBox> boxes, std::uint32_t begin, std::uint32_t end, Reference* references) {
    Chunk chunk;
    chunk.range.begin = chunk.range.end = begin;
    Range range;  // apart from the chunk, so that it stays in registers
    std::uint32_t at = begin;
    for (std::uint32_t id = begin; id < end; ++id) {
        const FloatBox& b = boxes[id];
        const Bounds bounds = to_bounds(b);
        const Int4 plain =
            (bounds.lower <= bounds.upper) & (bounds.lower >= splat(-kBounded)) & (bounds.upper <= splat(kBounded));
        if ((plain[0] & plain[1] & plain[2]) == 0) {
            if (is_empty(b)) continue;
            chunk.unbounded.push_back(id);
            continue;
        }
        const Reference r(bounds, id);
        references[at++] = r;
        range.extend(r);
    }
    chunk.range = range;
    chunk.range.begin = begin, chunk.range.end = at;
    return chunk;
}

}  // namespace

Gathered gather(std::span<const FloatBox> boxes, std::uint32_t room) {
    const auto size = static_cast<std::uint32_t>(boxes.size());
    Gathered all{ReferenceArray(boxes.size() + room), {}, {}};
    Reference* references = all.references.data();
    std::vector<Chunk> chunks((size + kChunk - 1) / kChunk);
    for_each_chunk(0, size, [&](std::uint32_t c, std::uint32_t begin, std::uint32_t end) {
        chunks[c] = fill(boxes, begin, end, references);
    });
    for (const Chunk& chunk : chunks) {
        const Range& part = chunk.range;
        if (part.begin != all.range.end)
            std::copy(references + part.begin, references + part.end, references + all.range.end);
        all.range.end += part.size();
        all.range.extend(part);
        all.unbounded.insert(all.unbounded.end(), chunk.unbounded.begin(), chunk.unbounded.end());
    }
    all.range.room = room;
    return all;
}

Range range_over_many(const Reference* references, std::uint32_t begin, std::uint32_t end) {
    std::vector<Range> ranges((end - begin + kChunk - 1) / kChunk);
    for_each_chunk(begin, end, [&](std::uint32_t c, std::uint32_t first, std::uint32_t last) {
        ranges[c] = range_over(references, first, last);
    });
    Range all{begin, end, 0};
    for (const Range& r : ranges) all.extend(r);
    return all;
}

}  // namespace limn::accel
