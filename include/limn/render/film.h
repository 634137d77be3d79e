/// \file
/// The sums of samples that pictures are made of, in memory and in files.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "limn/core/color.h"
#include "limn/core/hash128.h"
#include "limn/image/image.h"
#include "limn/render/settings.h"
#include "limn/scene/camera.h"

namespace limn {

/// What films must have in common to be continued and merged, but for `scene`, `features` and `shard`.
struct FilmInfo {
    std::string scene{};     ///< Scene::name
    std::string features{};  ///< CompiledScene::features
    Hash128 scene_digest{};  ///< CompiledScene::digest
    /// Of the running program's file, if the scene has user-defined objects without a tag; otherwise 0.
    Hash128 program{};
    Camera camera{};  ///< that took it
    /// As in RenderSettings.
    ///@{
    int width = 0, height = 0;
    int max_depth = 0;
    std::uint64_t seed = 0;
    bool antialias = true;
    Estimator estimator = Estimator::path;
    SamplerKind sampler = SamplerKind::sobol;
    bool uniform = false;
    std::optional<PixelBounds> crop{};
    bool transparent = false;
    Shard shard{};
    ///@}

    /// The pixels that the film has, of a picture of width x height.
    PixelBounds window() const { return crop.value_or(PixelBounds{0, 0, width, height}); }
};

/// Why a film is not of the same render as another: "its seed is 2, not 1"; empty if it is.
std::string difference(const FilmInfo& film, const FilmInfo& other);

/// How many samples each pixel is to have.
struct SamplePlan {
    /// Of each pixel in the first pass of a render. From so many on there is an estimate of the error, and they tell
    /// adaptive sampling how noisy the pixels are.
    static constexpr int kFirstPass = 8;

    int samples = 0;  ///< in the mean over the picture; 0: none yet
    /// Of the pixel at Film::place, in multiples of the mean; empty: all pixels get as many.
    std::vector<float> rates{};
    double scale = 0;  ///< samples of a pixel whose rate is 1
    /// The upper end of the error's interval where it was looked at last; NaN: never.
    double upper_error = std::numeric_limits<double>::quiet_NaN();

    /// Of the pixel in row y, column x, which stands at `place` in `rates`.
    std::uint32_t wanted(int x, int y, std::size_t place) const {
        return rates.empty() ? static_cast<std::uint32_t>(samples) : wanted(x, y, rates[place], scale);
    }
    /// By rate and scale, in whole rounds of the replicates. Never falls when the scale grows.
    static std::uint32_t wanted(int x, int y, float rate, double scale) {
        // The sequence R2 rounds up or down, evenly over the picture and for a pixel alike at every scale (Roberts, The
        // unreasonable effectiveness of quasirandom sequences, 2018).
        const std::uint32_t r2 =
            static_cast<std::uint32_t>(x) * 0xC13FA9A9u + static_cast<std::uint32_t>(y) * 0x91E10DA6u;
        const double rounds = std::min(scale * rate / 2 + r2 * 0x1p-32, 0x1p30);
        return std::max(2 * static_cast<std::uint32_t>(rounds), std::uint32_t{kFirstPass});
    }
};

/// The film of a render: sums of the samples of each pixel, in two replicates from which their error is known. Sample i
/// of a pixel belongs to replicate i mod 2. Each pixel gets its samples in order, so that the sums, in double, depend
/// on nothing else. Different pixels may be changed by different threads.
class Film {
public:
    static constexpr int kReplicates = 2;                      ///< independent of each other
    static constexpr int kTile = 16;                           ///< pixels a side
    static constexpr std::size_t kTilePixels = kTile * kTile;  ///< those beyond the picture included

    /// Black, with the tiles of its shard. \throws ArgumentError if there is no such shard, Error if memory lacks
    explicit Film(const FilmInfo& info);
    /// Of no scene in particular. \throws Error if memory lacks
    Film(int width, int height);
    /// Black, with some tiles, ascending. \throws Error if memory lacks
    Film(const FilmInfo& info, std::vector<std::uint32_t> tiles);

    /// The film in a file. \throws FileError if there is none, it is damaged or cut short, or of a version of limn
    /// whose samples are others
    static Film load(const std::string& path);
    /// The film that the tiles of all files make together, in any order; needs the memory of one film.
    /// \throws FileError, which names the files, also if they are not of one render, are unfinished, overlap, or leave
    /// tiles out; ArgumentError if there are no paths
    static Film merge(std::span<const std::string> paths);
    /// Writes the film to a file as save_image does: whole or not at all. \throws FileError
    void save(const std::string& path) const;

    const FilmInfo& info() const { return info_; }  ///< what it is a film of
    /// In pixels, of FilmInfo::window. Rows and columns below are counted within it.
    ///@{
    int width() const { return width_; }
    int height() const { return height_; }
    ///@}
    /// Whether it has all tiles of the picture.
    bool is_whole() const { return tiles_.size() == slots_.size(); }
    /// Whether each of its pixels has the samples that the plan wants.
    bool is_finished() const { return is_finished(tiles_); }
    bool is_finished(std::span<const std::uint32_t> tiles) const;  ///< the same of some of its tiles
    std::size_t memory_bytes() const;                              ///< of all that it holds

    /// A sample that is not finite counts as black; the result says whether it was finite.
    /// \param clear of the sample's light, how much came by from behind the scene; counts in a transparent film
    /// \pre it has the pixel's tile
    bool add(int x, int y, const Color& sample, double clear = 0);

    /// Of the pixel in row y, column x; black, without samples, where the film lacks the tile.
    ///@{
    std::uint32_t samples(int x, int y) const { return at(x, y).samples; }
    Color mean(int x, int y) const;  ///< of all samples, black if there is none yet
    /// The part of its samples that met something; 0 if there is none yet, 1 in a film that is not transparent.
    double alpha(int x, int y) const;
    /// Samples in replicate r, and their mean. \pre there is one
    ///@{
    std::uint32_t replicate_samples(int x, int y, std::uint32_t r) const;
    Color replicate_mean(int x, int y, std::uint32_t r) const;
    ///@}
    /// The variance of the mean, estimated without bias from the difference of the replicates: one degree of freedom.
    /// \pre each has a sample
    Color variance(int x, int y) const;
    /// The variance of the mean if all samples were independent. Sobol points are not, so it is biased, but it has n -
    /// 1 degrees of freedom instead of one. \pre there are two
    Color independent_variance(int x, int y) const;
    /// The largest share that one sample has of the pixel's luminance, 0 to 1.
    double largest_share(int x, int y) const;
    ///@}

    Image image() const;  ///< of the means
    /// The part of `image` that is a tile's. \pre the image has the film's size, and the film the tile
    void draw(std::uint32_t tile, Image& image) const;
    void draw_alpha(std::uint32_t tile, std::span<float> alpha) const;  ///< the same of `alpha`
    std::vector<float> alpha() const;      ///< row by row; empty in a film that is not transparent
    double mean_samples() const;           ///< a pixel that it has
    std::uint64_t all_samples() const;     ///< of all pixels that it has
    std::size_t own_pixels() const;        ///< that it has
    std::uint32_t fewest_samples() const;  ///< of all pixels of the picture

    /// Of a pixel in tables that go row by row, and how many there are.
    ///@{
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    std::size_t pixels() const { return index(0, height_); }
    ///@}
    /// The same in tables that go tile by tile, over those that it has, 256 places for each.
    ///@{
    std::size_t place(int x, int y) const {
        const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
        return slots_[row / kTile * across_ + column / kTile] * kTilePixels + row % kTile * kTile + column % kTile;
    }
    std::size_t places() const { return tiles_.size() * kTilePixels; }
    ///@}

    /// How many samples its pixels are to have, and the seconds that its samples took, for whoever adds them.
    ///@{
    const SamplePlan& plan() const { return plan_; }
    SamplePlan& plan() { return plan_; }
    /// Takes the rates of its tiles from a table for `tiles`, ascending.
    void set_rates(std::span<const std::uint32_t> tiles, std::span<const float> rates);
    double seconds() const { return seconds_; }
    void set_seconds(double seconds) { seconds_ = seconds; }
    ///@}

    /// What was traced for a tile.
    struct Counts {
        std::uint64_t rays = 0;                   ///< camera, scattered and shadow rays
        std::uint64_t unusable_rays = 0;          ///< of these
        std::uint64_t nonfinite = 0;              ///< samples
        Counts& operator+=(const Counts& other);  ///< the sums
    };
    using Tile = PixelBounds;                                                              ///< of the film
    static Tile tile(const FilmInfo& info, std::uint32_t number);                          ///< by its index, row by row
    Tile tile(std::uint32_t number) const { return tile(info_, number); }                  ///< the same
    static std::uint32_t tile_count(const FilmInfo& info);                                 ///< of all its window
    std::span<const std::uint32_t> tiles() const { return tiles_; }                        ///< that it has, ascending
    bool has(std::uint32_t tile) const { return slots_[tile] < tiles_.size(); }            ///< whether it has the tile
    void count(std::uint32_t tile, const Counts& more) { counts_[slots_[tile]] += more; }  ///< \pre it has the tile
    Counts counts() const;                                                                 ///< of all its tiles

    /// A tile as a file holds it, and how long that is. `set_tile` takes what `tile_bytes` gave. \pre it has the tile
    ///@{
    static std::size_t tile_size(const FilmInfo& info) { return kTileBytes + (info.transparent ? kClearBytes : 0); }
    std::vector<std::byte> tile_bytes(std::uint32_t tile) const;
    void set_tile(std::uint32_t tile, std::span<const std::byte> bytes);
    ///@}

private:
    struct Pixel {
        std::array<Color, kReplicates> sums;
        Color squares;      // sum of the squares of the samples
        float largest = 0;  // luminance of the brightest sample
        std::uint32_t samples = 0;
    };
    const Pixel& at(int x, int y) const { return pixels_[place(x, y)]; }
    static constexpr std::size_t kTileBytes = 24 + 80 * kTilePixels, kClearBytes = 8 * kTilePixels;

    FilmInfo info_;
    int width_ = 0, height_ = 0;        // of the window
    std::size_t across_ = 0;            // tiles in a row
    std::vector<std::uint32_t> tiles_;  // that it has, ascending
    std::vector<std::uint32_t> slots_;  // of each tile of the picture: its place in tiles_, or tiles_.size()
    std::vector<Pixel> pixels_;         // tile by tile, and one that stays black
    std::vector<double> clear_;         // of a transparent film, as pixels_: what was not met by its samples
    std::vector<Counts> counts_;        // tile by tile
    SamplePlan plan_;
    double seconds_ = 0;
};

/// Whether a file begins as films do.
bool is_film_file(const std::string& path);

}  // namespace limn
