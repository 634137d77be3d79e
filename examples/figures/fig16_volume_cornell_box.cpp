// "Volume Cornell Box": the Cornell box of figure 15 with black and white smoke instead of the boxes.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig16_volume_cornell_box(const FigureInputs&) {
    const auto lamp = std::make_shared<DiffuseLight>(Color{7, 7, 7});
    const auto boundary = matte({.73, .73, .73});  // has no effect, because smoke has no surface
    Scene scene = cornell_room(std::make_shared<Quad>(Point3{113, 554, 127}, Vec3{330, 0, 0}, Vec3{0, 0, 305}, lamp));
    scene.add(std::make_shared<ConstantMedium>(tall_box(boundary), .01, Color{0, 0, 0}));
    scene.add(std::make_shared<ConstantMedium>(short_box(boundary), .01, Color{1, 1, 1}));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = cornell_camera(),
            .settings = {.samples_per_pixel = 100}};
}

}  // namespace limn::figures
