// Files of chunks, for films.
//
// Numbers are little endian. A file is eight letters that say what it is, and versions; then chunks, each with its
// length before and its checksum behind; then the length of all this and the eight letters of the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/replace_file.h"

namespace limn {

struct ChunkFormat {
    const char* name;             // "film"
    std::string_view begin, end;  // eight letters each
};

// Whether a file begins as those of the format do.
bool is_chunk_file(const std::string& path, const ChunkFormat& format);

// Writes one, whole or not at all. \throws FileError
class ChunkWriter {
public:
    ChunkWriter(const std::string& path, const ChunkFormat& format, std::span<const std::uint32_t> versions);
    void chunk(std::span<const std::byte> bytes);
    void finish();

private:
    void write(std::span<const std::byte> bytes);

    FileReplacement file_;
    const ChunkFormat& format_;
    std::uint64_t length_ = 0;
};

// Reads one, in the same order. \throws FileError
class ChunkReader {
public:
    // Reads as many versions as there is room for.
    ChunkReader(const std::string& path, const ChunkFormat& format, std::span<std::uint32_t> versions);

    const std::string& path() const { return path_; }

    // `what`: for the message, "its header". Of as many bytes as there are, from `least` to `most`.
    std::vector<std::byte> chunk(const char* what, std::uint64_t least = 0,
                                 std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
    // After the last chunk.
    void finish();

    std::uint64_t left() const { return size_ - position_; }  // in bytes

    [[noreturn]] void fail(const std::string& problem) const;
    [[noreturn]] void fail_damaged(const std::string& what) const { fail("is damaged: " + what); }

private:
    void require(std::uint64_t length) const;  // so many bytes are left
    void read(std::span<std::byte> to);

    std::string path_;
    const ChunkFormat& format_;
    std::ifstream file_;
    std::uint64_t size_ = 0, position_ = 0;
};

}  // namespace limn
