// What holds for every camera: which pixel a ray belongs to, and what moving, scaling and mirroring change.
#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/camera.h"
#include "property.h"
#include "support/grid.h"

namespace limn::camera_laws_test {

using test::draw_int;
using test::draw_on_grid;
using test::draw_point;
using test::draw_power_of_two;
using test::draw_unit;
using test::draw_vec;

namespace {

constexpr int kWidth = 192, kHeight = 128;

Camera draw_camera() {
    Camera c;
    c.look_from = draw_point(), c.look_at = draw_point(), c.up = draw_vec();
    const Vec3 view = c.look_at - c.look_from;
    RC_PRE((length(view) > 0 && length(c.up) > 0));
    RC_PRE(length(cross(normalize(view), normalize(c.up))) > 0.01);
    c.vertical_fov = draw_int(1, 170);
    if (draw_int(0, 1)) c.aspect_ratio = draw_int(1, 256) / 64.0;
    if (draw_int(0, 1)) c.aperture_angle = draw_int(1, 20);
    c.focus_distance = draw_int(1, 640) / 64.0;
    return c;
}

// Where on the picture the direction from the eye to a point lies, by trigonometry alone.
Uv pixel_of(const Camera& c, const Vec3& to_point) {
    const Vec3 forward = normalize(c.look_at - c.look_from), right = unit_cross(forward, c.up),
               up = cross(right, forward);
    const double half = std::tan(c.vertical_fov * kPi / 360),
                 aspect = c.aspect_ratio.value_or(double(kWidth) / kHeight);
    const double depth = dot(to_point, forward);
    return {(1 + dot(to_point, right) / depth / (half * aspect)) / 2 * kWidth,
            (1 - dot(to_point, up) / depth / half) / 2 * kHeight};
}

bool same(const Ray& a, const Ray& b) { return a.origin == b.origin && a.direction == b.direction; }

}  // namespace

TEST_CASE("Camera: what is in focus on a ray through (x, y) lies at (x, y) of the picture, whatever the lens",
          "[scene][camera]") {
    test::holds(
        [] {
            const Camera camera = draw_camera();
            const CameraRays rays(camera, kWidth, kHeight);
            const double x = kWidth * draw_unit(), y = kHeight * draw_unit();
            const Ray ray = rays.ray(x, y, draw_unit(), draw_unit(), 0);
            const Vec3 forward = normalize(camera.look_at - camera.look_from);
            RC_ASSERT(std::abs(dot(ray.direction, forward) - 1) <= 1e-12);  // t is the distance along the view
            const Uv pixel = pixel_of(camera, ray.at(*camera.focus_distance) - camera.look_from);
            // The eye's coordinates are up to 16, those in focus from 1/64 on; a fov of 1 degree magnifies by 115.
            RC_ASSERT(std::abs(pixel.u - x) <= 1e-8);
            RC_ASSERT(std::abs(pixel.v - y) <= 1e-8);
            RC_ASSERT((ray.t_min == 0 && ray.t_max == kInfinity));
        },
        500);
}

TEST_CASE("Camera: moved, it sends the same directions from where it stands, to the bit", "[scene][camera]") {
    test::holds([] {
        const Camera camera = draw_camera();
        const Vec3 by = 64 * draw_vec();
        Camera moved = camera;
        moved.look_from = camera.look_from + by, moved.look_at = camera.look_at + by;
        const double x = kWidth * draw_unit(), y = kHeight * draw_unit(), u = draw_unit(), v = draw_unit();
        const Ray a = CameraRays(camera, kWidth, kHeight).ray(x, y, u, v, 0),
                  b = CameraRays(moved, kWidth, kHeight).ray(x, y, u, v, 0);
        RC_ASSERT(a.direction == b.direction);
        RC_ASSERT(length((b.origin - a.origin) - by) <= 1e-12);
    });
}

TEST_CASE("Camera: in a world 2^k times as large the directions are the same and the lens is 2^k times as wide",
          "[scene][camera]") {
    test::holds([] {
        const Camera camera = draw_camera();
        const double s = draw_power_of_two(-30, 30);
        Camera scaled = camera;
        scaled.look_from = Point3{} + s * (camera.look_from - Point3{});
        scaled.look_at = Point3{} + s * (camera.look_at - Point3{});
        scaled.up = draw_power_of_two(-30, 30) * camera.up;
        scaled.focus_distance = s * *camera.focus_distance;
        const double x = kWidth * draw_unit(), y = kHeight * draw_unit(), u = draw_unit(), v = draw_unit();
        const Ray a = CameraRays(camera, kWidth, kHeight).ray(x, y, u, v, 0),
                  b = CameraRays(scaled, kWidth, kHeight).ray(x, y, u, v, 0);
        RC_ASSERT(a.direction == b.direction);
        RC_ASSERT(s * (a.origin - Point3{}) == b.origin - Point3{});
    });
}

TEST_CASE("Camera: mirrored pixels get mirrored rays, to the bit", "[scene][camera]") {
    Camera camera{.look_from = {0, 0, 8}, .look_at = {0, 0, 0}, .vertical_fov = 70};
    const CameraRays rays(camera, kWidth, kHeight);
    test::holds([&] {
        const double x = draw_int(0, 64 * kWidth) / 64.0, y = draw_int(0, 64 * kHeight) / 64.0;
        const Ray ray = rays.ray(x, y, 0, 0, 0);
        const Vec3 d = ray.direction;
        RC_ASSERT(same(rays.ray(kWidth - x, y, 0, 0, 0), {.origin = ray.origin, .direction = {-d.x, d.y, d.z}}));
        RC_ASSERT(same(rays.ray(x, kHeight - y, 0, 0, 0), {.origin = ray.origin, .direction = {d.x, -d.y, d.z}}));
    });
}

TEST_CASE("Camera: the lens point goes right with on-disc x and up with y", "[scene][camera]") {
    Camera camera{.look_from = {1, 2, 8}, .look_at = {1, 2, 0}, .vertical_fov = 70};
    camera.aperture_angle = 90, camera.focus_distance = 3.0;  // a radius of 3
    const CameraRays rays(camera, kWidth, kHeight);
    const auto lens = [&](double u, double v) { return rays.ray(5, 7, u, v, 0).origin - camera.look_from; };
    CHECK(length(lens(1, 0.5) - Vec3{3, 0, 0}) <= 1e-14);
    CHECK(length(lens(0, 0.5) - Vec3{-3, 0, 0}) <= 1e-14);
    CHECK(length(lens(0.5, 1) - Vec3{0, 3, 0}) <= 1e-14);
    CHECK(length(lens(0.5, 0) - Vec3{0, -3, 0}) <= 1e-14);
    CHECK(lens(0.5, 0.5) == Vec3{});
}

TEST_CASE("frame_box: a box endless on either side is refused, one of a point is seen from as near as numbers allow",
          "[scene][camera]") {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Box low{{0, 0, 0}, {1, 1, 1}}, high = low;
        low.lower[axis] = -kInfinity, high.upper[axis] = kInfinity;
        CHECK_THROWS_AS(frame_box(low), ArgumentError);
        CHECK_THROWS_AS(frame_box(high), ArgumentError);
    }
    for (const double size : {1e-6, 1.0, 1e6}) {
        const Point3 p{2 * size, -3 * size, 6 * size};  // 7 size from the origin
        const Camera camera = frame_box(Box{p, p});
        CHECK(camera.look_at == p);
        const double away = length(camera.look_from - p);
        CHECK((away > 0x1p-40 * 7 * size && away < 8 * 0x1p-40 * 7 * size));
    }
    CHECK(length(frame_box(Box{{0, 0, 0}, {0, 0, 0}}).look_from - Point3{}) > 0);
}

}  // namespace limn::camera_laws_test
