#include "bench/promise.h"

#include <algorithm>
#include <limits>

#include "bench/transport_scenes.h"
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

// Besides those of the convergence report.
struct Entry {
    const char* name;
    Figure (*figure)();
};

constexpr Entry kOthers[] = {
    {"bouncing", [] { return figures::fig01_bouncing_spheres(); }},
    {"glass", [] { return figures::fig13_dielectric(); }},
    {"fireflies", fireflies},
};

Figure figure_of(const std::string& name) {
    for (const Entry& e : kOthers)
        if (name == e.name) return e.figure();
    return make_transport_scene(name);
}

// As fine as takes a few thousand samples a pixel.
double finest_of(const std::string& name) { return name == "glass-mesh" ? 1e-2 : 1e-4; }

RenderSettings settings_of(const Subject& subject, std::uint64_t seed) {
    return {.width = subject.size, .height = subject.size, .seed = seed, .threads = 1};
}

double error_of(const Subject& subject, const Image& image) {
    return compare_images(image, subject.a, subject.b).corrected_relative_mse;
}

Known known_of(const Subject& subject, const RenderResult& r, std::uint64_t seed) {
    return {.seed = seed,
            .samples = r.report.samples_per_pixel,
            .estimate = r.error.estimate,
            .lower = r.error.ci95_low,
            .upper = r.error.ci95_high,
            .error = error_of(subject, r.image)};
}

Image mean_of(const Image& a, const Image& b) {
    Image mean(a.width(), a.height());
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) mean.set(x, y, 0.5 * (a.at(x, y) + b.at(x, y)));
    return mean;
}

}  // namespace

const std::vector<std::string>& subject_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = promised_scene_names();
        for (const Entry& e : kOthers) all.push_back(e.name);
        return all;
    }();
    return names;
}

Subject subject_of(const std::string& name) {
    Figure figure = figure_of(name);
    figure.camera.aspect_ratio.reset();
    return {.name = name, .scene = compile(figure.scene), .camera = figure.camera, .finest = finest_of(name)};
}

void render_reference(Subject& subject) {
    const auto half = [&subject](std::uint64_t seed) {
        RenderSettings settings = settings_of(subject, seed);
        settings.threads = 0;
        settings.error = subject.finest / 8;
        return render(subject.scene, subject.camera, settings).image;
    };
    subject.a = half(1'000'001), subject.b = half(1'000'002);
}

Known known_after(const Subject& subject, int samples, std::uint64_t seed) {
    RenderSettings settings = settings_of(subject, seed);
    settings.samples_per_pixel = samples;
    return known_of(subject, render(subject.scene, subject.camera, settings), seed);
}

Known known_at_stop(const Subject& subject, double target, std::uint64_t seed, bool compare) {
    RenderSettings settings = settings_of(subject, seed);
    settings.error = target;
    Known known = known_of(subject, render(subject.scene, subject.camera, settings), seed);
    if (!compare) return known;
    settings.error = std::numeric_limits<double>::min();  // never reached: a render of so many samples, spread as above
    const auto image_of = [&](int samples, std::uint64_t of_seed) {
        settings.max_samples_per_pixel = samples, settings.seed = of_seed;
        return render(subject.scene, subject.camera, settings).image;
    };
    const int stop = static_cast<int>(known.samples);
    if (known.error <= target) {
        int low = 6, high = stop;  // low is too few: there is no estimate before 8
        while (high - low > std::max(2, high / 50)) {
            const int samples = (low + high) / 4 * 2;
            (error_of(subject, image_of(samples, seed)) <= target ? high : low) = samples;
        }
        known.fewest = high;
    }
    constexpr std::uint64_t kOtherSeeds = 1 << 20;  // that nothing else has
    known.halves =
        error_of(subject, mean_of(image_of(stop / 2, seed + kOtherSeeds), image_of(stop / 2, seed + 2 * kOtherSeeds)));
    return known;
}

}  // namespace limn::bench
