// Bindings of cameras and renders.
#include "limn/render/render.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "arguments.h"
#include "bindings.h"
#include "images.h"
#include "interruptible.h"
#include "limn/render/first_hits.h"

namespace limn::python {

namespace {

// Returns the number, or nothing if the argument is None.
std::optional<double> number_or_none(NumberArgument argument, const char* name) {
    if (argument.object.is_none()) return std::nullopt;
    return number(argument, name);
}

// Constructs a Camera from the arguments of Camera.__init__.
void construct(Camera* self, TripleArgument look_from, TripleArgument look_at, TripleArgument up, NumberArgument fov,
               NumberArgument aspect_ratio, NumberArgument aperture_angle, NumberArgument focus_distance,
               NumberArgument shutter_open, NumberArgument shutter_close, NameArgument projection,
               NumberArgument view_height) {
    new (self) Camera{
        .look_from = point(look_from, "look_from"),
        .look_at = point(look_at, "look_at"),
        .up = vector(up, "up"),
        .vertical_fov = number(fov, "vertical_fov"),
        .aspect_ratio = number_or_none(aspect_ratio, "aspect_ratio"),
        .aperture_angle = number(aperture_angle, "aperture_angle"),
        .focus_distance = number_or_none(focus_distance, "focus_distance"),
        .shutter_open = number(shutter_open, "shutter_open"),
        .shutter_close = number(shutter_close, "shutter_close"),
        .projection =
            std::array{
                Projection::perspective, Projection::orthographic,
                Projection::panorama}[choice(projection, "projection", {"perspective", "orthographic", "panorama"})],
        .view_height = number_or_none(view_height, "view_height")};
}

// Returns a number of at least 1.
int count(CountArgument argument, const char* name) {
    return static_cast<int>(whole(argument, name, 1, std::numeric_limits<int>::max()));
}

// Returns the crop window of the argument (left, top, right, bottom), or nothing if it is None. The render checks that
// the window is inside the picture.
std::optional<PixelBounds> window(WindowArgument argument) {
    if (argument.object.is_none()) return std::nullopt;
    const std::vector<nb::object> of = items(argument.object, 4, "crop", "four whole numbers or None");
    const auto side = [&](std::size_t i) { return static_cast<int>(whole({of[i]}, "crop", 0, kMaxSide)); };
    return PixelBounds{side(0), side(1), side(2), side(3)};
}

// Returns settings with the fields that camera rays depend on. The other fields have their defaults.
RenderSettings ray_settings(CountArgument width, CountArgument height, CountArgument seed, CountArgument threads,
                            FlagArgument antialias, NameArgument sampler, WindowArgument crop) {
    RenderSettings s;
    s.width = count(width, "width");
    s.height = count(height, "height");
    s.seed = static_cast<std::uint64_t>(whole(seed, "seed", 0, std::numeric_limits<long long>::max()));
    s.threads = thread_count(threads);
    s.antialias = flag(antialias, "antialias");
    s.sampler =
        choice(sampler, "sampler", {"sobol", "independent"}) == 0 ? SamplerKind::sobol : SamplerKind::independent;
    s.crop = window(crop);
    return s;
}

// Returns settings with all fields but `progress`.
RenderSettings settings_of(CountArgument width, CountArgument height, CountArgument samples, CountArgument max_depth,
                           CountArgument seed, CountArgument threads, NumberArgument error, NumberArgument time_limit,
                           CountArgument most_samples, FlagArgument uniform, FlagArgument antialias,
                           NameArgument estimator, NameArgument sampler, WindowArgument crop,
                           FlagArgument transparent) {
    RenderSettings s = ray_settings(width, height, seed, threads, antialias, sampler, crop);
    s.samples_per_pixel = count(samples, "samples_per_pixel");
    s.max_depth = max_depth.object.is_none() ? kUnlimitedDepth : count(max_depth, "max_depth");
    s.error = number_or_none(error, "error");
    s.time_limit = number_or_none(time_limit, "time_limit");
    s.max_samples_per_pixel = count(most_samples, "max_samples_per_pixel");
    s.uniform = flag(uniform, "uniform");
    s.estimator = choice(estimator, "estimator", {"path", "naive"}) == 0 ? Estimator::path : Estimator::naive;
    s.transparent = flag(transparent, "transparent");
    return s;
}

const char* name_of(StoppedBy reason) {
    return std::array{"samples", "error", "time", "callback"}[static_cast<std::size_t>(reason)];
}

// Returns the report as RenderResult.report in _render.py describes it.
nb::dict report_of(const RenderResult& result) {
    const RenderReport& r = result.report;
    nb::dict report;
    report["scene"] = r.scene;
    report["width"] = r.width;
    report["height"] = r.height;
    report["seed"] = r.seed;
    report["threads"] = r.threads;
    report["max_depth"] = r.max_depth;
    report["samples_per_pixel"] = r.samples_per_pixel;
    report["compile_seconds"] = r.compile_seconds;
    report["render_seconds"] = r.render_seconds;
    report["rays"] = r.rays;
    report["nonfinite_samples"] = r.nonfinite_samples;
    report["unusable_rays"] = r.unusable_rays;
    report["features"] = r.features;
    report["memory_bytes"] = r.memory_bytes;
    report["complete"] = r.complete;
    report["stopped_by"] = name_of(r.stopped_by);
    return report;
}

// Returns the estimated error as RenderResult.error in _render.py describes it.
nb::dict error_of(const ErrorEstimate& e) {
    nb::dict error;
    error["estimate"] = e.estimate;
    error["ci95_low"] = e.ci95_low;
    error["ci95_high"] = e.ci95_high;
    error["max_sample_share"] = e.max_sample_share;
    error["reason"] = e.reason;
    error["reached"] = e.reached;
    return error;
}

// Renders, and returns the arguments of RenderResult in _render.py: image, report, error, maps.
nb::tuple render_arrays(const CompiledScene& scene, const Camera& camera, CountArgument width, CountArgument height,
                        CountArgument samples, CountArgument max_depth, CountArgument seed, CountArgument threads,
                        NumberArgument error, NumberArgument time_limit, CountArgument most_samples,
                        FlagArgument uniform, FlagArgument antialias, NameArgument estimator, NameArgument sampler,
                        WindowArgument crop, FlagArgument transparent, CallbackArgument progress) {
    const RenderSettings settings =
        settings_of(width, height, samples, max_depth, seed, threads, error, time_limit, most_samples, uniform,
                    antialias, estimator, sampler, crop, transparent);
    if (!progress.object.is_none() && !PyCallable_Check(progress.object.ptr()))
        wrong_type("progress", "callable or None", progress.object);
    RenderResult result = render_interruptibly(scene, camera, settings, progress.object);
    const int columns = result.image.width(), rows = result.image.height();
    nb::dict maps;
    maps["error"] = map_of(result.maps.error, columns, rows);
    maps["samples"] = map_of(result.maps.samples, columns, rows);
    maps["alpha"] = map_of(result.maps.alpha, columns, rows);
    const nb::dict report = report_of(result), estimate = error_of(result.error);
    return nb::make_tuple(array_of(std::move(result.image)), report, estimate, maps);
}

// Returns the arguments of FirstHits in _render.py.
nb::tuple first_hit_arrays(const CompiledScene& scene, const Camera& camera, CountArgument width, CountArgument height,
                           CountArgument seed, CountArgument threads, FlagArgument antialias, NameArgument sampler,
                           WindowArgument crop) {
    const RenderSettings s = ray_settings(width, height, seed, threads, antialias, sampler, crop);
    FirstHits hits = [&] {
        const nb::gil_scoped_release release;
        return first_hits(scene, camera, s);
    }();
    const int columns = hits.albedo.width(), rows = hits.albedo.height();
    return nb::make_tuple(array_of(std::move(hits.albedo)), array_of(std::move(hits.normal)),
                          array_of(std::move(hits.position)), map_of(hits.depth, columns, rows),
                          map_of(hits.object, columns, rows), map_of(hits.primitive, columns, rows));
}

}  // namespace

void bind_render(nb::module_& module) {
    nb::class_<Progress>(module, "Progress", "The progress of a render.")
        .def_ro("fraction", &Progress::fraction,
                "The part of the render that is done, 0 to 1. It never decreases. With `error` or `time_limit` it is "
                "an estimate.")
        .def_ro("seconds", &Progress::seconds, "Seconds since the render began.");
    nb::class_<Camera>(module, "Camera", "A thin-lens camera.")
        .def("__init__", &construct, nb::kw_only(), given("look_from") = nb::make_tuple(0.0, 0.0, 1.0),
             given("look_at") = nb::make_tuple(0.0, 0.0, 0.0), given("up") = nb::make_tuple(0.0, 1.0, 0.0),
             given("vertical_fov") = 40.0, given("aspect_ratio") = nb::none(), given("aperture_angle") = 0.0,
             given("focus_distance") = nb::none(), given("shutter_open") = 0.0, given("shutter_close") = 1.0,
             given("projection") = "perspective", given("view_height") = nb::none(),
             R"(Makes a camera. Angles are in degrees, lengths in world units, times in units of the shutter, 0 to 1.

Args:
    look_from: the position of the camera, the centre of its lens.
    look_at: the point in the middle of the picture.
    up: the direction that is upward in the picture. It may have any length, but must not be along the view.
    vertical_fov: angle between the top and the bottom edge of a perspective picture.
    aspect_ratio: width over height of the frame. None is the width over height in pixels.
    aperture_angle: full angle of the cone whose apex is a point in focus and whose base is the lens. 0 is a pinhole.
    focus_distance: distance of the plane in focus along the view axis. None is |look_at - look_from|.
    shutter_open, shutter_close: times between which the time of a ray is uniform.
    projection: "perspective", "orthographic" or "panorama". Orthographic rays start in the plane through look_from that
        is perpendicular to the view. Without a lens they are parallel. A panorama is equirectangular: it spans 360
        degrees horizontally and 180 degrees vertically, with look_at in its middle. It needs an aperture_angle of 0.
    view_height: height of an orthographic picture in world units. None is the height that vertical_fov spans at
        look_at.)");
    module.def("_render", &render_arrays, nb::arg("scene"), nb::arg("camera"), given("width"), given("height"),
               given("samples_per_pixel"), given("max_depth"), given("seed"), given("threads"), given("error"),
               given("time_limit"), given("max_samples_per_pixel"), given("uniform"), given("antialias"),
               given("estimator"), given("sampler"), given("crop"), given("transparent"), given("progress"));
    module.def("_first_hits", &first_hit_arrays, nb::arg("scene"), nb::arg("camera"), given("width"), given("height"),
               given("seed"), given("threads"), given("antialias"), given("sampler"), given("crop"));
}

}  // namespace limn::python
