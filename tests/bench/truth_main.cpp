// limn_bench_truth: what limn answers to the rays of `limn bench`, on a sample, against exact truth. As JSON on stdout.
// Usage: limn_bench_truth SCALE RAYS SAMPLE [MODEL.obj ...]. Exit status 1 if an answer is wrong.
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/scenes.h"
#include "bench/truth.h"

namespace {

using namespace limn;

bool judge_scene(const bench::Geometry& geometry, std::size_t rays, std::size_t sample, nlohmann::ordered_json& out) {
    const CompiledScene scene = compile(bench::describe(geometry));
    bool all_right = true;
    for (const bench::RaySet& set : bench::make_rays(geometry, scene, rays)) {
        const test::Verdict v = test::judge(geometry, scene, set, sample);
        all_right = all_right && v.wrong == 0;
        out.push_back({{"scene", geometry.name},
                       {"rays", set.name},
                       {"judged", v.rays},
                       {"hits", v.hits},
                       {"wrong", v.wrong},
                       {"first", v.first}});
    }
    return all_right;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fputs("usage: limn_bench_truth SCALE RAYS SAMPLE [MODEL.obj ...]\n", stderr);
        return 2;
    }
    try {
        const double scale = std::atof(argv[1]);
        const auto rays = static_cast<std::size_t>(std::atoll(argv[2]));
        const auto sample = static_cast<std::size_t>(std::atoll(argv[3]));
        nlohmann::ordered_json out = nlohmann::ordered_json::array();
        bool all_right = true;
        for (const std::string& name : bench::scene_names())
            all_right = judge_scene(bench::make_scene(name, scale), rays, sample, out) && all_right;
        for (int i = 4; i < argc; ++i)
            all_right = judge_scene(bench::load_scene(argv[i]), rays, sample, out) && all_right;
        std::printf("%s\n", out.dump(1).c_str());
        return all_right ? 0 : 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "limn_bench_truth: %s\n", e.what());
        return 1;
    }
}
