// Whatever the bytes of a film or plan are, reading them gives one or a FileError, or an Error where memory lacks. The
// checksums are made right, so that what is within reaches the reader; what was read survives being used.
#include <cstdint>
#include <vector>

#include "limn/core/error.h"
#include "limn/render/film.h"
#include "render/film_file.h"
#include "scratch_file.h"
#include "support/film_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::string> paths = {limn::fuzz::scratch_path("film")};
    limn::fuzz::write_file(paths[0], limn::test::with_chunk_sums({reinterpret_cast<const char*>(data), size}));
    limn::fuzz::attempt<limn::Error>([&] {
        const limn::Film film = limn::Film::load(paths[0]);
        static_cast<void>(film.is_finished() ? film.mean_samples() : film.fewest_samples());
    });
    limn::fuzz::attempt<limn::Error>([&] { limn::Film::merge(paths).image(); });
    limn::fuzz::attempt<limn::Error>(
        [&] { limn::transport::FilmReader(paths[0], limn::transport::FilmContent::plan).finish(); });
    return 0;
}
