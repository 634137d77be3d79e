// Bindings of the shapes, except for meshes.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>

#include "arguments.h"
#include "bindings.h"
#include "limn/scene/material/material.h"
#include "limn/scene/shape/constant_medium.h"
#include "limn/scene/shape/disk.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"
#include "limn/scene/texture/texture.h"
#include "shapes.h"

namespace limn::python {

std::shared_ptr<const Material> material_or_none(MaterialArgument argument, const char* name) {
    if (argument.object.is_none()) return nullptr;
    return shared<Material>(argument.object, name, "a Material or None");
}

std::shared_ptr<const Hittable> shape_of(nb::handle object, const char* name) {
    return shared<Hittable>(object, name, "a shape");
}

nb::tuple corners(const Box& box) {
    return nb::make_tuple(nb::make_tuple(box.lower.x, box.lower.y, box.lower.z),
                          nb::make_tuple(box.upper.x, box.upper.y, box.upper.z));
}

namespace {

void bind_flat_shapes(nb::module_& module) {
    nb::class_<Triangle, Hittable>(module, "Triangle", "A flat triangle with float64 vertices.")
        .def(
            "__init__",
            [](Triangle* self, TripleArgument a, TripleArgument b, TripleArgument c, MaterialArgument material) {
                new (self)
                    Triangle(point(a, "a"), point(b, "b"), point(c, "c"), material_or_none(material, "material"));
            },
            given("a"), given("b"), given("c"), given("material") = nb::none(),
            R"(Makes a triangle. The outward normal is (b - a) x (c - a).

Args:
    a, b, c: the vertices, in world units.
    material: a Material. Queries need no material; renders do.)");
    nb::class_<Quad, Hittable>(module, "Quad", "A parallelogram.")
        .def(
            "__init__",
            [](Quad* self, TripleArgument corner, TripleArgument u, TripleArgument v, MaterialArgument material) {
                new (self) Quad(point(corner, "corner"), vector(u, "edge_u"), vector(v, "edge_v"),
                                material_or_none(material, "material"));
            },
            given("corner"), given("edge_u"), given("edge_v"), given("material") = nb::none(),
            R"(Makes the parallelogram corner + u edge_u + v edge_v, with u and v in [0, 1].

Args:
    corner: in world units.
    edge_u, edge_v: the edges, in world units. They must not be parallel. The outward normal is edge_u x edge_v.
    material: a Material. Queries need no material; renders do.)");
    nb::class_<Disk, Hittable>(module, "Disk", "A flat disk, including its rim.")
        .def(
            "__init__",
            [](Disk* self, TripleArgument center, TripleArgument normal, NumberArgument radius,
               MaterialArgument material) {
                new (self) Disk(point(center, "center"), vector(normal, "normal"), number(radius, "radius"),
                                material_or_none(material, "material"));
            },
            given("center"), given("normal"), given("radius"), given("material") = nb::none(),
            R"(Makes a disk.

Args:
    center: in world units.
    normal: the outward normal. It may have any length but 0.
    radius: in world units, over 0.
    material: a Material. Queries need no material; renders do.)");
}

void bind_groups(nb::module_& module) {
    nb::class_<HittableList, Hittable>(module, "HittableList", "A list of objects that is one object.")
        .def(
            "__init__",
            [](HittableList* self, nb::typed<nb::sequence, Hittable> objects) {
                std::vector<std::shared_ptr<const Hittable>> shapes;
                for (const nb::handle object : objects) shapes.push_back(shape_of(object, "objects"));
                new (self) HittableList(std::move(shapes));
            },
            given("objects"), R"(Makes a list.

Args:
    objects: a sequence of Hittables.)");
    module.def(
        "make_box",
        [](TripleArgument corner, TripleArgument opposite, MaterialArgument material) {
            return make_box(point(corner, "corner"), point(opposite, "opposite"),
                            material_or_none(material, "material"));
        },
        given("corner"), given("opposite"), given("material") = nb::none(),
        R"(Returns the six quads of an axis-aligned box, with outward normals, as a HittableList.

Args:
    corner, opposite: two opposite corners, in world units.
    material: a Material. Queries need no material; renders do.)");
    nb::class_<Instance, Hittable>(module, "Instance", "A transformed object. It may move.")
        .def(
            "__init__",
            [](Instance* self, ShapeArgument object, MatrixArgument at_time0, MatrixArgument at_time1) {
                const std::shared_ptr<const Hittable> shape = shape_of(object.object, "object");
                const Transform first = matrix(at_time0, "world_from_object");
                if (at_time1.object.is_none())
                    new (self) Instance(shape, first);
                else
                    new (self) Instance(shape, first, matrix(at_time1, "at_time1"));
            },
            given("object"), given("world_from_object"), given("at_time1") = nb::none(),
            R"(Makes an instance of an object.

Args:
    object: a Hittable.
    world_from_object: an affine transform that is not singular: shape (3, 4) or (4, 4), rows of the matrix.
    at_time1: the transform at time 1 if the object moves, or None. world_from_object is then the transform at time 0.
        The matrices between are interpolated linearly. They must not be singular either.)");
    nb::class_<ConstantMedium, Hittable>(module, "ConstantMedium",
                                         "A homogeneous medium in a closed boundary: fog, smoke or milk.")
        .def(
            "__init__",
            [](ConstantMedium* self, ShapeArgument boundary, NumberArgument density, ColorArgument albedo) {
                const std::shared_ptr<const Hittable> shape = shape_of(boundary.object, "boundary");
                std::shared_ptr<Texture> texture;
                const double extinction = number(density, "density");
                if (!albedo.object.is_none() && nb::try_cast(albedo.object, texture))
                    new (self) ConstantMedium(shape, extinction, std::shared_ptr<const Texture>(std::move(texture)));
                else
                    new (self) ConstantMedium(shape, extinction, color(albedo.object, "albedo"));
            },
            given("boundary"), given("density"), given("albedo"),
            R"(Makes a medium with an isotropic phase function.

Args:
    boundary: a Hittable, which must not contain a ConstantMedium. It does not reflect or refract light.
    density: extinction per world unit of length, at least 0.
    albedo: single-scattering albedo, linear red, green, blue in [0, 1], or a texture.)");
}

}  // namespace

void bind_shapes(nb::module_& module) {
    nb::class_<Hittable>(module, "Hittable", "A shape, an object that rays can hit.")
        .def_prop_ro(
            "bounds", [](const Hittable& shape) { return corners(shape.bounds()); },
            nb::sig("def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]"),
            "The lower and the upper corner of a box around the shape, over the whole shutter.");
    nb::class_<Sphere, Hittable>(module, "Sphere", "A sphere. It may move.")
        .def(
            "__init__",
            [](Sphere* self, TripleArgument center, NumberArgument radius, MaterialArgument material,
               TripleArgument center1) {
                const Point3 first = point(center, "center");
                const Point3 last = center1.object.is_none() ? first : point(center1, "center1");
                new (self) Sphere(first, last, number(radius, "radius"), material_or_none(material, "material"));
            },
            given("center"), given("radius"), given("material") = nb::none(), nb::kw_only(),
            given("center1") = nb::none(),
            R"(Makes a sphere.

Args:
    center: in world units.
    radius: in world units, not 0. A negative radius turns the normal inward.
    material: a Material. Queries need no material; renders do.
    center1: the centre at time 1 if the sphere moves, or None. `center` is then the centre at time 0.)");
    bind_flat_shapes(module);
    bind_groups(module);
}

}  // namespace limn::python
