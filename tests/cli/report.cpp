// The report and the picture's facts, from a result whose every number is another.
#include "report.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.h"

namespace limn::test::report_test {
namespace {

RenderResult result() {
    RenderResult r;
    r.error = {.estimate = 0.25, .ci95_low = 0.125, .ci95_high = 0.5, .max_sample_share = 0.75, .reason = ""};
    r.report = {.scene = "a scene",
                .width = 20,
                .height = 14,
                .seed = 18446744073709551615u,
                .threads = 3,
                .max_depth = 11,
                .samples_per_pixel = 7.5,
                .compile_seconds = 1.5,
                .render_seconds = 4,
                .rays = 6'000'000,
                .nonfinite_samples = 17,
                .unusable_rays = 23,
                .features = "sphere quad medium",
                .memory_bytes = 123456,
                .complete = true,
                .stopped_by = StoppedBy::time};
    return r;
}

TEST_CASE("Report: every field holds its own number, in the order of the documentation", "[cli][report]") {
    CHECK(app::report_json(result(), 2.5) == R"({
  "scene": "a scene",
  "width": 20,
  "height": 14,
  "seed": 18446744073709551615,
  "threads": 3,
  "spp": 7.5,
  "seconds": {
    "compile": 1.5,
    "render": 4.0,
    "save": 2.5
  },
  "rays": 6000000,
  "mrays_per_second": 1.5,
  "error": {
    "metric": "relMSE",
    "estimate": 0.25,
    "ci95_low": 0.125,
    "ci95_high": 0.5,
    "target": null,
    "reached": null,
    "max_sample_share": 0.75,
    "reason": null
  },
  "stopped_by": "time",
  "nonfinite_samples": 17,
  "unusable_rays": 23,
  "features": [
    "sphere",
    "quad",
    "medium"
  ],
  "memory_bytes": 123456,
  "version": ")" + std::string(version()) + "\"\n}\n");
}

TEST_CASE("Report: what is not a number is null, and a name that is not UTF-8 does no harm", "[cli][report]") {
    RenderResult r = result();
    r.error = {.estimate = std::nan(""), .ci95_low = std::nan(""), .ci95_high = INFINITY, .reason = "too few"};
    r.report.render_seconds = 0;
    r.report.scene = "caf\xe9";
    const auto json = nlohmann::json::parse(app::report_json(r, 0));
    for (const char* name : {"estimate", "ci95_low", "ci95_high"}) CHECK(json["error"][name].is_null());
    CHECK(json["error"]["reason"] == "too few");
    CHECK(json["mrays_per_second"].is_null());
    CHECK(json["scene"] == "caf\xef\xbf\xbd");
}

using Facts = std::vector<std::pair<std::string, std::string>>;

TEST_CASE("Report: a target stands beside whether it was reached, and what ended the render is named",
          "[cli][report]") {
    RenderResult r = result();
    r.error.target = 0.375;
    for (const auto& [cause, name] : {std::pair{StoppedBy::samples, "samples"},
                                      {StoppedBy::error, "error"},
                                      {StoppedBy::callback, "interrupted"}}) {
        r.report.stopped_by = cause;
        r.error.reached = cause == StoppedBy::error;
        const auto json = nlohmann::json::parse(app::report_json(r, 0));
        CHECK(json["stopped_by"] == name);
        CHECK(json["error"]["target"] == 0.375);
        CHECK(json["error"]["reached"] == r.error.reached);
    }
}

TEST_CASE("Facts: a picture's header says what was rendered, how well, and by which command", "[cli][report]") {
    FilmInfo info;
    info.antialias = true, info.estimator = Estimator::path;
    CHECK(app::picture_facts(result(), info, "limn render x.obj") == Facts{{"scene", "a scene"},
                                                                           {"width", "20"},
                                                                           {"height", "14"},
                                                                           {"seed", "18446744073709551615"},
                                                                           {"spp", "7.5"},
                                                                           {"max_depth", "11"},
                                                                           {"antialias", "yes"},
                                                                           {"estimator", "path"},
                                                                           {"sampler", "sobol"},
                                                                           {"seconds.compile", "1.5"},
                                                                           {"seconds.render", "4"},
                                                                           {"error.metric", "relMSE"},
                                                                           {"error.estimate", "0.25"},
                                                                           {"error.ci95_low", "0.125"},
                                                                           {"error.ci95_high", "0.5"},
                                                                           {"error.max_sample_share", "0.75"},
                                                                           {"stopped_by", "time"},
                                                                           {"nonfinite_samples", "17"},
                                                                           {"unusable_rays", "23"},
                                                                           {"complete", "yes"},
                                                                           {"version", version()},
                                                                           {"command_line", "limn render x.obj"}});
}

TEST_CASE("Facts: what is unlimited, switched off, unknown or unfinished says so", "[cli][report]") {
    RenderResult r = result();
    r.error.reason = "too few";
    r.report.max_depth = kUnlimitedDepth;
    r.error.target = 0.1;
    r.report.complete = false;
    r.report.stopped_by = StoppedBy::callback;
    FilmInfo info;
    info.antialias = false, info.estimator = Estimator::naive, info.sampler = SamplerKind::independent;
    CHECK(app::picture_facts(r, info, "") == Facts{{"scene", "a scene"},
                                                   {"width", "20"},
                                                   {"height", "14"},
                                                   {"seed", "18446744073709551615"},
                                                   {"spp", "7.5"},
                                                   {"max_depth", "unlimited"},
                                                   {"antialias", "no"},
                                                   {"estimator", "naive"},
                                                   {"sampler", "independent"},
                                                   {"seconds.compile", "1.5"},
                                                   {"seconds.render", "4"},
                                                   {"error.metric", "relMSE"},
                                                   {"error.reason", "too few"},
                                                   {"error.target", "0.1"},
                                                   {"error.reached", "no"},
                                                   {"error.max_sample_share", "0.75"},
                                                   {"stopped_by", "interrupted"},
                                                   {"nonfinite_samples", "17"},
                                                   {"unusable_rays", "23"},
                                                   {"complete", "no"},
                                                   {"version", version()},
                                                   {"command_line", ""}});
}

}  // namespace
}  // namespace limn::test::report_test
