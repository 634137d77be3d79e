// Files of films. A film is a chunk file (math/system/chunk_file.h) with two versions: that of the format and
// kSampleVersion. Its chunks are
// - the header: the content (FilmContent), the FilmInfo and the numbers of the film's tiles,
// - each tile, in ascending order,
// - the plan: a SamplePlan without its rates, and the seconds,
// - the rates, if the plan has any.
// The plan is read after the tiles. A film may be written while it is rendered, and then its plan must be at least as
// new as its tiles, so that no tile has more samples than the plan wants. A file with a plan alone has no tile chunks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "limn/render/film.h"
#include "math/system/chunk_file.h"

namespace limn::transport {

// The version of limn's samples. It is raised when the same scene, settings, seed and sample number give another sample
// than before. Samples of different versions must not be summed.
inline constexpr std::uint32_t kSampleVersion = 4;

// The content of a file: a film with its plan, or a plan alone.
enum class FilmContent : std::uint8_t { film, plan };

// True if FilmInfo::window is not empty and lies in the picture.
bool is_window(const FilmInfo& info);

// Writes a film, or a plan alone. For a film, call tile() for each of its tiles in ascending order, then finish(). For
// a plan, call finish(). The file appears when finish() returns, whole or not at all. All functions throw FileError.
class FilmWriter {
public:
    // Begins the file and writes its header.
    FilmWriter(const std::string& path, const Film& film, FilmContent content = FilmContent::film);
    // Writes a tile, given as Film::tile_bytes.
    void tile(std::span<const std::byte> bytes) { file_.chunk(bytes); }
    // Writes the plan with `rates` in place of plan.rates. `rates` are in the order of Film::place, or empty.
    void finish(const SamplePlan& plan, std::span<const float> rates, double seconds);

private:
    ChunkWriter file_;
};

// Reads what FilmWriter wrote, in the same order. Unless stated otherwise, functions throw FileError if the file is
// damaged or cut short.
class FilmReader {
public:
    // Opens the file and reads its header. Also throws FileError if the file has other content or another version.
    explicit FilmReader(const std::string& path, FilmContent content = FilmContent::film);

    const std::string& path() const { return file_.path(); }
    const FilmInfo& info() const { return info_; }
    const std::vector<std::uint32_t>& tiles() const { return tiles_; }

    // Reads all tiles of the file. Those that `film` has replace its own; the others are ignored.
    void read_tiles(Film& film);
    // Reads the plan, which follows the tiles. Its rates, if any, are those of tiles(), kTilePixels for each.
    SamplePlan finish();
    // Returns Film::seconds. \pre finish() was called
    double seconds() const { return seconds_; }

    // Throws a FileError that names the file.
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
