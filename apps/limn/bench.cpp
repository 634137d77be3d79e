#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "bench/session.h"
#include "commands.h"
#include "interrupt.h"
#include "json_output.h"
#include "limn/math/error.h"
#include "parse.h"
#include "program.h"
#include "progress_bar.h"

namespace limn::app {

namespace {

using bench::Plan;

constexpr const char* kMeaning =
    R"(Rates are in million rays per second, medians over the rounds. limn/Embree, limn/robust and
batch/best are medians of the ratios of each round, with their quartiles. In every round each
renderer takes its turn. One thread is measured by processor time, several by the clock.

batch is the fastest of limn's batches of 1, 8, 64, 4096 and 65536 rays. Embree appears if its
module was built. best is its fastest mode: single rays, packets of 4, 8 or 16, streams of single
rays (1M) or of packets (16M). differ/M is the number of rays in a million on which Embree and
limn differ.)";

// Returns a function for Options::add that stores an integer in [lowest, highest].
template <class Integer>
auto integer_option(const char* option, Integer lowest, Integer highest, Integer& value) {
    return [=, &value](const std::string& text) { value = parse_integer(option, text, lowest, highest); };
}

// Adds a repeatable option whose values are among `names`. They are appended to `chosen`.
void add_choice(Options& options, const std::string& name, const std::string& help, const std::string& preset,
                const std::vector<std::string>& names, std::vector<std::string>& chosen) {
    options.add({.name = name,
                 .value = "NAME",
                 .help = fmt::format("{} (repeatable): {}", help, fmt::join(names, ", ")),
                 .preset = preset,
                 .repeatable = true},
                [&names, &chosen, name](const std::string& text) {
                    if (std::find(names.begin(), names.end(), text) == names.end())
                        refuse(name, text, fmt::format("is none of {}", fmt::join(names, ", ")));
                    chosen.push_back(text);
                });
}

void add_options(Options& options, Plan& plan, bool& quiet) {
    // Add what is measured.
    const auto text = [](const auto& value) { return fmt::format("{}", value); };
    options.add({.name = "MODEL",
                 .value = "",
                 .help = "Wavefront OBJ models to measure",
                 .preset = "none, and all scenes without --scene",
                 .repeatable = true},
                file_names("MODEL", plan.models));
    add_choice(options, "--scene", "A scene to measure", "all where no MODEL is given", bench::scene_names(),
               plan.scenes);
    add_choice(options, "--kind", "Measure only rays of this kind", "all", bench::ray_kinds(), plan.kinds);
    options.add({.name = "--scale",
                 .value = "X",
                 .help = "Factor on the number of primitives of the scenes",
                 .preset = text(plan.scale)},
                [&plan](const std::string& s) {
                    plan.scale = parse_number("--scale", s);
                    if (!(plan.scale > 0 && plan.scale <= 100)) refuse("--scale", s, "must be in (0, 100]");
                });
    // Add how it is measured.
    options.add({.name = "--rays", .value = "N", .help = "Rays of each kind", .preset = text(plan.rays)},
                integer_option("--rays", std::size_t{1}, std::size_t{1} << 26, plan.rays));
    options.add({.name = "--rounds", .value = "N", .help = "Rounds of each measurement", .preset = text(plan.rounds)},
                integer_option("--rounds", 1, 1000, plan.rounds));
    options.add({.name = "--build-rounds",
                 .value = "N",
                 .help = "Rounds of building the scene",
                 .preset = text(plan.build_rounds)},
                integer_option("--build-rounds", 0, 1000, plan.build_rounds));
    options.add({.name = "--threads", .value = "N", .help = "Number of threads", .preset = "one, and then all"},
                [&plan](const std::string& s) { plan.threads = {parse_integer("--threads", s, 1, 1024)}; });
    options.add_flag("--quiet", quiet, "Print errors only");
}

}  // namespace

int bench_command(int argc, const char* const* argv) {
    // Read the options.
    Options options("limn bench", "Measures rays per second, and Embree on the same rays where it is installed.",
                    kMeaning);
    Plan plan;
    bool quiet = false;
    add_options(options, plan, quiet);
    const JsonOption json(options);
    if (!options.parse(argc, argv)) return kDone;
    json.check(plan.models);
    if (plan.scenes.empty() && plan.models.empty()) plan.scenes = bench::scene_names();
    if (plan.threads.empty()) {
        plan.threads = {1};
        if (const unsigned all = std::thread::hardware_concurrency(); all > 1)
            plan.threads.push_back(static_cast<int>(all));
    }

    // Load Embree, if its module was built.
    const Console console{.program = "limn", .quiet = quiet};
    std::vector<std::string> notes;
    const std::vector<bench::Contender> contenders = bench::load_contenders(notes);
    for (const std::string& note : notes) console.note(note);

    // Measure with a progress bar. A signal ends the measurement.
    catch_interrupts();
    ProgressBar bar(!quiet && stderr_is_terminal());
    const auto begin = std::chrono::steady_clock::now();
    const auto watch = [&](double fraction) {
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        bar.update({fraction, seconds.count()});
        return caught_signal() == 0;
    };
    const bench::Results results = from_files([&] { return bench::run_session(plan, contenders, watch); });

    // Write the results, also those of an interrupted measurement.
    bar.clear();
    json.write(results.table, results.json);
    if (caught_signal() != 0) return 128 + caught_signal();
    if (!results.fault.empty()) throw Error(results.fault);
    return kDone;
}

}  // namespace limn::app
