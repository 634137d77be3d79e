#include "core/huge_pages.h"

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
    if (alignment == kPage) {  // wishes: nothing depends on them
        madvise(memory, bytes, MADV_DONTNEED);  // memory that was in use before has small pages
        madvise(memory, bytes, MADV_HUGEPAGE);
    }
#endif
    return memory;
}

void free_huge_pages(void* memory) noexcept { std::free(memory); }

}  // namespace limn
