// The path tracer and its reference, in the scenes of ./build.sh convergence.
#include <cstdio>
#include <cstdlib>

#include "bench/transport_scenes.h"
#include "catch.h"
#include "support/reference_paths.h"

namespace limn::test {

TEST_CASE("Li: every sample of the convergence scenes has the radiance that the reference finds", "[bench][li]") {
    for (const std::string& name : bench::transport_scene_names()) {
        const Figure figure = bench::make_transport_scene(name);
        const CompiledScene scene = compile(figure.scene);
        RenderSettings settings = figure.settings;
        settings.width = settings.height = 64;
        settings.samples_per_pixel = std::getenv("LIMN_FULL") ? 16 : 1;
        for (const Estimator estimator : {Estimator::path, Estimator::naive}) {
            settings.estimator = estimator;
            const ComparedPaths compared = compare_paths(scene, figure.camera, settings);
            std::printf("%-15s %s: %d of %d paths differ\n", name.c_str(),
                        estimator == Estimator::path ? "path " : "naive", compared.differing, compared.paths);
            CAPTURE(name, estimator);
            // A comparison may fall within rounding in one path of 10,000.
            CHECK(compared.differing <= compared.paths / 10'000);
            CHECK(compared.mean > 0);
        }
    }
}

}  // namespace limn::test
