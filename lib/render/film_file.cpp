#include "render/film_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <type_traits>

#include "core/checksum.h"
#include "core/read_file.h"
#include "limn/core/error.h"
#include "render/film_fields.h"

namespace limn::transport {

namespace {

static_assert(std::endian::native == std::endian::little, "films are written as they lie in memory");

constexpr std::string_view kBegin = "limnfilm", kEnd = "filmlimn";
constexpr std::uint32_t kFormat = 1;

template <class T>
constexpr bool kIsPlain = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

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

// Reads what Bytes wrote. `damaged` is called where that cannot be, and throws.
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
            if (number > 1) damaged_();  // enumerations have two values
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

// The bytes of the plan's chunk.
constexpr std::uint64_t kPlanBytes = 4 + 8 + 8 + 8 + 1;

}  // namespace

// ---- writing -------------------------------------------------------------------------------------------------------

FilmWriter::FilmWriter(const std::string& path, const Film& film, FilmContent content) : film_(film), file_(path) {
    write(std::as_bytes(std::span(kBegin)));
    const std::array versions = {kFormat, kSampleVersion};
    write(std::as_bytes(std::span(versions)));
    Bytes header;
    header.put(content);
    each_field(film.info(), film.info(), [&](const char*, const auto& field, const auto&) { header.put(field); });
    header.append(std::as_bytes(film.tiles()));
    chunk(header.bytes());
}

void FilmWriter::finish(const SamplePlan& plan, std::span<const float> rates, double seconds) {
    Bytes scalars;
    scalars.put(std::int32_t{plan.samples});
    scalars.put(plan.scale);
    scalars.put(plan.upper_error);
    scalars.put(seconds);
    scalars.put(!rates.empty());
    chunk(scalars.bytes());
    if (!rates.empty()) chunk(std::as_bytes(rates));
    const std::uint64_t length = length_;
    write(std::as_bytes(std::span(&length, 1)));
    write(std::as_bytes(std::span(kEnd)));
    file_.commit();
}

void FilmWriter::chunk(std::span<const std::byte> bytes) {
    const std::uint64_t length = bytes.size(), sum = checksum(bytes);
    write(std::as_bytes(std::span(&length, 1)));
    write(bytes);
    write(std::as_bytes(std::span(&sum, 1)));
}

void FilmWriter::write(std::span<const std::byte> bytes) {
    file_.write(bytes);
    length_ += bytes.size();
}

// ---- reading -------------------------------------------------------------------------------------------------------

FilmReader::FilmReader(const std::string& path, FilmContent content) : path_(path) {
    require_readable(path);
    file_.open(path, std::ios::binary);
    size_ = std::filesystem::file_size(path);
    char begin[kBegin.size()] = {};
    const auto known = static_cast<std::size_t>(std::min<std::uint64_t>(size_, kBegin.size()));
    read(std::as_writable_bytes(std::span(begin)).first(known));
    if (std::string_view(begin, known) != kBegin.substr(0, known) || known == 0) fail("is not a film");
    std::array<std::uint32_t, 2> versions = {};
    read(std::as_writable_bytes(std::span(versions)));
    if (versions[0] != kFormat)
        fail("is a film of format " + std::to_string(versions[0]) + "; this version of limn reads format " +
             std::to_string(kFormat));
    if (versions[1] != kSampleVersion)
        fail("is of a version of limn whose samples are others (" + std::to_string(versions[1]) + ", not " +
             std::to_string(kSampleVersion) + "): they cannot be brought together with those of this one");
    read_header(content);
}

void FilmReader::read_header(FilmContent content) {
    const std::vector<std::byte> bytes = chunk("its header", 1, std::numeric_limits<std::uint64_t>::max());
    const auto damaged = [this] { fail_damaged("its header"); };
    Parser header(bytes, damaged);
    if (header.get<FilmContent>() != content)
        fail(content == FilmContent::film ? "is a plan, not a film" : "is a film, not a plan");
    each_field(info_, info_, [&](const char*, auto& field, const auto&) { header.get(field); });
    const std::span rest = header.rest();
    if (rest.empty() || rest.size() % sizeof(std::uint32_t) != 0) damaged();
    tiles_.resize(rest.size() / sizeof(std::uint32_t));
    std::memcpy(tiles_.data(), rest.data(), rest.size());
    const auto in_range = [](int side) { return side > 0 && side <= kMaxSide; };
    const Shard& shard = info_.shard;
    if (!in_range(info_.width) || !in_range(info_.height) || shard.index < 1 || shard.index > shard.count ||
        static_cast<std::uint32_t>(shard.count) > Film::tile_count(info_) ||
        std::ranges::adjacent_find(tiles_, std::ranges::greater_equal{}) != tiles_.end() ||
        tiles_.back() >= Film::tile_count(info_))
        damaged();
}

void FilmReader::read_tiles(Film& film) {
    for (const std::uint32_t tile : tiles_) {
        const std::vector<std::byte> bytes = chunk("a tile", Film::kTileBytes, Film::kTileBytes);
        if (film.has(tile)) film.set_tile(tile, std::span<const std::byte, Film::kTileBytes>(bytes));
    }
}

SamplePlan FilmReader::finish() {
    const std::vector<std::byte> bytes = chunk("its plan", kPlanBytes, kPlanBytes);
    const auto damaged = [this] { fail_damaged("its plan"); };
    Parser scalars(bytes, damaged);
    SamplePlan plan;
    bool has_rates = false;
    plan.samples = scalars.get<std::int32_t>();
    scalars.get(plan.scale), scalars.get(plan.upper_error), scalars.get(seconds_), scalars.get(has_rates);
    if (plan.samples < 0 || !(plan.scale >= 0)) damaged();
    if (has_rates) {
        const std::uint64_t size = tiles_.size() * Film::kTilePixels * sizeof(float);
        const std::vector<std::byte> rates = chunk("its rates", size, size);
        plan.rates.resize(tiles_.size() * Film::kTilePixels);
        std::memcpy(plan.rates.data(), rates.data(), rates.size());
        if (!std::ranges::all_of(plan.rates, [](float rate) { return rate >= 0; })) fail_damaged("its rates");
    }
    const std::uint64_t length = position_;
    std::uint64_t said = 0;
    char end[kEnd.size()] = {};
    read(std::as_writable_bytes(std::span(&said, 1)));
    read(std::as_writable_bytes(std::span(end)));
    if (said != length || std::string_view(end, kEnd.size()) != kEnd || left() > 0) fail_damaged("its end");
    return plan;
}

std::vector<std::byte> FilmReader::chunk(const char* what, std::uint64_t least, std::uint64_t most) {
    std::uint64_t length = 0, sum = 0;
    read(std::as_writable_bytes(std::span(&length, 1)));
    if (length < least || length > most) fail_damaged(what);
    if (length > left()) fail("is cut short");
    std::vector<std::byte> bytes(static_cast<std::size_t>(length));
    read(bytes);
    read(std::as_writable_bytes(std::span(&sum, 1)));
    if (sum != checksum(bytes)) fail_damaged(what);
    return bytes;
}

void FilmReader::read(std::span<std::byte> to) {
    if (to.size() > left()) fail("is cut short");
    if (!file_.read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size())))
        fail("reading failed");
    position_ += to.size();
}

void FilmReader::fail(const std::string& problem) const { throw FileError(path_, problem); }

}  // namespace limn::transport

namespace limn {

bool is_film_file(const std::string& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) return false;
    char begin[transport::kBegin.size()] = {};
    std::ifstream(path, std::ios::binary).read(begin, sizeof begin);
    return std::string_view(begin, sizeof begin) == transport::kBegin;
}

}  // namespace limn
