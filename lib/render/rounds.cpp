// A render to an error by several machines: each round they render, then their films are merged and asked.
#include <limits>

#include "limn/core/error.h"
#include "limn/render/render_job.h"
#include "render/error_estimate.h"
#include "render/film_file.h"
#include "render/sample_rates.h"

namespace limn {

bool plan_next_round(const Film& film, double error, const std::string& path) {
    if (!film.is_whole()) throw ArgumentError("plan_next_round: the film lacks tiles");
    if (film.fewest_samples() < SamplePlan::kFirstPass)
        throw ArgumentError("plan_next_round: the film has pixels with fewer than " +
                            std::to_string(SamplePlan::kFirstPass) + " samples");
    const ErrorEstimate e = tracing::check_error(film);
    const double upper = e.reason.empty() ? e.ci95_high : std::numeric_limits<double>::infinity();
    if (upper <= error) return true;
    SamplePlan plan = film.plan();
    plan.samples = tracing::next_round(plan.samples, upper, error);
    if (plan.rates.empty() && !film.info().uniform) plan.rates = tracing::sample_rates(film);
    if (!plan.rates.empty()) plan.scale = tracing::scale_for(film, plan.rates, plan.samples, false);
    tracing::FilmWriter(path, film, tracing::FilmContent::plan).finish(plan, plan.rates, film.seconds());
    return false;
}

}  // namespace limn
