// The references that a build begins with.
#pragma once

#include <span>
#include <vector>

#include "accel/reference.h"
#include "core/huge_pages.h"

namespace limn::accel {

// Room for references, not written to yet.
class ReferenceArray {
public:
    explicit ReferenceArray(std::size_t size) : size_(size), data_(Allocator().allocate(size)) {}
    ReferenceArray(ReferenceArray&& other) noexcept : size_(other.size_), data_(other.data_) { other.data_ = nullptr; }
    ReferenceArray& operator=(ReferenceArray&&) = delete;
    ~ReferenceArray() {
        if (data_ != nullptr) Allocator().deallocate(data_, size_);
    }

    Reference* data() { return data_; }

private:
    using Allocator = HugePageAllocator<Reference>;

    std::size_t size_;
    Reference* data_;
};

struct Gathered {
    ReferenceArray references;             // of bounded boxes
    Range range;                           // all of them
    std::vector<std::uint32_t> unbounded;  // numbers of the others
};

// Leaves out empty boxes. Counts boxes as unbounded too whose sides' sums or differences could overflow. The references
// have room for so many more.
Gathered gather(std::span<const FloatBox> boxes, std::uint32_t room);

// As range_over, in parallel.
Range range_over_many(const Reference* references, std::uint32_t begin, std::uint32_t end);

}  // namespace limn::accel
