// Films in files: what is written is read again, whatever is damaged is refused by name.
#include "render/film_file.h"

#include <cstring>
#include <random>

#include "limn/math/error.h"
#include "property.h"
#include "support/film_bytes.h"
#include "support/folder.h"
#include "support/random_geometry.h"

namespace limn::film_file_test {

using namespace test;

namespace {

FilmInfo some_info(int width = 35, int height = 20) {
    FilmInfo info;
    info.scene = "a scene";
    info.features = "sphere quad";
    info.scene_digest = {1, 2};
    info.program = {3, 4};
    info.camera = {.look_from = {1, 2, 3},
                   .look_at = {4, 5, 6},
                   .up = {7, 8, 9},
                   .vertical_fov = 10,
                   .aspect_ratio = 1.5,
                   .aperture_angle = 11,
                   .focus_distance = 12,
                   .shutter_open = 0.25,
                   .shutter_close = 0.75};
    info.width = width, info.height = height;
    info.max_depth = 13;
    info.seed = 14;
    info.antialias = false;
    info.estimator = Estimator::naive;
    info.sampler = SamplerKind::independent;
    info.uniform = true;
    return info;
}

// Every pixel with its own number of its own samples.
Film some_film(const FilmInfo& info, bool has_rates = true) {
    Film film(info);
    Random random(info.seed);
    for (const std::uint32_t number : film.tiles()) {
        const Film::Tile t = film.tile(number);
        for (int y = t.top; y < t.bottom; ++y)
            for (int x = t.left; x < t.right; ++x)
                for (int i = 0; i < 1 + (x + y) % 5; ++i)
                    film.add(x, y, {random.uniform(), random.uniform(), random.uniform()});
        film.count(number, {100 + number, 2, 1});
    }
    film.set_seconds(2.5);
    film.plan() = {.samples = 1, .rates = {}, .scale = 0.5, .upper_error = 0.125};
    if (has_rates) {
        film.plan().rates.resize(film.places());
        for (std::size_t i = 0; i < film.places(); ++i) film.plan().rates[i] = static_cast<float>(i % 7);
    }
    return film;
}

std::string fault_of(const std::string& path) {
    try {
        Film::load(path);
    } catch (const FileError& e) {
        CHECK(e.path() == path);
        return std::string(e.what()).substr(path.size() + 2);
    }
    return "";
}

std::string bytes_of(const Folder& folder, const Film& film) {
    film.save(folder.path("saved.film"));
    return folder.read("saved.film");
}

}  // namespace

TEST_CASE("Film files: a film is read as it was written, in bits", "[render][film][film-file]") {
    const Folder folder;
    for (const Shard shard : {Shard{1, 1}, Shard{2, 3}, Shard{6, 6}})
        for (const bool has_rates : {false, true}) {
            FilmInfo info = some_info();
            info.shard = shard;
            const Film film = some_film(info, has_rates);
            const std::string bytes = bytes_of(folder, film);
            const Film again = Film::load(folder.path("saved.film"));
            CHECK(difference(again.info(), info).empty());
            CHECK((again.info().scene == "a scene" && again.info().features == "sphere quad"));
            CHECK((again.info().shard.index == shard.index && again.info().shard.count == shard.count));
            CHECK(std::ranges::equal(again.tiles(), film.tiles()));
            CHECK(again.image() == film.image());
            CHECK(again.counts().rays == film.counts().rays);
            CHECK(again.counts().nonfinite == film.tiles().size());
            CHECK(again.seconds() == 2.5);
            CHECK((again.plan().samples == 1 && again.plan().scale == 0.5 && again.plan().upper_error == 0.125));
            CHECK(again.plan().rates == film.plan().rates);
            CHECK(bytes_of(folder, again) == bytes);  // sums, squares and all
        }
    CHECK(is_film_file(folder.path("saved.film")));
    CHECK_FALSE(is_film_file(folder.write("text", "limnfil")));
    CHECK_FALSE(is_film_file(folder.path()));
    CHECK_FALSE(is_film_file(folder.path("none")));
}

TEST_CASE("Film files: cut short anywhere, they are refused", "[render][film-file]") {
    const Folder folder;
    const std::string bytes = bytes_of(folder, some_film(some_info(17, 3)));
    std::mt19937 generator(5);
    std::vector<std::size_t> lengths = {
        0, 1, 7, 8, 12, 15, 16, 23, 24, bytes.size() - 1, bytes.size() - 8, bytes.size() - 16, bytes.size() - 17};
    while (lengths.size() < 120) lengths.push_back(generator() % bytes.size());
    for (const std::size_t length : lengths) {
        CAPTURE(length);
        const std::string fault = fault_of(folder.write("cut.film", bytes.substr(0, length)));
        CHECK(fault == (length == 0 ? "is not a film" : "is cut short"));
    }
    CHECK(fault_of(folder.write("long.film", bytes + "x")) == "is damaged: its end");
}

TEST_CASE("Film files: a bit flipped anywhere, they are refused", "[render][film-file]") {
    const Folder folder;
    const std::string bytes = bytes_of(folder, some_film(some_info(17, 3)));
    std::mt19937 generator(6);
    std::vector<std::size_t> places(64);
    for (std::size_t i = 0; i < 32; ++i) places[i] = i, places[63 - i] = bytes.size() - 1 - i;
    while (places.size() < 400) places.push_back(generator() % bytes.size());
    for (const std::size_t place : places) {
        const unsigned bit = generator() % 8;
        CAPTURE(place, bit);
        std::string flipped = bytes;
        flipped[place] = static_cast<char>(flipped[place] ^ 1 << bit);
        const std::string fault = fault_of(folder.write("flipped.film", flipped));
        if (place < 8)
            CHECK(fault == "is not a film");
        else if (place < 12)
            CHECK(fault.find("is a film of format") == 0);
        else if (place < 16)
            CHECK(fault.find("is of a version of limn whose samples are others") == 0);
        else
            CHECK((fault.find("is damaged") == 0 || fault == "is cut short"));
    }
}

TEST_CASE("Film files: a header that cannot be, with a checksum that is right, is refused", "[render][film-file]") {
    const Folder folder;
    const std::string bytes = bytes_of(folder, some_film(some_info(17, 3)));
    std::uint64_t length = 0;
    std::memcpy(&length, &bytes[16], 8);
    std::size_t refused = 0;
    for (std::size_t place = 24; place < 24 + length; ++place)
        for (const int value : {0, 1, 0x7f, 0xff}) {
            std::string other = bytes;
            other[place] = static_cast<char>(value);
            // Most make another film, of which the rest is not; never anything worse.
            refused += !fault_of(folder.write("header.film", with_chunk_sums(other))).empty();
        }
    CHECK(refused > 30);
    std::string plan = bytes;
    plan[24] = 1;
    CHECK(fault_of(folder.write("plan.film", with_chunk_sums(plan))) == "is a plan, not a film");
}

TEST_CASE("Film files: more tiles than a film can have, or than the file holds, and endless rates are refused",
          "[render][film-file]") {
    const Folder folder;
    FilmInfo info = some_info();
    info.scene.clear(), info.features.clear();
    Film film = some_film(info);
    const auto fault = [&](const std::string& bytes) {
        return fault_of(folder.write("a.film", with_chunk_sums(bytes)));
    };
    const std::string bytes = bytes_of(folder, film);
    // Behind the content and the two empty names.
    const auto with_sides = [&](std::int32_t side) {
        std::string other = bytes;
        for (const std::size_t place : {24U + 17U, 24U + 21U}) std::memcpy(&other[place], &side, 4);
        return other;
    };
    CHECK(fault(with_sides(1 << 20)) == "is damaged: its header");
    CHECK(fault(bytes.substr(0, bytes.size() / 2)) == "is cut short");
    const float endless = std::numeric_limits<float>::infinity();
    film.plan().rates[3] = endless;
    CHECK(fault(bytes_of(folder, film)) == "is damaged: its rates");
    film.plan().rates[3] = 1;
    film.plan().scale = static_cast<double>(endless);
    CHECK(fault(bytes_of(folder, film)) == "is damaged: its plan");
}

TEST_CASE("Film files: what is no film, or not there, is refused by name", "[render][film-file]") {
    const Folder folder;
    CHECK(fault_of(folder.path("none.film")) == "there is no such file");
    CHECK(fault_of(folder.path()) == "is a folder, not a file");
    CHECK(fault_of(folder.write("text", "v 0 0 0\n")) == "is not a film");
    CHECK(fault_of("/dev/null") == "is not a regular file");
    CHECK_THROWS_AS(some_film(some_info()).save(folder.path("none/a.film")), FileError);
}

TEST_CASE("Film files: each field that a sample depends on tells films apart, by name", "[render][film-file]") {
    const FilmInfo info = some_info();
    const auto changed = [&](auto change) {
        FilmInfo other = info;
        change(other);
        return difference(other, info);
    };
    CHECK(difference(info, info).empty());
    CHECK(changed([](FilmInfo& i) { i.width = 36; }) == "its width is 36, not 35");
    CHECK(changed([](FilmInfo& i) { i.height = 21; }) == "its height is 21, not 20");
    CHECK(changed([](FilmInfo& i) { i.seed = 15; }) == "its seed is 15, not 14");
    CHECK(changed([](FilmInfo& i) { i.max_depth = 5; }) == "its depth limit is 5, not 13");
    CHECK(changed([](FilmInfo& i) { i.scene_digest[1] = 0; }) == "its scene is another");
    CHECK(changed([](FilmInfo& i) { i.program[0] = 0; }) == "its program is another");
    CHECK(changed([](FilmInfo& i) { i.camera.look_from.z = 0; }) == "its camera's place is another");
    CHECK(changed([](FilmInfo& i) { i.camera.look_at.x = 0; }) == "its camera's target is another");
    CHECK(changed([](FilmInfo& i) { i.camera.up.y = 0; }) == "its camera's up is another");
    CHECK(changed([](FilmInfo& i) { i.camera.vertical_fov = 9; }).find("its field of view is 9") == 0);
    CHECK(changed([](FilmInfo& i) { i.camera.aspect_ratio.reset(); }) == "its aspect ratio is another");
    CHECK(changed([](FilmInfo& i) { i.camera.aperture_angle = 0; }).find("its aperture angle") == 0);
    CHECK(changed([](FilmInfo& i) { i.camera.focus_distance = 2; }) == "its focus distance is another");
    CHECK(changed([](FilmInfo& i) { i.camera.shutter_open = 0; }).find("its shutter") == 0);
    CHECK(changed([](FilmInfo& i) { i.camera.shutter_close = 1; }).find("its shutter") == 0);
    CHECK(changed([](FilmInfo& i) { i.antialias = true; }) == "its antialiasing is on, not off");
    CHECK(changed([](FilmInfo& i) { i.estimator = Estimator::path; }) == "its estimator is another");
    CHECK(changed([](FilmInfo& i) { i.sampler = SamplerKind::sobol; }) == "its sampler is another");
    CHECK(changed([](FilmInfo& i) { i.uniform = false; }) == "its choice of uniform sampling is off, not on");
    CHECK(changed([](FilmInfo& i) { i.scene = "other", i.features = "", i.shard = {1, 2}; }).empty());
}

TEST_CASE("Shards: each tile is in one, as many in each, and all over the picture", "[render][film][shard]") {
    for (const auto& [width, height] : {std::pair{400, 400}, {37, 500}, {1000, 17}})
        for (const int count : {1, 2, 3, 7, 16}) {
            CAPTURE(width, height, count);
            FilmInfo info = some_info(width, height);
            std::vector<int> owners(Film::tile_count(info));
            std::size_t fewest = owners.size(), most = 0;
            for (int i = 1; i <= count; ++i) {
                info.shard = {i, count};
                const Film film(info);
                CHECK(film.is_whole() == (count == 1));
                for (const std::uint32_t tile : film.tiles()) ++owners[tile];
                fewest = std::min(fewest, film.tiles().size()), most = std::max(most, film.tiles().size());
                // Wherever one looks, it has its share of the tiles: in a quarter of the columns, or of the rows.
                if (owners.size() < 40 * static_cast<std::size_t>(count)) continue;
                FilmInfo whole = info;
                whole.shard = {};
                const Film all(whole);
                for (const int quarter : {0, 1, 2, 3})
                    for (const bool by_column : {false, true}) {
                        const auto is_there = [&](std::uint32_t number) {
                            const Film::Tile t = all.tile(number);
                            return 4 * (by_column ? t.left : t.top) / (by_column ? all.width() : all.height()) ==
                                   quarter;
                        };
                        const auto mine = std::ranges::count_if(film.tiles(), is_there);
                        const auto theirs = std::ranges::count_if(all.tiles(), is_there);
                        if (theirs >= 10 * count)
                            CHECK(std::abs(static_cast<double>(mine * count) / static_cast<double>(theirs) - 1) < 0.15);
                    }
            }
            CHECK(most - fewest <= 1);
            CHECK(std::ranges::all_of(owners, [](int owner) { return owner == 1; }));
        }
    for (const Shard wrong : {Shard{0, 1}, Shard{2, 1}, Shard{1, 0}, Shard{-1, 3}, Shard{1, 7}}) {
        FilmInfo info = some_info();  // six tiles
        info.shard = wrong;
        CHECK_THROWS_AS(Film(info), ArgumentError);
    }
}

TEST_CASE("Merging: the tiles of all files, in any order, make the film that has them all",
          "[render][film-file][merge]") {
    const Folder folder;
    const Film whole = some_film(some_info(50, 70), false);
    std::vector<std::string> paths;
    for (int i = 1; i <= 5; ++i) {
        FilmInfo info = whole.info();
        info.shard = {i, 5};
        Film part(info);
        for (const std::uint32_t tile : part.tiles()) part.set_tile(tile, whole.tile_bytes(tile));
        part.plan() = whole.plan();
        part.set_seconds(0.5);
        part.save(folder.path(std::to_string(i) + ".film"));
        paths.push_back(folder.path(std::to_string(i) + ".film"));
    }
    const std::string bytes = bytes_of(folder, whole);
    std::mt19937 generator(7);
    for (int order = 0; order < 4; ++order) {
        const Film merged = Film::merge(paths);
        CHECK(merged.is_whole());
        CHECK(merged.seconds() == 2.5);
        CHECK(bytes_of(folder, merged) == bytes);
        std::ranges::shuffle(paths, generator);
    }
}

}  // namespace limn::film_file_test
