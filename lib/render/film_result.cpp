// The result of a film: its picture, the estimated error and the report.
#include "limn/math/error.h"
#include "limn/render/render.h"
#include "math/parallel.h"
#include "render/error_estimate.h"
#include "render/job_info.h"

namespace limn {

namespace {

RenderResult result_of(const Film& film, std::optional<double> error) {
    // Estimate the error.
    RenderResult r{film.image(), {}, {}, {}};
    r.error = transport::estimate_error(film, &r.maps);
    r.maps.alpha = film.alpha();
    r.error.target = error;
    r.error.reached = error && r.error.ci95_high <= *error;
    // Fill in the fields of the report that the film knows.
    const FilmInfo& info = film.info();
    const Film::Counts counts = film.counts();
    r.report.scene = info.scene;
    r.report.width = film.width();
    r.report.height = film.height();
    r.report.seed = info.seed;
    r.report.max_depth = info.max_depth;
    r.report.samples_per_pixel = film.mean_samples();
    r.report.render_seconds = film.seconds();
    r.report.rays = counts.rays;
    r.report.nonfinite_samples = counts.nonfinite;
    r.report.unusable_rays = counts.unusable_rays;
    r.report.features = info.features;
    r.report.memory_bytes = film.memory_bytes();
    if (r.error.reached) r.report.stopped_by = StoppedBy::error;
    return r;
}

}  // namespace

RenderResult render_result(const Film& film, std::optional<double> error) {
    if (error && !transport::is_target(*error))
        throw ArgumentError("render_result: the error asked for must be over 0 and finite");
    return with_threads(0, [&] { return result_of(film, error); });
}

const char* version() { return LIMN_VERSION; }

}  // namespace limn
