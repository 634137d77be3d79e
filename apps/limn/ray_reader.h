/// \file
/// The rays that `limn trace` reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limn/core/ray.h"

namespace limn::app {

/// Rays from a file or standard input, given as they arrive. A program that sends a ray and waits for its result gets
/// it, and memory does not grow with their number.
///
/// As text one a line, `ox oy oz dx dy dz [tmin tmax]`; blank lines and those that begin with # are skipped. As
/// binary eight little-endian float64 each, in the same order.
class RayReader {
public:
    /// \param path a file, or - for standard input
    /// \throws FileError
    RayReader(const std::string& path, bool binary);
    ~RayReader();
    RayReader(const RayReader&) = delete;
    RayReader& operator=(const RayReader&) = delete;

    /// Waits for a whole ray, and gives all that have come by then; none at the end. Valid until the next call.
    /// \throws FileError that names the line, once the rays before what is wrong have been given
    std::span<const Ray> next();

    /// How much of a regular file has been read, 0 to 1; empty for a pipe or a terminal, whose end nobody knows.
    std::optional<double> fraction() const;

private:
    void fill();
    void take();
    void take_lines();
    void take_binary();
    std::string_view waiting() const { return {&buffer_[begin_], end_ - begin_}; }

    std::string name_;
    bool binary_;
    int file_ = -1;
    std::uint64_t file_size_ = 0;  // 0: not a regular file
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0;  // in buffer_: what has been read and not been taken
    bool ended_ = false;
    std::uint64_t bytes_read_ = 0;
    std::uint64_t line_ = 1;  // that comes next
    std::vector<Ray> rays_;
};

}  // namespace limn::app
