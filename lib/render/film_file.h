// Films in files.
//
// Numbers are little endian. A file is "limnfilm", the format's version and the samples' version; then chunks, each
// with its length before and its checksum behind: the header (what the film is of and which tiles it has), each tile,
// the plan, its rates; then the length of all this and "filmlimn". The plan comes after the tiles, for a film
// may be written while it is rendered: what wants a tile's samples is a plan that is taken later. The file of a plan
// alone has no chunks of tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/replace_file.h"
#include "limn/render/film.h"

namespace limn::transport {

// Raised when the same scene, settings, seed and number give another sample than before: sums of both are of neither.
inline constexpr std::uint32_t kSampleVersion = 2;

enum class FilmContent : std::uint8_t { film, plan };

// Writes a film: each of its tiles in order, then the plan. \throws FileError
class FilmWriter {
public:
    FilmWriter(const std::string& path, const Film& film, FilmContent content = FilmContent::film);
    void tile(std::span<const std::byte> bytes) { chunk(bytes); }
    // `rates`, tile by tile of the film, may be empty.
    void finish(const SamplePlan& plan, std::span<const float> rates, double seconds);

private:
    void chunk(std::span<const std::byte> bytes);
    void write(std::span<const std::byte> bytes);

    const Film& film_;
    FileReplacement file_;
    std::uint64_t length_ = 0;
};

// Reads one, in the same order. \throws FileError
class FilmReader {
public:
    explicit FilmReader(const std::string& path, FilmContent content = FilmContent::film);

    const std::string& path() const { return path_; }
    const FilmInfo& info() const { return info_; }
    const std::vector<std::uint32_t>& tiles() const { return tiles_; }

    // All of `tiles`: those that the film has become its own.
    void read_tiles(Film& film);
    // After the tiles: the plan, with rates tile by tile, or none.
    SamplePlan finish();
    double seconds() const { return seconds_; }  // after that

    // A fault that concerns the film as a whole.
    [[noreturn]] void fail(const std::string& problem) const;

private:
    void read_header(FilmContent content);
    std::vector<std::byte> chunk(const char* what, std::uint64_t least, std::uint64_t most);
    [[noreturn]] void fail_damaged(const std::string& what) const { fail("is damaged: " + what); }
    void read(std::span<std::byte> to);
    std::uint64_t left() const { return size_ - position_; }

    std::string path_;
    std::ifstream file_;
    std::uint64_t size_ = 0, position_ = 0;
    FilmInfo info_;
    std::vector<std::uint32_t> tiles_;
    double seconds_ = 0;
};

}  // namespace limn::transport
