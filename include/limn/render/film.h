/// \file
/// Films: the sums of the samples of a picture, in memory and in files.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "limn/image/image.h"
#include "limn/math/color.h"
#include "limn/math/hash128.h"
#include "limn/render/settings.h"
#include "limn/scene/camera.h"

namespace limn {

/// The render that a film belongs to. A film can be continued by a render, or merged with other films, if all fields
/// are equal except `scene`, `features` and `shard`.
struct FilmInfo {
    std::string scene{};     ///< Scene::name
    std::string features{};  ///< CompiledScene::features
    Hash128 scene_digest{};  ///< CompiledScene::digest
    /// The digest of the running program's file if the scene has user-defined objects without a tag, else 0.
    Hash128 program{};
    Camera camera{};  ///< the camera of the render
    /// The settings of the same names in RenderSettings.
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

    /// Returns the pixels of the film within the picture of width x height: the crop window, or all pixels.
    PixelBounds window() const { return crop.value_or(PixelBounds{0, 0, width, height}); }
};

/// Returns the first difference between the renders of two films, such as "its seed is 2, not 1". Returns an empty
/// string if the films belong to the same render.
std::string difference(const FilmInfo& film, const FilmInfo& other);

/// The number of samples that each pixel is to have.
struct SamplePlan {
    /// The number of samples of each pixel in the first pass of a render. The error can be estimated from this number
    /// on. Adaptive sampling takes the noise of the pixels from the first pass.
    static constexpr int kFirstPass = 8;

    int samples = 0;  ///< mean number of samples per pixel; 0 before the first pass
    /// The number of samples of each pixel relative to the mean, by Film::place. If it is empty, all pixels get the
    /// same number.
    std::vector<float> rates{};
    double scale = 0;  ///< number of samples of a pixel whose rate is 1
    /// The upper end of the error's 95 % interval at the last milestone: a number of samples at which renders to any
    /// target check their error. It is infinity if there was no estimate, and NaN before the first milestone.
    double upper_error = std::numeric_limits<double>::quiet_NaN();

    /// Returns the number of samples that the pixel in column x, row y is to have. `place` is its index in `rates`.
    std::uint32_t wanted(int x, int y, std::size_t place) const {
        return rates.empty() ? static_cast<std::uint32_t>(samples) : wanted(x, y, rates[place], scale);
    }
    /// Returns the number of samples for a rate and a scale. It is a multiple of the number of replicates, at least
    /// kFirstPass, and never falls when the scale grows.
    static std::uint32_t wanted(int x, int y, float rate, double scale) {
        // Round up or down by the sequence R2. Its numbers are even over the picture, and a pixel has the same number
        // at every scale (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
        const std::uint32_t r2 =
            static_cast<std::uint32_t>(x) * 0xC13FA9A9u + static_cast<std::uint32_t>(y) * 0x91E10DA6u;
        const double rounds = std::min(scale * rate / 2 + r2 * 0x1p-32, 0x1p30);
        return std::max(2 * static_cast<std::uint32_t>(rounds), std::uint32_t{kFirstPass});
    }
};

/// The film of a render. It has the sums of the samples of each pixel, in two replicates whose difference gives the
/// error. Sample i of a pixel belongs to replicate i mod 2. Each pixel gets its samples in order, so the sums, in
/// double, don't depend on the threads. Threads may change different pixels at the same time.
class Film {
public:
    static constexpr int kReplicates = 2;  ///< number of independent replicates
    static constexpr int kTile = 16;       ///< width and height of a tile in pixels
    /// The number of pixels in a tile. It includes those beyond the border of the picture.
    static constexpr std::size_t kTilePixels = kTile * kTile;

    /// Makes a black film with the tiles of `info.shard`.
    /// \throws ArgumentError if there is no such shard, Error if there is not enough memory
    explicit Film(const FilmInfo& info);
    /// Makes a black film that belongs to no scene. \throws Error if there is not enough memory
    Film(int width, int height);
    /// Makes a black film with the given tiles, in ascending order. \throws Error if there is not enough memory
    Film(const FilmInfo& info, std::vector<std::uint32_t> tiles);

    /// Reads a film.
    /// \throws FileError if the file is missing, damaged, truncated or isn't a film, or if it is from a version of limn
    /// that has another format or other samples
    static Film load(const std::string& path);
    /// Reads films whose tiles together make the whole picture, and returns the whole film. The order of the files does
    /// not matter. The function needs the memory of one film.
    /// \throws FileError that names the files, as `load` does, and if they don't belong to one render, are unfinished,
    /// share tiles or lack tiles
    /// \throws ArgumentError if `paths` is empty
    static Film merge(std::span<const std::string> paths);
    /// Writes the film to a file, whole or not at all, as save_image does. \throws FileError that names the file
    void save(const std::string& path) const;

    const FilmInfo& info() const { return info_; }  ///< returns the render that the film belongs to
    /// Return the size of FilmInfo::window in pixels. Columns and rows in the functions below are counted within the
    /// window.
    ///@{
    int width() const { return width_; }
    int height() const { return height_; }
    ///@}
    /// Returns true if the film has all tiles of the picture.
    bool is_whole() const { return tiles_.size() == slots_.size(); }
    /// Returns true if each pixel of the film has as many samples as the plan says.
    bool is_finished() const { return is_finished(tiles_); }
    /// Returns true if each pixel of the given tiles has as many samples as the plan says. \pre the film has the tiles
    bool is_finished(std::span<const std::uint32_t> tiles) const;
    std::size_t memory_bytes() const;  ///< returns the memory of the film

    /// Adds a sample to the pixel in column x, row y. Returns false if the sample is not finite; it then counts as
    /// black and opaque.
    /// \param x,y column and row of the pixel
    /// \param sample the radiance of the sample
    /// \param clear the share of the sample that is background seen past the scene, 0 to 1. The radiance of that
    /// background is not part of `sample`. A film that is not transparent ignores the share.
    /// \pre the film has the pixel's tile
    bool add(int x, int y, const Color& sample, double clear = 0);

    /// Return a property of the pixel in column x, row y. A pixel whose tile the film lacks is black and has no
    /// samples.
    ///@{
    std::uint32_t samples(int x, int y) const { return at(x, y).samples; }
    Color mean(int x, int y) const;  ///< returns the mean of all samples; black if there are none
    /// Returns the share of the pixel that is not background, 0 to 1. It is 0 if there are no samples, else 1 in a film
    /// that is not transparent.
    double alpha(int x, int y) const;
    /// Return the number of samples in replicate r, and their mean. \pre for the mean: the replicate has a sample
    ///@{
    std::uint32_t replicate_samples(int x, int y, std::uint32_t r) const;
    Color replicate_mean(int x, int y, std::uint32_t r) const;
    ///@}
    /// Returns the variance of the mean, estimated from the difference of the replicates. The estimate is unbiased and
    /// has one degree of freedom.
    /// \pre each replicate has a sample
    Color variance(int x, int y) const;
    /// Returns the variance that the mean of n independent samples would have. It has n - 1 degrees of freedom. It is
    /// biased, because Sobol points are not independent.
    /// \pre the pixel has two samples
    Color independent_variance(int x, int y) const;
    /// Returns the largest share that one sample has in the luminance of the pixel, 0 to 1.
    double largest_share(int x, int y) const;
    ///@}

    Image image() const;  ///< returns the means of all pixels
    /// Writes the means of a tile's pixels into an image. \pre the image has the film's size, and the film has the tile
    void draw(std::uint32_t tile, Image& image) const;
    /// Writes the alpha of a tile's pixels into a table of all pixels, row by row. \pre the film has the tile
    void draw_alpha(std::uint32_t tile, std::span<float> alpha) const;
    std::vector<float> alpha() const;   ///< returns all alpha values, row by row; empty if the film is not transparent
    double mean_samples() const;        ///< returns the mean number of samples over the pixels of the film's tiles
    std::uint64_t all_samples() const;  ///< returns the number of all samples
    std::size_t own_pixels() const;     ///< returns the number of pixels in the film's tiles
    /// Returns the lowest number of samples of a pixel; 0 if the film lacks tiles.
    std::uint32_t fewest_samples() const;

    /// Return the index of a pixel in a table of all pixels row by row, and the size of such a table.
    ///@{
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    std::size_t pixels() const { return index(0, height_); }
    ///@}
    /// Return the index of a pixel in a table of the film's tiles, 256 entries for each tile, and the size of such a
    /// table.
    /// \pre for `place`: the film has the pixel's tile
    ///@{
    std::size_t place(int x, int y) const {
        const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
        return slots_[row / kTile * across_ + column / kTile] * kTilePixels + row % kTile * kTile + column % kTile;
    }
    std::size_t places() const { return tiles_.size() * kTilePixels; }
    ///@}

    /// Return or set the plan, and the seconds that the samples took. The film only stores them for the code that adds
    /// samples.
    ///@{
    const SamplePlan& plan() const { return plan_; }
    SamplePlan& plan() { return plan_; }
    /// Sets the rates of the plan. `rates` has 256 entries for each of `tiles`, in ascending order. Tiles that the film
    /// lacks are ignored.
    /// \throws ArgumentError if `rates` has another length
    void set_rates(std::span<const std::uint32_t> tiles, std::span<const float> rates);
    double seconds() const { return seconds_; }
    void set_seconds(double seconds) { seconds_ = seconds; }
    ///@}

    /// The number of rays and samples that were traced for a tile.
    struct Counts {
        std::uint64_t rays = 0;                   ///< camera, scattered and shadow rays
        std::uint64_t unusable_rays = 0;          ///< rays that could not be traced (see is_usable)
        std::uint64_t nonfinite = 0;              ///< samples that were not finite
        Counts& operator+=(const Counts& other);  ///< adds each count
    };
    using Tile = PixelBounds;  ///< the pixels of a tile within the film's window
    /// Return the pixels of a tile. Tiles are numbered row by row from the top left one.
    ///@{
    static Tile tile(const FilmInfo& info, std::uint32_t number);
    Tile tile(std::uint32_t number) const { return tile(info_, number); }
    ///@}
    /// Returns the number of tiles of the whole window. \throws Error if they are more than 2^24
    static std::uint32_t tile_count(const FilmInfo& info);
    std::span<const std::uint32_t> tiles() const { return tiles_; }  ///< returns the film's tiles, ascending
    bool has(std::uint32_t tile) const { return slots_[tile] < tiles_.size(); }  ///< returns true if it has the tile
    /// Adds to the counts of a tile. \pre the film has the tile
    void count(std::uint32_t tile, const Counts& more) { counts_[slots_[tile]] += more; }
    Counts counts() const;  ///< returns the sum of the counts of all tiles

    /// Convert a tile to the bytes that are stored in a file, and back. `tile_size` is the number of the bytes.
    /// `set_tile` throws an ArgumentError if there are more or fewer.
    /// \pre the film has the tile
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
    int width_ = 0, height_ = 0;        // size of the window
    std::size_t across_ = 0;            // number of tiles in a row
    std::vector<std::uint32_t> tiles_;  // numbers of the film's tiles, ascending
    std::vector<std::uint32_t> slots_;  // for each tile of the window: its index in tiles_, or tiles_.size()
    std::vector<Pixel> pixels_;         // tile by tile; then a black tile that represents all tiles the film lacks
    std::vector<double> clear_;         // in a transparent film: for each of pixels_ the sum of `clear`
    std::vector<Counts> counts_;        // for each of tiles_
    SamplePlan plan_;
    double seconds_ = 0;
};

/// Returns true if the file begins as a film does. Returns false if it isn't a regular file.
bool is_film_file(const std::string& path);

}  // namespace limn
