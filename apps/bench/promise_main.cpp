// limn's estimate of its own error against references: after given numbers of samples, and where a render to an error
// ends. Writes a line for each render; promise.py makes tables of them.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/promise.h"
#include "parse.h"
#include "program.h"

namespace limn::bench {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> scenes = subject_names();
    int seeds = 50, stops = 20, compared = 5;
    int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::string folder = "build/promise";
};

// After so many samples, or, if 0, at a target.
struct Task {
    int samples = 0;
    double target = 0;
    std::uint64_t seed = 0;
    bool compare = false;

    Json key() const { return {{"after", samples}, {"target", target}, {"seed", seed}}; }
};

std::vector<Task> tasks_of(const Subject& subject, const Arguments& a) {
    std::vector<Task> tasks;
    for (const int samples : {8, 16, 32, 64, 256})
        for (int seed = 1; seed <= a.seeds; ++seed)
            tasks.push_back({.samples = samples, .seed = static_cast<std::uint64_t>(seed)});
    for (const double target : {3e-2, 1e-2, 1e-3, 1e-4})
        for (int seed = 1; seed <= a.stops && target >= subject.finest; ++seed)
            tasks.push_back(
                {.target = target, .seed = static_cast<std::uint64_t>(seed), .compare = seed <= a.compared});
    return tasks;
}

Json measure(const Subject& subject, const Task& task) {
    const Known k = task.samples > 0 ? known_after(subject, task.samples, task.seed)
                                     : known_at_stop(subject, task.target, task.seed, task.compare);
    Json j = task.key();
    j.update({{"samples", k.samples},
              {"estimate", k.estimate},
              {"lower", k.lower},
              {"upper", k.upper},
              {"error", k.error},
              {"fewest", k.fewest},
              {"halves", k.halves}});
    return j;  // NaN becomes null
}

// What was measured before is not measured again: a line each, in a file for each scene.
class Record {
public:
    explicit Record(const fs::path& path) : path_(path) {
        std::ifstream in(path);
        std::string line;
        while (std::getline(in, line))
            if (const Json j = Json::parse(line, nullptr, false); !j.is_discarded()) lines_.push_back(j);
    }

    bool holds(const Task& task) const {
        const Json key = task.key();
        return std::any_of(lines_.begin(), lines_.end(), [&key](const Json& line) {
            return std::all_of(key.items().begin(), key.items().end(),
                               [&line](const auto& item) { return line.value(item.key(), Json{}) == item.value(); });
        });
    }
    void add(const Json& line) {
        const std::lock_guard lock(mutex_);
        std::ofstream(path_, std::ios::app) << line.dump() << '\n';
    }

private:
    fs::path path_;
    std::vector<Json> lines_;
    std::mutex mutex_;
};

// A reference is kept for good: delete the folder to begin anew.
void load_or_render(Subject& subject, const fs::path& folder) {
    const auto path = [&](const char* half) {
        return (folder / fmt::format("{}_{}_{}_{}.exr", subject.name, subject.size, subject.finest, half)).string();
    };
    if (fs::exists(path("a")) && fs::exists(path("b"))) {
        subject.a = load_image(path("a")), subject.b = load_image(path("b"));
        return;
    }
    render_reference(subject);
    save_image(subject.a, path("a"));
    save_image(subject.b, path("b"));
}

void measure_all(const std::string& name, const Arguments& a, const app::Console& console) {
    Subject subject = subject_of(name);
    Record record(fs::path(a.folder) / (name + ".jsonl"));
    std::vector<Task> missing;
    for (const Task& task : tasks_of(subject, a))
        if (!record.holds(task)) missing.push_back(task);
    if (missing.empty()) return;
    console.note(name + ": reference ...");
    load_or_render(subject, a.folder);
    console.note(fmt::format("{}: {} renders ...", name, missing.size()));
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i; (i = next++) < missing.size();) record.add(measure(subject, missing[i]));
    };
    std::vector<std::jthread> threads;
    for (int t = 0; t < a.threads; ++t) threads.emplace_back(work);
}

int run(int argc, char** argv) {
    app::Options options("limn_promise", "Measures limn's estimate of its own error. Earlier measurements are kept.");
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
    integer("--seeds", a.seeds, 0, "Renders of each scene after each number of samples");
    integer("--stops", a.stops, 0, "Renders of each scene to each error");
    integer("--compared", a.compared, 0, "Of these, those whose fewest samples are looked for");
    integer("--threads", a.threads, 1, "Renders at a time");
    options.add(
        {.name = "--folder", .value = "FOLDER", .help = "Where lines and references are kept", .preset = a.folder},
        app::file_name("--folder", a.folder));
    if (!options.parse(argc, argv)) return app::kDone;
    if (!scenes.empty()) a.scenes = scenes;
    fs::create_directories(a.folder);
    for (const std::string& name : a.scenes) measure_all(name, a, {.program = "limn_promise"});
    return app::kDone;
}

}  // namespace

}  // namespace limn::bench

int main(int argc, char** argv) {
    return limn::app::run_program("limn_promise", [&] { return limn::bench::run(argc, argv); });
}
