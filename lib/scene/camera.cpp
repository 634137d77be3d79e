#include "limn/scene/camera.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/camera.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "limn/math/error.h"
#include "limn/math/math.h"
#include "math/elementary.h"
#include "math/warps-inl.h"
#include "scene/camera_rays.h"

HWY_BEFORE_NAMESPACE();
namespace limn::camera::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

// A ray for each lane of N.
template <class N>
struct RayOf {
    Vector<N> origin, direction;
    N time;
};

// Returns the direction of a panorama's ray. `across` and `upward` are in [-1, 1].
template <class N>
HWY_INLINE Vector<N> panorama_direction(const CameraRays::View& view, N across, N upward) {
    const SineCosine<N> longitude = sine_cosine_of_turns(across / 2.0);
    const SineCosine<N> latitude = sine_cosine_of_turns(upward / 4.0);
    const Vector<N> level = longitude.cosine * broadcast<N>(view.forward) + longitude.sine * broadcast<N>(view.right);
    return latitude.cosine * level + latitude.sine * broadcast<N>(view.up);
}

// Returns the ray through a point of the picture: see CameraRays::ray().
template <class N>
HWY_INLINE RayOf<N> ray(const CameraRays::View& view, N x, N y, N lens_u, N lens_v, N time_u) {
    // Compute (2x - w) / w rather than 2x/w - 1. Its numerator is exact, so mirrored pixels get mirrored rays.
    const N across = (2.0 * x - view.width) / view.width, upward = (view.height - 2.0 * y) / view.height;
    const N time = view.shutter_open + time_u * (view.shutter_close - view.shutter_open);
    const Vector<N> eye = broadcast<N>(view.eye), forward = broadcast<N>(view.forward);
    if (view.projection == Projection::panorama) return {eye, panorama_direction(view, across, upward), time};
    const Vector<N> along_x = broadcast<N>(view.right), along_y = broadcast<N>(view.up);
    const Vector<N> right = across * view.half_width * along_x, up = upward * view.half_height * along_y;
    const bool is_perspective = view.projection == Projection::perspective;
    const Vector<N> origin = is_perspective ? eye : eye + right + up;
    const Vector<N> pinhole = is_perspective ? forward + right + up : forward;
    if (view.lens_radius == 0) return {origin, pinhole, time};
    const Vector<N> on_disc = uniform_disc(lens_u, lens_v);
    const Vector<N> shift = view.lens_radius * (on_disc.x * along_x + on_disc.y * along_y);
    // Direct the ray to the point where the pinhole's ray intersects the plane of focus.
    return {origin + shift, pinhole - shift / view.focus_distance, time};
}

void make_rays(const CameraRays::View& view, const Rows& rows) {
    for (std::size_t i = 0; i < rows.count; i += kLanes<Doubles>) {
        const auto number = [&](std::size_t d) HWY_ATTR { return load<Doubles>(rows.numbers[d] + i); };
        const RayOf<Doubles> r = ray(view, number(0), number(1), number(2), number(3), number(4));
        store(r.origin.x, rows.origin[0] + i);
        store(r.direction.x, rows.direction[0] + i);
        store(r.origin.y, rows.origin[1] + i);
        store(r.direction.y, rows.direction[1] + i);
        store(r.origin.z, rows.origin[2] + i);
        store(r.direction.z, rows.direction[2] + i);
        store(r.time, rows.time + i);
    }
}

}  // namespace limn::camera::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

namespace {

void require(bool holds, const char* what) {
    if (!holds) throw ArgumentError(std::string("camera: ") + what);
}

// Returns tan(degrees / 2), accurate to a few roundings. Near 180 degrees the tangent magnifies the rounding error of
// its argument. 180 - degrees is exact there, so the cotangent of half of it is used.
double tan_of_half(double degrees) {
    return degrees <= 90 ? tangent(radians(degrees) / 2) : 1 / tangent(radians(180 - degrees) / 2);
}

bool is_height(double height) { return height > 0 && std::isfinite(height); }

// Returns half the height of the frame: at distance 1, or in world units if the camera is orthographic.
double half_height_of(const Camera& camera) {
    const double half_angle = tan_of_half(camera.vertical_fov);
    if (camera.projection != Projection::orthographic) return half_angle;
    const double half =
        camera.view_height ? *camera.view_height / 2 : length(camera.look_at - camera.look_from) * half_angle;
    require(is_height(half), "the height of the view must be positive and finite");
    return half;
}

// Checks a camera and returns the numbers that its rays are computed from.
CameraRays::View view_of(const Camera& camera, int width, int height) {
    CameraRays::View v{};
    v.eye = camera.look_from;
    v.projection = camera.projection;
    v.width = width;
    v.height = height;
    v.shutter_open = camera.shutter_open;
    v.shutter_close = camera.shutter_close;
    // Check what doesn't depend on the axes.
    require(width > 0 && height > 0, "width and height must be positive");
    require(is_finite(camera.look_from), "look-from must be finite");
    require(is_finite(camera.look_at), "look-at must be finite");
    require(is_height(camera.view_height.value_or(1)), "the height of the view must be positive and finite");
    require(is_finite(camera.up) && !(camera.up == Vec3{}), "up must be finite and not zero");
    require(camera.vertical_fov > 0 && camera.vertical_fov < 180, "the vertical field of view must be in (0, 180)");
    require(camera.aperture_angle >= 0 && camera.aperture_angle < 180, "the aperture angle must be in [0, 180)");
    require(v.shutter_open >= 0 && v.shutter_open <= v.shutter_close && v.shutter_close <= 1,
            "the shutter must satisfy 0 <= open <= close <= 1");
    // Compute the axes.
    const Vec3 view = camera.look_at - camera.look_from;
    require(is_finite(view) && !(view == Vec3{}), "look-from and look-at must differ");
    v.forward = normalize(view);
    const Vec3 right = cross(v.forward, normalize(camera.up));
    // If `up` is closer than this to the view direction, the axes would depend on rounding alone.
    require(length(right) > 16 * kRoundoff, "up must not be parallel to the view direction");
    v.right = normalize(right);
    v.up = cross(v.right, v.forward);

    // Compute the frame and the lens.
    const double aspect = camera.aspect_ratio.value_or(v.width / v.height);
    require(aspect > 0 && std::isfinite(aspect), "the aspect ratio must be positive and finite");
    v.half_height = half_height_of(camera);
    v.half_width = v.half_height * aspect;
    v.focus_distance = camera.focus_distance.value_or(length(view));
    require(v.focus_distance > 0 && std::isfinite(v.focus_distance), "the focus distance must be positive and finite");
    v.lens_radius = v.focus_distance * tan_of_half(camera.aperture_angle);
    require(v.lens_radius == 0 || v.projection != Projection::panorama,
            "a panorama has no lens: its aperture must be 0");
    // Check that no origin or direction overflows.
    const double frame = v.half_width + v.half_height, reach = frame + v.lens_radius / v.focus_distance;
    require(std::isfinite(2 * reach) && std::isfinite(max_abs(v.eye) + 2 * frame + 2 * v.lens_radius),
            "the frame or the lens is too large");
    return v;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height) : view_(view_of(camera, width, height)) {}

Ray CameraRays::ray(double x, double y, double lens_u, double lens_v, double time_u) const {
    const auto [origin, direction, time] = camera::HWY_NAMESPACE::ray(view_, x, y, lens_u, lens_v, time_u);
    return {{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}, 0, kInfinity, time};
}

namespace camera {

HWY_EXPORT(make_rays);

void make_rays(const CameraRays& camera, const Rows& rows) { HWY_DYNAMIC_DISPATCH(make_rays)(camera.view(), rows); }

}  // namespace camera

Camera frame_box(const Box& box, double aspect_ratio) {
    // Check the arguments.
    if (box.is_empty() || !is_finite(box.lower) || !is_finite(box.upper))
        throw ArgumentError("frame_box: the box must be finite and not empty");
    if (!(aspect_ratio > 0) || !std::isfinite(aspect_ratio))
        throw ArgumentError("frame_box: the aspect ratio must be positive and finite");
    // Find the bounding sphere. That of a single point gets the radius that its coordinates can resolve.
    const Point3 center = box.center();
    const Vec3 half = box.diagonal() / 2;
    double radius = length(half);
    if (radius == 0) radius = std::max(0x1p-40 * length(center - Point3{}), 0x1p-100);
    // Look from the front right and a little above, so that three sides are visible.
    const Vec3 back = normalize(Vec3{0.5, 0.35, 1});
    Camera camera;
    camera.vertical_fov = 30;
    const double half_height = tan_of_half(camera.vertical_fov);
    // Fit the sphere into the narrower of the two angles, with 2 % of free space around it.
    const double narrow = arc_tangent(half_height * std::min(1.0, aspect_ratio));
    const double distance = 1.02 * radius / sine(narrow);
    camera.look_at = center;
    camera.look_from = center + distance * back;
    return camera;
}

}  // namespace limn
#endif
