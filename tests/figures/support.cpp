#include "support.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limn::test {

Estimate estimate(std::span<const double> samples) {
    const auto n = static_cast<double>(samples.size());
    double sum = 0, squares = 0;
    for (const double x : samples) sum += x;
    const double mean = sum / n;
    for (const double x : samples) squares += (x - mean) * (x - mean);
    return {mean, std::sqrt(squares / (n - 1) / n)};
}

bool agrees(const Estimate& e, double truth, double rounding) {
    return std::abs(e.mean - truth) <= kSigmas * e.error + rounding;
}

bool same_float(double a, double b) { return std::abs(a - b) <= std::ldexp(std::abs(b), -23); }

bool same_float(const Color& a, const Color& b) {
    return same_float(a.r, b.r) && same_float(a.g, b.g) && same_float(a.b, b.b);
}

Projected project(const Camera& camera, int size, const Point3& p) {
    const Vec3 w = normalize(camera.look_from - camera.look_at);
    const Vec3 u = normalize(cross(camera.up, w));
    const Vec3 v = cross(w, u);
    const Vec3 d = p - camera.look_from;
    const double depth = -dot(d, w), h = std::tan(radians(camera.vertical_fov) / 2);
    return {size * (1 + dot(d, u) / depth / h) / 2, size * (1 - dot(d, v) / depth / h) / 2, depth};
}

Ray picture_ray(const Camera& camera, int size, double x, double y, double time) {
    Camera pinhole = camera;
    pinhole.aperture_angle = 0;
    Ray ray = CameraRays(pinhole, size, size).ray(x, y, 0.5, 0.5, 0);
    ray.time = time;
    return ray;
}

bool close(double a, double b, double rounding) { return std::abs(a - b) <= rounding; }

bool appears_at(const Camera& camera, const Point3& p, double x, double y) {
    const Projected at = project(camera, 400, p);
    const Ray ray = picture_ray(camera, 400, at.x, at.y);
    // The projection and the ray each take some 30 rounded operations.
    const bool ray_meets_it =
        length(cross(p - ray.origin, normalize(ray.direction))) <= gamma(60) * length(p - ray.origin);
    return close(at.x, x, .051) && close(at.y, y, .051) && ray_meets_it;
}

double horizon(const Figure& figure, double x) {
    const Hittable& ground = *figure.scene.objects().at(0);
    return boundary(0, 400, [&](double y) { return ground.hit(picture_ray(figure.camera, 400, x, y)).has_value(); });
}

Image render_figure(const Figure& figure, int spp, std::uint64_t seed) {
    RenderSettings settings = figure.settings;
    settings.samples_per_pixel = spp;
    settings.seed = seed;
    return render(compile(figure.scene), figure.camera, settings).image;
}

bool all_see(const Footprint& footprint, std::uint32_t object) {
    return std::all_of(footprint.begin(), footprint.end(),
                       [&](const auto& hit) { return hit && hit->object == object; });
}

bool all_see_sky(const Footprint& footprint) {
    return std::none_of(footprint.begin(), footprint.end(), [](const auto& hit) { return hit.has_value(); });
}

Footprint footprint_of(const CompiledScene& scene, const Figure& figure, int x, int y) {
    Footprint footprint;
    for (const auto& [dx, dy] : {std::pair{.5, .5}, {-1., -1.}, {2., -1.}, {-1., 2.}, {2., 2.}})
        footprint.push_back(scene.closest_hit(picture_ray(figure.camera, figure.settings.width, x + dx, y + dy)));
    return footprint;
}

double share_of_frame(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Projected &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2 / 160000;
}

bool contains(const Polygon& polygon, double x, double y) {
    int left = 0, right = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Projected &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0 ? left : right) += 1;
    }
    return left == 0 || right == 0;
}

Surface surface_at(const Point3& position) {
    Surface s;
    s.position = position;
    return s;
}

Scene only(const Scene& scene, const std::vector<std::size_t>& objects) {
    Scene part;
    part.background = scene.background;
    for (const std::size_t i : objects) part.add(scene.objects().at(i));
    return part;
}

Scene scene_of(const Background& background, const std::vector<std::shared_ptr<const Hittable>>& objects) {
    Scene scene;
    scene.background = background;
    for (const auto& object : objects) scene.add(object);
    return scene;
}

std::vector<Image> replicates(const CompiledScene& scene, const Camera& camera, RenderSettings settings, int count) {
    std::vector<Image> images;
    for (int i = 0; i < count; ++i) {
        settings.seed = 1000 + static_cast<std::uint64_t>(i);
        images.push_back(render(scene, camera, settings).image);
    }
    return images;
}

double mean_over(const Image& image, std::size_t channel, int x0, int y0, int x1, int y1) {
    double sum = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            const Color c = image.at(x, y);
            sum += Vec3(c.r, c.g, c.b)[channel];
        }
    return sum / ((x1 - x0) * (y1 - y0));
}

double mean_over(const Image& image, std::size_t channel) {
    return mean_over(image, channel, 0, 0, image.width(), image.height());
}

Radiance radiance(const CompiledScene& scene, const Point3& from, const Point3& towards,
                  const RenderSettings& settings) {
    const Vec3 view = towards - from;
    const Camera camera{
        .look_from = from, .look_at = towards, .up = view.x == 0 && view.z == 0 ? Vec3{0, 0, 1} : Vec3{0, 1, 0}};
    RenderSettings one_pixel = settings;
    one_pixel.width = one_pixel.height = 1;
    one_pixel.antialias = false;
    const std::vector<Image> images = replicates(scene, camera, one_pixel);
    const auto channel = [&](std::size_t c) {
        return measure(images, [&](const Image& image) { return mean_over(image, c); });
    };
    return {channel(0), channel(1), channel(2)};
}

}  // namespace limn::test
