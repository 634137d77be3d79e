#include "report.h"

#include <fmt/format.h>

#include <sstream>

#include "json_output.h"

namespace limn::app {

namespace {

constexpr const char* kMetric = "relMSE";

Json error_json(const ErrorEstimate& error) {
    return {{"metric", kMetric},
            {"estimate", error.estimate},
            {"ci95_low", error.ci95_low},
            {"ci95_high", error.ci95_high},
            {"target", error.target ? Json(*error.target) : Json(nullptr)},
            {"reached", error.target ? Json(error.reached) : Json(nullptr)},
            {"max_sample_share", error.max_sample_share},
            {"reason", error.reason.empty() ? Json(nullptr) : Json(error.reason)}};
}

const char* name_of(StoppedBy cause) {
    switch (cause) {
        case StoppedBy::samples: return "samples";
        case StoppedBy::error: return "error";
        case StoppedBy::time: return "time";
        case StoppedBy::callback: break;
    }
    return "interrupted";
}

Json words(const std::string& text) {
    Json list = Json::array();
    std::istringstream stream(text);
    for (std::string word; stream >> word;) list.push_back(word);
    return list;
}

}  // namespace

std::string report_json(const RenderResult& result, double save_seconds) {
    const RenderReport& r = result.report;
    const Json json = {
        {"scene", r.scene},
        {"width", r.width},
        {"height", r.height},
        {"seed", r.seed},
        {"threads", r.threads},
        {"spp", r.samples_per_pixel},
        {"seconds", {{"compile", r.compile_seconds}, {"render", r.render_seconds}, {"save", save_seconds}}},
        {"rays", r.rays},
        {"mrays_per_second", static_cast<double>(r.rays) / r.render_seconds * 1e-6},
        {"error", error_json(result.error)},
        {"stopped_by", name_of(r.stopped_by)},
        {"nonfinite_samples", r.nonfinite_samples},
        {"unusable_rays", r.unusable_rays},
        {"features", words(r.features)},
        {"memory_bytes", r.memory_bytes},
        {"version", version()},
    };
    return json_text(json);
}

std::vector<std::pair<std::string, std::string>> picture_facts(const RenderResult& result, const FilmInfo& info,
                                                               const std::string& command_line) {
    const RenderReport& r = result.report;
    const ErrorEstimate& e = result.error;
    const auto text = [](const auto& value) { return fmt::format("{}", value); };
    std::vector<std::pair<std::string, std::string>> facts = {
        {"scene", r.scene},
        {"width", text(r.width)},
        {"height", text(r.height)},
        {"seed", text(r.seed)},
        {"spp", text(r.samples_per_pixel)},
        {"max_depth", r.max_depth == kUnlimitedDepth ? "unlimited" : text(r.max_depth)},
        {"antialias", info.antialias ? "yes" : "no"},
        {"estimator", info.estimator == Estimator::path ? "path" : "naive"},
        {"sampler", info.sampler == SamplerKind::sobol ? "sobol" : "independent"},
        {"seconds.compile", text(r.compile_seconds)},
        {"seconds.render", text(r.render_seconds)},
        {"error.metric", kMetric},
    };
    if (const auto& crop = info.crop)
        facts.emplace_back("crop", fmt::format("{},{},{},{} of {}x{}", crop->left, crop->top, crop->right, crop->bottom,
                                               info.width, info.height));
    if (e.reason.empty()) {
        facts.emplace_back("error.estimate", text(e.estimate));
        facts.emplace_back("error.ci95_low", text(e.ci95_low));
        facts.emplace_back("error.ci95_high", text(e.ci95_high));
    } else {
        facts.emplace_back("error.reason", e.reason);
    }
    if (e.target) {
        facts.emplace_back("error.target", text(*e.target));
        facts.emplace_back("error.reached", e.reached ? "yes" : "no");
    }
    facts.emplace_back("error.max_sample_share", text(e.max_sample_share));
    facts.emplace_back("stopped_by", name_of(r.stopped_by));
    facts.emplace_back("nonfinite_samples", text(r.nonfinite_samples));
    facts.emplace_back("unusable_rays", text(r.unusable_rays));
    facts.emplace_back("complete", r.complete ? "yes" : "no");
    facts.emplace_back("version", version());
    facts.emplace_back("command_line", command_line);
    return facts;
}

}  // namespace limn::app
