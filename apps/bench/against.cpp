// Prints the time that a render or a set of rays takes. against.py links it with the libraries of two commits.
//     against                                   lists the scenes: "samples NAME" or "rays NAME"
//     against samples|instructions|rays NAME SPP  renders 100x100 or 16x16 pixels, or traces rays of each kind
#include <cstdio>
#include <functional>
#include <map>

#include "bench/contender.h"
#include "bench/transport_scenes.h"
#include "figures.h"

using namespace limn;

static std::map<std::string, std::function<Figure()>> pictures() {
    std::map<std::string, std::function<Figure()>> found;
#define LIMN_ADD(figure) found[#figure] = [] { return figures::figure(); };
    LIMN_FIGURES(LIMN_ADD)
    for (const std::string& name : bench::transport_scene_names())
        found[name] = [name] { return bench::make_transport_scene(name); };
    return found;
}

// Calls `work` and prints the processor time of this thread.
static void print_seconds(const std::string& what, const std::function<void()>& work) {
    const double begin = bench::seconds(bench::Clock::thread);
    work();
    std::printf("%s %.9g\n", what.c_str(), bench::seconds(bench::Clock::thread) - begin);
}

// Renders. Callgrind counts only the instructions of this function.
extern "C" [[gnu::noinline]] void measured_render(const CompiledScene& scene, const Figure& figure) {
    render(scene, figure.camera, figure.settings);
}

static void trace_rays(const std::string& name) {
    const bench::Geometry geometry = bench::make_scene(name, 1);
    const CompiledScene scene = compile(bench::describe(geometry));
    for (const bench::RaySet& set : bench::make_rays(geometry, scene, 65536)) {
        std::vector<RayHit> hits(set.rays.size());
        std::vector<std::uint8_t> occluded(set.rays.size());
        print_seconds(set.name + ",single", [&] {
            for (const Ray& ray : set.rays) set.any ? scene.any_hit(ray) : scene.closest_hit(ray).has_value();
        });
        print_seconds(set.name + ",batch",
                      [&] { set.any ? scene.any_hit(set.rays, occluded) : scene.closest_hit(set.rays, hits); });
    }
}

int main(int argc, char** argv) {
    const std::string what = argc == 4 ? argv[1] : "list";
    if (what == "list") {
        for (const auto& [name, make] : pictures()) std::printf("samples %s\n", name.c_str());
        for (const std::string& name : bench::scene_names()) std::printf("rays %s\n", name.c_str());
    } else if (what == "rays") {
        trace_rays(argv[2]);
    } else {
        Figure figure = pictures().at(argv[2])();
        figure.settings.width = figure.settings.height = what == "samples" ? 100 : 16;
        figure.settings.samples_per_pixel = std::stoi(argv[3]);
        figure.settings.threads = 1;
        const CompiledScene scene = compile(figure.scene);
        print_seconds("samples", [&] { measured_render(scene, figure); });
    }
}
