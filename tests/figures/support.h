// Rendering, projection and statistics for the tests of figures.
//
// Tolerances are not chosen by looking at results. A random result is compared with its true value in units of its
// standard error, which comes from the spread between independent renders (other seeds) or from the binomial law; it
// may be kSigmas of them away. A number that is known to some decimals is known to half a unit of the last one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "figures.h"

namespace limn::test {

inline constexpr double kSigmas = 4.5;
inline constexpr int kReplicates = 32;

/// A mean of independent equal estimates, and its standard error.
struct Estimate {
    double mean = 0, error = 0;
};
Estimate estimate(std::span<const double> samples);

/// Whether `e` is at most kSigmas standard errors from `truth`, which is known to +-rounding.
bool agrees(const Estimate& e, double truth, double rounding = 0);

/// Equal up to the rounding of float32, in which images hold their values.
bool same_float(double a, double b);
bool same_float(const Color& a, const Color& b);

/// Where a point appears in a size x size picture, in pixels from the left and top edge, and its depth along the view
/// axis: from the definition of the camera, not by way of CameraRays. The camera is square.
struct Projected {
    double x = 0, y = 0, depth = 0;
};
Projected project(const Camera& camera, int size, const Point3& p);

/// The ray through a point of the picture and the centre of the lens.
Ray picture_ray(const Camera& camera, int size, double x, double y, double time = 0);

/// Whether a number known to +-rounding is met.
bool close(double a, double b, double rounding);

/// Whether a point appears at (x, y), known to one decimal (itself rounded from two), in the figure's own 400 x 400
/// pixels, both by `project` and by the ray that the camera sends there.
bool appears_at(const Camera& camera, const Point3& p, double x, double y);

/// The row at which the ground (object 0) begins in the column x.
double horizon(const Figure& figure, double x);

/// Renders the figure at its own size.
Image render_figure(const Figure& figure, int spp, std::uint64_t seed = 1);

/// What the rays through the centre of a pixel and the outer corners of the 3 x 3 pixels around it hit.
using Footprint = std::vector<std::optional<RayHit>>;
bool all_see(const Footprint& footprint, std::uint32_t object);
bool all_see_sky(const Footprint& footprint);

/// Calls f(x, y, footprint) for each pixel of the figure.
template <class F>
void for_each_pixel(const Figure& figure, const F& f);

/// The area, as a share of a 400 x 400 picture, of the polygon with these corners; and whether a place lies in it. Its
/// corners go round in either sense; it is convex.
using Polygon = std::vector<Projected>;
double share_of_frame(const Polygon& polygon);
bool contains(const Polygon& polygon, double x, double y);

/// A place for textures that look at nothing else.
Surface surface_at(const Point3& position);

/// The scene with only those of its objects.
Scene only(const Scene& scene, const std::vector<std::size_t>& objects);
Scene scene_of(const Background& background, const std::vector<std::shared_ptr<const Hittable>>& objects);

/// `low` and `high` differ in whether `inside` holds; the place where it changes between them.
template <class Predicate>
double boundary(double low, double high, const Predicate& inside) {
    const bool at_low = inside(low);
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (inside(middle) == at_low ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// Renders `count` times with different seeds.
std::vector<Image> replicates(const CompiledScene& scene, const Camera& camera, RenderSettings settings,
                              int count = kReplicates);

/// `measure` of each of the images.
template <class Measure>
Estimate measure(std::span<const Image> images, const Measure& of_image) {
    std::vector<double> values;
    for (const Image& image : images) values.push_back(of_image(image));
    return estimate(values);
}

/// The mean over a rectangle of pixels, [x0, x1) x [y0, y1), of one channel (0, 1, 2).
double mean_over(const Image& image, std::size_t channel, int x0, int y0, int x1, int y1);
double mean_over(const Image& image, std::size_t channel);

/// The radiance that arrives at `from` out of the direction of `towards`, one estimate a channel.
struct Radiance {
    Estimate r, g, b;
};
Radiance radiance(const CompiledScene& scene, const Point3& from, const Point3& towards,
                  const RenderSettings& settings);

Footprint footprint_of(const CompiledScene& scene, const Figure& figure, int x, int y);

template <class F>
void for_each_pixel(const Figure& figure, const F& f) {
    const CompiledScene scene = compile(figure.scene);
    for (int y = 0; y < figure.settings.height; ++y)
        for (int x = 0; x < figure.settings.width; ++x) f(x, y, footprint_of(scene, figure, x, y));
}

}  // namespace limn::test
