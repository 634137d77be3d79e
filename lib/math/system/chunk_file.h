// Files that consist of chunks with checksums. Films are saved in this form.
//
// A file contains, in this order:
//   - the eight letters ChunkFormat::begin, which identify the format;
//   - version numbers of 32 bits each;
//   - the chunks, each of them its length in bytes (64 bits), its bytes, and their checksum() (64 bits);
//   - the number of bytes in all of the above (64 bits);
//   - the eight letters ChunkFormat::end.
// Numbers are little endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/system/replace_file.h"

namespace limn {

// The names and marks of one kind of chunk file.
struct ChunkFormat {
    const char* name;             // what error messages call the file: "film"
    std::string_view begin, end;  // the first and the last eight letters of a file
};

// Returns true if `path` is a regular file that begins with the letters of `format`.
bool is_chunk_file(const std::string& path, const ChunkFormat& format);

// Writes a chunk file through a FileReplacement: the file at `path` changes only when finish() is called. All members
// throw FileError if the file cannot be written. `format` is kept by reference.
class ChunkWriter {
public:
    ChunkWriter(const std::string& path, const ChunkFormat& format, std::span<const std::uint32_t> versions);
    void chunk(std::span<const std::byte> bytes);
    // Writes the end of the file and puts it in its place. To be called once, after the last chunk.
    void finish();

private:
    void write(std::span<const std::byte> bytes);

    FileReplacement file_;
    const ChunkFormat& format_;
    std::uint64_t length_ = 0;  // bytes written so far
};

// Reads a chunk file. The caller asks for the chunks in the order in which they were written. All members throw
// FileError if the file cannot be read or is damaged. `format` is kept by reference.
class ChunkReader {
public:
    // Checks the first eight letters and reads versions.size() version numbers.
    ChunkReader(const std::string& path, const ChunkFormat& format, std::span<std::uint32_t> versions);

    const std::string& path() const { return path_; }

    // Returns the bytes of the next chunk. A chunk of fewer than `least` or more than `most` bytes counts as damaged.
    // Error messages call the chunk `what`: "its header".
    std::vector<std::byte> chunk(const char* what, std::uint64_t least = 0,
                                 std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
    // Checks that the file ends here as it should. To be called after the last chunk.
    void finish();

    // Returns the number of bytes not read yet.
    std::uint64_t left() const { return size_ - position_; }

    // Throws a FileError that names the file and `problem`.

    [[noreturn]] void fail(const std::string& problem) const;
    [[noreturn]] void fail_damaged(const std::string& what) const { fail("is damaged: " + what); }

private:
    // Throws FileError if fewer than `length` bytes are left.
    void require(std::uint64_t length) const;
    void read(std::span<std::byte> to);

    std::string path_;
    const ChunkFormat& format_;
    std::ifstream file_;
    std::uint64_t size_ = 0, position_ = 0;
};

}  // namespace limn
