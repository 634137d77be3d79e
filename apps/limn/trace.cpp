#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

#include "answer_writer.h"
#include "commands.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "model_input.h"
#include "parse.h"
#include "program.h"
#include "progress_bar.h"
#include "ray_reader.h"

namespace limn::app {

namespace {

constexpr const char* kForms =
    R"(A ray is a line of six or eight numbers, ox oy oz dx dy dz [tmin tmax]: its origin, its
direction, and the interval (tmin, tmax], which is (0, inf] unless given. Blank lines and
lines that begin with # are skipped.

The result of a ray is a line: t face u v with 17 digits, or miss; with --any 1 or 0. t is in
units of the direction, which need not have unit length. face is the index of the face in the
file, from 0; the triangles of a polygon share it. u and v are the weights of the second and
third corner of the triangle that was hit.

Results come in the order of the rays, each as soon as its ray has arrived. A ray that cannot
be used (NaN, no direction, an infinite origin or direction, tmin = inf, tmin above tmax) is a
miss. Such rays are counted on stderr at the end.

With --binary a ray is 8 little-endian float64: origin, direction, tmin, tmax. Its result is
4: t or inf, face or -1, u, v; with --any it is 1.)";

struct Arguments {
    std::string model, rays = "-";
    bool any = false, binary = false, quiet = false;
};

// A model and its compiled scene. The model maps triangles back to the faces of the file.
struct Traceable {
    Model model;
    CompiledScene scene;
};

Traceable load(const Arguments& a, const Console& console) {
    Model model = read_model(a.model, {.textures = false});
    for (const std::string& warning : model.warnings) console.note(warning);
    Scene scene;
    scene.add(model);
    CompiledScene compiled = compile(scene);
    return {std::move(model), std::move(compiled)};
}

// Writes the nearest hit of each ray. Returns the number of unusable rays.
std::size_t answer_closest(const Traceable& in, std::span<const Ray> rays, AnswerWriter& answers) {
    std::vector<RayHit> hits(rays.size());
    const std::size_t unusable = in.scene.closest_hit(rays, hits);
    for (const RayHit& hit : hits) {
        if (hit.t == kInfinity)
            answers.miss();
        else
            answers.hit(hit.t, in.model.meshes[in.model.instances[hit.object].mesh]->face(hit.element), hit.u, hit.v);
    }
    return unusable;
}

// Writes for each ray if it hits anything. Returns the number of unusable rays.
std::size_t answer_any(const Traceable& in, std::span<const Ray> rays, AnswerWriter& answers) {
    std::vector<std::uint8_t> occluded(rays.size());
    const std::size_t unusable = in.scene.any_hit(rays, occluded);
    for (const std::uint8_t is_hit : occluded) answers.occluded(is_hit != 0);
    return unusable;
}

// True if a progress bar can be shown: the end of the input is known, and no results are printed on the terminal.
bool wants_bar(const Arguments& a, const RayReader& reader) {
    return !a.quiet && reader.fraction() && stderr_is_terminal() && ::isatty(STDOUT_FILENO) == 0;
}

void trace(const Arguments& a, const Console& console) {
    // Open the rays before the model is loaded, so that a wrong name is reported early.
    RayReader reader(a.rays, a.binary);
    const Traceable in = from_files([&] { return load(a, console); });
    AnswerWriter answers(a.binary);
    ProgressBar bar(wants_bar(a, reader));
    const auto begin = std::chrono::steady_clock::now();
    // Trace the rays block by block as they arrive.
    std::size_t unusable = 0;
    for (std::span<const Ray> rays; !(rays = reader.next()).empty();) {
        unusable += a.any ? answer_any(in, rays, answers) : answer_closest(in, rays, answers);
        answers.flush();
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        bar.update({reader.fraction().value_or(0), seconds.count()});
    }
    bar.clear();
    if (unusable > 0) console.note(fmt::format("rays that cannot be used, counted as misses: {}", unusable));
}

}  // namespace

int trace_command(int argc, const char* const* argv) {
    Options options("limn trace", "Prints the face of a model that each ray hits first, or whether it hits any.",
                    kForms);
    Arguments a;
    options.add({.name = "MODEL",
                 .value = "",
                 .help = "The model: OBJ, PLY, STL or glTF; - for standard input",
                 .required = true},
                file_name("MODEL", a.model));
    options.add({.name = "--rays", .value = "FILE", .help = "File of the rays", .preset = "-, which is standard input"},
                file_name("--rays", a.rays));
    options.add_flag("--any", a.any, "Print only whether there is a hit: 1 or 0");
    options.add_flag("--binary", a.binary, "Read rays and write results as little-endian float64 instead of text");
    options.add_flag("--quiet", a.quiet, "Print errors only");
    if (!options.parse(argc, argv)) return kDone;
    if (a.model == kStandardInput && a.rays == kStandardInput)
        throw ArgumentError("MODEL -: standard input cannot be the rays too; name a file of them with --rays");
    if (a.binary && ::isatty(STDOUT_FILENO) != 0)
        throw ArgumentError("--binary: standard output is a terminal; send it to a file or a pipe");

    trace(a, {.program = "limn", .quiet = a.quiet});
    return kDone;
}

}  // namespace limn::app
