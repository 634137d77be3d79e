// Loading, merging and saving films.
#include <algorithm>
#include <optional>
#include <type_traits>

#include "limn/math/error.h"
#include "limn/render/film.h"
#include "render/film_fields.h"
#include "render/film_file.h"

namespace limn {

using transport::FilmReader;

namespace {

// Returns a value as it is written in a message: a bool or a number. The text of any other type is empty.
template <class T>
std::string text(const T& value) {
    if constexpr (std::is_same_v<T, bool>) return value ? "on" : "off";
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) return std::to_string(value);
    return "";
}

std::string samples_of(const SamplePlan& plan) { return std::to_string(plan.samples) + " samples a pixel"; }

// Adds the plan of a file to the film that is merged. The plans of all files must have the same samples and scale. Each
// file contributes the rates of its own tiles. `first` is the path of the first file.
void add_plan(const FilmReader& reader, const SamplePlan& plan, bool is_first, const std::string& first, Film& film) {
    SamplePlan& all = film.plan();
    if (!is_first &&
        (plan.samples != all.samples || plan.scale != all.scale || plan.rates.empty() != all.rates.empty()))
        reader.fail("has " + samples_of(plan) + ", " + first + " " + samples_of(all) + ", or other rates");
    if (is_first) {
        all.samples = plan.samples;
        all.scale = plan.scale;
        all.upper_error = plan.upper_error;
    }
    if (!plan.rates.empty()) film.set_rates(reader.tiles(), plan.rates);
}

// Returns a list of the missing shards, which names ten of them at most. Their number is that of the first shard.
std::string missing_shards(const std::vector<Shard>& shards) {
    const int count = shards.front().count;
    std::vector<bool> is_there(static_cast<std::size_t>(count) + 1);
    for (const Shard& s : shards)
        if (s.count == count) is_there[static_cast<std::size_t>(s.index)] = true;
    std::string names;
    int missing = 0;
    for (int i = 1; i <= count; ++i) {
        if (is_there[static_cast<std::size_t>(i)] || ++missing > 10) continue;
        names += (names.empty() ? "" : ", ") + std::to_string(i) + "/" + std::to_string(count);
    }
    return names + (missing > 10 ? " and " + std::to_string(missing - 10) + " more" : "");
}

// Checks by their headers that the files can be merged, and returns the FilmInfo of the whole picture.
// \throws FileError if they are of different renders, or have a tile twice or not at all
FilmInfo check_headers(std::span<const std::string> paths) {
    std::optional<FilmInfo> info;
    std::vector<std::uint32_t> owner;  // for each tile the index of the path that has it, or kNobody
    std::vector<Shard> shards;
    constexpr std::uint32_t kNobody = 0xffffffff;
    // Read each header and note the owner of each tile.
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
        const FilmReader reader(paths[i]);
        if (!info) {
            info = reader.info();
            owner.assign(Film::tile_count(*info), kNobody);
        }
        if (const std::string other = difference(reader.info(), *info); !other.empty())
            reader.fail("is not of one render with " + paths[0] + ": " + other);
        for (const std::uint32_t tile : reader.tiles()) {
            if (owner[tile] != kNobody) reader.fail("has pixels that " + paths[owner[tile]] + " has too");
            owner[tile] = i;
        }
        shards.push_back(reader.info().shard);
    }
    // Throw if a tile is missing.
    if (std::ranges::find(owner, kNobody) != owner.end()) {
        const std::string shards_missing = missing_shards(shards);
        throw FileError(
            paths[0], (paths.size() == 1 ? "is" : "and the other files are") + std::string(" not the whole picture: ") +
                          (shards_missing.empty() ? "some tiles are missing" : "missing are shards " + shards_missing));
    }
    info->shard = {};
    return *info;
}

}  // namespace

std::string difference(const FilmInfo& film, const FilmInfo& other) {
    std::string found;
    transport::each_field(film, other, [&found](const std::string& name, const auto& a, const auto& b) {
        if (!found.empty() || name.empty() || a == b) return;
        found = "its " + name + " is " + (text(a).empty() ? "another" : text(a) + ", not " + text(b));
    });
    return found;
}

Film Film::load(const std::string& path) {
    FilmReader reader(path);
    Film film(reader.info(), reader.tiles());
    reader.read_tiles(film);
    film.plan_ = reader.finish();
    film.seconds_ = reader.seconds();
    return film;
}

Film Film::merge(std::span<const std::string> paths) {
    if (paths.empty()) throw ArgumentError("Film::merge: there are no files");
    Film film(check_headers(paths));
    for (const std::string& path : paths) {
        FilmReader reader(path);
        if (!difference(reader.info(), film.info()).empty()) reader.fail("was changed meanwhile");
        reader.read_tiles(film);
        const SamplePlan plan = reader.finish();
        add_plan(reader, plan, &path == &paths[0], paths[0], film);
        film.seconds_ += reader.seconds();
        if (!film.is_finished(reader.tiles()))
            reader.fail("lacks samples: its render was interrupted, and can be resumed");
    }
    return film;
}

void Film::save(const std::string& path) const {
    transport::FilmWriter writer(path, *this);
    for (const std::uint32_t tile : tiles_) writer.tile(tile_bytes(tile));
    writer.finish(plan_, plan_.rates, seconds_);
}

}  // namespace limn
