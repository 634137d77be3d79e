// limn_accuracy [GROUP ...] [--rays N] [--leak-rays N] [--threads N]: measures groups of rays and writes them to stdout
// as JSON. Run by apps/bench/accuracy.py.
#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "accuracy/embree.h"
#include "accuracy/groups.h"
#include "limn/math/error.h"

namespace {

using namespace limn::accuracy;
using Json = nlohmann::ordered_json;

struct NamedGroup {
    const char* name;
    Group (*measure)(const Effort&);
};
const NamedGroup kGroups[] = {
    {"spheres", sphere_group},     {"triangles", triangle_group},     {"leaks", leak_group},
    {"quads", quad_group},         {"quad-leaks", quad_leak_group},   {"slabs", slab_group},
    {"instances", instance_group}, {"leaving", leaving_group},        {"furnace", furnace_group},
    {"bad-rays", bad_ray_group},   {"far-origins", far_origin_group}, {"queries", query_group}};

// Null where there is none.
Json embree_version() {
#ifdef LIMN_EMBREE_VERSION
    if (Embree::is_there()) return LIMN_EMBREE_VERSION;
#endif
    return nullptr;
}

Json to_json(const Group& group) {
    Json out{{"group", group.key}, {"measure", group.measure}, {"columns", group.columns}, {"rows", Json::array()}};
    for (const Row& row : group.rows) {
        Json cells = Json::array();
        for (const Cell& c : row.cells)
            cells.push_back({{"asked", c.asked},
                             {"false_hits", c.false_hits},
                             {"false_misses", c.false_misses},
                             {"self_hits", c.self_hits},
                             {"lost", c.lost},
                             {"aborts", c.aborts},
                             {"t_ulps", c.t_ulps},
                             {"uv_ulps", c.uv_ulps},
                             {"figure", c.figure},
                             {"figure_error", c.figure_error}});
        out["rows"].push_back({{"case", row.name}, {"x", row.x}, {"rays", row.rays}, {"judged", row.judged}});
        out["rows"].back()["cells"] = std::move(cells);
    }
    return out;
}

[[noreturn]] void usage(const std::string& problem) {
    std::fprintf(stderr,
                 "limn_accuracy: %s\nusage: limn_accuracy [GROUP ...] [--rays N] [--leak-rays N] [--threads N]\n"
                 "groups:",
                 problem.c_str());
    for (const NamedGroup& group : kGroups) std::fprintf(stderr, " %s", group.name);
    std::fputc('\n', stderr);
    std::exit(2);
}

std::uint64_t number(const std::string& option, const char* text) {
    std::uint64_t value = 0;
    const std::string digits = text ? text : "";
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem != std::errc{} || end != digits.data() + digits.size() || value == 0)
        usage(option + " needs a whole number above 0");
    return value;
}

int run(int argc, char** argv) {
    Effort effort;
    std::vector<const NamedGroup*> chosen;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--rays") {
            effort.rays = number(word, argv[++i]);
        } else if (word == "--leak-rays") {
            effort.leak_rays = number(word, argv[++i]);
        } else if (word == "--threads") {
            effort.threads = static_cast<unsigned>(std::min<std::uint64_t>(number(word, argv[++i]), 1024));
        } else {
            const auto* group = std::find_if(std::begin(kGroups), std::end(kGroups),
                                             [&](const NamedGroup& g) { return word == g.name; });
            if (group == std::end(kGroups)) usage("there is no group or option " + word);
            chosen.push_back(group);
        }
    }
    if (chosen.empty())
        for (const NamedGroup& group : kGroups) chosen.push_back(&group);

    Json out{{"embree", embree_version()}, {"compiler", __VERSION__}, {"groups", Json::array()}};
    for (const NamedGroup* group : chosen) out["groups"].push_back(to_json(group->measure(effort)));
    const std::string text = out.dump(1);
    return std::puts(text.c_str()) >= 0 && std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
