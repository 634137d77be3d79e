// "Image of Earth as Texture": a sphere with a map of the Earth.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig06_earth(const FigureInputs& inputs) {
    const auto map = std::make_shared<ImageTexture>(load_image(inputs.texture, inputs.texture_encoding),
                                                    ImageTextureOptions{Filter::nearest, Wrap::clamp});
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, 0, 0}, 2.0, std::make_shared<Lambertian>(map)));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {0, 0, 12}, .vertical_fov = 20},
            .settings = {.samples_per_pixel = 100}};
}

}  // namespace limn::figures
