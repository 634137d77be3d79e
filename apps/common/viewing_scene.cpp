#include "viewing_scene.h"

#include "limn/core/frame.h"
#include "limn/material/diffuse_light.h"
#include "limn/shape/quad.h"

namespace limn::app {

namespace {

// The sky lights a white surface to about 0.25 and the key light adds 0.7 where it falls straight on: together just
// under the white of a display, and shadows are a quarter as bright as light, which shows shape without hiding any.
constexpr Background kSky = Background::gradient({0.12, 0.12, 0.12}, {0.34, 0.4, 0.5});
constexpr Color kKeyRadiance{9.3, 9.3, 9.3};

// From the model to the key light. frame_box looks from (0.5, 0.35, 1): this is 62 degrees from there, enough for
// shadows that show the shape, and far enough for the light to stay out of the picture.
const Vec3 kTowardsKey{-0.7, 1.1, 0.8};
// In radii of the bounding sphere: clear of any model, wide enough for soft shadows (0.24 sr).
constexpr double kKeyDistance = 4;
constexpr double kKeySide = 2;

std::shared_ptr<const Hittable> key_light(const Box& box) {
    const double radius = length(box.diagonal() / 2);
    const Vec3 towards = normalize(kTowardsKey);
    const Frame frame(towards);
    const Vec3 edge_u = kKeySide * radius * frame.x, edge_v = kKeySide * radius * frame.y;
    const Point3 middle = box.center() + kKeyDistance * radius * towards;
    return std::make_shared<Quad>(middle - edge_u / 2 - edge_v / 2, edge_u, edge_v,
                                  std::make_shared<DiffuseLight>(kKeyRadiance));
}

}  // namespace

Scene make_viewing_scene(const Model& model) {
    Scene scene;
    scene.background = kSky;
    scene.add(model);
    scene.add(key_light(model.bounds()));
    return scene;
}

}  // namespace limn::app
