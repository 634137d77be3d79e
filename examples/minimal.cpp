// Renders three spheres on a plain to minimal.png, to a relMSE of at most 0.002.
#include <limn/limn.h>

using namespace limn;

int main() {
    const auto tiles = std::make_shared<Checker>(0.5, Color{0.2, 0.3, 0.1}, Color{0.9, 0.9, 0.9});
    const auto ground = std::make_shared<Lambertian>(tiles);
    const auto red = std::make_shared<Lambertian>(Color{0.7, 0.2, 0.1});
    const auto gold = std::make_shared<Metal>(Color{0.8, 0.6, 0.2}, /*fuzz*/ 0.1);
    const auto glass = std::make_shared<Dielectric>(1.5);

    Scene scene;
    scene.background = Background::gradient(Color{1, 1, 1}, Color{0.5, 0.7, 1});
    scene.add(std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, ground));
    scene.add(std::make_shared<Sphere>(Point3{-2.1, 1, 0}, 1.0, red));
    scene.add(std::make_shared<Sphere>(Point3{0, 1, 0}, 1.0, glass));
    scene.add(std::make_shared<Sphere>(Point3{2.1, 1, 0}, 1.0, gold));

    const Camera camera{.look_from = {0, 2.5, 9}, .look_at = {0, 0.9, 0}, .vertical_fov = 30};
    const RenderSettings settings{.width = 480, .height = 320, .error = 0.002};
    save_image(render(compile(scene), camera, settings).image, "minimal.png");
}
