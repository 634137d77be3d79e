// Camera rays against their geometry in __float128, for every place, direction, field of view, lens and size of
// picture.
#include "limn/scene/camera.h"
#include "hard/hard.h"
#include "limn/math/error.h"
#include "support/random_geometry.h"
#include "support/real.h"

namespace limn::camera_test {

using namespace test;

namespace {

Real3 unit(const Real3& v) { return (1 / length(v)) * v; }

// tan(degrees / 2) by the addition theorem from a rounded angle: the rest of it is small.
Real tan_half(double degrees) {
    const Real pi = Real(3.14159265358979323846) + Real(1.2246467991473532e-16), angle = Real(degrees) * pi / 360;
    const double rounded = static_cast<double>(angle);
    Real sine = 0, cosine = 0, term = 1;  // Taylor's series of both, for angles below pi / 2
    for (int k = 0; k < 60; ++k) {
        (k % 2 ? sine : cosine) += (k % 4 < 2 ? 1 : -1) * term;
        term *= Real(rounded) / (k + 1);
    }
    const Real rest = angle - Real(rounded), tangent = sine / cosine;
    return (tangent + rest) / (1 - tangent * rest);
}

struct TrueCamera {
    Real3 forward, right, up;
    Real half_width, half_height;
    int width, height;

    TrueCamera(const Camera& c, int w, int h) : width(w), height(h) {
        forward = unit(Real3(c.look_at) - Real3(c.look_from));
        right = unit(cross(forward, Real3(c.up)));
        up = cross(right, forward);
        half_height = tan_half(c.vertical_fov);
        half_width = half_height * w / h;
    }
    Real3 direction(double x, double y) const {
        return forward + ((2 * Real(x) - width) / width * half_width) * right +
               ((height - 2 * Real(y)) / height * half_height) * up;
    }
};

// The largest component of the difference of the unit directions.
double error_of(const Vec3& d, const Real3& truth) {
    const Real3 e = unit(Real3(d)) - unit(truth);
    return static_cast<double>(std::max({absolute(e.x), absolute(e.y), absolute(e.z)}));
}

// Anywhere, looking anywhere, upright to within 6 degrees of the view at worst.
Camera random_camera(Random& random) {
    Camera c;
    c.look_from = Point3{} + random.log_uniform(1e-3, 1e6) * random.unit();
    const Vec3 view = random.log_uniform(1e-3, 1e6) * random.unit();
    c.look_at = c.look_from + view;
    do c.up = random.log_uniform(1e-30, 1e30) * random.unit();
    while (length(cross(normalize(c.up), normalize(view))) < 0.1);
    return c;
}

}  // namespace

TEST_CASE("Camera: every direction is right to some roundings, of pictures up to 65536 x 65536, and neighbours differ",
          "[hard][camera]") {
    Random random(58);
    double worst = 0;
    int equal = 0;
    for (int i = 0; i < count(1e5); ++i) {
        Camera camera = random_camera(random);
        camera.vertical_fov = random.chance(0.5) ? random.uniform(1e-3, 120) : random.log_uniform(1e-3, 120);
        const int width = random.chance(0.5) ? 65536 : 1 + static_cast<int>(random.index(2000)), height = 65536;
        const CameraRays rays(camera, width, height);
        const TrueCamera truth(camera, width, height);
        for (const bool at_corner : {false, true}) {
            const double x = (at_corner ? 0 : static_cast<double>(random.index(static_cast<std::size_t>(width)))) + 0.5,
                         y = (at_corner ? height - 1 : static_cast<double>(random.index(65536))) + 0.5;
            const Vec3 d = rays.ray(x, y, 0, 0, 0).direction;
            worst = std::max(worst, error_of(d, truth.direction(x, y)));
            // Directions beside each other differ by 1e-3 degrees / 65536, 2.7e-10, at least.
            equal += d == rays.ray(x + 1, y, 0, 0, 0).direction || d == rays.ray(x, y + 1, 0, 0, 0).direction;
        }
    }
    // Each vector of the frame is normalised (3 roundings) and the right one a cross product (2), of which a tenth may
    // cancel where up leans to the view.
    CHECK(worst <= 16 * 0x1p-53 * 10);
    CHECK(equal == 0);
}

TEST_CASE("Camera: looking along an axis, directions are right to 4 ulp from 1e-3 to 179.9 degrees", "[hard][camera]") {
    Random random(61);
    for (const double fov : {1e-3, 1e-2, 1.0, 40.0, 90.0, 150.0, 179.0, 179.9}) {
        for (const Vec3& view : {Vec3{0, 0, -1}, Vec3{0, 0, 1e-3}, Vec3{1e5, 0, 0}, Vec3{-7, 0, 0}}) {
            Camera camera{.look_from = {1, 2, 3}, .look_at = Point3{1, 2, 3} + view, .vertical_fov = fov};
            const CameraRays rays(camera, 640, 480);
            const TrueCamera truth(camera, 640, 480);
            double worst = 0;
            for (int i = 0; i < count(1e4); ++i) {
                const double x = random.uniform(0, 640), y = random.uniform(0, 480);
                worst = std::max(worst, error_of(rays.ray(x, y, 0, 0, 0).direction, truth.direction(x, y)));
            }
            CAPTURE(fov, view.x, view.z, worst * 0x1p52);
            CHECK(worst <= 4 * 0x1p-52);
        }
    }
}

TEST_CASE("Camera: every lens ray passes the point in focus, from apertures of 1e-3 to 10 degrees at 1e-3 to 1e6",
          "[hard][camera]") {
    Random random(60);
    double worst = 0;
    for (int i = 0; i < count(1e6); ++i) {
        Camera camera = random_camera(random), pinhole = camera;
        camera.aperture_angle = random.log_uniform(1e-3, 10);
        const double focus = random.log_uniform(1e-3, 1e6);
        camera.focus_distance = focus;
        const double x = random.uniform(0, 64), y = random.uniform(0, 48);
        const Ray ray = CameraRays(camera, 64, 48).ray(x, y, random.uniform(), random.uniform(), 0),
                  straight = CameraRays(pinhole, 64, 48).ray(x, y, 0, 0, 0);
        const Real3 in_focus = Real3(straight.origin) + Real(focus) * Real3(straight.direction),
                    reached = Real3(ray.origin) + Real(focus) * Real3(ray.direction);
        // The lens point is rounded where the eye is.
        const double eye = 4 * 0x1p-53 * max_abs(camera.look_from);
        worst = std::max(worst, (static_cast<double>(length(reached - in_focus)) - eye) / focus);
    }
    CHECK(worst <= 8 * 0x1p-53);
}

TEST_CASE("Camera: one without an aperture is a pinhole to the bit, wherever its focus is", "[hard][camera]") {
    Random random(59);
    int differing = 0;
    for (int i = 0; i < count(1e5); ++i) {
        Camera camera = random_camera(random), focused = camera;
        focused.focus_distance = random.log_uniform(1e-3, 1e6);
        const double x = random.uniform(0, 64), y = random.uniform(0, 48);
        const Ray a = CameraRays(camera, 64, 48).ray(x, y, 0, 0, 0),
                  b = CameraRays(focused, 64, 48).ray(x, y, random.uniform(), random.uniform(), 0);
        differing += !(a.origin == b.origin && a.direction == b.direction);
    }
    CHECK(differing == 0);
}

TEST_CASE("Camera: one at the ends of the numbers is refused, or all its rays can be used", "[hard][camera]") {
    Random random(57);
    const auto number = [&] {
        const double special[] = {0.0,      -0.0,      5e-324,     1e-310,       1.7e308,
                                  -1.7e308, kInfinity, -kInfinity, std::nan(""), 1.0};
        if (random.chance(0.2)) return special[random.index(std::size(special))];
        return random.sign() * std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.index(2090)) - 1070);
    };
    const auto vector = [&] {
        const double x = number(), y = number();
        return random.chance(0.5) ? Vec3{x, y, number()}
                                  : std::ldexp(1, static_cast<int>(random.index(2000)) - 1000) * random.unit();
    };
    int made = 0, refused = 0, wrong = 0;
    for (int i = 0; i < count(1e7); ++i) {
        Camera c;
        c.look_from = Point3{} + (random.chance(0.5) ? random.unit() : vector());
        c.look_at = c.look_from + (random.chance(0.5) ? random.unit() : vector());
        c.up = random.chance(0.3) ? c.look_at - c.look_from : vector();
        if (random.chance(0.3)) c.vertical_fov = number();
        if (random.chance(0.3)) c.aspect_ratio = number();
        if (random.chance(0.5)) c.aperture_angle = random.chance(0.5) ? random.uniform(0, 180) : number();
        if (random.chance(0.5)) c.focus_distance = number();
        if (random.chance(0.1)) c.shutter_open = number();
        if (random.chance(0.1)) c.shutter_close = number();
        try {
            const CameraRays rays(c, 1 + static_cast<int>(random.index(7)), 5);
            ++made;
            for (const double x : {0.0, 0.5, 1.0})
                for (const double u : {0.0, 0.5, 1 - 0x1p-53}) {
                    const Ray ray = rays.ray(x, 5 * u, u, 1 - u, u);
                    wrong += !(is_usable(ray) && ray.time >= 0 && ray.time <= 1);
                }
        } catch (const ArgumentError&) {
            ++refused;
        }
    }
    CHECK(wrong == 0);
    CHECK(made > 1000);
    CHECK(refused > 1000);
}

}  // namespace limn::camera_test
