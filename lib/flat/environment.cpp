// Builds the tables for sampling an environment map: first a row, then a place in the row (Pharr, Jakob, Humphreys,
// Physically Based Rendering, 4th ed., sections A.5.3 and 12.5.2). There are two differences:
// - The pdf is interpolated like the map, so it is proportional to the luminance everywhere.
// - The vertical coordinate is the cosine of the angle, so no weight by the sine is needed.
#include <algorithm>
#include <cmath>

#include "flat/steps.h"
#include "limn/math/math.h"
#include "math/elementary.h"
#include "math/parallel.h"

namespace limn::compiler {

namespace {

constexpr std::size_t kRowsAtOnce = 16;  // rows of one task

// Fills a row of Environment::column_before. Returns the sum of the row's luminance.
double tabulate_row(const Image& image, int y, std::int32_t* before) {
    const int width = image.width();
    double all = 0;
    for (int x = 0; x < width; ++x) all += luminance(image.at(x, y));
    double sum = 0, here = luminance(image.at(0, y));
    for (int x = 0; x < width; ++x) {
        before[x] = all > 0 ? static_cast<std::int32_t>(std::min(sum / all, 1.0) * flat::Environment::kWhole) : 0;
        const double next = luminance(image.at((x + 1) % width, y));
        sum += (here + next) / 2;
        here = next;
    }
    before[width] = all > 0 ? flat::Environment::kWhole : 0;
    return all;
}

}  // namespace

std::unique_ptr<const flat::Environment> tabulate(const EnvironmentMap& map) {
    // Sum up each row.
    auto environment = std::make_unique<flat::Environment>();
    flat::Environment& e = *environment;
    e.image = map.image();
    e.axes = pattern::axes_of(map.world_from_map());
    e.scale = map.scale();
    const Image& image = *e.image;
    const auto height = static_cast<std::size_t>(image.height()), width = static_cast<std::size_t>(image.width());
    e.row_luminance.resize(height);
    e.column_before.resize(height * (width + 1));
    for_all(0, height, kRowsAtOnce, [&](std::size_t y) {
        e.row_luminance[y] = tabulate_row(image, static_cast<int>(y), &e.column_before[y * (width + 1)]);
    });
    // Integrate each band.
    double sum = 0;
    for (std::size_t band = 0; band <= height; ++band) {
        const double upper = band == 0 ? 0 : (static_cast<double>(band) - 0.5) / static_cast<double>(height);
        const double lower = band == height ? 1 : (static_cast<double>(band) + 0.5) / static_cast<double>(height);
        e.band_cosine.push_back(cosine(kPi * upper));
        e.band_before.push_back(sum);
        const double rows = e.row_luminance[band == 0 ? 0 : band - 1] + e.row_luminance[std::min(band, height - 1)];
        // cos a - cos b as a product, which doesn't cancel
        sum += 2 * sine(kPi / 2 * (lower + upper)) * sine(kPi / 2 * (lower - upper)) * rows / 2;
    }
    e.band_cosine.push_back(-1);
    e.band_before.push_back(sum);
    e.luminance = 2 * kPi / static_cast<double>(width) * sum;
    // Clear the tables if the map is black.
    if (!(e.luminance > 0 && e.scale > 0)) {
        e.row_luminance = {};
        e.band_cosine = {};
        e.band_before = {};
        e.column_before = {};
    }
    return environment;
}

}  // namespace limn::compiler
