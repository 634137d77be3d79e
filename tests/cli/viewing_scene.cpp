// The default light of `limn render`.
#include "viewing_scene.h"

#include "catch.h"
#include "limn/record_sink.h"
#include "limn/scene/camera.h"
#include "limn/shape/quad.h"
#include "support/meshes.h"
#include "support/solid_angle.h"

namespace limn::test {
namespace {

// A box from (-1, -2, 0) to (3, 2, 2), so that its sphere has radius 3 around (1, 0, 1).
Scene viewed(double scale = 1) {
    MeshData data = cube_mesh();
    for (Float3& v : data.vertices)
        v = to_float3(scale * Vec3{4 * double{v.x} - 1, 4 * double{v.y} - 2, 2 * double{v.z}});
    Model model;
    model.meshes.push_back(std::make_shared<Mesh>(data, nullptr));
    model.instances.push_back({});
    return app::make_viewing_scene(model);
}

QuadRecord lamp_of(const Scene& scene, Color& radiance) {
    RecordSink sink;
    for (const auto& object : scene.objects()) object->lower(sink);
    REQUIRE(sink.records().quads.size() == 1);
    const QuadRecord q = sink.records().quads[0];
    const MaterialRecord& m = sink.records().materials.at(static_cast<std::size_t>(q.material));
    REQUIRE(m.kind == "diffuse-light");
    radiance = sink.records().textures.at(static_cast<std::size_t>(m.emission)).color;
    return q;
}

TEST_CASE("Viewing scene: a square lamp, 2 radii wide, stands 4 radii off to the upper left front and faces the model",
          "[cli][viewing]") {
    for (const double scale : {1.0, 1024.0}) {
        Color radiance;
        const QuadRecord q = lamp_of(viewed(scale), radiance);
        const double radius = 3 * scale;
        const Point3 center{scale, 0, scale}, middle = q.corner + q.edge_u / 2 + q.edge_v / 2;
        const Vec3 way = middle - center;
        CHECK(length(way) == Approx(4 * radius).epsilon(1e-12));
        CHECK(length(way / (4 * radius) - normalize(Vec3{-0.7, 1.1, 0.8})) <= 1e-12);
        CHECK(length(q.edge_u) == Approx(2 * radius).epsilon(1e-12));
        CHECK(length(q.edge_v) == Approx(2 * radius).epsilon(1e-12));
        CHECK(std::abs(dot(q.edge_u, q.edge_v)) <= 1e-12 * radius * radius);
        CHECK(length(cross(q.edge_u, q.edge_v)) == Approx(std::abs(dot(cross(q.edge_u, q.edge_v), way)) / length(way)));
        CHECK(radiance == Color{9.3, 9.3, 9.3});
        // Straight on a white surface at the centre it adds 0.7, to that digit.
        const Point3 p = q.corner;
        const Vec3 light =
            vector_irradiance({p, p + q.edge_u, p + q.edge_u + q.edge_v, p + q.edge_v}, center) * (9.3 / kPi);
        CHECK(length(light) == Approx(0.7).margin(0.05));
    }
}

TEST_CASE("Viewing scene: the lamp is outside the picture that frame_box takes, the model inside", "[cli][viewing]") {
    const Scene scene = viewed();
    Color radiance;
    const QuadRecord q = lamp_of(scene, radiance);
    const Box model{{-1, -2, 0}, {3, 2, 2}};
    for (const double aspect : {0.5, 1.0, 2.0}) {
        const Camera camera = frame_box(model, aspect);
        const CameraRays rays(camera, 100, 100);
        for (int i = 0; i <= 20; ++i)
            for (int j = 0; j <= 20; ++j) {
                const Ray ray = rays.ray(5 * i, 5 * j, 0.5, 0.5, 0);
                CHECK_FALSE(Quad(q.corner, q.edge_u, q.edge_v, nullptr).hit(ray));
            }
    }
}

TEST_CASE("Viewing scene: the sky is dim below, bluish white above, a quarter in the middle", "[cli][viewing]") {
    const Scene scene = viewed();
    CHECK(scene.objects().size() == 2);
    CHECK(scene.background.bottom == Color{0.12, 0.12, 0.12});
    CHECK(scene.background.top == Color{0.34, 0.4, 0.5});
    CHECK(luminance(scene.background.radiance({1, 0, 0})) == Approx(0.25).epsilon(0.05));
}

}  // namespace
}  // namespace limn::test
