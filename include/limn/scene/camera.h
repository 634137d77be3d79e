/// \file
/// Cameras and the rays that they make.
#pragma once

#include <cstdint>
#include <optional>

#include "limn/core/box.h"
#include "limn/core/ray.h"
#include "limn/core/vec.h"

namespace limn {

/// How points of the picture become rays.
enum class Projection : std::uint8_t {
    perspective,   ///< from the eye through a flat frame
    orthographic,  ///< along the view, from the plane through the eye that stands across it
    /// From the eye to all sides: across the picture goes the longitude, 360 degrees, and down it the latitude, 180
    /// (equirectangular). What is in the middle of its frame is `look_at`, and the poles are along the component of
    /// `up` that is perpendicular to the view.
    panorama
};

/// A thin-lens camera. Angles in degrees, lengths in world units, times in shutter units within [0, 1].
struct Camera {
    Point3 look_from{0, 0, 1};  ///< the eye, the centre of the lens
    Point3 look_at{0, 0, 0};    ///< what is in the middle of the picture
    Vec3 up{0, 1, 0};           ///< what is upward in the picture; of any length, not along the view
    double vertical_fov = 40;   ///< full angle between the top and the bottom edge of a perspective
    /// Width over height of the picture's frame; by default that of its pixels. A panorama has none.
    std::optional<double> aspect_ratio{};
    /// Full angle of the cone that the lens fills, seen from the focus plane: the lens has radius
    /// focus_distance * tan(aperture_angle / 2). 0: a pinhole, which is all that a panorama may have.
    double aperture_angle = 0;
    /// To the plane in focus, along the view axis; by default |look_at - look_from|.
    std::optional<double> focus_distance{};
    double shutter_open = 0;                          ///< a ray's time is uniform between the two
    double shutter_close = 1;                         ///< not before shutter_open
    Projection projection = Projection::perspective;  ///< how directions map to the picture
    /// Of an orthographic picture, in world units; by default what the vertical_fov takes in at look_at.
    std::optional<double> view_height{};
};

/// A camera for a picture of a given size, ready to make rays. Immutable, thread-safe.
class CameraRays {
public:
    /// \throws ArgumentError for an impossible camera: eye equal to target, up along the view, an angle outside (0,
    /// 180) (aperture [0, 180)), an aspect ratio, a height, a focus distance or a size that is not positive, a frame or
    /// a lens beyond double, a shutter outside [0, 1], a panorama with a lens, anything NaN
    CameraRays(const Camera& camera, int width, int height);

    /// The ray through a point of the picture. Its direction reaches from the lens to the plane at distance 1 from it:
    /// in a perspective, or with a lens, it has no unit length.
    ///
    /// \param x,y in pixels from the left and top edge: pixel (i, j) covers [i, i+1) x [j, j+1)
    /// \param lens_u,lens_v in [0, 1): where on the lens, uniform over its area (Shirley and Chiu's map)
    /// \param time_u in [0, 1): when in the shutter
    Ray ray(double x, double y, double lens_u, double lens_v, double time_u) const;

    bool has_lens() const { return view_.lens_radius > 0; }                        ///< whether lens_u and lens_v matter
    bool has_shutter() const { return view_.shutter_close > view_.shutter_open; }  ///< whether time_u matters

    /// \cond
    // What the rays are made of.
    struct View {
        Point3 eye;                          ///< as Camera has it
        Projection projection;               ///< the same
        double width, height;                ///< of the picture, in pixels
        double shutter_open, shutter_close;  ///< as Camera has them
        Vec3 right, up, forward;             ///< unit
        double half_width, half_height;      ///< of the frame, which a perspective has at distance 1
        double lens_radius, focus_distance;  ///< in world units
    };
    /// \endcond
    const View& view() const { return view_; }  ///< limn's own

private:
    View view_;
};

/// A pinhole camera of 30 degrees that looks down on a box from the front right (+x, +z) and has the box's bounding
/// sphere in a picture of the given width over height.
///
/// \throws ArgumentError if the box is empty or not finite, or the ratio is not positive and finite
Camera frame_box(const Box& box, double aspect_ratio = 1);

}  // namespace limn
