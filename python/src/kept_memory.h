// Memory of large result arrays that is used again for later results.
#pragma once

#include <cstddef>

namespace limn::python {

// The size in bytes from which new_array uses KeptMemory. numpy allocates smaller arrays.
inline constexpr std::size_t kLeastKept = std::size_t{1} << 20;

// A block of memory that is taken from the kept blocks of its size, or allocated if there is none. The destructor keeps
// the block for later, up to 128 MiB in all. The reason: the system clears each new page of a process. Clearing takes
// more than a third of the time in which the rays are traced whose results the memory stores.
// \pre the GIL is held in the constructor and in the destructor
class KeptMemory {
public:
    explicit KeptMemory(std::size_t bytes);  // the memory isn't cleared; throws std::bad_alloc
    ~KeptMemory();
    KeptMemory(const KeptMemory&) = delete;
    KeptMemory& operator=(const KeptMemory&) = delete;

    void* data() const { return data_; }

private:
    std::size_t bytes_;
    void* data_;
};

}  // namespace limn::python
