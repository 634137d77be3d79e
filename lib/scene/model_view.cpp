#include "limn/scene/model_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/elementary.h"
#include "limn/core/error.h"
#include "limn/core/frame.h"
#include "limn/material/diffuse_light.h"
#include "limn/material/lambertian.h"
#include "limn/shape/disk.h"
#include "limn/shape/quad.h"

namespace limn {

namespace {

// In this file x is right, y is up and z is towards the viewer.
const Vec3 kTowardsEye{0.5, 0.42, 1};
constexpr double kFieldOfView = 30;
constexpr double kFilled = 0.88;  // of the frame, by the model where it is as wide or as high

// The key light is 60 degrees from the eye, enough for shadows that show the shape, and far enough to stay out of the
// picture. In radii of the bounding sphere: clear of any model, wide enough for soft shadows (0.24 sr).
const Vec3 kTowardsKey{-0.7, 1.1, 0.8};
constexpr double kKeyDistance = 4, kKeySide = 2;

// The key light adds 0.7 to white in the middle of the model where it falls straight on, and more nearer to it, the sky
// about 0.3: what is nearly white stays below the white of a display. The ground is darker than most models, which
// stand out so.
constexpr Color kKeyRadiance{9.6, 9.2, 8.6};
constexpr Background kSky = Background::gradient({0.16, 0.15, 0.14}, {0.36, 0.42, 0.52});
constexpr Color kGround{0.4, 0.4, 0.4};
constexpr double kGroundRadius = 1000;  // in those of the model: to the horizon
constexpr double kGroundGap = 1e-4;     // so that what is flat and lies on it is seen

// The directions right, up and towards the viewer.
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

// Where the corners of triangles are, in axes.
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

// The nearest that a plane of the frame, which leans outward by `slope` for each unit towards the scene, may be.
struct Reach {
    double low = kInfinity, high = kInfinity;  // towards the lower and the higher side

    void add(double across, double depth, double slope) {
        low = std::min(low, across + depth * slope), high = std::min(high, depth * slope - across);
    }
    double depth(double slope) const { return (low + high) / (2 * slope); }  // of the eye
    double middle() const { return (low - high) / 2; }
};

// The tightest frame. Its four planes touch corners, or two of them do and the eye is in the middle between the others.
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

Camera frame_orthographic(const std::vector<Vec3>& corners, const Vec3& forward, const Vec3& right, const Vec3& up,
                          double aspect, double radius) {
    Box box;  // across, upward and into the picture
    for (const Vec3& c : corners) box.extend(Point3{dot(c, right), dot(c, up), dot(c, forward)});
    const Vec3 size = box.diagonal();
    const Point3 middle = box.center();
    Camera camera;
    camera.look_from = Point3{} + middle.x * right + middle.y * up + (middle.z - 8 * radius) * forward;
    camera.projection = Projection::orthographic;
    camera.view_height = std::max(size.y, size.x / aspect) / kFilled;
    return camera;
}

// In axes.
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
    require(options.aspect_ratio > 0 && std::isfinite(options.aspect_ratio), "the ratio must be positive and finite");
    require(is_finite(options.up) && !(options.up == Vec3{}), "up must be finite and not zero");
    require(!options.environment || !options.background, "a background and an environment exclude each other");
    const Axes axes(options.up);
    const std::vector<Vec3> corners = corners_of(model, axes);
    require(!corners.empty(), "the model has no triangles");
    Box box;
    for (const Vec3& c : corners) box.extend(Point3{} + c);
    const Point3 middle = box.center();
    const double radius = length(box.diagonal() / 2);
    const auto to_world = [&](const Point3& p) { return Point3{} + axes.to_world(p - Point3{}); };

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
    view.camera = frame(corners, middle, radius, options);
    view.camera.look_from = to_world(view.camera.look_from), view.camera.look_at = to_world(view.camera.look_at);
    view.camera.up = axes.up;
    return view;
}

}  // namespace limn
