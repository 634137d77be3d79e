// Defines a texture, wood: the annual rings of a trunk along the y axis. Writes custom_texture.png.
#include <limn/limn.h>

#include <cmath>
#include <memory>

using namespace limn;

// Each ring is light on its inner side, which grew in spring, and darkens towards autumn. The Noise texture distorts
// the rings and adds the fibres.
class Wood final : public Texture {
public:
    explicit Wood(double rings) : rings_(rings) {}

    Color value(const Surface& s) const override {
        Surface stretched = s;
        stretched.position.y /= 8;  // fibres run along the trunk
        const double from_pith = std::hypot(s.position.x, s.position.z) + 0.4 * bend_.value(stretched).r;
        const double age = from_pith * rings_;
        const double season = age - std::floor(age);
        const double ring = 6.75 * season * season * (1 - season);  // 1 after two thirds of the year, 0 at its ends
        const double dark = 0.7 * ring + 0.3 * fibre_.value(stretched).r;
        return (1 - dark) * spring_ + dark * autumn_;
    }

private:
    double rings_;
    Color spring_{.80, .48, .20}, autumn_{.25, .09, .03};
    Noise bend_{1.5, /*seed*/ 3}, fibre_{30, /*seed*/ 4};
};

int main() {
    const auto wood = std::make_shared<Lambertian>(std::make_shared<Wood>(6));
    const auto table = std::make_shared<Lambertian>(Color{.6, .62, .6});

    // Add a block, of which only the three visible faces are needed, and a ball further from the pith.
    const Point3 corner{-.3, 0, -.3};
    const Vec3 x{1.6, 0, 0}, y{0, 1.6, 0}, z{0, 0, 1.6};
    Scene scene;
    scene.background = Background::gradient(Color{1, 1, 1}, Color{.9, .95, 1});
    scene.add(std::make_shared<Quad>(Point3{-20, 0, -20}, Vec3{0, 0, 40}, Vec3{40, 0, 0}, table));
    scene.add(std::make_shared<Quad>(corner + x, y, z, wood));
    scene.add(std::make_shared<Quad>(corner + y, x, z, wood));
    scene.add(std::make_shared<Quad>(corner + z, x, y, wood));
    scene.add(std::make_shared<Sphere>(Point3{-.9, .6, 1.7}, 0.6, wood));

    const Camera camera{.look_from = {6, 5, 8}, .look_at = {.1, .6, .6}, .vertical_fov = 26};
    const RenderSettings settings{.width = 200, .height = 200, .samples_per_pixel = 64};
    save_image(render(compile(scene), camera, settings).image, "custom_texture.png");
}
