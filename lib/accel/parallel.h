#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace limn::accel {

// Calls function(i) for all i from `begin` to `end`, in parallel by `grain` or more; so few alone take no task.
template <class Function>
void for_all(std::size_t begin, std::size_t end, std::size_t grain, const Function& function) {
    const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
    };
    const tbb::blocked_range<std::size_t> all(begin, end, grain);
    if (all.is_divisible())
        tbb::parallel_for(all, run);
    else
        run(all);
}

}  // namespace limn::accel
