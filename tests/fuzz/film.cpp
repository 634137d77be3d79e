// Whatever the bytes of a film or plan are, reading them gives one or a FileError, or an Error where memory lacks. What
// is given cuts a file short and changes its bytes behind the versions; the checksums are made right, so that what is
// within reaches the reader.
#include <cstdint>
#include <vector>

#include "limn/math/error.h"
#include "limn/render/film.h"
#include "math/system/read_file.h"
#include "render/film_file.h"
#include "scratch_file.h"
#include "support/film_bytes.h"

namespace {

using limn::transport::FilmContent;

// The file of a small film, or that of its plan.
std::string small_film(const std::string& path, FilmContent content) {
    limn::FilmInfo info;
    info.scene = "name", info.features = "sphere", info.scene_digest = {1, 2}, info.program = {3, 4};
    info.width = 20, info.height = 9;
    limn::Film film(info);
    film.add(1, 2, {3, 4, 5});
    film.plan() = {.samples = 8, .rates = std::vector<float>(film.places(), 1), .scale = 8, .upper_error = 0.5};
    if (content == FilmContent::film)
        film.save(path);
    else
        limn::transport::FilmWriter(path, film, content).finish(film.plan(), film.plan().rates, 2.5);
    return limn::read_file(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::string> paths = {limn::fuzz::scratch_path("film")};
    static const std::string film = small_film(paths[0], FilmContent::film);
    static const std::string plan = small_film(paths[0], FilmContent::plan);
    if (size < 4) return 0;
    // Four bytes say which file, and how much of it is missing.
    std::string bytes = data[0] % 2 == 0 ? film : plan;
    const std::size_t missing = (data[1] | data[2] << 8 | data[3] << 16) % bytes.size();
    for (std::size_t i = limn::test::kFirstChunk; i < bytes.size() && i < size; ++i)
        bytes[i] = static_cast<char>(bytes[i] ^ data[i]);
    limn::fuzz::write_file(paths[0], limn::test::with_chunk_sums(bytes.substr(0, bytes.size() - missing)));
    limn::fuzz::attempt<limn::Error>([&] {
        const limn::Film read = limn::Film::load(paths[0]);
        static_cast<void>(read.is_finished() ? read.mean_samples() : read.fewest_samples());
    });
    limn::fuzz::attempt<limn::Error>([&] { limn::Film::merge(paths).image(); });
    limn::fuzz::attempt<limn::Error>([&] { limn::transport::FilmReader(paths[0], FilmContent::plan).finish(); });
    return 0;
}
