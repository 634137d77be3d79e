// Models as parts of scenes.
#include "limn/scene/model.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/scene.h"
#include "support/meshes.h"

namespace limn::model_test {

using namespace test;

namespace {

Model two_cubes() {
    Model model;
    model.materials = {"red", "blue", "red"};
    MeshData data = cube_mesh();
    data.material_slots.assign(data.triangles.size(), 3);
    model.meshes.push_back(std::make_shared<Mesh>(data, std::vector<std::shared_ptr<const Material>>(4)));
    model.instances = {{0}, {0, Transform::translate({2, 0, 0}), "right"}};
    return model;
}

}  // namespace

TEST_CASE("Model: a scene gets an object for each instance, the mesh itself where it is not moved", "[scene][model]") {
    const Model model = two_cubes();
    Scene scene;
    scene.add(model.meshes[0]);
    CHECK(scene.add(model) == 1);
    REQUIRE(scene.objects().size() == 3);
    CHECK(scene.objects()[1] == model.meshes[0]);
    const Box cube = model.meshes[0]->bounds(), right = transform_box(Transform::translate({2, 0, 0}), cube);
    CHECK(scene.objects()[2]->bounds() == right);
    CHECK(model.bounds() == merge(cube, right));
}

TEST_CASE("Model: a material is replaced by its name, wherever it is, and the triangles are shared", "[scene][model]") {
    Model model = two_cubes();
    const MeshData* triangles = &model.meshes[0]->data();
    const auto green = std::make_shared<Lambertian>(Color{0, 1, 0});
    model.replace_material("red", green);
    const auto& materials = model.meshes[0]->materials();
    CHECK((materials[1] == green && materials[3] == green));
    CHECK((!materials[0] && !materials[2]));
    CHECK(&model.meshes[0]->data() == triangles);
    CHECK(model.meshes[0]->hit({.origin = {0.5, 0.5, 5}, .direction = {0, 0, -1}})->material == green.get());
    CHECK_THROWS_AS(model.replace_material("yellow", green), ArgumentError);
}

}  // namespace limn::model_test
