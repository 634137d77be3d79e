#include "kept_memory.h"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <new>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace limn::python {

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
// The largest number of bytes that are kept. Two results of cast_rays for a million rays take 112 MB.
constexpr std::size_t kMostKept = std::size_t{1} << 27;

struct Block {
    std::size_t bytes;
    void* data;
};

// Returns the blocks that are kept and not in use, the oldest first. They are never destroyed, because an array may
// outlive the static objects of the module.
std::deque<Block>& waiting() {
    static auto* const blocks = new std::deque<Block>;
    return *blocks;
}

// Returns new memory, aligned to a huge page. Throws std::bad_alloc.
void* allocate(std::size_t bytes) {
    void* const data = std::aligned_alloc(kHugePage, bytes);
    if (data == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(data, bytes, MADV_HUGEPAGE);
#endif
    return data;
}

}  // namespace

KeptMemory::KeptMemory(std::size_t bytes) : bytes_((bytes + kHugePage - 1) / kHugePage * kHugePage) {
    std::deque<Block>& blocks = waiting();
    const auto same = std::find_if(blocks.rbegin(), blocks.rend(), [&](const Block& b) { return b.bytes == bytes_; });
    if (same == blocks.rend()) {
        data_ = allocate(bytes_);
    } else {
        data_ = same->data;
        blocks.erase(std::next(same).base());
    }
}

KeptMemory::~KeptMemory() {
    std::deque<Block>& blocks = waiting();
    blocks.push_back({bytes_, data_});
    std::size_t kept = 0;
    for (const Block& block : blocks) kept += block.bytes;
    for (; kept > kMostKept; blocks.pop_front()) {
        kept -= blocks.front().bytes;
        std::free(blocks.front().data);
    }
}

}  // namespace limn::python
