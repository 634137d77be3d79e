// Defines a material, velvet: its fibres shine if light and view are at grazing angles. Writes custom_material.png.
#include <limn/limn.h>

#include <algorithm>
#include <memory>

using namespace limn;

// The scattering function is f = (body + rim (1 - cos_in)(1 - cos_out)) / pi. It is symmetric in the two directions. It
// conserves energy if body + rim <= 1. Directions are sampled with a pdf that is proportional to the cosine.
class Velvet final : public Material {
public:
    Velvet(const Color& body, const Color& rim) : body_(body), rim_(rim) {}

    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override {
        const Vec3 in = Frame(s.shading_normal).to_world(sample_cosine_hemisphere(random.x, random.y));
        const ScatterValue v = value(s, out, in);
        if (v.pdf == 0) return std::nullopt;
        return ScatterSample{.direction = in, .weight = v.value / v.pdf, .pdf = v.pdf};
    }

    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override {
        const double cos_in = dot(in, s.shading_normal);
        const double cos_out = std::clamp(dot(out, s.shading_normal), 0.0, 1.0);
        if (cos_in <= 0 || dot(in, s.normal) <= 0) return {};  // no transmission
        const double pdf = pdf_cosine_hemisphere(cos_in);
        return {.value = (body_ + (1 - std::min(cos_in, 1.0)) * (1 - cos_out) * rim_) * pdf, .pdf = pdf};
    }

private:
    Color body_, rim_;
};

int main() {
    const auto crimson = std::make_shared<Velvet>(Color{.25, .01, .03}, Color{.75, .5, .55});
    const auto midnight = std::make_shared<Velvet>(Color{.01, .02, .12}, Color{.4, .6, .88});
    const auto stage = std::make_shared<Lambertian>(Color{.45, .42, .4});
    const auto lamp = std::make_shared<DiffuseLight>(Color{30, 28, 26});

    Scene scene;
    scene.background = Background::gradient(Color{.2, .2, .22}, Color{.4, .45, .55});
    scene.add(std::make_shared<Quad>(Point3{-20, 0, -20}, Vec3{0, 0, 40}, Vec3{40, 0, 0}, stage));
    scene.add(std::make_shared<Sphere>(Point3{-1.1, 1, 0}, 1.0, crimson));
    scene.add(std::make_shared<Sphere>(Point3{1.1, 1, 0}, 1.0, midnight));
    scene.add(std::make_shared<Quad>(Point3{-2, 4, -4}, Vec3{4, 0, 0}, Vec3{0, 2, 1}, lamp));

    const Camera camera{.look_from = {0, 2.2, 8}, .look_at = {0, 1, 0}, .vertical_fov = 34};
    const RenderSettings settings{.width = 200, .height = 200, .samples_per_pixel = 64};
    save_image(render(compile(scene), camera, settings).image, "custom_material.png");
}
