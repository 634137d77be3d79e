// Renders to a target error by several machines. In each round they render their shards; then the films are merged and
// the error is checked.
#include "limn/render/render_job.h"
#include "math/require.h"
#include "render/error_estimate.h"
#include "render/film_file.h"
#include "render/sample_rates.h"

namespace limn {

void plan_next_round(const Film& film, const ErrorEstimate& error, const std::string& path) {
    require(error.target.has_value(), "plan_next_round: there is no target");
    require(film.is_whole(), "plan_next_round: the film lacks tiles");
    require(film.fewest_samples() >= SamplePlan::kFirstPass, "plan_next_round: the film has pixels with fewer than " +
                                                                 std::to_string(SamplePlan::kFirstPass) + " samples");
    SamplePlan plan = film.plan();
    plan.samples = transport::next_round(plan.samples, error.ci95_high, *error.target);
    if (plan.rates.empty() && !film.info().uniform) plan.rates = transport::sample_rates(film);
    if (!plan.rates.empty()) plan.scale = transport::scale_for(film, plan.rates, plan.samples, false);
    transport::FilmWriter(path, film, transport::FilmContent::plan).finish(plan, plan.rates, film.seconds());
}

}  // namespace limn
