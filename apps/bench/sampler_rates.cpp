// How fast single pixels converge with either sampler: the variance over seeds of pictures of one pixel, as JSON.
#include <cmath>

#include "figures.h"
#include "json_output.h"
#include "parse.h"
#include "program.h"
#include "text_file.h"

namespace limn::bench {

namespace {

using app::Json;

struct Pixel {
    const char* name;
    Figure figure;
    Point3 at;  // what is seen in its middle
};

// On the rim of the ball, seen from the eye: a tangent of it, upward.
Point3 rim(const Camera& camera, const Point3& centre, double radius) {
    const Vec3 to_centre = centre - camera.look_from, ahead = normalize(to_centre);
    const Vec3 right = normalize(cross(ahead, camera.up)), up = cross(right, ahead);
    const double sine = radius / length(to_centre);
    return camera.look_from + (std::sqrt(1 - sine * sine) * ahead + sine * up);
}

std::vector<Pixel> pixels() {
    const Figure balls = figures::fig13_dielectric();
    return {{"smooth: a wall of the Cornell box", figures::fig15_cornell_box(), {278, 420, 555}},
            {"smooth: a ball under the sky", balls, {0, .3, -.6}},
            {"edge: the rim of that ball", balls, rim(balls.camera, {0, 0, -1}, .5)},
            {"glass: the middle of a hollow ball", balls, {-1, 0, -1}}};
}

// The relative variance of the pixel's green, of a picture 400 pixels wide.
double relative_variance(const Pixel& pixel, const CompiledScene& scene, SamplerKind sampler, int samples, int seeds) {
    Camera camera = pixel.figure.camera;
    camera.look_at = pixel.at;
    camera.aspect_ratio = 1;
    camera.vertical_fov = 2 * std::atan(std::tan(radians(camera.vertical_fov) / 2) / 400) * (180 / kPi);
    double sum = 0, squares = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        const RenderSettings settings{.width = 1,
                                      .height = 1,
                                      .samples_per_pixel = samples,
                                      .seed = static_cast<std::uint64_t>(seed),
                                      .threads = 1,
                                      .sampler = sampler};
        const double value = render(scene, camera, settings).image.at(0, 0).g;
        sum += value, squares += value * value;
    }
    const double mean = sum / seeds;
    return (squares / seeds - mean * mean) * seeds / (seeds - 1) / (mean * mean);
}

int run(int argc, char** argv) {
    app::Options options("limn_sampler_rates", "Measures how fast single pixels converge with either sampler.");
    std::string json;
    int seeds = 100;
    options.add(
        {.name = "--seeds", .value = "N", .help = "Pictures for each variance", .preset = std::to_string(seeds)},
        [&seeds](const std::string& s) { seeds = app::parse_integer("--seeds", s, 2, 100'000); });
    options.add(
        {.name = "--json", .value = "FILE", .help = "Where the result goes; - is standard output", .required = true},
        app::file_name("--json", json));
    if (!options.parse(argc, argv)) return app::kDone;
    Json all = Json::array();
    for (const Pixel& pixel : pixels()) {
        const CompiledScene scene = compile(pixel.figure.scene);
        for (const auto& [name, sampler] :
             {std::pair{"sobol", SamplerKind::sobol}, {"independent", SamplerKind::independent}}) {
            Json row = {{"pixel", pixel.name}, {"sampler", name}, {"seeds", seeds}, {"variance", Json::object()}};
            for (const int samples : {16, 64, 256, 1024, 4096})
                row["variance"][std::to_string(samples)] = relative_variance(pixel, scene, sampler, samples, seeds);
            all.push_back(row);
        }
    }
    app::write_text(json, app::json_text(all));
    return app::kDone;
}

}  // namespace

}  // namespace limn::bench

int main(int argc, char** argv) {
    return limn::app::run_program("limn_sampler_rates", [&] { return limn::bench::run(argc, argv); });
}
