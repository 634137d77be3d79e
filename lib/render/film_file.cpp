#include "render/film_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <type_traits>

#include "limn/math/error.h"
#include "math/system/checksum.h"
#include "math/system/read_file.h"
#include "render/film_fields.h"

namespace limn::transport {

namespace {

constexpr ChunkFormat kFilms{"film", "limnfilm", "filmlimn"};
constexpr std::uint32_t kFormat = 4;
constexpr std::array kVersions = {kFormat, kSampleVersion};

// The largest stored value of an enumeration or bool.
template <class T>
constexpr std::uint8_t kLast = 1;
template <>
constexpr std::uint8_t kLast<Projection> = static_cast<std::uint8_t>(Projection::panorama);

template <class T>
constexpr bool kIsPlain = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

// Values as the bytes of a chunk: numbers as they are in memory, a bool or an enumeration as one byte, a string as its
// length (uint64) and its characters, everything else part by part (each_part).
class Bytes {
public:
    template <class T>
    void put(const T& value) {
        if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
            put(static_cast<std::uint8_t>(value));
        } else if constexpr (std::is_same_v<T, std::string>) {
            put(std::uint64_t{value.size()});
            append(std::as_bytes(std::span(value)));
        } else if constexpr (kIsPlain<T>) {
            append(std::as_bytes(std::span(&value, 1)));
        } else {
            each_part(value, [this](const auto& part) { this->put(part); });
        }
    }
    void append(std::span<const std::byte> more) {
        bytes_.resize(bytes_.size() + more.size());
        std::ranges::copy(more, bytes_.end() - static_cast<std::ptrdiff_t>(more.size()));
    }
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

// Reads values that Bytes wrote. If a value is impossible or the bytes end early, it calls damaged(), which must throw.
template <class Damaged>
class Parser {
public:
    Parser(std::span<const std::byte> bytes, const Damaged& damaged) : rest_(bytes), damaged_(damaged) {}

    template <class T>
    T get() {
        T value;
        get(value);
        return value;
    }
    template <class T>
    void get(T& value) {
        if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
            const auto number = get<std::uint8_t>();
            if (number > kLast<T>) damaged_();
            value = static_cast<T>(number);
        } else if constexpr (std::is_same_v<T, std::string>) {
            const std::span text = take(get<std::uint64_t>());
            value.assign(reinterpret_cast<const char*>(text.data()), text.size());
        } else if constexpr (kIsPlain<T>) {
            std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        } else {
            each_part(value, [this](auto& part) { this->get(part); });
        }
    }
    std::span<const std::byte> take(std::uint64_t count) {
        if (count > rest_.size()) damaged_();
        const auto taken = rest_.first(static_cast<std::size_t>(count));
        rest_ = rest_.subspan(taken.size());
        return taken;
    }
    std::span<const std::byte> rest() const { return rest_; }

private:
    std::span<const std::byte> rest_;
    const Damaged& damaged_;
};

// The size of the plan's chunk: samples, scale, upper_error, the seconds and a flag that says if rates follow.
constexpr std::uint64_t kPlanBytes = 4 + 8 + 8 + 8 + 1;

}  // namespace

bool is_window(const FilmInfo& info) {
    const auto [left, top, right, bottom] = info.window();
    return 0 <= left && left < right && right <= info.width && 0 <= top && top < bottom && bottom <= info.height;
}

// ---- writing -------------------------------------------------------------------------------------------------------

FilmWriter::FilmWriter(const std::string& path, const Film& film, FilmContent content)
    : file_(path, kFilms, kVersions) {
    Bytes header;
    header.put(content);
    each_field(film.info(), film.info(), [&](const char*, const auto& field, const auto&) { header.put(field); });
    header.append(std::as_bytes(film.tiles()));
    file_.chunk(header.bytes());
}

void FilmWriter::finish(const SamplePlan& plan, std::span<const float> rates, double seconds) {
    Bytes scalars;
    scalars.put(std::int32_t{plan.samples});
    scalars.put(plan.scale);
    scalars.put(plan.upper_error);
    scalars.put(seconds);
    scalars.put(!rates.empty());
    file_.chunk(scalars.bytes());
    if (!rates.empty()) file_.chunk(std::as_bytes(rates));
    file_.finish();
}

// ---- reading -------------------------------------------------------------------------------------------------------

FilmReader::FilmReader(const std::string& path, FilmContent content) : file_(path, kFilms, versions_) {
    if (versions_[0] != kFormat)
        fail("is a film of format " + std::to_string(versions_[0]) + "; this version of limn reads format " +
             std::to_string(kFormat));
    if (versions_[1] != kSampleVersion)
        fail("is of a version of limn whose samples are others (" + std::to_string(versions_[1]) + ", not " +
             std::to_string(kSampleVersion) + "): they cannot be brought together with those of this one");
    read_header(content);
}

void FilmReader::read_header(FilmContent content) {
    // Read the content, the FilmInfo and the numbers of the tiles.
    const std::vector<std::byte> bytes = file_.chunk("its header", 1);
    const auto damaged = [this] { file_.fail_damaged("its header"); };
    Parser header(bytes, damaged);
    if (header.get<FilmContent>() != content)
        fail(content == FilmContent::film ? "is a plan, not a film" : "is a film, not a plan");
    each_field(info_, info_, [&](const char*, auto& field, const auto&) { header.get(field); });
    const std::span rest = header.rest();
    if (rest.empty() || rest.size() % sizeof(std::uint32_t) != 0) damaged();
    tiles_.resize(rest.size() / sizeof(std::uint32_t));
    std::memcpy(tiles_.data(), rest.data(), rest.size());

    // Check that the picture, the window, the shard and the tiles are possible.
    const auto in_range = [](int side) { return side > 0 && side <= kMaxSide; };
    const Shard& shard = info_.shard;
    if (!in_range(info_.width) || !in_range(info_.height) || !is_window(info_)) damaged();
    std::uint32_t tiles = 0;
    try {
        tiles = Film::tile_count(info_);
    } catch (const Error&) {  // a film cannot have that many tiles
        damaged();
    }
    if (shard.index < 1 || shard.index > shard.count || static_cast<std::uint32_t>(shard.count) > tiles ||
        std::ranges::adjacent_find(tiles_, std::ranges::greater_equal{}) != tiles_.end() || tiles_.back() >= tiles)
        damaged();

    // Check that the file is long enough for its tiles before memory for them is allocated.
    if (content == FilmContent::film && tiles_.size() > file_.left() / Film::tile_size(info_)) fail("is cut short");
}

void FilmReader::read_tiles(Film& film) {
    for (const std::uint32_t tile : tiles_) {
        const std::size_t size = Film::tile_size(info_);
        const std::vector<std::byte> bytes = file_.chunk("a tile", size, size);
        if (film.has(tile)) film.set_tile(tile, bytes);
    }
}

SamplePlan FilmReader::finish() {
    // Read the plan.
    const std::vector<std::byte> bytes = file_.chunk("its plan", kPlanBytes, kPlanBytes);
    const auto damaged = [this] { file_.fail_damaged("its plan"); };
    Parser scalars(bytes, damaged);
    SamplePlan plan;
    bool has_rates = false;
    plan.samples = scalars.get<std::int32_t>();
    scalars.get(plan.scale);
    scalars.get(plan.upper_error);
    scalars.get(seconds_);
    scalars.get(has_rates);
    if (plan.samples < 0 || !(plan.scale >= 0 && std::isfinite(plan.scale))) damaged();

    // Read the rates.
    if (has_rates) {
        const std::uint64_t size = tiles_.size() * Film::kTilePixels * sizeof(float);
        const std::vector<std::byte> rates = file_.chunk("its rates", size, size);
        plan.rates.resize(tiles_.size() * Film::kTilePixels);
        std::memcpy(plan.rates.data(), rates.data(), rates.size());
        if (!std::ranges::all_of(plan.rates, [](float rate) { return rate >= 0 && std::isfinite(rate); }))
            file_.fail_damaged("its rates");
    }
    file_.finish();
    return plan;
}

}  // namespace limn::transport

namespace limn {

bool is_film_file(const std::string& path) { return is_chunk_file(path, transport::kFilms); }

}  // namespace limn
