// The caller's floating-point environment: flushing of subnormals, rounding mode, unmasked traps. Whatever it is, limn
// leaks no ray, raises no trap, answers as in the default one, and leaves it as it was.
#if defined(__x86_64__)

#include <ucontext.h>
#include <csignal>
#include <cstring>

#include "catch.h"
#include "hard/corpus.h"
#include "hard/float_environments.h"
#include "hard/hard.h"
#include "limn/render/render.h"
#include "limn/scene/material/lambertian.h"

namespace limn::environment_test {

using namespace test;

namespace {

// Traps are counted and masked, so that the program goes on.
volatile std::sig_atomic_t traps = 0;

void on_trap(int, siginfo_t*, void* context) {
    traps = traps + 1;
    auto& csr = static_cast<ucontext_t*>(context)->uc_mcontext.fpregs->mxcsr;
    csr = (csr | kDefault) & ~kFlags;
}

// Runs `work` with every exception but "inexact" unmasked, and says how often one was raised.
template <class Work>
int count_traps(const Work& work) {
    struct sigaction action = {}, before = {};
    action.sa_sigaction = on_trap;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGFPE, &action, &before);
    traps = 0;
    {
        const InEnvironment unmasked(0x1000);  // of the masks only that of "inexact" is left
        work();
    }
    sigaction(SIGFPE, &before, nullptr);
    return traps;
}

std::vector<Ray> corpus_rays(const Corpus& corpus, int rays) {
    Random random(9000);
    std::vector<Ray> all;
    for (int i = 0; i < rays; ++i) all.push_back(corpus_ray(corpus, random, i));
    return all;
}

// What both worlds say of the rays, worked out in one environment.
struct Answers {
    std::vector<std::optional<RayHit>> compiled;
    std::vector<std::uint8_t> any;
    std::vector<std::optional<Hit>> described;
};

Answers ask(const CompiledScene& compiled, const HittableList& described, const std::vector<Ray>& rays, unsigned csr) {
    Answers answers;
    const InEnvironment environment(csr);
    for (const Ray& ray : rays) {
        answers.compiled.push_back(compiled.closest_hit(ray));
        answers.any.push_back(compiled.any_hit(ray));
        answers.described.push_back(described.hit(ray));
    }
    return answers;
}

template <class A, class B>
std::string compare(const std::optional<A>& a, const std::optional<B>& b) {
    if (a.has_value() != b.has_value()) return a ? "missed" : "false hit";
    if (!a) return {};
    if (a->t != b->t) return "t";
    return a->u != b->u || a->v != b->v ? "u, v" : "";
}

Scene small_scene() {
    Scene scene;
    scene.background = Background::gradient(Color{1, 1, 1}, Color{0.5, 0.7, 1});
    scene.add(std::make_shared<Sphere>(Point3{0, -100, 0}, 99.0, std::make_shared<Lambertian>(Color{0.5, 0.6, 0.7})));
    scene.add(std::make_shared<Instance>(
        std::make_shared<Mesh>(icosphere(1), std::make_shared<Lambertian>(Color{0.8, 0.3, 0.2})),
        Transform::rotate({1, 2, 3}, 40) * Transform::scale(1, 0.5, 2), Transform::rotate({1, 2, 3}, 60)));
    return scene;
}

Image small_picture(const Scene& scene, int threads) {
    return render(compile(scene), {.look_from = {0, 1, 6}, .look_at = {0, 0, 0}, .vertical_fov = 40},
                  {.width = 48, .height = 32, .samples_per_pixel = 8, .threads = threads})
        .image;
}

}  // namespace

TEST_CASE("Environment: whatever the caller flushes and how it rounds, no ray leaks out of a closed mesh",
          "[hard][environment]") {
    for (const double place : {0.0, 1e3}) {
        const MeshData mesh = icosphere(4, 1, {place, -place, place});
        Scene scene;
        scene.add(std::make_shared<Mesh>(mesh, nullptr));
        Random random(9010);
        std::vector<Ray> rays;
        for (int i = 0; i < count(1e6); ++i) {
            const Index3 t = mesh.triangles[random.index(mesh.triangles.size())];
            const Point3 a = vertex(mesh, t.a), b = vertex(mesh, t.b);
            const Point3 target = a + (i % 2 ? random.uniform() : 0) * (b - a);
            const Point3 origin = Point3{place, -place, place} + 0.5 * random.unit();
            rays.push_back({.origin = origin, .direction = target - origin});
        }
        for (const Environment& environment : kEnvironments) {
            std::vector<std::uint8_t> hit(rays.size());
            bool kept = false;
            {
                const InEnvironment there(environment.csr);
                compile(scene).any_hit(rays, hit);
                kept = there.is_as_it_was();
            }
            Tally tally;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ++tally.rays, ++tally.judged;
                if (!hit[i]) tally.fault(rays[i], "leak");
            }
            check(tally, environment.name);
            CHECK(kept);
        }
    }
}

TEST_CASE(
    "Environment: whatever the caller flushes and how it rounds, answers have the bits of the default one, and it "
    "is left as it was",
    "[hard][environment]") {
    const Corpus corpus = make_corpus();
    const CompiledScene compiled = compile(corpus.scene);
    const HittableList described(corpus.scene.objects());
    const std::vector<Ray> rays = corpus_rays(corpus, count(2e5));
    const Answers expected = ask(compiled, described, rays, kDefault);
    for (const Environment& environment : kEnvironments) {
        const Answers found = ask(compiled, described, rays, environment.csr);
        Tally tally;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ++tally.rays, ++tally.judged;
            std::string fault = compare(expected.compiled[i], found.compiled[i]);
            if (fault.empty()) fault = compare(expected.described[i], found.described[i]);
            if (fault.empty() && expected.any[i] != found.any[i]) fault = "any_hit";
            if (!fault.empty()) tally.fault(rays[i], fault);
        }
        check(tally, environment.name);

        const InEnvironment there(environment.csr);
        compiled.closest_hit(rays[0]);
        described.hit(rays[0]);
        compiled.any_hit(rays[0]);
        CHECK(there.is_as_it_was());
    }
}

TEST_CASE("Environment: a single shape, asked by itself, answers with the bits of the default one and raises no trap",
          "[hard][environment]") {
    const Corpus corpus = make_corpus();
    const std::vector<Ray> rays = corpus_rays(corpus, count(1e5));
    for (const Object& object : corpus.scene.objects()) {
        Tally tally;
        for (const Ray& ray : rays) {
            ++tally.rays, ++tally.judged;
            const auto expected = object->hit(ray);
            for (const Environment& environment : kEnvironments) {
                std::optional<Hit> found;
                {
                    const InEnvironment there(environment.csr);
                    found = object->hit(ray);
                }
                const std::string fault = compare(expected, found);
                if (!fault.empty()) tally.fault(ray, std::string(environment.name) + ": " + fault);
            }
            if (count_traps([&] { object->hit(ray); })) tally.fault(ray, "trap");
        }
        check(tally, "a shape");
    }
}

TEST_CASE("Environment: no query raises a trap, on usable rays or on others", "[hard][environment]") {
    const Corpus corpus = make_corpus();
    const CompiledScene compiled = compile(corpus.scene);
    const HittableList described(corpus.scene.objects());
    std::vector<Ray> rays = corpus_rays(corpus, count(1e6));
    for (const Ray& ray : unusable_rays()) rays.push_back(ray);
    Tally tally;
    for (const Ray& ray : rays) {
        ++tally.rays, ++tally.judged;
        if (count_traps([&] { compiled.closest_hit(ray); })) tally.fault(ray, "closest_hit");
        if (count_traps([&] { compiled.any_hit(ray); })) tally.fault(ray, "any_hit");
        if (count_traps([&] { described.hit(ray); })) tally.fault(ray, "hit");
    }
    check(tally, "traps");
}

TEST_CASE("Environment: compiling, surfaces and pictures raise no trap", "[hard][environment]") {
    const Corpus corpus = make_corpus();
    CHECK(count_traps([&] { compile(corpus.scene); }) == 0);
    const CompiledScene compiled = compile(corpus.scene);
    Tally tally;
    for (const Ray& ray : corpus_rays(corpus, count(1e6))) {
        ++tally.rays, ++tally.judged;
        const auto hit = compiled.closest_hit(ray);
        if (!hit) continue;
        std::optional<Surface> surface;
        if (count_traps([&] { surface = compiled.surface_at(ray, *hit); })) tally.fault(ray, "surface_at");
        if (count_traps([&] { surface->spawn_ray({1, 2, 3}, 0); })) tally.fault(ray, "spawn_ray");
        if (count_traps([&] { surface->spawn_ray_to(Point3{1, 2, 3}, 0); })) tally.fault(ray, "spawn_ray_to");
    }
    check(tally, "traps");
    const Scene scene = small_scene();
    CHECK(count_traps([&] { small_picture(scene, 1); }) == 0);
    CHECK(count_traps([&] { small_picture(scene, 2); }) == 0);
}

TEST_CASE("Environment: a picture has the same bits in every one, on one thread or two", "[hard][environment]") {
    const Scene scene = small_scene();
    const Image expected = small_picture(scene, 1);
    for (const Environment& environment : kEnvironments)
        for (const int threads : {1, 2}) {
            Image found;
            {
                const InEnvironment there(environment.csr);
                found = small_picture(scene, threads);
            }
            int different = 0;
            for (int y = 0; y < expected.height(); ++y)
                for (int x = 0; x < expected.width(); ++x) different += !(found.at(x, y) == expected.at(x, y));
            INFO(environment.name << ", " << threads << " threads");
            CHECK(different == 0);
        }
}

}  // namespace limn::environment_test

#endif
