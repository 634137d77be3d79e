// Memory of large answers, which the next ones get.
#pragma once

#include <cstddef>

namespace limn::python {

// From so many bytes on. Smaller arrays are numpy's own.
inline constexpr std::size_t kLeastKept = std::size_t{1} << 20;

// Memory that is new to a process is cleared page by page, which takes longer than a third of the rays that are
// answered into it. So what arrays give back is kept for others of their size. \pre the interpreter's lock is held,
// here and when it ends
class KeptMemory {
public:
    explicit KeptMemory(std::size_t bytes);  // as it was left
    ~KeptMemory();
    KeptMemory(const KeptMemory&) = delete;
    KeptMemory& operator=(const KeptMemory&) = delete;

    void* data() const { return data_; }

private:
    std::size_t bytes_;
    void* data_;
};

}  // namespace limn::python
