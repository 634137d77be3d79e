// Memory for tables that rays read in no order. It is on huge pages if the system has them: on small pages, most cache
// misses in a large tree would also miss the TLB.
#pragma once

#include <cstddef>
#include <vector>

namespace limn {

// Allocates memory that is aligned to 64 bytes, or to 2 MiB if it is at least as large. The caller frees it with
// free_huge_pages(). \throws std::bad_alloc
void* allocate_on_huge_pages(std::size_t bytes);
void free_huge_pages(void* memory) noexcept;

// A standard allocator for allocate_on_huge_pages().
template <class T>
struct HugePageAllocator {
    using value_type = T;

    HugePageAllocator() = default;
    template <class U>
    HugePageAllocator(const HugePageAllocator<U>&) {}

    T* allocate(std::size_t n) { return static_cast<T*>(allocate_on_huge_pages(n * sizeof(T))); }
    void deallocate(T* memory, std::size_t) noexcept { free_huge_pages(memory); }

    friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }
};

// A deleter for std::unique_ptr to memory of allocate_on_huge_pages().
struct HugePageDeleter {
    void operator()(void* memory) const noexcept { free_huge_pages(memory); }
};

template <class T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace limn
