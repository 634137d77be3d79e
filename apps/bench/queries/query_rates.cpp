// How long limn's queries take in C++, on the mesh and the rays of a file. Run by queries.py.
//
// limn_query_rates rays INPUT   nearest hits of all rays, and all hits of rays that have one
// limn_query_rates move INPUT   10,000 instances of the mesh put elsewhere
//
// INPUT: counts of vertices, faces and rays as uint64, then float32 vertices, uint32 faces, float32 rays.
// Prints JSON: seconds that passed, each the least of several rounds.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/stopwatch.h"
#include "limn/query/compiled_scene.h"
#include "limn/shape/instance.h"
#include "limn/shape/mesh.h"

namespace {

using namespace limn;
using bench::Stopwatch;

constexpr int kRounds = 9;
constexpr std::size_t kInstances = 10000;

struct Input {
    MeshData mesh;
    std::vector<Ray> rays;
};

template <class T>
std::vector<T> read(std::ifstream& in, std::size_t count) {
    std::vector<T> values(count);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    return values;
}

Input read_input(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::vector<std::uint64_t> sizes = read<std::uint64_t>(in, 3);
    Input input;
    input.mesh.vertices = read<Float3>(in, sizes[0]);
    input.mesh.triangles = read<Index3>(in, sizes[1]);
    const std::vector<float> r = read<float>(in, 6 * sizes[2]);
    if (!in) throw std::runtime_error("the input is cut short");
    for (std::size_t i = 0; i < r.size(); i += 6)
        input.rays.push_back({.origin = {r[i], r[i + 1], r[i + 2]}, .direction = {r[i + 3], r[i + 4], r[i + 5]}});
    return input;
}

CompiledScene compile_mesh(const std::shared_ptr<const Mesh>& mesh) {
    Scene scene;
    scene.add(mesh);
    return compile(scene);
}

// The least of what some rounds have taken.
struct Least {
    double seconds = kInfinity;

    template <class Work>
    void of(Work&& work) {
        const Stopwatch watch(bench::Clock::wall);
        work();
        seconds = std::min(seconds, watch.seconds());
    }
};

// From the middle between the first two hits of one ray, in the direction of the next: where a mesh is closed, inside.
std::vector<Ray> with_one_hit(const CompiledScene& scene, const std::vector<Ray>& rays) {
    std::vector<Ray> found;
    std::vector<RayHit> hits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        scene.all_hits(rays[i], hits);
        if (hits.size() < 2) continue;
        const Ray inner{.origin = rays[i].origin + rays[i].direction * ((hits[0].t + hits[1].t) / 2),
                        .direction = rays[(i + 1) % rays.size()].direction};
        scene.all_hits(inner, hits);
        if (hits.size() == 1) found.push_back(inner);
    }
    return found;
}

// Keeps what is asked of single rays from being left out.
double sum_of_t = 0;

void measure_rays(const Input& input) {
    const CompiledScene scene = compile_mesh(std::make_shared<Mesh>(input.mesh, nullptr));
    const std::vector<Ray> single = with_one_hit(scene, input.rays);
    std::vector<RayHit> hits(input.rays.size()), some;
    RayHits all;
    const std::span<RayHit> of_single = std::span(hits).first(single.size());
    Least nearest, batch, threads, one_nearest, one_all, one_nearest_batch, one_all_batch;
    for (int round = 0; round < kRounds; ++round) {
        nearest.of([&] {
            for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = scene.closest_hit(input.rays[i]).value_or(RayHit{});
        });
        batch.of([&] { scene.closest_hit(input.rays, hits); });
        threads.of([&] { scene.closest_hit(input.rays, hits, 0); });
        one_nearest.of([&] {
            for (const Ray& ray : single) sum_of_t += scene.closest_hit(ray)->t;
        });
        one_all.of([&] {
            for (const Ray& ray : single) {
                scene.all_hits(ray, some);
                sum_of_t += some.front().t;
            }
        });
        one_nearest_batch.of([&] { scene.closest_hit(single, of_single); });
        one_all_batch.of([&] { scene.all_hits(single, all); });
    }
    std::printf(R"({"rays": %zu, "nearest": %.9g, "nearest_batch": %.9g, "nearest_threads": %.9g, )"
                R"("one_hit_rays": %zu, "one_hit_nearest": %.9g, "one_hit_all": %.9g, )"
                R"("one_hit_nearest_batch": %.9g, "one_hit_all_batch": %.9g, "sum": %.9g})"
                "\n",
                input.rays.size(), nearest.seconds, batch.seconds, threads.seconds, single.size(), one_nearest.seconds,
                one_all.seconds, one_nearest_batch.seconds, one_all_batch.seconds, sum_of_t);
}

void measure_moves(const Input& input) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> along(-50, 50);
    const auto somewhere = [&] {
        const double x = along(random), y = along(random), z = along(random);
        return Transform::translate({x, y, z});
    };
    const auto mesh = std::make_shared<Mesh>(input.mesh, nullptr);
    Scene description;
    for (std::size_t i = 0; i < kInstances; ++i) description.add(std::make_shared<Instance>(mesh, somewhere()));
    CompiledScene scene = compile(description);
    Least move;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<MovedObject> moved;
        for (std::size_t i = 0; i < kInstances; ++i) moved.push_back({i, somewhere()});
        move.of([&] { scene = recompile(std::move(scene), moved); });
    }
    std::printf("{\"recompile\": %.9g}\n", move.seconds);
}

}  // namespace

int main(int count, char** arguments) try {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    if (words.size() == 2 && words[0] == "rays") {
        measure_rays(read_input(words[1]));
    } else if (words.size() == 2 && words[0] == "move") {
        measure_moves(read_input(words[1]));
    } else {
        std::fputs("usage: limn_query_rates rays|move INPUT\n", stderr);
        return 2;
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "limn_query_rates: %s\n", error.what());
    return 1;
}
