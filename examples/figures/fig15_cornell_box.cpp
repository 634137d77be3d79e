// "Cornell Box": two white boxes in a room with a red and a green wall.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig15_cornell_box(const FigureInputs&) {
    const auto white = matte({.73, .73, .73});
    Scene scene = cornell_room(cornell_lamp());
    scene.add(tall_box(white));
    scene.add(short_box(white));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = cornell_camera(),
            .settings = {.samples_per_pixel = 100}};
}

}  // namespace limn::figures
