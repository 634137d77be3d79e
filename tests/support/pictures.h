// Rendering small pictures over many seeds, and what their means may differ by.
#pragma once

#include <cmath>
#include <memory>

#include "catch.h"
#include "limn/render/render.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/material/isotropic.h"
#include "limn/scene/material/lambertian.h"
#include "support/scene_zoo.h"

namespace limn::test {

using MaterialPtr = std::shared_ptr<const Material>;

inline MaterialPtr grey(double albedo) { return std::make_shared<Lambertian>(Color{albedo, albedo, albedo}); }
inline MaterialPtr lamp(double radiance) { return std::make_shared<DiffuseLight>(Color{radiance, radiance, radiance}); }
inline Object sphere(const Point3& c, double r, MaterialPtr m) { return std::make_shared<Sphere>(c, r, std::move(m)); }
inline Object quad(const Point3& q, const Vec3& u, const Vec3& v, MaterialPtr m) {
    return std::make_shared<Quad>(q, u, v, std::move(m));
}
/// Wide, at y = 0, facing up.
inline Object floor_of(MaterialPtr m) { return quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, std::move(m)); }

inline CompiledScene compile_with(const Background& background, const std::vector<Object>& objects) {
    Scene scene;
    scene.background = background;
    for (const Object& object : objects) scene.add(object);
    return compile(scene);
}
inline Background sky(double radiance) { return Background::constant({radiance, radiance, radiance}); }

inline Camera camera_at(const Point3& from, const Point3& at, double vertical_fov) {
    const bool upright = std::abs(normalize(at - from).y) < 0.9;
    return {
        .look_from = from, .look_at = at, .up = upright ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, .vertical_fov = vertical_fov};
}

inline RenderSettings square(int side, int samples, int max_depth, Estimator estimator = Estimator::path) {
    RenderSettings s;
    s.width = s.height = side;
    s.samples_per_pixel = samples;
    s.max_depth = max_depth;
    s.estimator = estimator;
    return s;
}

inline double mean(const Image& image) {
    double sum = 0;
    for (const float value : image.values()) sum += static_cast<double>(value);
    return sum / static_cast<double>(image.values().size());
}

/// The mean of a picture over many seeds and its standard error.
struct Measured {
    double mean = 0, sigma = 0;
};

inline Measured measure(const CompiledScene& scene, const Camera& camera, RenderSettings settings, int seeds = 32) {
    double sum = 0, squares = 0;
    for (int i = 0; i < seeds; ++i) {
        settings.seed = 1000 + static_cast<std::uint64_t>(i);
        const double value = mean(render(scene, camera, settings).image);
        sum += value, squares += value * value;
    }
    const double average = sum / seeds;
    return {average, std::sqrt(std::max(0.0, squares / seeds - average * average) / (seeds - 1))};
}

/// 4.5 standard errors, and the rounding of pixels to float; `power`: the relative standard error that the test must
/// reach in order to say anything.
inline void check_mean(const Measured& m, double truth, double power) {
    INFO("mean " << m.mean << " +- " << m.sigma << ", truth " << truth);
    CHECK(std::abs(m.mean - truth) <= 4.5 * m.sigma + 1e-6 * std::abs(truth));
    CHECK(m.sigma <= power * std::abs(truth));
}

inline void check_same(const Measured& a, const Measured& b, double power) {
    INFO("means " << a.mean << " +- " << a.sigma << " and " << b.mean << " +- " << b.sigma);
    const double sigma = std::hypot(a.sigma, b.sigma);
    CHECK(std::abs(a.mean - b.mean) <= 4.5 * sigma + 1e-6 * std::abs(a.mean));
    CHECK(sigma <= power * std::abs(a.mean));
    CHECK(a.mean > 0);
}

}  // namespace limn::test
