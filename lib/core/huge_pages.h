// Memory for tables that rays read all over: on huge pages where the system has them, since most misses of a large tree
// would miss in the TLB too.
#pragma once

#include <cstddef>
#include <vector>

namespace limn {

// Aligned to 64 bytes at least. \throws std::bad_alloc
void* allocate_on_huge_pages(std::size_t bytes);
void free_huge_pages(void* memory) noexcept;

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

struct HugePageDeleter {
    void operator()(void* memory) const noexcept { free_huge_pages(memory); }
};

template <class T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace limn
