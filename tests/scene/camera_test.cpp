#include "limn/scene/camera.h"

#include "catch.h"
#include "limn/math/error.h"
#include "support/random_geometry.h"

namespace limn::camera_test {

using limn::test::Random;

namespace {

Camera plain() { return {.look_from = {0, 0, 5}, .look_at = {0, 0, 0}, .up = {0, 1, 0}, .vertical_fov = 90}; }

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

// In long double, 11 bits finer than what is tested.
struct Direction {
    long double x, y, z;
};

// The direction of a camera that looks along -z, through a point of the picture.
Direction exact_direction(double vertical_fov, int width, int height, double x, double y) {
    const long double half =
        std::tan(static_cast<long double>(vertical_fov) * (3.14159265358979323846264338327950288L / 180) / 2);
    return {(2.0L * x - width) / height * half, (height - 2.0L * y) / height * half, -1};
}

// The largest component of the difference between the unit directions.
double error_of(const Vec3& d, const Direction& e) {
    const long double x = d.x, y = d.y, z = d.z;
    const long double ld = std::sqrt(x * x + y * y + z * z), le = std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
    return static_cast<double>(
        std::max({std::abs(x / ld - e.x / le), std::abs(y / ld - e.y / le), std::abs(z / ld - e.z / le)}));
}

}  // namespace

TEST_CASE("Camera: pixels run right along right and down from the top, over the whole field of view",
          "[scene][camera]") {
    const CameraRays rays(plain(), 200, 100);
    const auto direction = [&](double x, double y) { return rays.ray(x, y, 0.5, 0.5, 0).direction; };
    CHECK(length(cross(direction(100, 50), Vec3{0, 0, -1})) <= 1e-15);
    CHECK(direction(150, 50).x > 0);
    CHECK(direction(100, 25).y > 0);
    CHECK(angle_between(direction(100, 0), direction(100, 100)) == Approx(radians(90)));
    CHECK(angle_between(direction(0, 50), direction(200, 50)) == Approx(2 * std::atan(2.0)));  // twice as wide as high
    CHECK(rays.ray(3, 4, 0, 0, 0).origin == Point3{0, 0, 5});

    Camera square = plain();
    square.aspect_ratio = 1.0;
    const CameraRays squeezed(square, 200, 100);
    CHECK(angle_between(squeezed.ray(0, 50, 0, 0, 0).direction, squeezed.ray(200, 50, 0, 0, 0).direction) ==
          Approx(radians(90)));
}

TEST_CASE("Camera: up stays up, and the picture is not mirrored", "[scene][camera]") {
    // The Cornell camera: looking along +z, the image's right is -x.
    const Camera cornell{.look_from = {278, 278, -800}, .look_at = {278, 278, 0}, .vertical_fov = 40};
    const CameraRays rays(cornell, 400, 400);
    CHECK(rays.ray(400, 200, 0, 0, 0).direction.x < 0);
    CHECK(rays.ray(200, 0, 0, 0, 0).direction.y > 0);
    Random random(100);
    for (int i = 0; i < 500; ++i) {
        Camera c = plain();
        c.look_from = Point3{} + random.in_cube(10), c.look_at = Point3{} + random.in_cube(10),
        c.up = random.in_cube(3);
        const CameraRays r(c, 64, 64);
        const Vec3 forward = normalize(c.look_at - c.look_from);
        const Vec3 right = r.ray(64, 32, 0, 0, 0).direction - r.ray(0, 32, 0, 0, 0).direction;
        const Vec3 up = r.ray(32, 0, 0, 0, 0).direction - r.ray(32, 64, 0, 0, 0).direction;
        CHECK(std::abs(dot(right, forward)) <= 1e-13);
        CHECK(std::abs(dot(right, c.up)) <= 1e-12);
        CHECK(dot(up, c.up) > 0);
        CHECK(dot(cross(right, up), forward) < 0);
        CHECK(length(right) == Approx(length(up)));
    }
}

TEST_CASE("Camera: an impossible one is refused with a message that says why", "[scene][camera]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](const std::function<void(Camera&)>& spoil, const char* what) {
        Camera camera = plain();
        spoil(camera);
        CHECK_THROWS_AS(CameraRays(camera, 4, 4), ArgumentError);
        CHECK_THROWS_WITH(CameraRays(camera, 4, 4), Catch::Contains(what));
    };
    refused([](Camera& c) { c.look_at = c.look_from; }, "look-from");
    refused([](Camera& c) { c.up = {0, 0, 3}; }, "up");
    refused([](Camera& c) { c.up = {0, 0, -1e-9}; }, "up");
    refused([](Camera& c) { c.up = {0, 0, 0}; }, "up");
    refused([](Camera& c) { c.look_from = {1, 2, 3}, c.look_at = {4, 8, 12}, c.up = {1, 2, 3}; }, "up");
    for (const double fov : {0.0, 180.0, -10.0, 360.0, nan, kInfinity})
        refused([&](Camera& c) { c.vertical_fov = fov; }, "field of view");
    for (const double angle : {-1.0, 180.0, nan, kInfinity})
        refused([&](Camera& c) { c.aperture_angle = angle; }, "aperture");
    for (const double focus : {0.0, -1.0, nan, kInfinity})
        refused([&](Camera& c) { c.focus_distance = focus; }, "focus");
    for (const double aspect : {0.0, -1.0, nan, kInfinity})
        refused([&](Camera& c) { c.aspect_ratio = aspect; }, "aspect");
    for (const double height : {0.0, -1.0, nan, kInfinity})  // also in the projections that do not use it
        refused([&](Camera& c) { c.view_height = height; }, "height of the view");
    refused([](Camera& c) { c.shutter_open = 0.6, c.shutter_close = 0.5; }, "shutter");
    refused([](Camera& c) { c.shutter_open = -0.1; }, "shutter");
    refused([](Camera& c) { c.shutter_close = 1.1; }, "shutter");
    refused([&](Camera& c) { c.shutter_close = nan; }, "shutter");
    for (const double bad : {nan, kInfinity}) {
        refused([&](Camera& c) { c.look_from.x = bad; }, "look-from");
        refused([&](Camera& c) { c.look_at.y = bad; }, "look-at");
        refused([&](Camera& c) { c.up.z = bad; }, "up");
    }
    for (const int size : {0, -1}) {
        CHECK_THROWS_AS(CameraRays(plain(), size, 4), ArgumentError);
        CHECK_THROWS_WITH(CameraRays(plain(), 4, size), Catch::Contains("height"));
    }
    CHECK_NOTHROW(CameraRays(plain(), 1, 1));
}

TEST_CASE("Camera: in a picture of 65536 x 65536 every direction is right and neighbours differ", "[scene][camera]") {
    const int size = 65536;
    const double fov = 40;
    Camera camera = plain();
    camera.vertical_fov = fov;
    const CameraRays rays(camera, size, size);
    Random random(101);
    double worst = 0;
    int equal = 0;
    for (int i = 0; i < 20000; ++i) {
        double x = static_cast<double>(random.index(size)) + 0.5, y = static_cast<double>(random.index(size)) + 0.5;
        if (i == 0) x = 0.5, y = 0.5;
        if (i == 1) x = size - 0.5, y = size - 0.5;
        const Vec3 d = rays.ray(x, y, 0, 0, 0).direction;
        worst = std::max(worst, error_of(d, exact_direction(fov, size, size, x, y)));
        equal += d == rays.ray(x + 1, y, 0, 0, 0).direction || d == rays.ray(x, y + 1, 0, 0, 0).direction;
    }
    CHECK(worst <= 2 * 0x1p-52);  // 2 ulp of the unit direction
    CHECK(equal == 0);
}

TEST_CASE("Camera: the narrowest and widest fields of view are right to 4 ulp", "[scene][camera]") {
    for (const double fov : {1e-3, 0.1, 20.0, 90.0, 179.0, 179.9}) {
        Camera camera = plain();
        camera.vertical_fov = fov;
        const CameraRays rays(camera, 640, 480);
        for (const double y : {0.0, 0.5, 100.0, 479.5, 480.0}) {
            for (const double x : {0.0, 17.5, 320.0, 640.0}) {
                const Vec3 d = rays.ray(x, y, 0, 0, 0).direction;
                const Direction e = exact_direction(fov, 640, 480, x, y);
                CHECK(error_of(d, e) <= 4 * 0x1p-52);
                if (fov > 90) continue;  // beyond it the tangent magnifies what rounding 179.9 degrees to radians costs
                CHECK(std::abs(d.x / -d.z - static_cast<double>(e.x)) <=
                      4 * 0x1p-52 * std::abs(static_cast<double>(e.x)));
                CHECK(std::abs(d.y / -d.z - static_cast<double>(e.y)) <=
                      4 * 0x1p-52 * std::abs(static_cast<double>(e.y)));
            }
        }
    }
}

TEST_CASE("Camera: without a lens the random numbers do not matter, every ray leaves the eye", "[scene][camera]") {
    Random random(102);
    Camera camera = plain();
    camera.aperture_angle = 0;
    camera.focus_distance = 3;
    const CameraRays rays(camera, 64, 48), other(plain(), 64, 48);
    CHECK_FALSE(rays.has_lens());
    for (int i = 0; i < 1000; ++i) {
        const double x = random.uniform(0, 64), y = random.uniform(0, 48);
        const Ray a = rays.ray(x, y, random.uniform(), random.uniform(), 0), b = other.ray(x, y, 0, 0, 0);
        CHECK((a.origin == b.origin && a.direction == b.direction));
    }
}

TEST_CASE("Camera: every lens ray passes the point in focus, from a uniform disc of radius f tan(angle / 2)",
          "[scene][camera]") {
    Random random(103);
    for (const double aperture : {1e-3, 0.6, 10.0}) {
        for (const double focus : {1e-3, 3.4, 1e6}) {
            Camera camera = plain();
            camera.look_from = {1, 2, 3};
            camera.aperture_angle = aperture;
            camera.focus_distance = focus;
            const CameraRays rays(camera, 64, 48);
            CHECK(rays.has_lens());
            Camera pinhole = camera;
            pinhole.aperture_angle = 0;
            const CameraRays center(pinhole, 64, 48);
            const Vec3 forward = normalize(camera.look_at - camera.look_from);
            const double radius = focus * std::tan(radians(aperture) / 2);
            double largest = 0, worst_focus = 0, worst_plane = 0, inner = 0, mean_x = 0;
            const int count = 10000;
            for (int i = 0; i < count; ++i) {
                const double x = random.uniform(0, 64), y = random.uniform(0, 48);
                const Ray straight = center.ray(x, y, 0, 0, 0);
                const Point3 in_focus = straight.at(focus / dot(straight.direction, forward));
                const Ray ray = rays.ray(x, y, random.uniform(), random.uniform(), 0);
                const double along = dot(in_focus - ray.origin, forward) / dot(ray.direction, forward);
                worst_focus = std::max(worst_focus, length(ray.at(along) - in_focus));
                const Vec3 on_lens = ray.origin - camera.look_from;
                worst_plane = std::max(worst_plane, std::abs(dot(on_lens, forward)));
                largest = std::max(largest, length(on_lens));
                inner += length(on_lens) < radius / 2;
                mean_x += on_lens.x / radius / count;
            }
            // 4 float ulps of the focus distance; the eye's own coordinates are rounded too.
            CHECK(worst_focus <= 4 * 0x1p-23 * focus + 1e-14);
            CHECK(worst_plane <= 1e-14 * focus + 1e-14);
            CHECK(largest <= radius * (1 + 1e-9) + 1e-14);
            CHECK(largest >= 0.97 * radius);
            CHECK(std::abs(inner / count - 0.25) <= 4.5 * std::sqrt(0.25 * 0.75 / count));  // uniform by area
            CHECK(std::abs(mean_x) <= 4.5 * 0.5 / std::sqrt(count));
        }
    }
}

TEST_CASE("Camera: the focus distance moves the plane in focus, not the field of view", "[scene][camera]") {
    Camera camera = plain();
    camera.aperture_angle = 5;
    for (const double focus : {0.5, 5.0, 50.0}) {
        camera.focus_distance = focus;
        const CameraRays rays(camera, 64, 64);
        const Ray a = rays.ray(0, 32, 0.5, 0.5, 0), b = rays.ray(64, 32, 0.5, 0.5, 0);
        // From one point of the lens: the frame at the focus plane has the half width focus * tan(45 deg).
        const auto at_focus = [&](const Ray& r) { return r.at((5 - focus - r.origin.z) / r.direction.z); };
        CHECK(length(at_focus(b) - at_focus(a)) == Approx(2 * focus));
    }
    camera.focus_distance.reset();  // the target's distance
    const Ray r = CameraRays(camera, 64, 64).ray(32, 32, 0.1, 0.9, 0);
    CHECK(length(r.at((0 - r.origin.z) / r.direction.z) - Point3{0, 0, 0}) <= 1e-14);
}

TEST_CASE("Camera: times fill the shutter, and a closed interval is one moment", "[scene][camera]") {
    Camera camera = plain();
    camera.shutter_open = 0.25, camera.shutter_close = 0.75;
    const CameraRays rays(camera, 4, 4);
    CHECK(rays.has_shutter());
    CHECK(rays.ray(1, 1, 0, 0, 0).time == 0.25);
    CHECK(rays.ray(1, 1, 0, 0, 0.5).time == 0.5);
    CHECK(rays.ray(1, 1, 0, 0, std::nextafter(1, 0)).time <= 0.75);
    camera.shutter_close = 0.25;
    const CameraRays still(camera, 4, 4);
    CHECK_FALSE(still.has_shutter());
    CHECK(still.ray(1, 1, 0, 0, 0.9).time == 0.25);
}

TEST_CASE("frame_box: all of the box is in the picture, and a cube fills at least half of it", "[scene][camera]") {
    Random random(104);
    for (int i = 0; i < 2000; ++i) {
        Box box;
        const Point3 p = Point3{} + random.in_cube(random.log_uniform(1e-3, 1e3));
        box.extend(p);
        Vec3 size = limn::abs(random.log_uniform(1e-6, 1e6) * random.in_cube());
        if (random.chance(0.2)) size[random.index(3)] = 0;  // flat
        const bool cube = random.chance(0.2);
        if (cube) size = {size.x, size.x, size.x};
        box.extend(p + size);
        const double aspect = random.log_uniform(0.1, 10);
        const Camera camera = frame_box(box, aspect);
        const CameraRays rays(camera, 100, 100);  // refuses an impossible camera
        const Vec3 forward = normalize(camera.look_at - camera.look_from);
        const Vec3 right = normalize(cross(forward, camera.up)), up = cross(right, forward);
        const double half_height = std::tan(radians(camera.vertical_fov) / 2), half_width = half_height * aspect;
        double extent = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 v = Point3{corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                                  corner & 4 ? box.upper.z : box.lower.z} -
                           camera.look_from;
            const double depth = dot(v, forward);
            CHECK(depth > 0);
            const double x = std::abs(dot(v, right)) / depth / half_width,
                         y = std::abs(dot(v, up)) / depth / half_height;
            CHECK((x <= 1 && y <= 1));
            extent = std::max({extent, x, y});
        }
        if (cube && size.x > 1e-3 * length(p - Point3{})) CHECK(extent > 0.5);
        CHECK((forward.y < 0 && forward.z < 0 && forward.x < 0));  // down, from the front right
    }
}

TEST_CASE("frame_box: an empty or unbounded box and an impossible aspect ratio are refused, a point is not",
          "[scene][camera]") {
    CHECK_THROWS_AS(frame_box(Box{}), ArgumentError);
    CHECK_THROWS_AS(frame_box(Box{{0, 0, 0}, {1, kInfinity, 1}}), ArgumentError);
    for (const double aspect : {0.0, -1.0, kInfinity, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(frame_box(Box{{0, 0, 0}, {1, 1, 1}}, aspect), ArgumentError);
    for (const Point3 p : {Point3{0, 0, 0}, Point3{1e5, -2, 3}, Point3{1e-20, 0, 0}})
        CHECK_NOTHROW(CameraRays(frame_box(Box{p, p}), 8, 8));
}

}  // namespace limn::camera_test
