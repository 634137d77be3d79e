// Pictures.
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
#include "interruptible.h"

namespace limn::python {

namespace {

std::optional<double> number_or_none(NumberArgument argument, const char* name) {
    if (argument.object.is_none()) return std::nullopt;
    return number(argument, name);
}

void construct(Camera* self, TripleArgument look_from, TripleArgument look_at, TripleArgument up, NumberArgument fov,
               NumberArgument aspect_ratio, NumberArgument aperture_angle, NumberArgument focus_distance,
               NumberArgument shutter_open, NumberArgument shutter_close) {
    new (self) Camera{.look_from = point(look_from, "look_from"),
                      .look_at = point(look_at, "look_at"),
                      .up = vector(up, "up"),
                      .vertical_fov = number(fov, "vertical_fov"),
                      .aspect_ratio = number_or_none(aspect_ratio, "aspect_ratio"),
                      .aperture_angle = number(aperture_angle, "aperture_angle"),
                      .focus_distance = number_or_none(focus_distance, "focus_distance"),
                      .shutter_open = number(shutter_open, "shutter_open"),
                      .shutter_close = number(shutter_close, "shutter_close")};
}

int count(CountArgument argument, const char* name) {
    return static_cast<int>(whole(argument, name, 1, std::numeric_limits<int>::max()));
}

RenderSettings settings_of(CountArgument width, CountArgument height, CountArgument samples, CountArgument max_depth,
                           CountArgument seed, CountArgument threads, NumberArgument error, NumberArgument time_limit,
                           CountArgument most_samples, FlagArgument uniform, FlagArgument antialias,
                           NameArgument estimator, NameArgument sampler) {
    RenderSettings s;
    s.width = count(width, "width");
    s.height = count(height, "height");
    s.samples_per_pixel = count(samples, "samples_per_pixel");
    s.max_depth = max_depth.object.is_none() ? kUnlimitedDepth : count(max_depth, "max_depth");
    s.seed = static_cast<std::uint64_t>(whole(seed, "seed", 0, std::numeric_limits<long long>::max()));
    s.threads = thread_count(threads);
    s.error = number_or_none(error, "error");
    s.time_limit = number_or_none(time_limit, "time_limit");
    s.max_samples_per_pixel = count(most_samples, "max_samples_per_pixel");
    s.uniform = flag(uniform, "uniform");
    s.antialias = flag(antialias, "antialias");
    s.estimator = choice(estimator, "estimator", {"path", "naive"}) == 0 ? Estimator::path : Estimator::naive;
    s.sampler =
        choice(sampler, "sampler", {"sobol", "independent"}) == 0 ? SamplerKind::sobol : SamplerKind::independent;
    return s;
}

// The pixels are the array's: the image lives as long as it does.
nb::object array_of(Image image) {
    auto owned = std::make_unique<Image>(std::move(image));
    float* values = owned->values().data();
    const std::size_t height = static_cast<std::size_t>(owned->height());
    const std::size_t width = static_cast<std::size_t>(owned->width());
    const nb::capsule owner(owned.release(), [](void* p) noexcept { delete static_cast<Image*>(p); });
    return nb::cast(nb::ndarray<nb::numpy, float>(values, {height, width, std::size_t{3}}, owner));
}

nb::object map_of(const std::vector<float>& map, int width, int height) {
    if (map.empty()) return nb::none();
    const NewArray<float> array = new_array<float>({static_cast<std::size_t>(height), static_cast<std::size_t>(width)});
    std::copy(map.begin(), map.end(), array.values);
    return array.array;
}

const char* name_of(StoppedBy reason) {
    return std::array{"samples", "error", "time", "callback"}[static_cast<std::size_t>(reason)];
}

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

nb::tuple render_arrays(const CompiledScene& scene, const Camera& camera, CountArgument width, CountArgument height,
                        CountArgument samples, CountArgument max_depth, CountArgument seed, CountArgument threads,
                        NumberArgument error, NumberArgument time_limit, CountArgument most_samples,
                        FlagArgument uniform, FlagArgument antialias, NameArgument estimator, NameArgument sampler,
                        CallbackArgument progress) {
    const RenderSettings settings = settings_of(width, height, samples, max_depth, seed, threads, error, time_limit,
                                                most_samples, uniform, antialias, estimator, sampler);
    if (!progress.object.is_none() && !PyCallable_Check(progress.object.ptr()))
        wrong_type("progress", "callable or None", progress.object);
    RenderResult result = render_interruptibly(scene, camera, settings, progress.object);
    nb::dict maps;
    maps["error"] = map_of(result.maps.error, result.report.width, result.report.height);
    maps["samples"] = map_of(result.maps.samples, result.report.width, result.report.height);
    const nb::dict report = report_of(result), estimate = error_of(result.error);
    return nb::make_tuple(array_of(std::move(result.image)), report, estimate, maps);
}

nb::object to_srgb(ArrayArgument argument) {
    const ArrayView image(argument.object, "image", "an array of float32");
    if (!image.holds<float>()) throw nb::type_error("image: must be of float32");
    const NewArray<std::uint8_t> bytes = new_array<std::uint8_t>(image.shape());
    const float* values = image.data<float>();
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double shown = values[i] > 0 ? std::min(1.0, static_cast<double>(values[i])) : 0;  // NaN is black
        bytes.values[i] = static_cast<std::uint8_t>(std::lround(255 * srgb_encode(shown)));
    }
    return bytes.array;
}

}  // namespace

void bind_render(nb::module_& module) {
    nb::class_<Progress>(module, "Progress", "How far a render has come.")
        .def_ro("fraction", &Progress::fraction, "0 to 1, never decreasing.")
        .def_ro("seconds", &Progress::seconds, "Since the render began.");
    nb::class_<Camera>(module, "Camera", "A thin-lens camera.")
        .def("__init__", &construct, nb::kw_only(), given("look_from") = nb::make_tuple(0.0, 0.0, 1.0),
             given("look_at") = nb::make_tuple(0.0, 0.0, 0.0), given("up") = nb::make_tuple(0.0, 1.0, 0.0),
             given("vertical_fov") = 40.0, given("aspect_ratio") = nb::none(), given("aperture_angle") = 0.0,
             given("focus_distance") = nb::none(), given("shutter_open") = 0.0, given("shutter_close") = 1.0,
             R"(Angles in degrees, lengths in world units, times within the shutter, 0 to 1.

Args:
    look_from: the eye. look_at: what is in the middle of the picture. up: what is upward in it, of any length.
    vertical_fov: full angle between the top and the bottom edge.
    aspect_ratio: width over height; None: that of the pixels.
    aperture_angle: full angle of the cone that the lens fills, seen from the focus plane; 0: a pinhole.
    focus_distance: to the plane in focus; None: |look_at - look_from|.
    shutter_open, shutter_close: the time of a ray is uniform between them.)");
    module.def("_render", &render_arrays, nb::arg("scene"), nb::arg("camera"), given("width"), given("height"),
               given("samples_per_pixel"), given("max_depth"), given("seed"), given("threads"), given("error"),
               given("time_limit"), given("max_samples_per_pixel"), given("uniform"), given("antialias"),
               given("estimator"), given("sampler"), given("progress"));
    module.def(
        "to_srgb", &to_srgb, given("image"),
        nb::sig("def to_srgb(image: numpy.typing.NDArray) -> numpy.typing.NDArray"),
        "Linear values, float32 of any shape, clamped to [0, 1] and encoded by sRGB: bytes of the same shape, as in "
        "PNG files.");
}

}  // namespace limn::python
