// Bindings of triangle meshes, which are made from arrays.
#include "limn/scene/shape/mesh.h"

#include <nanobind/stl/shared_ptr.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "bindings.h"
#include "limn/math/error.h"
#include "limn/scene/shape/smooth_normals.h"
#include "shapes.h"

namespace limn::python {

namespace {

// Returns the rows of a float32 array of shape (n, width). `make` makes a Row from a pointer to its numbers. Throws a
// ValueError if a number isn't finite.
template <class Row, class Make>
std::vector<Row> float_rows(ArrayArgument argument, const char* name, std::size_t width, const Make& make) {
    const ArrayView array(argument.object, name, "an array of float32");
    if (!array.holds<float>())
        throw nb::type_error(
            (std::string(name) + ": must be of float32: array.astype(numpy.float32) rounds it").c_str());
    if (array.rank() != 2 || array.length(1) != width)
        wrong_value(name, "must have shape (n, " + std::to_string(width) + "), not " + shape_text(array.shape()));
    if (array.length(0) == 0) wrong_value(name, "must not be empty");
    const float* values = array.data<float>();
    for (std::size_t i = 0; i < array.size(); ++i)
        if (!std::isfinite(values[i])) wrong_value(name, "row " + std::to_string(i / width) + " is not finite");
    std::vector<Row> rows(array.length(0));
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = make(values + width * i);
    return rows;
}

Float3 float3(const float* v) { return {v[0], v[1], v[2]}; }

// Returns the elements of an array of any integer type. Throws a ValueError if one is negative or not below `end`; its
// message says that there are `end` of `what`.
std::vector<std::uint32_t> whole_numbers(const ArrayView& array, const char* name, std::uint64_t end,
                                         const char* what) {
    if (!array.is_whole_number()) throw nb::type_error((std::string(name) + ": must be of whole numbers").c_str());
    std::vector<std::uint32_t> numbers(array.size());
    const auto read = [&](const auto* values) {
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (values[i] < 0 || static_cast<std::uint64_t>(values[i]) >= end)
                wrong_value(name, "has " + std::to_string(values[i]) + ", but there are " + std::to_string(end) + what);
            numbers[i] = static_cast<std::uint32_t>(values[i]);
        }
    };
    const auto try_type = [&]<class T>(T) {
        if (!array.holds<T>()) return false;
        read(array.data<T>());
        return true;
    };
    if (!(try_type(std::uint32_t()) || try_type(std::int32_t()) || try_type(std::int64_t()) ||
          try_type(std::uint64_t()) || try_type(std::uint16_t()) || try_type(std::int16_t()) ||
          try_type(std::uint8_t()) || try_type(std::int8_t())))
        throw nb::type_error((std::string(name) + ": must be of whole numbers of 8 to 64 bits").c_str());
    return numbers;
}

// Returns the materials of a list or tuple, or of a single Material or None.
std::vector<std::shared_ptr<const Material>> materials_of(nb::handle argument) {
    std::vector<std::shared_ptr<const Material>> materials;
    if (nb::isinstance<nb::list>(argument) || nb::isinstance<nb::tuple>(argument)) {
        for (const nb::handle one : nb::iter(argument)) materials.push_back(material_or_none({one}, "material"));
        if (materials.empty()) wrong_value("material", "must not be an empty list");
    } else {
        materials.push_back(material_or_none({argument}, "material"));
    }
    return materials;
}

NewArray<float> vertices_of(const Mesh& mesh) {
    const NewArray<float> array = new_array<float>({mesh.data().vertices.size()}, 3);
    float* to = array.values;
    for (const Float3& v : mesh.data().vertices) {
        *to++ = v.x;
        *to++ = v.y;
        *to++ = v.z;
    }
    return array;
}

NewArray<std::uint32_t> faces_of(const Mesh& mesh) {
    const NewArray<std::uint32_t> array = new_array<std::uint32_t>({mesh.data().triangles.size()}, 3);
    std::uint32_t* to = array.values;
    for (const Index3& t : mesh.data().triangles) {
        *to++ = t.a;
        *to++ = t.b;
        *to++ = t.c;
    }
    return array;
}

// Throws a ValueError unless an array has a row for each of the `count` vertices or triangles.
void check_length(const char* name, std::size_t length, std::size_t count, const char* what) {
    if (length != count)
        wrong_value(name, "must have a row for each of the " + std::to_string(count) + what + ", not " +
                              std::to_string(length));
}

// Constructs a Mesh from the arguments of Mesh.__init__.
void construct(Mesh* self, ArrayArgument vertices, ArrayArgument faces, MaterialsArgument material,
               ArrayArgument normals, ArrayArgument uvs, ArrayArgument slots) {
    // Read the arrays of vertices and triangles.
    MeshData data = mesh_data(vertices, faces);
    if (!normals.object.is_none()) {
        data.normals = float_rows<Float3>(normals, "normals", 3, float3);
        check_length("normals", data.normals.size(), data.vertices.size(), " vertices");
    }
    if (!uvs.object.is_none()) {
        data.uvs = float_rows<Float2>(uvs, "uvs", 2, [](const float* v) { return Float2{v[0], v[1]}; });
        check_length("uvs", data.uvs.size(), data.vertices.size(), " vertices");
    }
    // Read the materials.
    std::vector<std::shared_ptr<const Material>> materials = materials_of(material.object);
    if (!slots.object.is_none()) {
        const ArrayView array(slots.object, "material_slots", "an array of whole numbers");
        if (array.rank() != 1) wrong_value("material_slots", "must have shape (m,), not " + shape_text(array.shape()));
        check_length("material_slots", array.length(0), data.triangles.size(), " triangles");
        data.material_slots = whole_numbers(array, "material_slots", materials.size(), " materials");
    }
    // Make the mesh.
    const std::shared_ptr<const Mesh> made = make_mesh(std::move(data), std::move(materials));
    new (self) Mesh(*made);
}

}  // namespace

MeshData mesh_data(ArrayArgument vertices, ArrayArgument faces) {
    MeshData data;
    data.vertices = float_rows<Float3>(vertices, "vertices", 3, float3);
    const ArrayView array(faces.object, "faces", "an array of whole numbers");
    if (array.rank() != 2 || array.length(1) != 3)
        wrong_value("faces", "must have shape (m, 3), not " + shape_text(array.shape()));
    if (array.length(0) == 0) wrong_value("faces", "must not be empty");
    const std::vector<std::uint32_t> numbers = whole_numbers(array, "faces", data.vertices.size(), " vertices");
    data.triangles.resize(array.length(0));
    for (std::size_t i = 0; i < data.triangles.size(); ++i)
        data.triangles[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    return data;
}

std::shared_ptr<const Mesh> make_mesh(MeshData data, std::vector<std::shared_ptr<const Material>> materials) {
    try {
        return std::make_shared<Mesh>(std::move(data), std::move(materials));
    } catch (const ArgumentError&) {
        throw;
    } catch (const Error& error) {
        wrong_value("faces", error.what());
    }
}

void bind_meshes(nb::module_& module) {
    nb::class_<Mesh, Hittable>(module, "Mesh", "A triangle mesh.")
        .def("__init__", &construct, given("vertices"), given("faces"), given("material") = nb::none(), nb::kw_only(),
             given("normals") = nb::none(), given("uvs") = nb::none(), given("material_slots") = nb::none(),
             R"(Makes a mesh. The arrays are copied.

Args:
    vertices: shape (n, 3), float32, in world units, finite.
    faces: the vertices of each triangle, counter-clockwise seen from outside: shape (m, 3), uint32 or another integer
        type.
    material: a Material for all triangles, or a list of materials for material_slots. Queries need no material;
        renders do.
    normals: the normal of each vertex, of any length but 0: shape (n, 3), float32. None gives flat shading.
    uvs: the texture coordinates of each vertex: shape (n, 2), float32. None gives the barycentric weights of the
        triangle's second and third vertex.
    material_slots: the index in the list of materials for each triangle: shape (m,), an integer type. None gives all
        triangles the first material.)")
        .def_prop_ro(
            "vertices", [](const Mesh& mesh) { return vertices_of(mesh).array; },
            nb::sig("def vertices(self) -> numpy.typing.NDArray"), "A copy of the vertices: shape (n, 3), float32.")
        .def_prop_ro(
            "faces", [](const Mesh& mesh) { return faces_of(mesh).array; },
            nb::sig("def faces(self) -> numpy.typing.NDArray"), "A copy of the faces: shape (m, 3), uint32.")
        .def_prop_ro("degenerate_triangles", &Mesh::degenerate_triangles,
                     "The number of triangles of exactly zero area. No ray can hit them.")
        .def(
            "smoothed",
            [](const Mesh& mesh, NumberArgument crease_degrees) {
                const double angle = number(crease_degrees, "crease_degrees");
                return std::make_shared<Mesh>(smooth_normals(mesh.data(), angle), mesh.materials());
            },
            given("crease_degrees"),
            R"(Returns the mesh with smooth normals. They replace the mesh's own normals.

Args:
    crease_degrees: 0 to 180. Normals are interpolated across an edge if its two triangles turn by less than this angle.
        Normals are not interpolated across the border of the mesh.)");
}

}  // namespace limn::python
