#include "limn/render/film.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>
#include <type_traits>
#include <utility>

#include "limn/math/error.h"

namespace limn {

namespace {

// Returns the number of tiles that cover a side of that many pixels.
std::uint32_t tiles_along(int pixels) { return static_cast<std::uint32_t>((pixels + Film::kTile - 1) / Film::kTile); }

Error too_large(const FilmInfo& info) {
    return Error("render: not enough memory for a picture of " + std::to_string(info.width) + " x " +
                 std::to_string(info.height));
}

// Returns the g for which the nearest points of the lattice {(x, y): x + g y = 0 modulo n} are farthest apart (Dammertz
// and Keller, Image synthesis by rank-1 lattices, 2008). Only g < kMostTried are tried, which is enough for any n.
std::int64_t lattice_generator(std::int64_t n) {
    constexpr std::int64_t kMostTried = 1024;
    std::int64_t best = 1, farthest = 0;
    for (std::int64_t g = 1; g < std::min(n, kMostTried); ++g) {
        // Find the squared distance of the lattice point nearest to the origin.
        std::int64_t nearest = n * n;
        for (std::int64_t y = 1; y * y < nearest && y <= n; ++y) {
            const std::int64_t x = n - g * y % n, across = std::min(x, n - x);
            nearest = std::min(nearest, across * across + y * y);
        }
        if (std::gcd(g, n) == 1 && nearest > farthest) {
            best = g;
            farthest = nearest;
        }
    }
    return best;
}

// Returns the tiles of the shard, ascending. All tiles are sorted by the cosets of a lattice. A shard is a run of this
// order. It is about as long as a coset, so its tiles are spread evenly over the picture.
std::vector<std::uint32_t> tiles_of(const FilmInfo& info) {
    const Shard& shard = info.shard;
    const std::uint32_t across = tiles_along(info.window().width()), all = Film::tile_count(info);
    if (shard.index < 1 || shard.index > shard.count || static_cast<std::uint32_t>(shard.count) > all)
        throw ArgumentError("render: there is no shard " + std::to_string(shard.index) + " of " +
                            std::to_string(shard.count) + " of a picture of " + std::to_string(all) + " tiles");
    std::vector<std::uint32_t> order(all);
    std::iota(order.begin(), order.end(), 0u);
    if (shard.count == 1) return order;
    const std::int64_t generator = lattice_generator(shard.count);
    const auto by_coset = [&](std::uint32_t t) {
        return std::pair((t % across + generator * (t / across)) % shard.count, t);
    };
    std::ranges::sort(order, {}, by_coset);
    const auto begin_of = [&](int i) { return static_cast<std::ptrdiff_t>(std::int64_t{i} * all / shard.count); };
    std::vector<std::uint32_t> some(order.begin() + begin_of(shard.index - 1), order.begin() + begin_of(shard.index));
    std::ranges::sort(some);
    return some;
}

FilmInfo of_size(int width, int height) {
    FilmInfo info;
    info.width = width;
    info.height = height;
    return info;
}

}  // namespace

Film::Film(const FilmInfo& info, std::vector<std::uint32_t> tiles)
    : info_(info),
      width_(info.window().width()),
      height_(info.window().height()),
      across_(tiles_along(width_)),
      tiles_(std::move(tiles)) {
    const std::uint32_t all = tile_count(info_);
    try {
        slots_.assign(all, static_cast<std::uint32_t>(tiles_.size()));
        for (std::uint32_t i = 0; i < tiles_.size(); ++i) slots_[tiles_[i]] = i;
        pixels_.resize((tiles_.size() + 1) * kTilePixels);
        if (info_.transparent) clear_.resize(pixels_.size());
        counts_.resize(tiles_.size());
    } catch (const std::bad_alloc&) {
        throw too_large(info_);
    }
}

Film::Film(const FilmInfo& info) : Film(info, tiles_of(info)) {}
Film::Film(int width, int height) : Film(of_size(width, height)) {}

bool Film::is_finished(std::span<const std::uint32_t> tiles) const {
    for (const std::uint32_t number : tiles) {
        const Tile t = tile(number);
        for (int y = t.top; y < t.bottom; ++y)
            for (int x = t.left; x < t.right; ++x)
                if (samples(x, y) < plan_.wanted(x, y, place(x, y))) return false;
    }
    return true;
}

std::size_t Film::memory_bytes() const {
    return pixels_.size() * sizeof(Pixel) + clear_.size() * sizeof(double) + counts_.size() * sizeof(Counts) +
           (tiles_.size() + slots_.size()) * sizeof(std::uint32_t) + plan_.rates.size() * sizeof(float);
}

bool Film::add(int x, int y, const Color& sample, double clear) {
    const std::size_t i = place(x, y);
    Pixel& p = pixels_[i];
    const std::uint32_t replicate = p.samples++ % kReplicates;
    if (!is_finite(sample)) return false;
    p.sums[replicate] += sample;
    p.squares += sample * sample;
    const double kLargest = std::numeric_limits<float>::max();
    p.largest = std::max(p.largest, static_cast<float>(std::min(luminance(sample), kLargest)));
    if (!clear_.empty()) clear_[i] += clear;
    return true;
}

double Film::alpha(int x, int y) const {
    const std::uint32_t count = samples(x, y);
    if (count == 0) return 0;
    return clear_.empty() ? 1 : 1 - clear_[place(x, y)] / count;
}

Color Film::mean(int x, int y) const {
    const Pixel& p = at(x, y);
    if (p.samples == 0) return {};
    Color sum;
    for (const Color& c : p.sums) sum += c;
    return sum / p.samples;
}

std::uint32_t Film::replicate_samples(int x, int y, std::uint32_t r) const {
    const std::uint32_t all = at(x, y).samples;
    return all / kReplicates + (r < all % kReplicates ? 1 : 0);
}

Color Film::replicate_mean(int x, int y, std::uint32_t r) const {
    return at(x, y).sums[r] / replicate_samples(x, y, r);
}

Color Film::variance(int x, int y) const {
    static_assert(kReplicates == 2);
    const double n = samples(x, y), first = replicate_samples(x, y, 0), second = replicate_samples(x, y, 1);
    const Color difference = replicate_mean(x, y, 0) - replicate_mean(x, y, 1);
    return difference * difference / (n * (1 / first + 1 / second));
}

Color Film::independent_variance(int x, int y) const {
    const Pixel& p = at(x, y);
    const double n = p.samples;
    const Color m = mean(x, y), about_mean = p.squares / n - m * m;
    const auto positive = [](double v) { return std::max(0.0, v); };  // rounding may make the difference negative
    return Color{positive(about_mean.r), positive(about_mean.g), positive(about_mean.b)} / (n - 1);
}

double Film::largest_share(int x, int y) const {
    const double sum = luminance(mean(x, y)) * samples(x, y);
    return sum > 0 ? std::min(1.0, at(x, y).largest / sum) : 0;
}

Image Film::image() const {
    Image image(width(), height());
    for (const std::uint32_t number : tiles_) draw(number, image);
    return image;
}

void Film::draw(std::uint32_t number, Image& image) const {
    const Tile t = tile(number);
    for (int y = t.top; y < t.bottom; ++y)
        for (int x = t.left; x < t.right; ++x) image.set(x, y, mean(x, y));
}

std::vector<float> Film::alpha() const {
    std::vector<float> alpha(clear_.empty() ? 0 : pixels());
    if (!alpha.empty())
        for (const std::uint32_t number : tiles_) draw_alpha(number, alpha);
    return alpha;
}

void Film::draw_alpha(std::uint32_t number, std::span<float> all) const {
    const Tile t = tile(number);
    for (int y = t.top; y < t.bottom; ++y)
        for (int x = t.left; x < t.right; ++x) all[index(x, y)] = static_cast<float>(alpha(x, y));
}

double Film::mean_samples() const { return static_cast<double>(all_samples()) / static_cast<double>(own_pixels()); }

std::uint64_t Film::all_samples() const {
    std::uint64_t sum = 0;
    for (const Pixel& p : pixels_) sum += p.samples;
    return sum;
}

std::size_t Film::own_pixels() const {
    std::size_t count = 0;
    for (const std::uint32_t number : tiles_) {
        const Tile t = tile(number);
        count += static_cast<std::size_t>(t.right - t.left) * static_cast<std::size_t>(t.bottom - t.top);
    }
    return count;
}

std::uint32_t Film::fewest_samples() const {
    if (!is_whole()) return 0;
    std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
    for (int y = 0; y < height(); ++y)
        for (int x = 0; x < width(); ++x) fewest = std::min(fewest, samples(x, y));
    return fewest;
}

void Film::set_rates(std::span<const std::uint32_t> tiles, std::span<const float> rates) {
    if (rates.size() != tiles.size() * kTilePixels) throw ArgumentError("film: rates of other tiles");
    plan_.rates.resize(places());
    for (std::size_t i = 0; i < tiles.size(); ++i)
        if (has(tiles[i]))
            std::ranges::copy(rates.subspan(i * kTilePixels, kTilePixels),
                              &plan_.rates[slots_[tiles[i]] * kTilePixels]);
}

Film::Counts& Film::Counts::operator+=(const Counts& other) {
    rays += other.rays;
    unusable_rays += other.unusable_rays;
    nonfinite += other.nonfinite;
    return *this;
}

Film::Counts Film::counts() const {
    Counts sum;
    for (const Counts& c : counts_) sum += c;
    return sum;
}

std::uint32_t Film::tile_count(const FilmInfo& info) {
    constexpr std::uint64_t kMost = 1 << 24;
    const PixelBounds window = info.window();
    const std::uint64_t count = std::uint64_t{tiles_along(window.width())} * tiles_along(window.height());
    if (count > kMost) throw too_large(info);
    return static_cast<std::uint32_t>(count);
}

Film::Tile Film::tile(const FilmInfo& info, std::uint32_t number) {
    const int width = info.window().width(), height = info.window().height();
    const std::uint32_t across = tiles_along(width);
    const int left = static_cast<int>(number % across) * kTile, top = static_cast<int>(number / across) * kTile;
    return {left, top, std::min(left + kTile, width), std::min(top + kTile, height)};
}

std::vector<std::byte> Film::tile_bytes(std::uint32_t number) const {
    static_assert(std::is_trivially_copyable_v<Pixel> && kTileBytes == sizeof(Counts) + kTilePixels * sizeof(Pixel));
    std::vector<std::byte> bytes(tile_size(info_));
    const std::size_t place = slots_[number] * kTilePixels;
    std::memcpy(bytes.data(), &counts_[slots_[number]], sizeof(Counts));
    std::memcpy(&bytes[sizeof(Counts)], &pixels_[place], kTilePixels * sizeof(Pixel));
    if (!clear_.empty()) std::memcpy(&bytes[kTileBytes], &clear_[place], kClearBytes);
    return bytes;
}

void Film::set_tile(std::uint32_t number, std::span<const std::byte> bytes) {
    if (bytes.size() != tile_size(info_)) throw ArgumentError("film: a tile of another size");
    const std::size_t place = slots_[number] * kTilePixels;
    std::memcpy(&counts_[slots_[number]], bytes.data(), sizeof(Counts));
    std::memcpy(&pixels_[place], &bytes[sizeof(Counts)], kTilePixels * sizeof(Pixel));
    if (!clear_.empty()) std::memcpy(&clear_[place], &bytes[kTileBytes], kClearBytes);
}

}  // namespace limn
