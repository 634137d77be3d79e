// The picture of a model that says nothing of light and camera.
#include "limn/scene/model_view.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/records/record_sink.h"
#include "limn/scene/shape/quad.h"
#include "support/meshes.h"
#include "support/solid_angle.h"

namespace limn::test::model_view_test {
namespace {

// A box from (-1, -2, 0) to (3, 2, 2), so that its sphere has radius 3 around (1, 0, 1).
const Box kBox{{-1, -2, 0}, {3, 2, 2}};
Model box_model(double scale = 1) {
    MeshData data = cube_mesh();
    for (Float3& v : data.vertices)
        v = to_float3(scale * Vec3{4 * double{v.x} - 1, 4 * double{v.y} - 2, 2 * double{v.z}});
    Model model;
    model.meshes.push_back(std::make_shared<Mesh>(data, nullptr));
    model.instances.push_back({});
    return model;
}

SceneRecords records_of(const Scene& scene) {
    RecordSink sink;
    for (const auto& object : scene.objects()) object->lower(sink);
    return std::move(sink).take();
}

// Where the corners of a box are in the picture, from -1 to 1.
struct Extent {
    double left = kInfinity, right = -kInfinity, bottom = kInfinity, top = -kInfinity;
};
Extent extent_of(const Camera& camera, double aspect, const Box& box) {
    const Vec3 forward = normalize(camera.look_at - camera.look_from), right = normalize(cross(forward, camera.up)),
               up = cross(right, forward);
    Extent e;
    for (int i = 0; i < 8; ++i) {
        const Point3 p{i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                       i & 4 ? box.upper.z : box.lower.z};
        const Vec3 to = p - camera.look_from;
        const bool is_flat = camera.projection == Projection::orthographic;
        const double half =
            is_flat ? *camera.view_height / 2 : dot(to, forward) * std::tan(radians(camera.vertical_fov) / 2);
        REQUIRE(dot(to, forward) > 0);
        const double x = dot(to, right) / (half * aspect), y = dot(to, up) / half;
        e.left = std::min(e.left, x), e.right = std::max(e.right, x);
        e.bottom = std::min(e.bottom, y), e.top = std::max(e.top, y);
    }
    return e;
}

TEST_CASE("Model view: the model fills 0.88 of the frame in one direction, from side to side, and no more in the other",
          "[scene][view]") {
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
        for (const double aspect : {0.25, 0.5, 1.0, 2.0, 4.0}) {
            const Camera camera = view_model(box_model(), {.aspect_ratio = aspect, .projection = projection}).camera;
            CHECK(camera.projection == projection);
            const Extent e = extent_of(camera, aspect, kBox);
            CHECK(std::max({-e.left, e.right, -e.bottom, e.top}) == Approx(0.88));
            CHECK((-e.left == Approx(e.right) || -e.bottom == Approx(e.top)));
        }
}

TEST_CASE("Model view: a square lamp, 2 radii wide, stands 4 radii off to the upper left front and faces the model",
          "[scene][view]") {
    for (const double scale : {1.0, 1024.0}) {
        const SceneRecords records = records_of(view_model(box_model(scale)).scene);
        REQUIRE(records.quads.size() == 1);
        const QuadRecord& q = records.quads[0];
        const double radius = 3 * scale;
        const Point3 center{scale, 0, scale}, middle = q.corner + q.edge_u / 2 + q.edge_v / 2;
        const Vec3 way = middle - center;
        CHECK(length(way / (4 * radius) - normalize(Vec3{-0.7, 1.1, 0.8})) <= 1e-7);  // of float32
        CHECK(length(q.edge_u) == Approx(2 * radius));
        CHECK(length(q.edge_v) == Approx(2 * radius));
        CHECK(std::abs(dot(q.edge_u, q.edge_v)) <= 1e-9 * radius * radius);
        CHECK(length(cross(q.edge_u, q.edge_v)) == Approx(std::abs(dot(cross(q.edge_u, q.edge_v), way)) / length(way)));
        const MaterialRecord& m = records.materials.at(static_cast<std::size_t>(q.material));
        const Color radiance = records.textures.at(static_cast<std::size_t>(m.emission)).color;
        // Straight on a white surface at the centre it adds seven tenths.
        const Point3 p = q.corner;
        const Vec3 light = vector_irradiance({p, p + q.edge_u, p + q.edge_u + q.edge_v, p + q.edge_v}, center) *
                           (luminance(radiance) / kPi);
        CHECK(length(light) == Approx(0.7).margin(0.05));
    }
}

TEST_CASE("Model view: the ground is just below the model's lowest point, to beyond the horizon of the picture",
          "[scene][view]") {
    const ModelView view = view_model(box_model());
    const SceneRecords records = records_of(view.scene);
    REQUIRE(records.disks.size() == 1);
    CHECK(records.disks[0].center.y < -2);
    CHECK(records.disks[0].center.y > -2 - 0.001);
    CHECK(records.disks[0].radius > 500);
    CHECK(records_of(view_model(box_model(), {.ground = false}).scene).disks.empty());
    // A turned instance has a box that is larger than it is.
    Model turned = box_model();
    turned.instances[0].world_from_mesh = Transform::rotate_z(45);
    const double lowest = (-1 - 2) / std::sqrt(2.0);
    const DiskRecord ground = records_of(view_model(turned).scene).disks[0];
    CHECK(ground.center.y == Approx(lowest).margin(0.001));
}

TEST_CASE("Model view: the lamp is outside the picture", "[scene][view]") {
    for (const double aspect : {0.5, 1.0, 2.0}) {
        const ModelView view = view_model(box_model(), {.aspect_ratio = aspect});
        const QuadRecord q = records_of(view.scene).quads[0];
        const CameraRays rays(view.camera, 100, 100);
        for (int i = 0; i <= 20; ++i)
            for (int j = 0; j <= 20; ++j)
                CHECK_FALSE(Quad(q.corner, q.edge_u, q.edge_v, nullptr).hit(rays.ray(5 * i, 5 * j, 0.5, 0.5, 0)));
    }
}

TEST_CASE("Model view: another up turns ground, light and camera with it", "[scene][view]") {
    // (x, y, z) becomes (x, -z, y).
    const auto turned = [](const Vec3& v) { return Vec3{v.x, -v.z, v.y}; };
    Model model = box_model();
    model.instances[0].world_from_mesh = Transform::rotate_x(90);
    const ModelView upright = view_model(box_model()), tilted = view_model(model, {.up = {0, 0, 3}});
    CHECK(length(turned(upright.camera.look_from - Point3{}) - (tilted.camera.look_from - Point3{})) <= 1e-9);
    CHECK(length(turned(upright.camera.look_at - Point3{}) - (tilted.camera.look_at - Point3{})) <= 1e-9);
    CHECK(tilted.camera.up == Vec3{0, 0, 1});
    const Vec3 normal = normalize(records_of(tilted.scene).disks[0].normal);
    CHECK(length(normal - Vec3{0, 0, 1}) <= 1e-12);
}

TEST_CASE("Model view: a background of one colour replaces the sky, which is dim below and bluish above",
          "[scene][view]") {
    const Background sky = view_model(box_model()).scene.background;
    CHECK(luminance(sky.top) > 2 * luminance(sky.bottom));
    CHECK(sky.top.b > sky.top.r);
    const Background pink = view_model(box_model(), {.background = Color{1, 0.5, 0.6}}).scene.background;
    CHECK(pink.top == Color{1, 0.5, 0.6});
    CHECK(pink.bottom == pink.top);
}

TEST_CASE("Model view: an environment map is all the light there is", "[scene][view]") {
    const auto map = std::make_shared<EnvironmentMap>(Image(4, 2, {1, 1, 1}));
    const Scene lit = view_model(box_model(), {.environment = map}).scene;
    CHECK(lit.environment == map);
    CHECK(lit.objects().size() + 1 == view_model(box_model()).scene.objects().size());
}

TEST_CASE("Model view: what cannot be shown is refused", "[scene][view]") {
    CHECK_THROWS_WITH(view_model(Model{}), Catch::Contains("the model has no triangles"));
    for (const double aspect : {0.0, -1.0, kInfinity, std::nan("")})
        CHECK_THROWS_AS(view_model(box_model(), {.aspect_ratio = aspect}), ArgumentError);
    CHECK_THROWS_WITH(view_model(box_model(), {.up = {0, 0, 0}}), Catch::Contains("up"));
    const auto map = std::make_shared<EnvironmentMap>(Image(4, 2, {1, 1, 1}));
    CHECK_THROWS_WITH(view_model(box_model(), {.background = Color{}, .environment = map}),
                      Catch::Contains("exclude each other"));
}

}  // namespace
}  // namespace limn::test::model_view_test
