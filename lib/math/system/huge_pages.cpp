#include "math/system/huge_pages.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace limn {

void* allocate_on_huge_pages(std::size_t bytes) {
    constexpr std::size_t kPage = std::size_t{1} << 21;
    const std::size_t alignment = bytes >= kPage ? kPage : 64;
    void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    // Ask for huge pages. Both calls are hints, so their failures are ignored.
    if (alignment == kPage) {
        madvise(memory, bytes, MADV_DONTNEED);  // frees the small pages of memory that was used before
        madvise(memory, bytes, MADV_HUGEPAGE);
    }
#endif
    return memory;
}

void free_huge_pages(void* memory) noexcept { std::free(memory); }

}  // namespace limn
