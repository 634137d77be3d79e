// Furnaces: in a uniform field of radiance 1 what absorbs nothing is invisible; a closed room that glows with 1 and
// reflects a shows 1 / (1 - a).
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"
#include "limn/render/render.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/isotropic.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/shape/constant_medium.h"
#include "limn/scene/shape/sphere.h"

namespace limn::accuracy {

namespace {

using MaterialPtr = std::shared_ptr<const Material>;
using Object = std::shared_ptr<const Hittable>;

constexpr int kDeep = 1000;  // nothing that matters is cut; and by the naive estimator nothing ends by roulette
constexpr int kDepths[] = {4, 10, 50, kDeep, kUnlimitedDepth};
constexpr int kSize = 32, kSeeds = 8, kDeepSeeds = 2;  // deep paths take long and hardly vary

// The mean of a picture by `samples` a pixel and seed, relative to what it must be.
Cell deviation(const CompiledScene& scene, const Camera& camera, int samples, int depth, double expected) {
    RenderSettings settings;
    settings.width = settings.height = kSize;
    settings.samples_per_pixel = samples;
    settings.max_depth = depth;
    if (depth == kDeep) settings.estimator = Estimator::naive;
    const int seeds = depth == kDeep ? kDeepSeeds : kSeeds;
    double sum = 0, squares = 0;
    for (int i = 0; i < seeds; ++i) {
        settings.seed = static_cast<std::uint64_t>(i);
        const Image image = render(scene, camera, settings).image;
        double mean = 0;
        for (const float value : image.values()) mean += static_cast<double>(value);
        mean = mean / static_cast<double>(image.values().size()) / expected - 1;
        sum += mean, squares += mean * mean;
    }
    Cell cell;
    cell.figure = sum / seeds;
    cell.figure_error = std::sqrt(std::max(0.0, squares / seeds - cell.figure * cell.figure) / (seeds - 1));
    cell.asked = static_cast<std::uint64_t>(samples) * kSize * kSize * static_cast<std::uint64_t>(seeds);
    return cell;
}

// A wall that glows with 1 and reflects diffusely.
class Wall final : public Material {
public:
    explicit Wall(double albedo) : reflector_(Color{albedo, albedo, albedo}) {}
    Color emitted(const Surface&) const override { return {1, 1, 1}; }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override {
        return reflector_.sample(s, out, random);
    }
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override {
        return reflector_.value(s, out, in);
    }

private:
    Lambertian reflector_;
};

}  // namespace

// cell.figure: relative deviation of the mean from what it must be, at each depth.
Group furnace_group(const Effort& effort) {
    Group group{"furnace", "furnace", {}, {}};
    for (const int depth : kDepths)
        group.columns.push_back(depth == kUnlimitedDepth ? "unlimited" : "depth " + std::to_string(depth));
    const int samples = static_cast<int>(std::clamp<std::uint64_t>(effort.rays / (kSize * kSize * kSeeds), 1, 128));

    const auto add = [&](const std::string& name, const Object& object, double field, const Camera& camera,
                         double expected) {
        note("furnace: " + name);
        Scene scene;
        scene.background = Background::constant({field, field, field});
        scene.add(object);
        const CompiledScene compiled = compile(scene);
        Row row;
        row.name = name;
        for (const int depth : kDepths)
            row.cells.push_back(deviation(compiled, camera, depth == kUnlimitedDepth ? samples : 1, depth, expected));
        row.rays = row.judged = row.cells.back().asked;
        group.rows.push_back(row);
    };

    const Camera at_ball{.look_from = {0.3, 0.5, 6}, .look_at = {0, 0, 0}, .vertical_fov = 24};
    const Color white{1, 1, 1};
    const std::pair<const char*, MaterialPtr> materials[] = {
        {"Lambertian", std::make_shared<Lambertian>(white)},       {"mirror", std::make_shared<Metal>(white, 0)},
        {"glass 1.5", std::make_shared<Dielectric>(1.5)},          {"glass 1.0", std::make_shared<Dielectric>(1.0)},
        {"bubble 1 / 1.5", std::make_shared<Dielectric>(1 / 1.5)}, {"diamond 2.4", std::make_shared<Dielectric>(2.4)},
        {"isotropic", std::make_shared<Isotropic>(white)}};
    for (const auto& [name, material] : materials) {
        add(std::string(name) + ", sphere", std::make_shared<Sphere>(Point3{0, 0, 0}, 1, material), 1, at_ball, 1);
        add(std::string(name) + ", bumpy mesh", std::make_shared<Mesh>(closed_mesh(true, {}).mesh, material), 1,
            at_ball, 1);
    }
    const Object ball = std::make_shared<Sphere>(Point3{0, 0, 0}, 1, materials[0].second);
    for (const double depth : {0.1, 1.0, 10.0})
        add(named("medium of albedo 1, optical depth %g", depth),
            std::make_shared<ConstantMedium>(ball, depth / 2, white), 1, at_ball, 1);
    const Camera inside{.look_from = {0.2, 0.1, 0}, .look_at = {1, 0.3, -1}, .vertical_fov = 90};
    for (const double albedo : {0.5, 0.8, 0.9, 0.99})
        add(named("closed room that glows, albedo %g", albedo),
            std::make_shared<Sphere>(Point3{0, 0, 0}, 3, std::make_shared<Wall>(albedo)), 0, inside, 1 / (1 - albedo));
    return group;
}

}  // namespace limn::accuracy
