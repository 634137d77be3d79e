#include "limn/scene/model_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "limn/math/error.h"
#include "limn/math/frame.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/shape/disk.h"
#include "limn/scene/shape/quad.h"
#include "math/elementary.h"

namespace limn {

namespace {

// Vectors in this file are in view axes, unless they are said to be in world space: x points right, y up and z towards
// the viewer.
const Vec3 kTowardsEye{0.5, 0.42, 1};
constexpr double kFieldOfView = 30;
constexpr double kFilled = 0.88;  // the share of the frame's width or height that the model fills

// The key light is 60 degrees from the eye. Its shadows show the shape, and the light itself isn't in the picture. Its
// distance and side are in radii of the bounding sphere. It's outside of any model, and wide enough for soft shadows
// (0.24 sr).
const Vec3 kTowardsKey{-0.7, 1.1, 0.8};
constexpr double kKeyDistance = 4, kKeySide = 2;

// At the centre of the model a white surface that faces the key light gets a radiance of 0.7 from it, and more if it's
// closer. The sky adds about 0.3. Nearly white surfaces stay below the white of a display. The ground is darker than
// most models, so that models are distinct from it.
constexpr Color kKeyRadiance{9.6, 9.2, 8.6};
constexpr Background kSky = Background::gradient({0.16, 0.15, 0.14}, {0.36, 0.42, 0.52});
constexpr Color kGround{0.4, 0.4, 0.4};
constexpr double kGroundRadius = 1000;  // in radii of the model; reaches to the horizon
constexpr double kGroundGap = 1e-4;     // in radii, below the model, so that a flat model isn't hidden by the ground

// The view axes in world space, of unit length.
struct Axes {
    explicit Axes(const Vec3& upward) : up(normalize(upward)) {
        const Vec3 across = cross(up, Vec3{0, 0, 1});
        right = length(across) > 1e-6 ? normalize(across) : Vec3{1, 0, 0};
        front = cross(right, up);
    }
    Vec3 to_world(const Vec3& v) const { return v.x * right + v.y * up + v.z * front; }
    Vec3 from_world(const Vec3& v) const { return {dot(v, right), dot(v, up), dot(v, front)}; }

    Vec3 right, up, front;
};

// Returns the vertices of all triangles, in view axes.
std::vector<Vec3> corners_of(const Model& model, const Axes& axes) {
    std::vector<Vec3> corners;
    for (const ModelInstance& instance : model.instances) {
        const MeshData& mesh = model.meshes.at(instance.mesh)->data();
        std::vector<bool> is_used(mesh.vertices.size());
        for (const Index3& t : mesh.triangles) is_used[t.a] = is_used[t.b] = is_used[t.c] = true;
        for (std::size_t i = 0; i < is_used.size(); ++i) {
            const Float3& v = mesh.vertices[i];
            const Point3 p = transform_point(instance.world_from_mesh, Point3{v.x, v.y, v.z});
            if (is_used[i]) corners.push_back(axes.from_world(p - Point3{}));
        }
    }
    return corners;
}

// Finds the eye of the tightest frame in one dimension. An eye at coordinate e across the frame and at depth d has a
// point in the frame if |across - e| <= slope * (depth - d), where `slope` is the frame's half width at depth 1. `low`
// and `high` are the smallest values of slope * depth + across and slope * depth - across over all points.
struct Reach {
    double low = kInfinity, high = kInfinity;

    void add(double across, double depth, double slope) {
        low = std::min(low, across + depth * slope);
        high = std::min(high, depth * slope - across);
    }
    // Returns the largest depth of the eye, and its place across the frame.
    double depth(double slope) const { return (low + high) / (2 * slope); }
    double middle() const { return (low - high) / 2; }
};

// Returns the camera of the tightest frame. Its upper and lower planes, or its left and right planes, touch corners.
// The eye is in the middle between the other two planes.
Camera frame_perspective(const std::vector<Vec3>& corners, const Vec3& forward, const Vec3& right, const Vec3& up,
                         double aspect) {
    const double upward = kFilled * tangent(radians(kFieldOfView) / 2), across = upward * aspect;
    Reach x, y;
    for (const Vec3& c : corners) {
        x.add(dot(c, right), dot(c, forward), across);
        y.add(dot(c, up), dot(c, forward), upward);
    }
    const Vec3 eye = x.middle() * right + y.middle() * up + std::min(x.depth(across), y.depth(upward)) * forward;
    return {.look_from = Point3{} + eye, .vertical_fov = kFieldOfView};
}

// Returns the camera of the tightest frame.
Camera frame_orthographic(const std::vector<Vec3>& corners, const Vec3& forward, const Vec3& right, const Vec3& up,
                          double aspect, double radius) {
    Box box;  // its axes are right, up and forward
    for (const Vec3& c : corners) box.extend(Point3{dot(c, right), dot(c, up), dot(c, forward)});
    const Vec3 size = box.diagonal();
    const Point3 middle = box.center();
    Camera camera;
    camera.look_from = Point3{} + middle.x * right + middle.y * up + (middle.z - 8 * radius) * forward;
    camera.projection = Projection::orthographic;
    camera.view_height = std::max(size.y, size.x / aspect) / kFilled;
    return camera;
}

// Returns the camera for the corners of the model, in view axes.
Camera frame(const std::vector<Vec3>& corners, const Point3& center, double radius, const ViewOptions& options) {
    const Vec3 forward = normalize(-kTowardsEye), right = normalize(cross(forward, Vec3{0, 1, 0})),
               up = cross(right, forward);
    const bool is_orthographic = options.projection == Projection::orthographic;
    Camera camera = is_orthographic ? frame_orthographic(corners, forward, right, up, options.aspect_ratio, radius)
                                    : frame_perspective(corners, forward, right, up, options.aspect_ratio);
    camera.projection = options.projection;
    camera.look_at = camera.look_from + dot(center - camera.look_from, forward) * forward;
    return camera;
}

// Returns the key light for a model with this bounding sphere, in world space.
std::shared_ptr<const Hittable> key_light(const Point3& center, double radius, const Axes& axes) {
    const Vec3 towards = normalize(axes.to_world(kTowardsKey));
    const Frame frame(towards);
    const Vec3 edge_u = kKeySide * radius * frame.x, edge_v = kKeySide * radius * frame.y;
    const Point3 middle = center + kKeyDistance * radius * towards;
    return std::make_shared<Quad>(middle - edge_u / 2 - edge_v / 2, edge_u, edge_v,
                                  std::make_shared<DiffuseLight>(kKeyRadiance));
}

void require(bool holds, const char* what) {
    if (!holds) throw ArgumentError(std::string("view_model: ") + what);
}

}  // namespace

ModelView view_model(const Model& model, const ViewOptions& options) {
    // Check the options.
    require(options.aspect_ratio > 0 && std::isfinite(options.aspect_ratio), "the ratio must be positive and finite");
    require(is_finite(options.up) && !(options.up == Vec3{}), "up must be finite and not zero");
    require(!options.environment || !options.background, "a background and an environment exclude each other");
    // Find the bounding sphere of the model.
    const Axes axes(options.up);
    const std::vector<Vec3> corners = corners_of(model, axes);
    require(!corners.empty(), "the model has no triangles");
    Box box;
    for (const Vec3& c : corners) box.extend(Point3{} + c);
    const Point3 middle = box.center();
    const double radius = length(box.diagonal() / 2);
    const auto to_world = [&](const Point3& p) { return Point3{} + axes.to_world(p - Point3{}); };

    // Add the model, the light and the ground.
    ModelView view;
    view.scene.background = options.background ? Background::constant(*options.background) : kSky;
    view.scene.environment = options.environment;
    view.scene.add(model);
    if (!options.environment) view.scene.add(key_light(to_world(middle), radius, axes));
    if (options.ground) {
        const Point3 below = to_world({middle.x, box.lower.y - kGroundGap * radius, middle.z});
        view.scene.add(
            std::make_shared<Disk>(below, axes.up, kGroundRadius * radius, std::make_shared<Lambertian>(kGround)));
    }
    // Frame it.
    view.camera = frame(corners, middle, radius, options);
    view.camera.look_from = to_world(view.camera.look_from);
    view.camera.look_at = to_world(view.camera.look_at);
    view.camera.up = axes.up;
    return view;
}

}  // namespace limn
