// A lamp in the colour of a texture's first pixel, for the tests of figure_main. A texture named "interrupt" is a
// signal.
#include <csignal>

#include "figure.h"
#include "limn/limn.h"

namespace {

limn::Figure lamp(const limn::FigureInputs& inputs) {
    using namespace limn;
    Color color{1, 1, 1};
    if (inputs.texture == "interrupt")
        std::raise(SIGINT);
    else if (!inputs.texture.empty())
        color = load_image(inputs.texture, inputs.texture_encoding).at(0, 0);
    Scene scene;
    scene.add(std::make_shared<Sphere>(Point3{0, 0, 0}, 10.0, std::make_shared<DiffuseLight>(color)));
    return {.name = "tiny",
            .scene = std::move(scene),
            .camera = {.look_from = {0, 0, 30}, .vertical_fov = 10},
            .settings = {.width = 6, .height = 4, .samples_per_pixel = 4, .max_depth = 3}};
}

}  // namespace

int main(int argc, char** argv) { return limn::figure_main(argc, argv, "tiny", lamp, limn::FigureInputs{}); }
