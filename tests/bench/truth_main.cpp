// limn_bench_truth judges a sample of limn's answers to the rays of `limn bench` by exact arithmetic. It prints JSON.
// Usage: limn_bench_truth SCALE RAYS SAMPLE SCENE|MODEL.obj ... The exit status is 1 if an answer is wrong.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>

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
    if (argc < 5) {
        std::fputs("usage: limn_bench_truth SCALE RAYS SAMPLE SCENE|MODEL.obj ...\n", stderr);
        return 2;
    }
    try {
        const double scale = std::atof(argv[1]);
        const auto rays = static_cast<std::size_t>(std::atoll(argv[2]));
        const auto sample = static_cast<std::size_t>(std::atoll(argv[3]));
        nlohmann::ordered_json out = nlohmann::ordered_json::array();
        bool all_right = true;
        for (const std::string name : std::span(argv + 4, argv + argc)) {
            const bool is_known = std::ranges::count(bench::scene_names(), name) > 0;
            const bench::Geometry geometry = is_known ? bench::make_scene(name, scale) : bench::load_scene(name);
            all_right = judge_scene(geometry, rays, sample, out) && all_right;
        }
        std::printf("%s\n", out.dump(1).c_str());
        return all_right ? 0 : 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "limn_bench_truth: %s\n", e.what());
        return 1;
    }
}
