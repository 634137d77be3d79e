// How often `--error` keeps its promise: renders many seeds to a target and measures each against a reference.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "bench/promise.h"
#include "parse.h"
#include "program.h"
#include "text_file.h"

namespace limn::bench {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> scenes = promise_names();
    int seeds = 200, searched = 24, threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::string folder = "build/promise", json;
};

Json to_json(const Stop& s) {
    return {{"seed", s.seed},   {"samples", s.samples}, {"estimate", s.estimate}, {"upper", s.upper},
            {"error", s.error}, {"fewest", s.fewest},   {"seconds", s.seconds}};
}

Stop to_stop(const Json& j) {
    return {j.at("seed"),  j.at("samples"), j.at("estimate"), j.at("upper"),
            j.at("error"), j.at("fewest"),  j.at("seconds")};
}

// What was measured by this very program is not measured again: a line a stop, in a file for each scene.
class Record {
public:
    Record(const fs::path& path, double target) : path_(path) {
        const auto built = fs::last_write_time("/proc/self/exe").time_since_epoch().count();
        const std::string key = Json{{"built", built}, {"target", target}}.dump();
        std::ifstream in(path);
        std::string line;
        if (std::getline(in, line) && line == key) {
            while (std::getline(in, line))
                if (const Json j = Json::parse(line, nullptr, false); !j.is_discarded()) stops_.push_back(to_stop(j));
            return;
        }
        std::ofstream(path) << key << '\n';
    }

    const std::vector<Stop>& stops() const { return stops_; }
    bool holds(std::uint64_t seed) const {
        return std::any_of(stops_.begin(), stops_.end(), [&](const Stop& s) { return s.seed == seed; });
    }
    void add(const Stop& stop) {
        const std::lock_guard lock(mutex_);
        stops_.push_back(stop);
        std::ofstream(path_, std::ios::app) << to_json(stop).dump() << '\n';
    }

private:
    fs::path path_;
    std::vector<Stop> stops_;
    std::mutex mutex_;
};

// A reference is kept for good: delete the folder to begin anew.
Reference load_or_render(const Promise& promise, const fs::path& folder) {
    const auto path = [&](const char* half) {
        return (folder / fmt::format("{}_{}_{}_{}.exr", promise.name, promise.size, promise.target, half)).string();
    };
    if (fs::exists(path("a")) && fs::exists(path("b"))) return {load_image(path("a")), load_image(path("b"))};
    const Reference reference = reference_of(promise);
    save_image(reference.a, path("a"));
    save_image(reference.b, path("b"));
    return reference;
}

double median(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

Json summary(const Promise& promise, const std::vector<Stop>& stops) {
    std::vector<double> samples, overshoots, by_error;
    double estimates = 0, errors = 0, seconds = 0;
    int kept = 0, at_floor = 0;
    for (const Stop& s : stops) {
        kept += s.error <= promise.target;
        at_floor += s.samples <= 64;
        samples.push_back(s.samples);
        estimates += s.estimate, errors += s.error, seconds += s.seconds;
        by_error.push_back(promise.target / s.error - 1);
        if (s.fewest > 0) overshoots.push_back(s.samples / s.fewest - 1);
    }
    return {{"scene", promise.name},
            {"size", promise.size},
            {"target", promise.target},
            {"stops", stops.size()},
            {"kept", kept},
            {"at_floor", at_floor},
            {"median_samples", median(samples)},
            {"estimate_over_error", estimates / errors},
            {"median_target_over_error", 1 + median(by_error)},
            {"median_overshoot", median(overshoots)},
            {"overshoots_measured", overshoots.size()},
            {"seconds", seconds}};
}

std::string row(const Json& s) {
    const auto number = [&s](const char* key) { return s[key].get<double>(); };
    return fmt::format(
        "{:10s} to {:.1e}: kept {} of {}, estimate / truth {:.3f}, {:.0f} samples, overshoot {:.1f} % ({:.1f} % in "
        "error)",
        s["scene"].get<std::string>(), number("target"), s["kept"].get<int>(), s["stops"].get<int>(),
        number("estimate_over_error"), number("median_samples"), 100 * number("median_overshoot"),
        100 * (number("median_target_over_error") - 1));
}

Json measure(const std::string& name, const Arguments& a, const app::Console& console) {
    const Promise promise = promise_of(name);
    Record record(fs::path(a.folder) / (name + ".jsonl"), promise.target);
    std::vector<std::uint64_t> missing;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(a.seeds); ++seed)
        if (!record.holds(seed)) missing.push_back(seed);
    if (!missing.empty()) {
        console.note(name + ": reference ...");
        const Reference reference = load_or_render(promise, a.folder);
        console.note(fmt::format("{}: {} renders ...", name, missing.size()));
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i; (i = next++) < missing.size();)
                record.add(
                    stop_of(promise, reference, missing[i], missing[i] <= static_cast<std::uint64_t>(a.searched)));
        };
        std::vector<std::jthread> threads;
        for (int t = 0; t < a.threads; ++t) threads.emplace_back(work);
    }
    const Json result = summary(promise, record.stops());
    console.note(row(result));
    return result;
}

int run(int argc, char** argv) {
    app::Options options(
        "limn_promise", "Measures how often a render to an error keeps its promise. What was measured before is kept.");
    Arguments a;
    std::vector<std::string> scenes;
    const auto integer = [&options](const std::string& name, int& value, int lowest, const std::string& help) {
        options.add({.name = name, .value = "N", .help = help, .preset = std::to_string(value)},
                    [=, &value](const std::string& s) { value = app::parse_integer(name, s, lowest, 1'000'000); });
    };
    options.add({.name = "--scene",
                 .value = "NAME",
                 .help = "One scene alone; may be repeated",
                 .preset = "all",
                 .repeatable = true},
                [&scenes](const std::string& s) { scenes.push_back(s); });
    integer("--seeds", a.seeds, 1, "Renders of each scene");
    integer("--searched", a.searched, 0, "Of these, those whose fewest samples are looked for");
    integer("--threads", a.threads, 1, "Renders at a time");
    options.add({.name = "--folder", .value = "FOLDER", .help = "Where stops are kept", .preset = a.folder},
                app::file_name("--folder", a.folder));
    options.add(
        {.name = "--json", .value = "FILE", .help = "Where the summary goes; - is standard output", .required = true},
        app::file_name("--json", a.json));
    if (!options.parse(argc, argv)) return app::kDone;
    if (!scenes.empty()) a.scenes = scenes;
    fs::create_directories(a.folder);
    Json all = Json::array();
    for (const std::string& name : a.scenes) all.push_back(measure(name, a, {.program = "limn_promise"}));
    app::write_text(a.json, all.dump(2) + "\n");  // NaN becomes null
    return app::kDone;
}

}  // namespace

}  // namespace limn::bench

int main(int argc, char** argv) {
    return limn::app::run_program("limn_promise", [&] { return limn::bench::run(argc, argv); });
}
