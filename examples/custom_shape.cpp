// Defines a shape by two functions, bounds() and hit(). limn traces it like a built-in shape. Writes custom_shape.png.
#include <limn/limn.h>

#include <cmath>
#include <memory>

using namespace limn;

// A flat ring in the plane y = 0 around the origin.
class Ring final : public Hittable {
public:
    Ring(double inner, double outer, std::shared_ptr<const Material> material)
        : inner_(inner), outer_(outer), material_(std::move(material)) {}

    Box bounds() const override { return {Point3{-outer_, 0, -outer_}, Point3{outer_, 0, outer_}}; }

    std::optional<Hit> hit(const Ray& ray) const override {
        if (!is_usable(ray) || ray.direction.y == 0) return std::nullopt;
        const double t = -ray.origin.y / ray.direction.y;
        if (!(t > ray.t_min && t <= ray.t_max)) return std::nullopt;
        const Point3 p = ray.at(t);
        const double radius = std::hypot(p.x, p.z);
        if (!(radius >= inner_ && radius <= outer_)) return std::nullopt;
        return Hit{.t = t,
                   .normal = {0, 1, 0},
                   .u = (radius - inner_) / (outer_ - inner_),
                   .v = (std::atan2(p.z, p.x) + kPi) / (2 * kPi),
                   .material = material_.get(),
                   // The division that gives t is rounded. This is how far that may move the point along the ray.
                   .position_error = kRoundoff * abs(t * ray.direction)};
    }

private:
    double inner_, outer_;
    std::shared_ptr<const Material> material_;
};

int main() {
    Image bands(6, 1, Color{0.75, 0.65, 0.5});
    bands.set(1, 0, Color{0.5, 0.4, 0.3});
    bands.set(3, 0, Color{0.1, 0.1, 0.1});
    const ImageTextureOptions stripes{.filter = Filter::nearest, .wrap = Wrap::clamp};
    const auto dust = std::make_shared<Lambertian>(std::make_shared<ImageTexture>(bands, stripes));
    const auto gas = std::make_shared<Lambertian>(Color{0.8, 0.7, 0.5});

    Scene scene;
    scene.background = Background::constant(Color{0.02, 0.02, 0.04});
    scene.add(std::make_shared<Sphere>(Point3{0, 0, 0}, 1.0, gas));
    const auto tilt = Transform::rotate_z(20) * Transform::rotate_x(15);
    scene.add(std::make_shared<Instance>(std::make_shared<Ring>(1.3, 2.3, dust), tilt));
    scene.add(std::make_shared<Sphere>(Point3{-8, 8, 8}, 3.0, std::make_shared<DiffuseLight>(Color{12, 12, 12})));

    const Camera camera{.look_from = {0, 0, 9}, .look_at = {0, 0, 0}, .vertical_fov = 32};
    const RenderSettings settings{.width = 200, .height = 200, .samples_per_pixel = 64};
    save_image(render(compile(scene), camera, settings).image, "custom_shape.png");
}
