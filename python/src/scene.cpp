// Bindings of Scene and CompiledScene.
#include "limn/scene/scene.h"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include "bindings.h"
#include "limn/query/compiled_scene.h"
#include "queries.h"
#include "shapes.h"

namespace limn::python {

namespace {

std::size_t add_triangles(Scene& scene, ArrayArgument vertices, ArrayArgument faces, MaterialArgument material) {
    return scene.add(make_mesh(mesh_data(vertices, faces), {material_or_none(material, "material")}));
}

std::size_t add(Scene& scene, ShapeArgument object) {
    return scene.add(shared<Hittable>(object.object, "object", "a shape or a light"));
}

void set_background(Scene& scene, BackgroundArgument argument) {
    scene.background = *shared<Background>(argument.object, "background", "a Background");
}

void set_name(Scene& scene, NameArgument argument) {
    if (!nb::isinstance<nb::str>(argument.object)) wrong_type("name", "a string", argument.object);
    scene.name = nb::cast<std::string>(argument.object);
}

// Sets the environment map. None removes it.
void set_environment(Scene& scene, EnvironmentArgument argument) {
    scene.environment = argument.object.is_none()
                            ? nullptr
                            : shared<EnvironmentMap>(argument.object, "environment", "an EnvironmentMap or None");
}

void bind_description(nb::module_& module) {
    nb::class_<Scene>(module, "Scene", R"(A description of objects, lights and a background.

It must be compiled for queries of rays and points. Changing it is not thread-safe.)")
        .def(nb::init<>())
        .def_prop_rw(
            "background", [](const Scene& scene) { return scene.background; }, &set_background,
            nb::for_setter(given("background")),
            "The Background. It gives the radiance of rays that hit nothing. An environment replaces it.")
        .def_prop_rw(
            "name", [](const Scene& scene) { return scene.name; }, &set_name, nb::for_setter(given("name")),
            "The name of the scene in reports.")
        .def("__len__", [](const Scene& scene) { return scene.objects().size(); })
        .def_prop_ro(
            "bounds", [](const Scene& scene) { return corners(scene.bounds()); },
            nb::sig("def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]"),
            "The lower and the upper corner of a box around all objects, over the whole shutter.")
        .def_prop_rw(
            "environment",
            [](const Scene& scene) { return std::const_pointer_cast<EnvironmentMap>(scene.environment); },
            &set_environment, nb::for_getter(nb::sig("def environment(self) -> EnvironmentMap | None")),
            nb::for_setter(given("environment")), "The EnvironmentMap that replaces the background, or None.")
        .def(
            "add", [](Scene& scene, const LightSource& light) { scene.add(light); }, nb::arg("light"),
            R"(Adds a light that isn't a shape.

Args:
    light: a PointLight, SpotLight, DirectionalLight or SunLight.)")
        .def("add", &add, given("object"),
             R"(Adds a shape.

Args:
    object: a Hittable.

Returns:
    The number of the object. Objects are numbered from 0 in the order in which they are added. Hits have this number in
    geometry_ids.)")
        .def("add_triangles", &add_triangles, given("vertices"), given("faces"), given("material") = nb::none(),
             R"(Adds a triangle mesh. The arrays are copied.

Args:
    vertices: shape (n, 3), float32, in world units, finite.
    faces: the vertices of each triangle, counter-clockwise seen from outside: shape (m, 3), uint32 or another integer
        type.
    material: a Material. Queries need no material; renders do.

Returns:
    The number of the object. Objects are numbered from 0 in the order in which they are added. Hits have this number in
    geometry_ids.)")
        .def(
            "compile",
            [](const Scene& scene) {
                const Scene copy = scene;  // another thread may add to the scene meanwhile
                const nb::gil_scoped_release release;
                return compile(copy);
            },
            R"(Returns a CompiledScene, for queries and renders.

The function uses all threads and releases the GIL. Later changes of the scene do not change the compiled scene.)");
}

}  // namespace

void bind_scene(nb::module_& module) {
    nb::class_<CompiledScene> compiled(
        module, "CompiledScene",
        "A scene for queries and renders. It does not change. Any number of threads may use it.");
    compiled
        .def_prop_ro(
            "primitives", [](const CompiledScene& scene) { return scene.stats().primitives; },
            "The number of primitives. A primitive counts once for each instance of it.")
        .def_prop_ro(
            "memory_bytes", [](const CompiledScene& scene) { return scene.stats().memory_bytes; },
            "The memory in bytes, including mesh arrays that are shared with the Scene.")
        .def_prop_ro(
            "name", [](const CompiledScene& scene) { return scene.name(); }, "The name of the Scene.")
        .def("open_edges", &CompiledScene::open_edges, nb::call_guard<nb::gil_scoped_release>(),
             R"(Returns the number of open edges of triangles, quads and disks.

An edge is open if the faces at it do not use it equally often in both directions. The number is 0 if all surfaces are
closed.)");
    bind_ray_queries(compiled);
    bind_point_queries(compiled);
    bind_description(module);
}

}  // namespace limn::python
