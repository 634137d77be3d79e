// "Looking from point3(13, 2, 3)": some 480 balls, many of which jump while the shutter is open.
#include "figure_data.h"
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {
namespace {

std::shared_ptr<const Material> material_of(const BouncingSphere& sphere) {
    if (sphere.material == "metal") return std::make_shared<Metal>(sphere.color, sphere.parameter);
    if (sphere.material == "dielectric") return std::make_shared<Dielectric>(sphere.parameter, Fresnel::schlick);
    return matte(sphere.color);
}

}  // namespace

Figure fig01_bouncing_spheres(const FigureInputs&) {
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, checkered(0.32)));
    for (const BouncingSphere& s : read_bouncing_spheres(data_file("bounce_spheres.csv")))
        scene.add(std::make_shared<Sphere>(s.center0, s.center1, s.radius, material_of(s)));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {13, 2, 3}, .vertical_fov = 20, .aperture_angle = 0.6, .focus_distance = 10},
            .settings = {.samples_per_pixel = 250}};
}

}  // namespace limn::figures
