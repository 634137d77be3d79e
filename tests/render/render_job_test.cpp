// Renders that are paused, saved, loaded, cut into shards and merged are those that never were.
#include "limn/render/render_job.h"

#include <atomic>
#include <mutex>
#include <thread>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/math/tagged.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/texture/perlin.h"
#include "support/folder.h"
#include "support/pictures.h"
#include "support/same_render.h"
#include "support/text.h"

namespace limn::render_job_test {

using namespace test;

namespace {

const Camera kEye = camera_at({0, 2, 6}, {0, 0.5, 0}, 40);

CompiledScene lit_scene() {
    return compile_with(sky(0.1), {quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, grey(0.7)),
                                   sphere({0, 0.5, 0}, 0.5, std::make_shared<Dielectric>(1.5)),
                                   sphere({1.5, 0.5, 0}, 0.5, std::make_shared<Metal>(Color{0.8, 0.6, 0.2}, 0.3)),
                                   quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, lamp(8))});
}

RenderSettings settings_of(std::optional<double> error, int samples = 40) {
    RenderSettings s = square(40, samples, 6);
    s.height = 33;
    s.error = error;
    s.threads = 2;
    return s;
}

// Stops at the n-th question of the callback, from 0 on.
RenderSettings stopping_at(RenderSettings settings, std::atomic<int>& questions) {
    settings.progress = [&questions](const Progress&) { return questions-- > 0; };
    return settings;
}

// Fails at the n-th question, from 0 on, and no more.
struct FailingOnce final : Texture {
    Color value(const Surface&) const override {
        if (left-- == 0) throw Error("once");
        return {0.5, 0.5, 0.5};
    }
    mutable std::atomic<int> left = -1;
};

std::string fault_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST_CASE("Jobs: stopped anywhere and run again, a render is the one that was not stopped", "[render][job]") {
    const CompiledScene scene = lit_scene();
    for (const std::optional<double> error : {std::optional<double>(), std::optional(0.02)}) {
        RenderSettings settings = settings_of(error);
        settings.max_samples_per_pixel = 4000;
        const RenderResult unbroken = render(scene, kEye, settings);
        std::atomic<int> questions = 0;
        RenderJob job(scene, kEye, stopping_at(settings, questions));
        int runs = 0;
        for (StoppedBy end = StoppedBy::callback; end == StoppedBy::callback; ++runs) {
            questions = 1 + runs % 3;  // at least one that is not the first of all
            end = job.run();
            CHECK((end == StoppedBy::callback || end == unbroken.report.stopped_by));
            REQUIRE(runs < 10000);
        }
        check_same(job.result(), unbroken);
        CHECK(job.result().report.complete);
        // There is nothing left to do.
        questions = 100;
        CHECK(job.run() == unbroken.report.stopped_by);
        check_same(job.result(), unbroken);
    }
}

TEST_CASE("Jobs: run again after user-defined code has thrown, a render is the one that was not", "[render][job]") {
    const auto texture = std::make_shared<FailingOnce>();
    const CompiledScene scene =
        compile_with(sky(1), {quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, std::make_shared<Lambertian>(texture)),
                              sphere({0, 0.5, 0}, 0.5, std::make_shared<Metal>(Color{0.9, 0.9, 0.9}, 0.2)),
                              sphere({3, 3, 0}, 0.5, lamp(50))});
    RenderSettings settings = settings_of({}, 8);
    settings.threads = 1;
    const RenderResult unbroken = render(scene, kEye, settings);
    for (const int at : {37, 700, 1000, 5000}) {
        CAPTURE(at);
        RenderJob job(scene, kEye, settings);
        texture->left = at;
        CHECK(fault_of([&] { job.run(); }) == "once");
        job.run();
        check_same(job.result(), unbroken);
    }
}

TEST_CASE("Jobs: saved while they run and loaded by another, they give the same", "[render][job]") {
    const Folder folder;
    const CompiledScene scene = lit_scene();
    for (const std::optional<double> error : {std::optional<double>(), std::optional(0.004)}) {
        RenderSettings settings = settings_of(error, 200);
        settings.max_samples_per_pixel = 4000;
        const RenderResult unbroken = render(scene, kEye, settings);
        std::vector<std::string> films;
        {
            RenderJob job(scene, kEye, settings);
            std::atomic<bool> done = false;
            std::thread saver([&] {
                while (!done && films.size() < 40) {
                    films.push_back(folder.path(std::to_string(films.size()) + ".film"));
                    job.save(films.back());
                    CHECK(job.image().width() == 40);
                }
            });
            job.run();
            done = true;
            saver.join();
            films.push_back(folder.path("end.film"));
            job.save(films.back());
        }
        int threads = 1;
        for (const std::string& path : films) {
            CAPTURE(path);
            settings.threads = 1 + threads++ % 3;
            RenderJob job(scene, kEye, settings);
            job.load(path);
            CHECK(job.run() == unbroken.report.stopped_by);
            check_same(job.result(), unbroken);
        }
    }
}

TEST_CASE("Jobs: more samples and smaller errors give what they had given from the beginning", "[render][job]") {
    const Folder folder;
    const CompiledScene scene = lit_scene();
    const auto rendered = [&](const RenderSettings& s) { return render(scene, kEye, s); };
    const auto continued = [&](const RenderSettings& s) {
        RenderJob job(scene, kEye, s);
        job.load(folder.path("a.film"));
        job.run();
        return job.result();
    };
    const auto begin = [&](const RenderSettings& s) {
        RenderJob job(scene, kEye, s);
        job.run();
        job.save(folder.path("a.film"));
    };
    begin(settings_of({}, 5));
    check_same(continued(settings_of({}, 70)), rendered(settings_of({}, 70)));
    for (const double first : {0.3, 0.02, 0.007})
        for (const double second : {0.0069, 0.003}) {
            CAPTURE(first, second);
            begin(settings_of(first));
            RenderSettings settings = settings_of(second);
            check_same(continued(settings), rendered(settings));
        }
    // By the most samples.
    RenderSettings settings = settings_of(1e-9);
    settings.max_samples_per_pixel = 50;
    begin(settings);
    settings.max_samples_per_pixel = 77;
    check_same(continued(settings), rendered(settings));

    RenderJob job(scene, kEye, settings_of({}, 7));
    job.run();
    CHECK(job.add_samples(4) == StoppedBy::samples);
    check_same(job.result(), rendered(settings_of({}, 11)));
    CHECK_THROWS_AS(job.add_samples(0), ArgumentError);
    CHECK_THROWS_AS(job.add_samples(std::numeric_limits<int>::max()), ArgumentError);
}

TEST_CASE("Jobs: what has been rendered already is kept where less is asked for", "[render][job]") {
    const Folder folder;
    const CompiledScene scene = lit_scene();
    RenderJob job(scene, kEye, settings_of({}, 24));
    job.run();
    job.save(folder.path("a.film"));
    for (const std::optional<double> error : {std::optional<double>(), std::optional(1e6)}) {
        RenderJob less(scene, kEye, settings_of(error, 8));
        less.load(folder.path("a.film"));
        CHECK(less.run() == (error ? StoppedBy::error : StoppedBy::samples));
        CHECK(less.result().report.samples_per_pixel >= 24);
    }
}

TEST_CASE("Jobs: a film of another render is refused by what differs, and the job stays as it was", "[render][job]") {
    const Folder folder;
    const CompiledScene scene = lit_scene();
    RenderJob job(scene, kEye, settings_of({}, 4));
    job.run();
    job.save(folder.path("a.film"));
    const auto refusal = [&](const CompiledScene& other, const Camera& eye, const RenderSettings& s) {
        RenderJob stranger(other, eye, s);
        stranger.run();
        const Image before = stranger.image();
        const std::string fault = fault_of([&] { stranger.load(folder.path("a.film")); });
        if (!fault.empty()) CHECK(stranger.image() == before);
        return fault;
    };
    const auto with = [](auto change) {
        RenderSettings s = settings_of({}, 4);
        change(s);
        return s;
    };
    CHECK(refusal(scene, kEye, with([](RenderSettings&) {})).empty());
    const CompiledScene dark = compile_with(sky(0), {});
    CHECK(contains(refusal(dark, kEye, with([](RenderSettings&) {})), "a.film: is not of this render: its scene"));
    CHECK(contains(refusal(scene, kEye, with([](RenderSettings& s) { s.seed = 2; })), "its seed is 0, not 2"));
    CHECK(contains(refusal(scene, kEye, with([](RenderSettings& s) { s.width = 41; })), "its width is 40, not 41"));
    CHECK(contains(refusal(scene, kEye, with([](RenderSettings& s) { s.max_depth = 7; })), "depth limit"));
    CHECK(contains(refusal(scene, camera_at({0, 2, 7}, {0, 0.5, 0}, 40), settings_of({}, 4)), "camera's place"));
    CHECK(contains(refusal(scene, kEye, with([](RenderSettings& s) { s.uniform = true; })), "uniform"));
    CHECK(contains(refusal(scene, kEye, with([](RenderSettings& s) { s.sampler = SamplerKind::independent; })),
                   "sampler"));
    CHECK(refusal(scene, kEye, with([](RenderSettings& s) { s.threads = 1, s.samples_per_pixel = 9; })).empty());
    CHECK(contains(fault_of([&] { job.load_plan(folder.path("a.film")); }), "is a film, not a plan"));
}

TEST_CASE("Jobs: shards merge to the picture of one render, in any order", "[render][job][shard]") {
    const Folder folder;
    const CompiledScene scene = lit_scene();
    const RenderResult whole = render(scene, kEye, settings_of({}, 9));
    std::vector<std::string> paths;
    for (int i = 1; i <= 4; ++i) {
        RenderSettings settings = settings_of({}, 9);
        settings.shard = {i, 4};
        RenderJob job(scene, kEye, settings);
        job.run();
        CHECK(job.result().report.samples_per_pixel == 9);
        CHECK(contains(job.result().error.reason, "only some of the picture's pixels"));
        paths.push_back(folder.path(std::to_string(i) + ".film"));
        job.save(paths.back());
    }
    for (int order = 0; order < 3; ++order) {
        check_same(render_result(Film::merge(paths)), whole);
        std::rotate(paths.begin(), paths.begin() + 1, paths.end());
    }
    // What was merged can be continued.
    Film::merge(paths).save(folder.path("all.film"));
    RenderJob job(scene, kEye, settings_of({}, 21));
    job.load(folder.path("all.film"));
    job.run();
    check_same(job.result(), render(scene, kEye, settings_of({}, 21)));

    const auto merge = [&](const std::vector<std::string>& some) { return fault_of([&] { Film::merge(some); }); };
    std::ranges::sort(paths);
    CHECK(contains(merge({paths[0], paths[1], paths[3]}), "missing are shards 3/4"));
    CHECK(contains(merge({paths[0], paths[1], paths[2], paths[3], paths[1]}), "2.film: has pixels that " + paths[1]));
    CHECK(contains(merge({paths[0], folder.path("all.film")}), "all.film: has pixels that " + paths[0]));
    CHECK(contains(merge({paths[0]}), "is not the whole picture: missing are shards 2/4, 3/4, 4/4"));
    CHECK_THROWS_AS(Film::merge({}), ArgumentError);
    // Of other samples, unfinished, of another seed.
    RenderSettings settings = settings_of({}, 10);
    settings.shard = {4, 4};
    const auto replaced = [&](const RenderSettings& s) {
        RenderJob other(scene, kEye, s);
        other.run();
        other.save(folder.path("x.film"));
        return merge({paths[0], paths[1], paths[2], folder.path("x.film")});
    };
    CHECK(contains(replaced(settings), "x.film: has 10 samples a pixel, " + paths[0] + " 9"));
    settings.samples_per_pixel = 9;
    settings.seed = 5;
    CHECK(contains(replaced(settings), "x.film: is not of one render with " + paths[0] + ": its seed is 5, not 0"));
    settings.seed = 0;
    CHECK(replaced(settings).empty());
    Film unfinished = Film::load(folder.path("x.film"));
    unfinished.plan().samples = 11;
    unfinished.save(folder.path("x.film"));
    CHECK(contains(merge({folder.path("x.film"), paths[0], paths[1], paths[2]}), "x.film: lacks samples"));
}

TEST_CASE("Jobs: a shard ends by samples or a plan alone", "[render][job][shard]") {
    const CompiledScene scene = lit_scene();
    RenderSettings settings = settings_of(0.1);
    settings.shard = {1, 2};
    CHECK_THROWS_AS(RenderJob(scene, kEye, settings), ArgumentError);
    settings.error.reset(), settings.time_limit = 1;
    CHECK_THROWS_AS(RenderJob(scene, kEye, settings), ArgumentError);
    settings.time_limit.reset();
    settings.shard = {10, 9};  // 3 x 3 tiles
    CHECK_THROWS_AS(RenderJob(scene, kEye, settings), ArgumentError);
}

TEST_CASE("Jobs: to an error in rounds, by shards and plans", "[render][job][shard]") {
    const Folder folder;
    const CompiledScene scene = lit_scene();
    const double error = 0.001;
    constexpr int kShards = 3;
    const RenderResult alone = render(scene, kEye, settings_of(error));
    std::vector<std::string> paths;
    for (int i = 1; i <= kShards; ++i) paths.push_back(folder.path(std::to_string(i) + ".film"));
    int rounds = 0;
    bool reached = false;
    for (; !reached && rounds < 30; ++rounds) {
        for (int i = 1; i <= kShards; ++i) {
            RenderSettings settings = settings_of({}, 8);
            settings.shard = {i, kShards};
            RenderJob job(scene, kEye, settings);
            if (rounds > 0) {
                job.load(paths[static_cast<std::size_t>(i - 1)]);
                job.load_plan(folder.path("plan"));
            }
            CHECK(job.run() == StoppedBy::samples);
            CHECK(job.film().is_finished());
            job.save(paths[static_cast<std::size_t>(i - 1)]);
        }
        const Film merged = Film::merge(paths);
        const ErrorEstimate known = render_result(merged, error).error;
        reached = known.reached;
        if (!reached) plan_next_round(merged, known, folder.path("plan"));
    }
    const RenderResult merged = render_result(Film::merge(paths), error);
    CHECK(merged.error.reached);
    CHECK((rounds > 1 && rounds < 12));
    CHECK(merged.report.samples_per_pixel <= 1.1 * alone.report.samples_per_pixel);
    CHECK(*std::ranges::max_element(merged.maps.samples) > 2 * *std::ranges::min_element(merged.maps.samples));
    CHECK(contains(fault_of([&] { Film::load(folder.path("plan")); }), "is a plan, not a film"));
    RenderJob job(scene, kEye, settings_of({}, 500));
    job.run();
    CHECK(contains(fault_of([&] { job.load_plan(folder.path("plan")); }), "is older than the film"));
    RenderSettings few = settings_of({}, 7);
    const Film unrendered = RenderJob(scene, kEye, few).film();
    CHECK_THROWS_AS(plan_next_round(unrendered, render_result(unrendered, error).error, folder.path("p")),
                    ArgumentError);
}

TEST_CASE("Checkpoints: they appear while a render runs, and a failed one is told and costs nothing", "[render][job]") {
    const Folder folder;
    const CompiledScene scene = lit_scene();
    RenderSettings settings = settings_of({}, 1 << 20);
    RenderJob* running = nullptr;
    const std::string path = folder.path("a.film");
    settings.progress = [&](const Progress& p) { return !std::filesystem::exists(path) && p.seconds < 60; };
    RenderJob job(scene, kEye, settings);
    running = &job;
    {
        const Checkpoints checkpoints(*running, path, 0.05, [](const Error&) {});
        job.run();
    }
    CHECK(Film::load(path).all_samples() > 0);

    std::atomic<int> told = 0;
    std::string message;
    settings.progress = [&](const Progress& p) { return told < 2 && p.seconds < 60; };
    RenderJob other(scene, kEye, settings);
    {
        const Checkpoints checkpoints(other, folder.path("none/a.film"), 0.01, [&](const Error& e) {
            if (told == 0) message = e.what();
            ++told;
        });
        other.run();
    }
    CHECK(told >= 2);
    CHECK(contains(message, "none/a.film"));
    CHECK(other.film().all_samples() > 0);
    CHECK_THROWS_AS(Checkpoints(other, path, 0, nullptr), ArgumentError);
}

TEST_CASE("Jobs: films of untagged user-defined classes are bound to their program, others are not", "[render][job]") {
    const CompiledScene bound = compile_with(sky(1), {std::make_shared<Stranger>(sphere({0, 0, 0}, 1, grey(0.5)))});
    CHECK(RenderJob(bound, kEye, settings_of({}, 1)).film().info().program != Hash128{});
    CHECK(RenderJob(lit_scene(), kEye, settings_of({}, 1)).film().info().program == Hash128{});
}

}  // namespace limn::render_job_test
