// As examples/minimal.cpp, so small that it is there at once without optimisation.
#include <limn/limn.h>

using namespace limn;

int main() {
    Scene scene;
    scene.background = Background::gradient(Color{1, 1, 1}, Color{0.5, 0.7, 1});
    scene.add(std::make_shared<Sphere>(Point3{0, 0, 0}, 1.0, std::make_shared<Lambertian>(Color{0.7, 0.2, 0.1})));
    const Camera camera{.look_from = {0, 0, 9}, .look_at = {0, 0, 0}, .vertical_fov = 30};
    save_image(render(compile(scene), camera, RenderSettings{.width = 48, .height = 32}).image, "picture.png");
}
