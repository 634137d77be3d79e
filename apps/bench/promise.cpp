#include "bench/promise.h"

#include <algorithm>
#include <limits>

#include "figures.h"
#include "scene_parts.h"

namespace limn::bench {

namespace {

// A small bright lamp behind a screen: the floor gets its light by way of a fuzzy mirror alone, in rare bright samples.
Figure fireflies() {
    const auto quad = [](const Point3& corner, const Vec3& u, const Vec3& v, std::shared_ptr<const Material> m) {
        return std::make_shared<Quad>(corner, u, v, std::move(m));
    };
    const auto grey = std::make_shared<Lambertian>(Color{.6, .6, .6});
    Scene scene;
    scene.background = Background::constant({.05, .06, .08});
    scene.add(quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, grey));
    scene.add(quad({-4, 0, -2}, {8, 0, 0}, {0, 4, 0}, std::make_shared<Metal>(Color{.9, .9, .9}, .15)));
    scene.add(std::make_shared<Sphere>(Point3{0, 1.5, 2}, .05, std::make_shared<DiffuseLight>(Color{800, 700, 600})));
    scene.add(quad({-1, 1.2, 1}, {2, 0, 0}, {0, 0, 2}, grey));
    return {.name = "fireflies",
            .scene = std::move(scene),
            .camera = {.look_from = {0, 3, 6}, .look_at = {0, .8, -1}, .vertical_fov = 45},
            .settings = {}};
}

struct Entry {
    const char* name;
    Figure (*figure)();
    double target;  // such that it takes well over the 64 samples from which on an error is believed
};

constexpr Entry kEntries[] = {
    {"cornell", [] { return figures::fig15_cornell_box(); }, 2.2e-3},
    {"bouncing", [] { return figures::fig01_bouncing_spheres(); }, 1.6e-3},
    {"glass", [] { return figures::fig13_dielectric(); }, 8e-4},
    {"smoke", [] { return figures::fig16_volume_cornell_box(); }, 1.3e-3},
    {"fireflies", fireflies, 3e-3},
};

RenderSettings settings_of(const Promise& promise, std::uint64_t seed) {
    return {.width = promise.size, .height = promise.size, .seed = seed};
}

}  // namespace

const std::vector<std::string>& promise_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Entry& e : kEntries) all.push_back(e.name);
        return all;
    }();
    return names;
}

Promise promise_of(const std::string& name) {
    for (const Entry& e : kEntries) {
        if (name != e.name) continue;
        Figure figure = e.figure();
        figure.camera.aspect_ratio.reset();
        return {.name = name, .scene = compile(figure.scene), .camera = figure.camera, .target = e.target};
    }
    throw ArgumentError("there is no scene " + name);
}

Reference reference_of(const Promise& promise) {
    const auto half = [&promise](std::uint64_t seed) {
        RenderSettings settings = settings_of(promise, seed);
        settings.error = promise.target / 16;
        return render(promise.scene, promise.camera, settings).image;
    };
    return {half(1'000'001), half(1'000'002)};
}

Stop stop_of(const Promise& promise, const Reference& reference, std::uint64_t seed, bool look_for_fewest) {
    const auto error_of = [&reference](const Image& image) {
        return compare_images(image, reference.a, reference.b).corrected_relative_mse;
    };
    RenderSettings settings = settings_of(promise, seed);
    settings.threads = 1;
    settings.error = promise.target;
    const RenderResult r = render(promise.scene, promise.camera, settings);
    Stop stop{.seed = seed,
              .samples = r.report.samples_per_pixel,
              .estimate = r.error.estimate,
              .upper = r.error.ci95_high,
              .error = error_of(r.image),
              .seconds = r.report.render_seconds};
    if (!look_for_fewest || stop.error > promise.target) return stop;
    settings.error = std::numeric_limits<double>::min();  // never reached: a render of so many samples, spread as above
    int low = 0, high = static_cast<int>(stop.samples);  // in multiples of 4; low is too few
    while (high - low > std::max(4, high / 50)) {
        settings.max_samples_per_pixel = (low + high) / 8 * 4;
        const Image image = render(promise.scene, promise.camera, settings).image;
        (error_of(image) <= promise.target ? high : low) = settings.max_samples_per_pixel;
    }
    stop.fewest = high;
    return stop;
}

}  // namespace limn::bench
