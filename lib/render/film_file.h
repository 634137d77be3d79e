// Films in files: see core/chunk_file.h. The versions are the format's and the samples'. The chunks are the header
// (what the film is of and which tiles it has), each tile, the plan, its rates. The plan comes after the tiles, for a
// film may be written while it is rendered: what wants a tile's samples is a plan that is taken later. The file of a
// plan alone has no chunks of tiles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/chunk_file.h"
#include "limn/render/film.h"

namespace limn::transport {

// Raised when the same scene, settings, seed and number give another sample than before: sums of both are of neither.
inline constexpr std::uint32_t kSampleVersion = 4;

enum class FilmContent : std::uint8_t { film, plan };

// Whether the crop window, if there is one, holds pixels, all of the picture.
bool is_window(const FilmInfo& info);

// Writes a film: each of its tiles in order, then the plan. \throws FileError
class FilmWriter {
public:
    FilmWriter(const std::string& path, const Film& film, FilmContent content = FilmContent::film);
    void tile(std::span<const std::byte> bytes) { file_.chunk(bytes); }
    // `rates`, tile by tile of the film, may be empty.
    void finish(const SamplePlan& plan, std::span<const float> rates, double seconds);

private:
    ChunkWriter file_;
};

// Reads one, in the same order. \throws FileError
class FilmReader {
public:
    explicit FilmReader(const std::string& path, FilmContent content = FilmContent::film);

    const std::string& path() const { return file_.path(); }
    const FilmInfo& info() const { return info_; }
    const std::vector<std::uint32_t>& tiles() const { return tiles_; }

    // All of `tiles`: those that the film has become its own.
    void read_tiles(Film& film);
    // After the tiles: the plan, with rates tile by tile, or none.
    SamplePlan finish();
    double seconds() const { return seconds_; }  // after that

    // A fault that concerns the film as a whole.
    [[noreturn]] void fail(const std::string& problem) const { file_.fail(problem); }

private:
    void read_header(FilmContent content);

    std::array<std::uint32_t, 2> versions_ = {};
    ChunkReader file_;
    FilmInfo info_;
    std::vector<std::uint32_t> tiles_;
    double seconds_ = 0;
};

}  // namespace limn::transport
