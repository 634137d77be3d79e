#include "bench/results.h"

#include <fmt/format.h>

#include <thread>

#include "bench/limn_contender.h"

namespace limn::bench {

namespace {

using app::Json;

std::string ratio_text(const Timing* a, const Timing* b) {
    if (a == nullptr || b == nullptr) return "-";
    const Spread r = ratio(*a, *b);
    return fmt::format("{:.2f} ({:.2f}..{:.2f})", r.median, r.low, r.high);
}

std::string rate_text(const RayRow& row, const Timing* timing) {
    return timing == nullptr ? "-" : fmt::format("{:.2f}", row.million_a_second(*timing));
}

std::string mismatch_text(const RayRow& row, const Timing* timing) {
    if (timing == nullptr) return "-";
    return fmt::format("{:.1f}", 1e6 * static_cast<double>(timing->mismatches) / static_cast<double>(row.count));
}

Json ratio_json(const Timing* a, const Timing* b) {
    if (a == nullptr || b == nullptr) return nullptr;
    const Spread r = ratio(*a, *b);
    return {{"median", r.median}, {"low", r.low}, {"high", r.high}, {"of", a->subject}, {"to", b->subject}};
}

Json row_json(const RayRow& row) {
    Json subjects = Json::array();
    for (const Timing& t : row.timings) {
        if (t.seconds.empty()) continue;
        subjects.push_back({{"name", t.subject},
                            {"million_a_second", row.million_a_second(t)},
                            {"mismatches", t.mismatches},
                            {"seconds", t.seconds}});
    }
    const Timing *single = row.find("limn"), *batch = row.best_batch();
    return {{"rays", row.rays},
            {"count", row.count},
            {"any", row.any},
            {"threads", row.threads},
            {"differences", row.differences},
            {"single_to_default", ratio_json(single, row.find("Embree"))},
            {"single_to_robust", ratio_json(single, row.find("Embree robust"))},
            {"batch_to_best", ratio_json(batch, row.best_peer())},
            {"subjects", subjects}};
}

Json build_json(const BuildRow& row) {
    Json json = {{"threads", row.threads}, {"seconds", Json::object()}, {"ratios", Json::object()}};
    for (const Timing& t : row.timings) {
        json["seconds"][t.subject] = t.seconds;
        if (&t != &row.timings.front()) json["ratios"][t.subject] = ratio_json(&row.timings.front(), &t);
    }
    return json;
}

}  // namespace

std::string results_table(const std::vector<SceneResult>& results) {
    std::string text;
    for (const SceneResult& scene : results) {
        text += fmt::format("{}: {} primitives", scene.name, scene.primitives);
        for (const auto& [name, bytes] : scene.bytes)
            text += fmt::format("; {} {:.1f} bytes each", name,
                                static_cast<double>(bytes) / static_cast<double>(scene.primitives));
        text += '\n';
        for (const BuildRow& row : scene.builds) {
            if (row.timings.back().seconds.empty()) continue;
            text += fmt::format("  built by {} thread{}:", row.threads, row.threads == 1 ? "" : "s");
            for (const Timing& t : row.timings) {
                text += fmt::format(" {} {:.3f} s", t.subject, spread_of(t.seconds).median);
                if (&t != &row.timings.front()) text += " x " + ratio_text(&row.timings.front(), &t);
                text += &t == &row.timings.back() ? "\n" : ",";
            }
        }
        if (scene.rows.empty()) continue;
        text += fmt::format("  {:<10} {:>2} {:>7} {:>7} {:>7} {:>7} {:>7} {:>9}  {:<18} {:<18} {:<18} {:>8}\n", "rays",
                            "th", "limn", "batch", "Embree", "robust", "best", "(mode)", "limn/Embree", "limn/robust",
                            "batch/best", "differ/M");
        for (const RayRow& row : scene.rows) {
            const Timing *single = row.find("limn"), *batch = row.best_batch(), *plain = row.find("Embree"),
                         *robust = row.find("Embree robust"), *best = row.best_peer();
            const std::string mode = best == nullptr || best == plain ? "1" : best->subject.substr(7);
            text += fmt::format("  {:<10} {:>2} {:>7} {:>7} {:>7} {:>7} {:>7} {:>9}  {:<18} {:<18} {:<18} {:>8}\n",
                                row.rays, row.threads, rate_text(row, single), rate_text(row, batch),
                                rate_text(row, plain), rate_text(row, robust), rate_text(row, best), mode,
                                ratio_text(single, plain), ratio_text(single, robust), ratio_text(batch, best),
                                mismatch_text(row, plain) + "/" + mismatch_text(row, robust));
        }
    }
    return text;
}

Json results_json(const Plan& plan, const std::vector<std::shared_ptr<const Contender>>& peers,
                  const std::vector<SceneResult>& results, bool complete) {
    Json versions = {{"limn", LimnContender().version()}};
    for (const auto& peer : peers) versions[peer->name()] = peer->version();
    Json json = {{"complete", complete},
                 {"versions", versions},
                 {"rounds", plan.rounds},
                 {"cores", std::thread::hardware_concurrency()},
                 {"scenes", Json::array()}};
    for (const SceneResult& scene : results) {
        Json builds = Json::array(), rows = Json::array(), bytes = Json::object();
        for (const BuildRow& row : scene.builds) builds.push_back(build_json(row));
        for (const RayRow& row : scene.rows) rows.push_back(row_json(row));
        for (const auto& [name, size] : scene.bytes) bytes[name] = size;
        json["scenes"].push_back({{"name", scene.name},
                                  {"primitives", scene.primitives},
                                  {"bytes", bytes},
                                  {"builds", builds},
                                  {"rows", rows}});
    }
    return json;
}

}  // namespace limn::bench
