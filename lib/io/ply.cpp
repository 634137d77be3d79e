#include <array>
#include <cmath>

#include "io/model_reader.h"
#include "io/ply_source.h"
#include "io/vertex_colors.h"
#include "limn/math/color.h"
#include "limn/math/error.h"

namespace limn {

namespace {

// Reads the vertices, faces and triangle strips of a PLY. Other elements are skipped.
class PlyReader {
public:
    PlyReader(std::string_view bytes, const std::string& path, Model& model)
        : source_(bytes, path, model.warnings), model_(model), cutter_(model) {}

    void read() {
        for (const PlyElement& element : source_.elements()) {
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_lists(element, [this] { add_face(); });
            } else if (element.name == "tristrips") {
                read_lists(element, [this] { add_strips(); });
            } else if (!element.properties.empty()) {
                for (std::uint64_t i = 0; i < element.count; ++i) source_.read_row(element, {}, values_, list_);
            }
        }
        source_.warn_of_rest(model_.warnings);
    }

    MeshData data;
    std::vector<Float3> colors;  // linear colours of the vertices, or empty

private:
    // The indices of three properties that form a vector; std::nullopt if the element lacks one of them.
    using Places = std::optional<std::array<std::size_t, 3>>;
    using Names = std::initializer_list<std::string_view>;

    static Places places(const PlyElement& element, Names x, Names y, Names z) {
        const auto a = element.find(x), b = element.find(y), c = element.find(z);
        if (!a || !b || !c) return std::nullopt;
        return std::array{*a, *b, *c};
    }

    // Returns a vector of the current row. \pre `at` has a value
    Float3 vector_at(const Places& at) const {
        const auto number = [&](std::size_t i) { return static_cast<float>(values_[(*at)[i]]); };
        return {number(0), number(1), number(2)};
    }

    void read_vertices(const PlyElement& element) {
        // Find the properties that limn uses.
        const Places position = places(element, {"x"}, {"y"}, {"z"}), normal = places(element, {"nx"}, {"ny"}, {"nz"});
        const Places color = places(element, {"red", "r", "diffuse_red"}, {"green", "g", "diffuse_green"},
                                    {"blue", "b", "diffuse_blue"});
        const auto u = element.find({"s", "u", "texture_u"}), v = element.find({"t", "v", "texture_v"});
        if (!position) source_.fail("its vertices have no x, y and z");
        // Read the rows.
        for (std::uint64_t i = 0; i < element.count; ++i) {
            source_.read_row(element, {}, values_, list_);
            const Float3 p = vector_at(position);
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                source_.fail("vertex " + std::to_string(i) + " is not finite");
            data.vertices.push_back(p);
            if (normal) data.normals.push_back(vector_at(normal));
            if (u && v) data.uvs.push_back({static_cast<float>(values_[*u]), static_cast<float>(values_[*v])});
            if (color) colors.push_back(linear(vector_at(color), element.properties[(*color)[0]].type));
        }
        model_.vertices = data.vertices.size();
    }

    // Returns the linear value of a colour. Floats are linear already. Integers are sRGB: a ushort from 0 to 65535, any
    // other type from 0 to 255, as programs write them.
    static Float3 linear(const Float3& c, PlyType type) {
        const double largest = !is_integer(type) ? 1 : type == PlyType::uint16 ? 65535 : 255;
        const auto decode = [&](float stored) {
            const double value = stored > 0 ? std::min(stored / largest, 1.0) : 0;  // NaN becomes 0
            return static_cast<float>(is_integer(type) ? srgb_decode(value) : value);
        };
        return {decode(c.x), decode(c.y), decode(c.z)};
    }

    // Reads the list of vertex indices in each row of an element, and calls add() for it.
    template <class Add>
    void read_lists(const PlyElement& element, const Add& add) {
        if (element.count == 0) return;
        const auto indices = element.find({"vertex_indices", "vertex_index"}, true);
        if (!indices || !is_integer(element.properties[*indices].type))
            source_.fail("its element " + in_quotes(element.name) + " has no list of integers vertex_indices");
        if (data.vertices.empty()) source_.fail("its faces come before its vertices");
        for (std::uint64_t i = 0; i < element.count; ++i) {
            source_.read_row(element, indices, values_, list_);
            add();
        }
    }

    // Converts an index of a vertex, after a check of its range.
    std::uint32_t vertex(double index) const {
        if (!(index >= 0 && index < static_cast<double>(data.vertices.size())))
            source_.fail("face " + std::to_string(model_.faces) + " refers to vertex " + integer_text(index) +
                         ", but the file has " + std::to_string(data.vertices.size()) + ", counted from 0");
        return static_cast<std::uint32_t>(index);
    }

    void add_face() {
        corners_.clear();
        for (const double index : list_) corners_.push_back(vertex(index));
        add_polygon();
    }

    // Adds triangle strips. Each three consecutive corners form a triangle, and every second triangle is reversed. An
    // index of -1 starts a new strip.
    void add_strips() {
        std::size_t begin = 0;
        for (std::size_t i = 0; i < list_.size(); ++i) {
            if (list_[i] == -1) begin = i + 1;
            if (i < begin + 2) continue;
            const std::size_t odd = (i - begin) % 2;
            corners_ = {vertex(list_[i - 2 + odd]), vertex(list_[i - 1 - odd]), vertex(list_[i])};
            add_polygon();
        }
    }

    // Adds the face with the corners `corners_`.
    void add_polygon() {
        polygon_.clear();
        for (const std::uint32_t corner : corners_) polygon_.push_back(data.vertices[corner]);
        const auto face = static_cast<std::uint32_t>(model_.faces++);
        for (const Index3& t : cutter_.cut(polygon_, "face", face)) {
            data.triangles.push_back({corners_[t.a], corners_[t.b], corners_[t.c]});
            data.faces.push_back(face);
        }
    }

    PlySource source_;
    Model& model_;
    FaceCutter cutter_;
    std::vector<double> values_, list_;   // the current row
    std::vector<std::uint32_t> corners_;  // the current face
    std::vector<Float3> polygon_;
};

}  // namespace

Model read_ply(std::string_view bytes, const std::string& path, const ModelOptions& options) {
    Model model;
    model.files = {path};
    PlyReader reader(bytes, path, model);
    reader.read();
    require_faces(reader.data, model, path, "it holds points alone");
    repair(reader.data, model);
    std::vector<std::shared_ptr<const Material>> materials{default_material(options)};
    if (!reader.colors.empty()) {
        model.materials = {"vertex colours"};
        materials.push_back(paint(reader.data, reader.colors));
    }
    add_mesh(model, std::move(reader.data), std::move(materials), options);
    return model;
}

}  // namespace limn
