// Scenes, and what they are compiled to.
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

// None: there is no map, and the background counts.
void set_environment(Scene& scene, EnvironmentArgument argument) {
    scene.environment = argument.object.is_none()
                            ? nullptr
                            : shared<EnvironmentMap>(argument.object, "environment", "an EnvironmentMap or None");
}

void bind_description(nb::module_& module) {
    nb::class_<Scene>(module, "Scene", "Objects, lights and a background. Compile it to trace rays or to render.")
        .def(nb::init<>())
        .def_prop_rw(
            "background", [](const Scene& scene) { return scene.background; }, &set_background,
            nb::for_setter(given("background")), "What rays meet that hit nothing.")
        .def_prop_rw(
            "name", [](const Scene& scene) { return scene.name; }, &set_name, nb::for_setter(given("name")),
            "In reports.")
        .def("__len__", [](const Scene& scene) { return scene.objects().size(); })
        .def_prop_ro(
            "bounds", [](const Scene& scene) { return corners(scene.bounds()); },
            nb::sig("def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]"),
            "The lowest and the highest corner of a box around all objects.")
        .def_prop_rw(
            "environment",
            [](const Scene& scene) { return std::const_pointer_cast<EnvironmentMap>(scene.environment); },
            &set_environment, nb::for_getter(nb::sig("def environment(self) -> EnvironmentMap | None")),
            nb::for_setter(given("environment")), "An EnvironmentMap in place of the background; None: there is none.")
        .def(
            "add", [](Scene& scene, const LightSource& light) { scene.add(light); }, nb::arg("light"),
            "Adds a light that is no shape. It has no number.")
        .def("add", &add, given("object"),
             "Adds a shape. Returns its number, counted from 0, which is geometry_ids of hits.")
        .def("add_triangles", &add_triangles, given("vertices"), given("faces"), given("material") = nb::none(),
             R"(Adds a mesh of copied arrays.

Args:
    vertices: shape (n, 3), float32, in world units, finite.
    faces: shape (m, 3), uint32 or other whole numbers: rows of vertices, counter-clockwise seen from outside.
    material: for render; queries need none.

Returns:
    The mesh's number, counted from 0, which is geometry_ids of hits.)")
        .def(
            "compile",
            [](const Scene& scene) {
                const Scene copy = scene;  // another thread may add to the scene meanwhile
                const nb::gil_scoped_release release;
                return compile(copy);
            },
            "Builds what queries and render need, on all threads. Later changes of the scene are not in it.");
}

}  // namespace

void bind_scene(nb::module_& module) {
    nb::class_<CompiledScene> compiled(module, "CompiledScene",
                                       "A scene ready to be traced. Immutable; any number of threads may ask it.");
    compiled
        .def_prop_ro(
            "primitives", [](const CompiledScene& scene) { return scene.stats().primitives; },
            "How many there are, instanced ones counted once an instance.")
        .def_prop_ro(
            "memory_bytes", [](const CompiledScene& scene) { return scene.stats().memory_bytes; },
            "Of its tables, and of arrays that it shares with the description.")
        .def_prop_ro(
            "name", [](const CompiledScene& scene) { return scene.name(); }, "Scene.name.")
        .def("open_edges", &CompiledScene::open_edges, nb::call_guard<nb::gil_scoped_release>(),
             "How many edges are used more often one way than the other; 0: all surfaces are closed.");
    bind_ray_queries(compiled);
    bind_point_queries(compiled);
    bind_description(module);
}

}  // namespace limn::python
