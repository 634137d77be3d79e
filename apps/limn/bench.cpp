#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "bench/peer_module.h"
#include "bench/results.h"
#include "bench/scenes.h"
#include "bench/session.h"
#include "commands.h"
#include "interrupt.h"
#include "json_output.h"
#include "limn/core/error.h"
#include "parse.h"
#include "program.h"
#include "progress_bar.h"

namespace limn::app {

namespace {

using bench::Plan;

constexpr const char* kMeaning =
    R"(Rates are in million rays a second, medians over the rounds; limn/Embree, limn/robust and batch/best are the
medians of the ratios of each round, with their quartiles. Every round lets each take its turn; what one thread
does is measured by processor time, what several do by the clock. Embree appears where its module was built; best is
its fastest way of asking: packets of 4, 8 or 16, streams of single rays (1M) or of packets (16M). differ/M: rays in a
million that Embree answers otherwise than limn.)";

template <class Integer>
auto integer_option(const char* option, Integer lowest, Integer highest, Integer& value) {
    return [=, &value](const std::string& text) { value = parse_integer(option, text, lowest, highest); };
}

// A repeatable option for some of `names`.
void add_choice(CLI::App& cli, const std::string& option, const std::string& help,
                const std::vector<std::string>& names, std::vector<std::string>& chosen) {
    cli.add_option(option, chosen, fmt::format("{} (repeatable): {}", help, fmt::join(names, ", ")))
        ->type_name("NAME")
        ->allow_extra_args(false)
        ->each([&names, option](const std::string& name) {
            if (std::find(names.begin(), names.end(), name) == names.end())
                refuse(option, name, fmt::format("is none of {}", fmt::join(names, ", ")));
        });
}

void add_options(CLI::App& cli, Plan& plan, bool& quiet) {
    cli.add_option("MODEL", plan.models, "Wavefront OBJ models to measure; without one and without --scene, all scenes")
        ->each(file_name("MODEL"));
    add_choice(cli, "--scene", "A scene to measure", bench::scene_names(), plan.scenes);
    add_choice(cli, "--kind", "Only rays of this kind", bench::ray_kinds(), plan.kinds);
    cli.add_option_function<std::string>(
           "--scale",
           [&plan](const std::string& text) {
               plan.scale = parse_number("--scale", text);
               if (!(plan.scale > 0 && plan.scale <= 100)) refuse("--scale", text, "must lie in (0, 100]");
           },
           "Multiplies the number of primitives of the scenes")
        ->type_name("X");
    cli.add_option_function<std::string>(
           "--rays", integer_option("--rays", std::size_t{1}, std::size_t{1} << 26, plan.rays), "Rays of each kind")
        ->type_name("N");
    cli.add_option_function<std::string>("--rounds", integer_option("--rounds", 1, 1000, plan.rounds),
                                         "Rounds of each measurement")
        ->type_name("N");
    cli.add_option_function<std::string>("--build-rounds", integer_option("--build-rounds", 0, 1000, plan.build_rounds),
                                         "Rounds of building")
        ->type_name("N");
    cli.add_option_function<std::string>(
           "--threads",
           [&plan](const std::string& text) { plan.threads = {parse_integer("--threads", text, 1, 1024)}; },
           "Threads; without it, one and then all")
        ->type_name("N");
    cli.add_flag("--quiet", quiet, "Say nothing but errors");
    cli.footer(kMeaning);
}

}  // namespace

int bench_command(int argc, const char* const* argv) {
    CLI::App cli("Measures rays a second, beside Embree where it is there, on the same rays.", "limn bench");
    Plan plan;
    bool quiet = false;
    add_options(cli, plan, quiet);
    const JsonOption json(cli);
    if (!parse_arguments(cli, argc, argv)) return kDone;
    json.check(plan.models);
    if (plan.scenes.empty() && plan.models.empty()) plan.scenes = bench::scene_names();
    if (plan.threads.empty()) {
        plan.threads = {1};
        if (const unsigned all = std::thread::hardware_concurrency(); all > 1)
            plan.threads.push_back(static_cast<int>(all));
    }

    const Console console{.program = "limn", .quiet = quiet};
    std::vector<std::string> notes;
    const auto peers = bench::load_peers(notes);
    for (const std::string& note : notes) console.note(note);
    catch_interrupts();
    ProgressBar bar(!quiet && stderr_is_terminal());
    const auto begin = std::chrono::steady_clock::now();
    const auto watch = [&](double fraction) {
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        bar.update({fraction, seconds.count()});
        return caught_signal() == 0;
    };
    const auto results = from_files([&] { return bench::run_session(plan, peers, watch); });
    bar.clear();
    json.write(bench::results_table(results), bench::results_json(plan, peers, results, caught_signal() == 0));
    if (caught_signal() != 0) return 128 + caught_signal();
    for (const bench::SceneResult& scene : results)
        for (const bench::RayRow& row : scene.rows)
            if (row.differences > 0)
                throw Error(fmt::format("{}, {}: {} rays are answered otherwise in batches", scene.name, row.rays,
                                        row.differences));
    return kDone;
}

}  // namespace limn::app
