#include <atomic>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "catch.h"
#include "limn/math/error.h"
#include "support/pictures.h"

namespace limn::settings_test {

using namespace test;

namespace {

const Camera kEye = camera_at({0, 0, 5}, {0, 0, 0}, 40);

// Somebody else's texture: spoilt on the right half.
class Spoilt final : public Texture {
public:
    explicit Spoilt(double value) : value_(value) {}
    Color value(const Surface& s) const override { return s.position.x > 0 ? Color{value_, 1, 1} : Color{1, 1, 1}; }

private:
    double value_;
};

// Keeps threads waiting until as many of them have come, or, so that a test ends, for two seconds once.
class Meeting final : public Texture {
public:
    explicit Meeting(std::size_t expected) : expected_(expected) {}
    std::size_t seen() const { return threads_.size(); }

    Color value(const Surface&) const override {
        std::unique_lock lock(mutex_);
        threads_.insert(std::this_thread::get_id());
        if (threads_.size() >= expected_) changed_.notify_all();
        if (!changed_.wait_for(lock, std::chrono::seconds(given_up_ ? 0 : 2),
                               [&] { return threads_.size() >= expected_; }))
            given_up_ = true;
        return {1, 1, 1};
    }

private:
    const std::size_t expected_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    mutable std::set<std::thread::id> threads_;
    mutable bool given_up_ = false;
};

}  // namespace

TEST_CASE("render: impossible settings are refused by name", "[render][settings]") {
    const CompiledScene scene = compile_with(sky(1), {});
    const auto refused = [&](const std::function<void(RenderSettings&)>& spoil, const char* what) {
        RenderSettings s = square(4, 4, 4);
        spoil(s);
        CHECK_THROWS_AS(render(scene, kEye, s), ArgumentError);
        CHECK_THROWS_WITH(render(scene, kEye, s), Catch::Contains(what));
    };
    for (const int bad : {0, -1, std::numeric_limits<int>::min()}) {
        refused([&](RenderSettings& s) { s.width = bad; }, "width");
        refused([&](RenderSettings& s) { s.height = bad; }, "height");
        refused([&](RenderSettings& s) { s.samples_per_pixel = bad; }, "samples");
        refused([&](RenderSettings& s) { s.max_depth = bad; }, "depth");
    }
    refused([](RenderSettings& s) { s.threads = -1; }, "threads");
    refused([](RenderSettings& s) { s.threads = 1025; }, "threads");
    refused([](RenderSettings& s) { s.width = (1 << 20) + 1; }, "width");
    refused([](RenderSettings& s) { s.height = (1 << 20) + 1; }, "height");
    Camera blind = kEye;
    blind.look_at = blind.look_from;
    CHECK_THROWS_AS(render(scene, blind, square(4, 4, 4)), ArgumentError);
    CHECK_NOTHROW(render(scene, kEye, square(1, 1, 1)));
}

TEST_CASE("render: a shape without a material is refused, a medium's boundary needs none", "[render][settings]") {
    const Object bare = sphere({0, 0, 0}, 1, nullptr);
    for (const Object& object :
         {bare, quad({}, {1, 0, 0}, {0, 1, 0}, nullptr),
          Object(std::make_shared<Triangle>(Point3{}, Point3{1, 0, 0}, Point3{0, 1, 0}, nullptr)),
          Object(std::make_shared<Sphere>(Point3{}, Point3{1, 0, 0}, 1.0, nullptr)),
          Object(std::make_shared<Mesh>(icosphere(0), nullptr)),
          Object(std::make_shared<Instance>(bare, Transform::scale(2, 2, 2))),
          Object(std::make_shared<HittableList>(std::vector<Object>{sphere({3, 0, 0}, 1, grey(1)), bare}))}) {
        const CompiledScene scene = compile_with(sky(1), {object});
        CHECK_THROWS_AS(render(scene, kEye, square(4, 4, 4)), Error);
        CHECK_THROWS_WITH(render(scene, kEye, square(4, 4, 4)), Catch::Contains("material"));
    }
    CHECK_NOTHROW(
        render(compile_with(sky(1), {std::make_shared<ConstantMedium>(bare, 1, Color{})}), kEye, square(4, 4, 4)));
    CHECK_NOTHROW(render(
        compile_with(sky(1), {std::make_shared<Instance>(std::make_shared<ConstantMedium>(
                                                             std::make_shared<Mesh>(icosphere(0), nullptr), 1, Color{}),
                                                         Transform{})}),
        kEye, square(4, 4, 4)));
    // The same bare ball once as a boundary and once as a shape: the shape still lacks its material.
    CHECK_THROWS_AS(
        render(compile_with(sky(1), {std::make_shared<ConstantMedium>(bare, 1, Color{}), bare}), kEye, square(4, 4, 4)),
        Error);
}

TEST_CASE("render: a user's own shape without a material is black at worst, never a crash", "[render][settings]") {
    const RenderResult r = render(compile_with(sky(1), {std::make_shared<Stranger>(sphere({0, 0, 0}, 1, nullptr))}),
                                  kEye, square(8, 4, 4));
    for (const float v : r.image.values()) CHECK((v >= 0 && v <= 1));
}

TEST_CASE("render: samples that are NaN or infinite count as black, and are counted", "[render][settings]") {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
        const auto lambert = std::make_shared<Lambertian>(std::make_shared<Spoilt>(bad));
        const auto light = std::make_shared<DiffuseLight>(std::make_shared<Spoilt>(bad));
        for (const MaterialPtr& m : {MaterialPtr(lambert), MaterialPtr(light)}) {
            for (const Estimator estimator : {Estimator::path, Estimator::naive}) {
                const Object wall = quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, m);
                const RenderResult r = render(compile_with(sky(1), {wall}), kEye, square(8, 16, 3, estimator));
                CHECK(r.report.nonfinite_samples == 8 * 8 * 16 / 2);
                for (int y = 0; y < 8; ++y) {
                    CHECK(r.image.at(1, y) == Color{1, 1, 1});
                    CHECK(is_black(r.image.at(6, y)));
                }
                CHECK_FALSE(std::isnan(r.error.estimate));
            }
        }
    }
}

TEST_CASE("render: a spoilt lamp does not spoil the others", "[render][settings]") {
    class Nan final : public Texture {
    public:
        Color value(const Surface&) const override { return {std::nan(""), std::nan(""), std::nan("")}; }
    };
    const Object floor = quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, grey(0.5)), good = sphere({0, 3, 0}, 0.5, lamp(9));
    const Object bad = sphere({0, 3, -900}, 1, std::make_shared<DiffuseLight>(std::make_shared<Nan>()));
    const Camera down = camera_at({0, 1, 0}, {0, 0, 0}, 1);
    const RenderResult clean = render(compile_with(sky(0), {floor, good}), down, square(8, 256, 2));
    const RenderResult spoilt = render(compile_with(sky(0), {floor, good, bad}), down, square(8, 256, 2));
    for (const float v : spoilt.image.values()) CHECK(std::isfinite(v));
    // At most the half of the samples that asked the spoilt lamp is black.
    CHECK(mean(spoilt.image) > 0.4 * mean(clean.image));
    CHECK(mean(spoilt.image) < 1.1 * mean(clean.image));
}

TEST_CASE("render: antialias off sends every sample through the pixel's centre", "[render][settings]") {
    const CompiledScene scene = compile_with(sky(0), {sphere({0, 0, 0}, 1, lamp(1))});
    const Camera camera = camera_at({0, 0, 10}, {0, 0, 0}, 20);
    RenderSettings settings = square(100, 4, 2);
    settings.antialias = false;
    const Image image = render(scene, camera, settings).image;
    const CameraRays rays(camera, 100, 100);
    const Sphere ball({0, 0, 0}, 1, nullptr);
    int wrong = 0;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
            wrong += image.at(x, y).r != (ball.hit(rays.ray(x + 0.5, y + 0.5, 0, 0, 0)) ? 1 : 0);
    CHECK(wrong == 0);
    settings.seed = 99;
    CHECK(render(scene, camera, settings).image == image);
    // With it, an edge pixel is as bright as it is covered: the whole is 0.2551627 of the frame.
    settings.antialias = true;
    settings.samples_per_pixel = 64;
    CHECK(mean(render(scene, camera, settings).image) == Approx(0.2551627).epsilon(2e-3));
}

TEST_CASE("render: aperture 0 gives the pinhole's picture, to the bit", "[render][settings]") {
    const CompiledScene scene = compile_with(Background::gradient({1, 1, 1}, {0.5, 0.7, 1}),
                                             {sphere({0, 0, 0}, 1, grey(0.5)), sphere({1, 0, -3}, 1, grey(0.2))});
    Camera pinhole = kEye, focused = kEye;
    focused.focus_distance = 2;
    focused.aperture_angle = 0;
    CHECK(render(scene, pinhole, square(16, 4, 5)).image == render(scene, focused, square(16, 4, 5)).image);
    focused.aperture_angle = 5;
    const Image blurred = render(scene, focused, square(16, 64, 5)).image;
    CHECK_FALSE(blurred == render(scene, pinhole, square(16, 64, 5)).image);
    CHECK(mean(blurred) ==
          Approx(mean(render(scene, pinhole, square(16, 64, 5)).image)).epsilon(0.03));  // light moves, none is made
}

TEST_CASE("render: progress begins at 0, never falls, is not called by two threads at once, and ends at 1",
          "[render][settings]") {
    const CompiledScene scene = compile_with(sky(1), {sphere({0, 0, 0}, 1, grey(0.5))});
    RenderSettings settings = square(64, 64, 10);
    settings.threads = 3;
    std::atomic<int> inside = 0, calls = 0, overlapping = 0;
    double first = -1, last = 0, last_seconds = 0;
    bool falling = false;
    settings.progress = [&](const Progress& p) {
        if (calls == 0) first = p.fraction;
        overlapping += ++inside > 1;
        falling = falling || p.fraction < last || p.fraction > 1 || p.seconds < last_seconds;
        last = p.fraction, last_seconds = p.seconds;
        ++calls;
        --inside;
        return true;
    };
    const RenderResult r = render(scene, kEye, settings);
    CHECK(calls >= 2);
    CHECK(overlapping == 0);
    CHECK_FALSE(falling);
    CHECK(first == 0);
    CHECK(last == 1);
    CHECK(r.report.complete);
}

TEST_CASE("render: as many threads work at once as were asked for, more than there are processors too",
          "[render][settings]") {
    for (const std::size_t threads : {1u, 2u, 5u}) {
        const auto meeting = std::make_shared<Meeting>(threads);
        RenderSettings settings = square(64, 4, 1);
        settings.threads = static_cast<int>(threads);
        render(compile_with(sky(0), {sphere({0, 0, 0}, 9, std::make_shared<DiffuseLight>(meeting))}), kEye, settings);
        CHECK(meeting->seen() == threads);
    }
}

TEST_CASE("render: what is left open is as documented", "[render][settings]") {
    const RenderSettings s;
    CHECK((s.width == 400 && s.height == 400 && s.samples_per_pixel == 64 && s.max_depth == 10));
    CHECK((s.seed == 0 && s.threads == 0 && s.antialias && s.estimator == Estimator::path && !s.progress));
}

TEST_CASE("render: stopping leaves a whole picture with fewer samples, and says so", "[render][settings]") {
    const CompiledScene scene = compile_with(sky(1), {sphere({0, 0, 0}, 1, grey(0.5))});
    RenderSettings settings = square(64, 1 << 20, 10);  // would take minutes
    settings.threads = 2;
    settings.progress = [&](const Progress& p) { return p.seconds < 0.3; };
    const RenderResult r = render(scene, kEye, settings);
    CHECK_FALSE(r.report.complete);
    CHECK(r.report.samples_per_pixel > 0);
    CHECK(r.report.samples_per_pixel < 1 << 20);
    CHECK(r.report.render_seconds < 20);
    CHECK(r.image.width() == 64);
    for (const float v : r.image.values())
        CHECK((v >= 0.49f && v <= 1.001f));  // albedo .5 before a white sky: never black

    settings.progress = [](const Progress&) { return false; };  // at the first call
    const RenderResult none = render(scene, kEye, settings);
    CHECK_FALSE(none.report.complete);
    for (const float v : none.image.values()) CHECK(std::isfinite(v));
}

TEST_CASE("render: told to stop when all is done, a picture is complete", "[render][settings]") {
    RenderSettings settings = square(8, 4, 2);
    settings.progress = [](const Progress& p) { return p.fraction < 1; };
    const RenderReport r = render(compile_with(sky(1), {}), kEye, settings).report;
    CHECK(r.complete);
    CHECK(r.samples_per_pixel == 4);
}

TEST_CASE("render: what the progress callback throws comes out of render", "[render][settings]") {
    const CompiledScene scene = compile_with(sky(1), {sphere({0, 0, 0}, 1, grey(0.5))});
    for (const int threads : {1, 2}) {
        RenderSettings settings = square(64, 4096, 10);
        settings.threads = threads;
        settings.progress = [](const Progress& p) -> bool {
            if (p.fraction > 0) throw std::runtime_error("enough");
            return true;
        };
        CHECK_THROWS_WITH(render(scene, kEye, settings), "enough");
    }
}

TEST_CASE("render: the report says what was rendered", "[render][settings]") {
    Scene described;
    described.name = "two balls";
    described.background = sky(1);
    described.add(sphere({0, 0, 0}, 1, grey(0.5)));
    described.add(sphere({2, 0, 0}, 1, grey(0.5)));
    const CompiledScene scene = compile(described);
    RenderSettings settings = square(16, 5, 7);
    settings.height = 8;
    settings.seed = 42;
    settings.threads = 2;
    const RenderReport r = render(scene, kEye, settings).report;
    CHECK(r.scene == "two balls");
    CHECK((r.width == 16 && r.height == 8 && r.seed == 42 && r.threads == 2 && r.max_depth == 7));
    CHECK(r.samples_per_pixel == 5);
    CHECK(r.rays >= 16 * 8 * 5);
    CHECK(r.rays < 16 * 8 * 5 * 7);
    CHECK(render(compile_with(sky(1), {}), kEye, settings).report.rays == 16 * 8 * 5);
    CHECK(r.compile_seconds == scene.stats().seconds);
    CHECK(r.render_seconds > 0);
    CHECK(r.nonfinite_samples == 0);
    CHECK(r.features == scene.features());
    CHECK(r.memory_bytes >= scene.stats().memory_bytes + 16 * 8 * 3 * sizeof(float));
    CHECK(r.complete);
    CHECK(std::string(version()).find('.') != std::string::npos);
}

}  // namespace limn::settings_test
