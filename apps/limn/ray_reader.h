/// \file
/// Reading the rays of `limn trace`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limn/math/ray.h"

namespace limn::app {

/// Reads rays from a file or standard input and returns them as soon as they arrive. So a program can send a ray and
/// wait for its result. The memory that is needed does not depend on the number of rays.
///
/// - As text, a ray is a line `ox oy oz dx dy dz [tmin tmax]`: its origin, direction and interval. By default the
///   interval is from 0 to infinity. Blank lines and lines that begin with # are skipped.
/// - As binary, a ray is eight little-endian float64 in the same order.
class RayReader {
public:
    /// \param path a file, or - for standard input
    /// \throws FileError if the file cannot be opened or is a folder
    RayReader(const std::string& path, bool binary);
    ~RayReader();
    RayReader(const RayReader&) = delete;
    RayReader& operator=(const RayReader&) = delete;

    /// Waits until a whole ray has arrived, and returns all rays that have arrived by then. The result is empty at the
    /// end. It is valid until the next call.
    /// \throws FileError if the input is invalid, after the rays before the error have been returned. In text, it names
    /// the line
    std::span<const Ray> next();

    /// Returns the part of a regular file that has been read, 0 to 1. Empty for a pipe or a terminal.
    std::optional<double> fraction() const;

private:
    // Reads at least one byte into the buffer, or sets ended_.
    void fill();
    // Moves all whole rays of the buffer to rays_.
    void take();
    void take_lines();
    void take_binary();
    std::string_view waiting() const { return {&buffer_[begin_], end_ - begin_}; }

    std::string name_;
    bool binary_;
    int file_ = -1;
    std::uint64_t file_size_ = 0;  // in bytes; 0 if it is not a regular file
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0;  // the bytes of buffer_ that are not parsed yet
    bool ended_ = false;               // true at the end of the input
    std::uint64_t bytes_read_ = 0;
    std::uint64_t line_ = 1;  // the number of the next line
    std::vector<Ray> rays_;   // the result of next()
};

}  // namespace limn::app
