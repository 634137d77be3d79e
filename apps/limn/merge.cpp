#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "limn/math/error.h"
#include "limn/render/film.h"
#include "limn/render/render_job.h"
#include "parse.h"
#include "picture_output.h"
#include "program.h"
#include "text_file.h"

namespace limn::app {

namespace {

struct Arguments : PictureOptions {
    std::vector<std::string> films;
    std::optional<double> error;
    std::string plan;
};

// Checks that the options fit together and the outputs can be written. \throws ArgumentError, FileError
void check(const Arguments& a) {
    if (a.error.has_value() == a.plan.empty()) throw ArgumentError("--error and --plan: each needs the other");
    std::vector<std::string> outputs = a.all_outputs();
    if (!a.plan.empty()) outputs.push_back(a.plan);
    if (outputs.empty()) throw ArgumentError("-o is missing: nothing would be written");
    check_distinct(outputs, a.films);
    check_picture_options(a);
    if (!a.plan.empty()) check_text_path(a.plan);
}

// Writes the plan of the next round. \throws FileError
void save_plan(const Film& film, const RenderResult& result, const Arguments& a) {
    if (film.fewest_samples() < SamplePlan::kFirstPass)
        throw FileError(fmt::format("{}", fmt::join(a.films, ", ")),
                        fmt::format("a plan needs {} samples in each pixel", SamplePlan::kFirstPass));
    plan_next_round(film, result.error, a.plan);
}

}  // namespace

int merge_command(int argc, const char* const* argv) {
    // Read the options.
    Options options(
        "limn merge",
        "Joins the films of the parts of a render (see --shard of limn render) to one film and its picture. "
        "The result is that of one render, bit for bit.",
        fmt::format(
            "The exit status is {} if the error is not reached: --plan was written for another render of all parts.",
            kUnfinished));
    Arguments a;
    a.command_line = "limn " + command_line(argc, argv);
    options.add({.name = "FILM",
                 .value = "",
                 .help = "Films that hold each tile of the picture once, in any order",
                 .required = true,
                 .repeatable = true},
                file_names("FILM", a.films));
    options.add({.name = "--error",
                 .value = "E",
                 .help = "The relMSE to reach, by the upper end of its 95 % interval; needs --plan",
                 .preset = "none"},
                [&a](const std::string& text) { a.error = parse_positive("--error", text); });
    options.add({.name = "--plan",
                 .value = "FILE",
                 .help = "If the picture has not reached that error, write how many samples each pixel needs next, for "
                         "limn render --plan",
                 .preset = "none"},
                file_name("--plan", a.plan));
    add_picture_options(options, a, false);
    if (!options.parse(argc, argv)) return kDone;
    check(a);

    // Merge the films and estimate the error.
    const Console console{.program = "limn", .quiet = a.quiet};
    const Film film = Film::merge(a.films);
    if (!a.film.empty()) film.save(a.film);
    const RenderResult result = render_result(film, a.error);
    const bool is_unfinished = a.error && !result.error.reached;

    // Save the pictures and the report, and the plan if the error is not reached.
    const bool saved = save_pictures(result, film.info(), a, console);
    if (is_unfinished) save_plan(film, result, a);
    return !saved ? kFailed : is_unfinished ? kUnfinished : kDone;
}

}  // namespace limn::app
