// Orthographic and panoramic cameras, and the rays of all of them in batches.
#include <array>
#include <cmath>
#include <limits>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/camera.h"
#include "scene/camera_rays.h"
#include "support/random_geometry.h"

namespace limn::projection_test {

namespace {

Camera along_minus_z(Projection projection) {
    return {.look_from = {1, 2, 5}, .look_at = {1, 2, 0}, .projection = projection};
}

bool near(const Vec3& a, const Vec3& b) { return length(a - b) <= 1e-15 * (1 + length(b)); }

}  // namespace

TEST_CASE("Orthographic: rays are parallel, and their origins fill the frame", "[scene][camera]") {
    Camera camera = along_minus_z(Projection::orthographic);
    camera.view_height = 4;
    const CameraRays rays(camera, 200, 100);
    for (const auto& [x, y, right, up] : {std::array{0.0, 0.0, -4.0, 2.0}, std::array{200.0, 100.0, 4.0, -2.0},
                                          std::array{100.0, 50.0, 0.0, 0.0}, std::array{150.0, 75.0, 2.0, -1.0}}) {
        const Ray ray = rays.ray(x, y, 0.3, 0.7, 0);
        CHECK(ray.origin == Point3{1 + right, 2 + up, 5});
        CHECK(ray.direction == Vec3{0, 0, -1});
    }
}

TEST_CASE("Orthographic: without a height the view is as high as that of the field of view at look_at",
          "[scene][camera]") {
    Camera camera = along_minus_z(Projection::orthographic);
    camera.vertical_fov = 90;
    const CameraRays rays(camera, 100, 100);
    CHECK(near(rays.ray(50, 0, 0, 0, 0).origin - Point3{1, 2, 5}, {0, 5, 0}));
    camera.aspect_ratio = 2;
    CHECK(near(CameraRays(camera, 100, 100).ray(100, 50, 0, 0, 0).origin - Point3{1, 2, 5}, {10, 0, 0}));
}

TEST_CASE("Orthographic: with a lens all rays of a point of the picture meet in the plane of focus",
          "[scene][camera]") {
    Camera camera = along_minus_z(Projection::orthographic);
    camera.view_height = 2, camera.aperture_angle = 20, camera.focus_distance = 3;
    const CameraRays rays(camera, 64, 64);
    const Ray a = rays.ray(48, 16, 0.1, 0.9, 0), b = rays.ray(48, 16, 0.8, 0.2, 0);
    CHECK(length(a.origin - b.origin) > 0.1);
    CHECK(length(a.at(3) - b.at(3)) <= 1e-14);
    CHECK(length(a.at(3) - Point3{1.5, 2.5, 2}) <= 1e-14);
}

TEST_CASE("Panorama: longitude goes across the picture and latitude down, from behind to behind and pole to pole",
          "[scene][camera]") {
    const Camera camera = along_minus_z(Projection::panorama);
    const CameraRays rays(camera, 360, 180);
    const auto direction = [&](double longitude, double latitude) {
        const Ray ray = rays.ray(180 + longitude, 90 - latitude, 0.5, 0.5, 0);
        CHECK(ray.origin == camera.look_from);
        return ray.direction;
    };
    CHECK(direction(0, 0) == Vec3{0, 0, -1});
    CHECK(near(direction(90, 0), {1, 0, 0}));
    CHECK(near(direction(-90, 0), {-1, 0, 0}));
    CHECK(near(direction(180, 0), {0, 0, 1}));
    CHECK(near(direction(-180, 0), {0, 0, 1}));
    CHECK(near(direction(30, 90), {0, 1, 0}));
    CHECK(near(direction(30, -90), {0, -1, 0}));
    for (const double longitude : {-170.0, -45.5, 12.0, 133.0})
        for (const double latitude : {-80.0, -20.0, 0.5, 60.0}) {
            const double a = radians(longitude), b = radians(latitude);
            CHECK(near(direction(longitude, latitude),
                       {std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b)}));
        }
}

TEST_CASE("Camera: what a projection cannot have is refused", "[scene][camera]") {
    Camera panorama = along_minus_z(Projection::panorama);
    panorama.aperture_angle = 1;
    CHECK_THROWS_WITH(CameraRays(panorama, 4, 4), Catch::Contains("a panorama has no lens"));
    Camera flat = along_minus_z(Projection::orthographic);
    for (const double height : {0.0, -1.0, kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
        flat.view_height = height;
        CHECK_THROWS_AS(CameraRays(flat, 4, 4), ArgumentError);
        CHECK_THROWS_WITH(CameraRays(flat, 4, 4), Catch::Contains("the height of the view"));
    }
}

TEST_CASE("Camera: rays that are made together are those that are made one by one, bit for bit", "[scene][camera]") {
    constexpr std::size_t kMost = 40;  // with room for a vector more
    test::Random random(102);
    for (const auto& [projection, aperture] :
         {std::pair{Projection::perspective, 0.0}, std::pair{Projection::perspective, 3.0},
          std::pair{Projection::orthographic, 0.0}, std::pair{Projection::orthographic, 3.0},
          std::pair{Projection::panorama, 0.0}}) {
        Camera camera = along_minus_z(projection);
        camera.look_at = {0.3, 0.7, -2}, camera.aperture_angle = aperture;
        camera.shutter_open = 0.2, camera.shutter_close = 0.7;
        const CameraRays rays(camera, 200, 100);
        double numbers[5][kMost], origin[3][kMost], direction[3][kMost], time[kMost];
        for (double(&row)[kMost] : numbers)
            for (double& number : row) number = random.uniform();
        for (std::size_t i = 0; i < kMost; ++i) numbers[0][i] *= 200, numbers[1][i] *= 100;
        numbers[2][0] = numbers[3][0] = 0.5;  // the middle of the lens
        for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{32}}) {
            camera::make_rays(rays, {count,
                                     {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]},
                                     {origin[0], origin[1], origin[2]},
                                     {direction[0], direction[1], direction[2]},
                                     time});
            for (std::size_t i = 0; i < count; ++i) {
                const Ray ray = rays.ray(numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i], numbers[4][i]);
                CHECK(ray.origin == Point3{origin[0][i], origin[1][i], origin[2][i]});
                CHECK(ray.direction == Vec3{direction[0][i], direction[1][i], direction[2][i]});
                CHECK(ray.time == time[i]);
            }
        }
    }
}

}  // namespace limn::projection_test
