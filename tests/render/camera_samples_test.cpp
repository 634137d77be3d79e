// The camera rays that a render really sends: every number that makes one is uniform and goes with no other.
#include <mutex>
#include <set>

#include "support/pictures.h"

namespace limn::camera_samples_test {

using namespace test;

namespace {

// Sees every ray, and is never hit.
class Witness final : public Hittable {
public:
    Box bounds() const override { return {{-100, -100, -100}, {100, 100, 100}}; }
    std::optional<Hit> hit(const Ray& ray) const override {
        const std::lock_guard lock(mutex_);
        rays_.push_back(ray);
        return std::nullopt;
    }
    const std::vector<Ray>& rays() const { return rays_; }

private:
    mutable std::mutex mutex_;
    mutable std::vector<Ray> rays_;
};

// Looks along -z from the origin at a frame of half height 1 in the plane in focus, through a lens of radius 1/2.
Camera camera() {
    Camera c;
    c.look_from = {0, 0, 0};
    c.look_at = {0, 0, -1};
    c.vertical_fov = 90;
    c.focus_distance = 1;
    c.aperture_angle = 2 * std::atan(0.5) * 180 / kPi;
    return c;
}

std::vector<Ray> rays_of(const Camera& c, const RenderSettings& settings) {
    const auto witness = std::make_shared<Witness>();
    render(compile_with(sky(1), {witness}), c, settings);
    return witness->rays();
}

// Where a ray meets the plane in focus, in pixels from the left and top edge.
Uv place(const Ray& ray, int width, int height) {
    const Point3 p = ray.at(-1 / ray.direction.z);
    const double aspect = double(width) / height;
    return {(p.x / aspect + 1) / 2 * width, (1 - p.y) / 2 * height};
}

}  // namespace

TEST_CASE("Camera samples: place in the pixel, place on the lens and time are uniform, and independent",
          "[render][settings]") {
    const std::vector<Ray> rays = rays_of(camera(), square(1, 1 << 14, 1));
    REQUIRE(rays.size() == 1 << 14);
    std::vector<std::vector<double>> columns(7);
    for (const Ray& ray : rays) {
        const Uv at = place(ray, 1, 1);
        const double x = 2 * ray.origin.x, y = 2 * ray.origin.y;  // in the unit disc
        CHECK(x * x + y * y <= 1 + 1e-12);
        const double turn = std::atan2(y, x) / (2 * kPi) + 0.5;
        const std::vector<double> numbers{at.u, at.v, ray.time, x * x + y * y, turn, (x + 1) / 2, (y + 1) / 2};
        for (std::size_t i = 0; i < numbers.size(); ++i) columns[i].push_back(numbers[i] - 0.5);
    }
    const double n = static_cast<double>(rays.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        double sum = 0, squares = 0;
        for (const double v : columns[i]) sum += v, squares += v * v;
        // Uniform in a unit interval: variance 1/12, of its square's 1/180. A disc's x / 2 has variance 1/16 and of its
        // square 1/128 - 1/256.
        const bool of_disc = i >= 5;
        CAPTURE(i);
        CHECK(std::abs(sum / n) <= 4.5 * std::sqrt((of_disc ? 1.0 / 16 : 1.0 / 12) / n));
        CHECK(std::abs(squares / n - (of_disc ? 1.0 / 16 : 1.0 / 12)) <=
              4.5 * std::sqrt((of_disc ? 1.0 / 256 : 1.0 / 180) / n));
        for (std::size_t j = 0; j < i; ++j) {
            if (j >= 3) continue;  // radius, angle, x and y of one point on the lens go together
            double product = 0;
            for (std::size_t k = 0; k < columns[i].size(); ++k) product += columns[i][k] * columns[j][k];
            CAPTURE(j);
            CHECK(std::abs(product / n) <= 4.5 / 12 / std::sqrt(n));
        }
    }
}

TEST_CASE("Camera samples: each goes through its own pixel, at a place of its own", "[render][settings]") {
    for (const auto& [width, height] : {std::pair{5, 3}, {3, 5}}) {
        RenderSettings settings = square(1, 8, 1);
        settings.width = width, settings.height = height;
        std::vector<int> counts(static_cast<std::size_t>(width * height));
        std::set<double> offsets;
        for (const Ray& ray : rays_of(camera(), settings)) {
            const Uv at = place(ray, width, height);
            REQUIRE((at.u >= 0 && at.u < width && at.v >= 0 && at.v < height));
            ++counts[static_cast<std::size_t>(int(at.v) * width + int(at.u))];
            offsets.insert(std::nearbyint((at.u - std::floor(at.u)) * 0x1p40));
        }
        for (const int count : counts) CHECK(count == 8);
        CHECK(offsets.size() == counts.size() * 8);
    }
}

TEST_CASE(
    "Camera samples: without antialiasing they go through the middle, and spread over lens and shutter all the same",
    "[render][settings]") {
    RenderSettings settings = square(2, 16, 1);
    settings.antialias = false;
    std::set<double> times, lenses;
    for (const Ray& ray : rays_of(camera(), settings)) {
        const Uv at = place(ray, 2, 2);
        CHECK(std::abs(at.u - std::floor(at.u) - 0.5) <= 1e-12);
        CHECK(std::abs(at.v - std::floor(at.v) - 0.5) <= 1e-12);
        times.insert(ray.time), lenses.insert(ray.origin.x);
    }
    CHECK((times.size() == 64 && lenses.size() == 64));
}

}  // namespace limn::camera_samples_test
