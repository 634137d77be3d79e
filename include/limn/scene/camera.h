/// \file
/// Cameras and their rays.
#pragma once

#include <cstdint>
#include <optional>

#include "limn/math/box.h"
#include "limn/math/ray.h"
#include "limn/math/vec.h"

namespace limn {

/// The mapping from points of the picture to rays.
enum class Projection : std::uint8_t {
    /// Rays start at the eye and pass through a flat frame.
    perspective,
    /// Rays are parallel to the view axis. They start on the plane that is perpendicular to the axis and contains the
    /// eye.
    orthographic,
    /// Rays start at the eye and go in all directions (equirectangular). The longitude runs across the picture, over
    /// 360 degrees, and the latitude runs down it, over 180 degrees. `look_at` is at the centre. The poles are along
    /// the component of `up` that is perpendicular to the view axis.
    panorama
};

/// A thin-lens camera. Angles are in degrees and lengths in world units. Objects move from time 0 to time 1. The view
/// axis is the line from `look_from` to `look_at`.
struct Camera {
    Point3 look_from{0, 0, 1};  ///< the eye: the centre of the lens
    Point3 look_at{0, 0, 0};    ///< the point at the centre of the picture; must differ from look_from
    Vec3 up{0, 1, 0};           ///< direction that is upward in the picture; not zero, not parallel to the view axis
    double vertical_fov = 40;   ///< full angle between the top and the bottom edge of a perspective, in (0, 180)
    /// Width over height of the frame. By default it is the ratio of the picture's sides in pixels. A panorama ignores
    /// it.
    std::optional<double> aspect_ratio{};
    /// Full angle of the cone from a point in focus to the edge of the lens, in [0, 180). The radius of the lens is
    /// focus_distance * tan(aperture_angle / 2). 0 means a pinhole. A panorama must have a pinhole.
    double aperture_angle = 0;
    /// Distance from the eye to the plane in focus, along the view axis. By default it is |look_at - look_from|.
    std::optional<double> focus_distance{};
    double shutter_open = 0;                          ///< earliest time of a ray
    double shutter_close = 1;                         ///< latest time of a ray: 0 <= shutter_open <= shutter_close <= 1
    Projection projection = Projection::perspective;  ///< mapping from the picture to rays
    /// Height of an orthographic picture in world units. By default it is the height that vertical_fov covers at
    /// look_at. Other projections ignore it.
    std::optional<double> view_height{};
};

/// Generates the rays of a camera for a picture of a given size. Immutable, thread-safe.
class CameraRays {
public:
    /// \param width,height size of the picture in pixels
    ///
    /// \throws ArgumentError if
    /// - a value is outside the range that Camera states, or NaN
    /// - the aspect ratio, the view height, the focus distance or the size of the picture is not positive and finite
    /// - the frame or the lens is so large that coordinates of rays would overflow
    /// - a panorama has a lens
    CameraRays(const Camera& camera, int width, int height);

    /// Returns the ray through a point of the picture, with t in (0, infinity]. The direction of a panorama's ray has
    /// length 1. In the other projections the component of the direction along the view axis is 1.
    ///
    /// \param x,y point of the picture, in pixels from the left and top edge: pixel (i, j) covers [i, i+1) x [j, j+1)
    /// \param lens_u,lens_v in [0, 1): point of the lens, by Shirley and Chiu's map, which keeps areas
    /// \param time_u in [0, 1): the time of the ray is shutter_open + time_u * (shutter_close - shutter_open)
    Ray ray(double x, double y, double lens_u, double lens_v, double time_u) const;

    bool has_lens() const { return view_.lens_radius > 0; }  ///< returns true if lens_u and lens_v matter
    bool has_shutter() const { return view_.shutter_close > view_.shutter_open; }  ///< returns true if time_u matters

    /// \cond
    // The numbers that the rays are computed from.
    struct View {
        Point3 eye;                          ///< Camera::look_from
        Projection projection;               ///< Camera::projection
        double width, height;                ///< size of the picture, in pixels
        double shutter_open, shutter_close;  ///< as in Camera
        Vec3 right, up, forward;             ///< orthonormal
        double half_width, half_height;      ///< half the size of the frame, at distance 1 if perspective
        double lens_radius, focus_distance;  ///< in world units
    };
    /// \endcond
    const View& view() const { return view_; }  ///< the camera in the form that limn's own code uses

private:
    View view_;
};

/// Returns a pinhole camera with a vertical field of view of 30 degrees. It looks down on `box` from the front right
/// (+x, +z). The bounding sphere of the box fits into the picture. `aspect_ratio` is the picture's width over its
/// height.
///
/// \throws ArgumentError if the box is empty or not finite, or the ratio is not positive and finite
Camera frame_box(const Box& box, double aspect_ratio = 1);

}  // namespace limn
