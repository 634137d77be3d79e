#include "math/system/chunk_file.h"

#include <algorithm>
#include <bit>
#include <filesystem>

#include "limn/math/error.h"
#include "math/system/checksum.h"
#include "math/system/read_file.h"

namespace limn {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::size_t kLetters = 8;

template <class Number>
std::span<const std::byte> bytes_of(const Number& number) {
    return std::as_bytes(std::span(&number, 1));
}

}  // namespace

bool is_chunk_file(const std::string& path, const ChunkFormat& format) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) return false;
    char begin[kLetters] = {};
    std::ifstream(path, std::ios::binary).read(begin, sizeof begin);
    return std::string_view(begin, sizeof begin) == format.begin;
}

ChunkWriter::ChunkWriter(const std::string& path, const ChunkFormat& format, std::span<const std::uint32_t> versions)
    : file_(path), format_(format) {
    write(std::as_bytes(std::span(format.begin)));
    write(std::as_bytes(versions));
}

void ChunkWriter::chunk(std::span<const std::byte> bytes) {
    write(bytes_of(std::uint64_t{bytes.size()}));
    write(bytes);
    write(bytes_of(checksum(bytes)));
}

void ChunkWriter::finish() {
    write(bytes_of(std::uint64_t{length_}));
    write(std::as_bytes(std::span(format_.end)));
    file_.commit();
}

void ChunkWriter::write(std::span<const std::byte> bytes) {
    file_.write(bytes);
    length_ += bytes.size();
}

ChunkReader::ChunkReader(const std::string& path, const ChunkFormat& format, std::span<std::uint32_t> versions)
    : path_(path), format_(format) {
    require_readable(path);
    file_.open(path, std::ios::binary);
    size_ = std::filesystem::file_size(path);
    char begin[kLetters] = {};
    const auto known = static_cast<std::size_t>(std::min<std::uint64_t>(size_, kLetters));
    read(std::as_writable_bytes(std::span(begin)).first(known));
    if (std::string_view(begin, known) != format.begin.substr(0, known) || known == 0)
        fail("is not a " + std::string(format.name));
    read(std::as_writable_bytes(versions));
}

std::vector<std::byte> ChunkReader::chunk(const char* what, std::uint64_t least, std::uint64_t most) {
    std::uint64_t length = 0, sum = 0;
    read(std::as_writable_bytes(std::span(&length, 1)));
    if (length < least || length > most) fail_damaged(what);
    require(length);
    std::vector<std::byte> bytes(static_cast<std::size_t>(length));
    read(bytes);
    read(std::as_writable_bytes(std::span(&sum, 1)));
    if (sum != checksum(bytes)) fail_damaged(what);
    return bytes;
}

void ChunkReader::require(std::uint64_t length) const {
    if (length > left()) fail("is cut short");
}

void ChunkReader::finish() {
    const std::uint64_t length = position_;
    std::uint64_t said = 0;
    char end[kLetters] = {};
    read(std::as_writable_bytes(std::span(&said, 1)));
    read(std::as_writable_bytes(std::span(end)));
    if (said != length || std::string_view(end, kLetters) != format_.end || left() > 0) fail_damaged("its end");
}

void ChunkReader::read(std::span<std::byte> to) {
    require(to.size());
    if (!file_.read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size())))
        fail("reading failed");
    position_ += to.size();
}

void ChunkReader::fail(const std::string& problem) const { throw FileError(path_, problem); }

}  // namespace limn
