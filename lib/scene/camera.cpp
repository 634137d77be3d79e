#include "limn/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lanes/functions-inl.h"
#include "limn/core/error.h"
#include "limn/core/math.h"
#include "limn/core/warp.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

namespace {

void require(bool holds, const char* what) {
    if (!holds) throw ArgumentError(std::string("camera: ") + what);
}

// tan(degrees / 2), right to a few roundings. Near 180 degrees the tangent magnifies that of the angle: what is missing
// there is exact.
double tan_of_half(double degrees) {
    return degrees <= 90 ? std::tan(radians(degrees) / 2) : 1 / std::tan(radians(180 - degrees) / 2);
}

double half_height_of(const Camera& camera) {
    const double half_angle = tan_of_half(camera.vertical_fov);
    if (camera.projection != Projection::orthographic) return half_angle;
    const double half =
        camera.view_height ? *camera.view_height / 2 : length(camera.look_at - camera.look_from) * half_angle;
    require(half > 0 && std::isfinite(half), "the height of the view must be positive and finite");
    return half;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : eye_(camera.look_from),
      projection_(camera.projection),
      width_(width),
      height_(height),
      shutter_open_(camera.shutter_open),
      shutter_close_(camera.shutter_close) {
    require(width > 0 && height > 0, "width and height must be positive");
    require(is_finite(camera.look_from), "look-from must be finite");
    require(is_finite(camera.look_at), "look-at must be finite");
    require(is_finite(camera.up) && !(camera.up == Vec3{}), "up must be finite and not zero");
    require(camera.vertical_fov > 0 && camera.vertical_fov < 180, "the vertical field of view must lie in (0, 180)");
    require(camera.aperture_angle >= 0 && camera.aperture_angle < 180, "the aperture angle must lie in [0, 180)");
    require(shutter_open_ >= 0 && shutter_open_ <= shutter_close_ && shutter_close_ <= 1,
            "the shutter must satisfy 0 <= open <= close <= 1");
    const Vec3 view = camera.look_at - camera.look_from;
    require(is_finite(view) && !(view == Vec3{}), "look-from and look-at must differ");
    forward_ = normalize(view);
    const Vec3 right = cross(forward_, normalize(camera.up));
    // Closer than this to the view direction, "up" would be decided by rounding alone.
    require(length(right) > 16 * kRoundoff, "up must not be parallel to the view direction");
    right_ = normalize(right);
    up_ = cross(right_, forward_);

    const double aspect = camera.aspect_ratio.value_or(width_ / height_);
    require(aspect > 0 && std::isfinite(aspect), "the aspect ratio must be positive and finite");
    half_height_ = half_height_of(camera);
    half_width_ = half_height_ * aspect;
    focus_distance_ = camera.focus_distance.value_or(length(view));
    require(focus_distance_ > 0 && std::isfinite(focus_distance_), "the focus distance must be positive and finite");
    lens_radius_ = focus_distance_ * tan_of_half(camera.aperture_angle);
    require(lens_radius_ == 0 || projection_ != Projection::panorama, "a panorama has no lens: its aperture must be 0");
    // No ray may begin or lead beyond the largest double.
    const double frame = half_width_ + half_height_, reach = frame + lens_radius_ / focus_distance_;
    require(std::isfinite(2 * reach) && std::isfinite(max_abs(eye_) + 2 * frame + 2 * lens_radius_),
            "the frame or the lens is too large");
}

Ray CameraRays::ray(double x, double y, double lens_u, double lens_v, double time_u) const {
    // (2x - w) / w rather than 2x/w - 1: exact in the numerator, so that mirrored pixels get mirrored rays.
    const double across = (2 * x - width_) / width_, upward = (height_ - 2 * y) / height_;
    const double time = shutter_open_ + time_u * (shutter_close_ - shutter_open_);
    if (projection_ == Projection::panorama) return {eye_, panorama_direction(across, upward), 0, kInfinity, time};
    const Vec3 right = across * half_width_ * right_, up = upward * half_height_ * up_;
    const bool is_perspective = projection_ == Projection::perspective;
    const Point3 origin = is_perspective ? eye_ : eye_ + right + up;
    const Vec3 pinhole = is_perspective ? forward_ + right + up : forward_;
    if (lens_radius_ == 0) return {origin, pinhole, 0, kInfinity, time};
    const Vec3 on_disc = sample_uniform_disc(lens_u, lens_v);
    const Vec3 shift = lens_radius_ * (on_disc.x * right_ + on_disc.y * up_);
    // Towards the point that the pinhole ray reaches in the plane of focus.
    return {origin + shift, pinhole - shift / focus_distance_, 0, kInfinity, time};
}

Vec3 CameraRays::panorama_direction(double across, double upward) const {
    const auto longitude = HWY_NAMESPACE::sine_cosine_of_turns(across / 2);
    const auto latitude = HWY_NAMESPACE::sine_cosine_of_turns(upward / 4);
    return latitude.cosine * (longitude.cosine * forward_ + longitude.sine * right_) + latitude.sine * up_;
}

Camera frame_box(const Box& box, double aspect_ratio) {
    if (box.is_empty() || !is_finite(box.lower) || !is_finite(box.upper))
        throw ArgumentError("frame_box: the box must be finite and not empty");
    if (!(aspect_ratio > 0) || !std::isfinite(aspect_ratio))
        throw ArgumentError("frame_box: the aspect ratio must be positive and finite");
    const Point3 center = box.center();
    const Vec3 half = box.diagonal() / 2;
    double radius = length(half);
    // A box of one point has no size to frame: stand off by what its coordinates can resolve.
    if (radius == 0) radius = std::max(0x1p-40 * length(center - Point3{}), 0x1p-100);
    const Vec3 back = normalize(Vec3{0.5, 0.35, 1});  // from the front right, a little above: three sides show
    Camera camera;
    camera.vertical_fov = 30;
    const double half_height = tan_of_half(camera.vertical_fov);
    // The bounding sphere fits the narrower of the two angles; 2 % stay free around it.
    const double narrow = std::atan(half_height * std::min(1.0, aspect_ratio));
    const double distance = 1.02 * radius / std::sin(narrow);
    camera.look_at = center;
    camera.look_from = center + distance * back;
    return camera;
}

}  // namespace limn
HWY_AFTER_NAMESPACE();
