// Reads STL files, text or binary (3D Systems, StereoLithography Interface Specification, 1989). An STL holds only
// triangles. The normals that it states are not used; the order of the corners determines the outward side.
#include <cmath>
#include <unordered_map>

#include "io/bytes.h"
#include "io/bytes_hash.h"
#include "io/file_kind.h"
#include "io/model_reader.h"
#include "io/text_lines.h"

namespace limn {

namespace {

using Words = std::vector<std::string_view>;

// Collects the triangles of an STL. Corners at the same position become one vertex.
class StlMesh {
public:
    explicit StlMesh(Model& model) : model_(model), cutter_(model) {}

    // Adds a triangle, unless it has no area. \param unit,number as for FaceCutter::cut
    void add(std::span<const Float3> corners, const char* unit, std::size_t number) {
        const auto face = static_cast<std::uint32_t>(model_.faces++);
        if (cutter_.cut(corners, unit, number).empty()) return;
        data_.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
        data_.faces.push_back(face);
    }

    MeshData take() {
        model_.vertices = data_.vertices.size();
        return std::move(data_);
    }

private:
    // Returns the index of the vertex at a position. Adds the vertex when it first occurs.
    std::uint32_t vertex(const Float3& p) {
        const Float3 position{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // turns -0 into +0, for BytesHash
        const auto next = static_cast<std::uint32_t>(data_.vertices.size());
        const auto [place, is_new] = numbers_.try_emplace(position, next);
        if (is_new) data_.vertices.push_back(position);
        return place->second;
    }

    Model& model_;
    FaceCutter cutter_;
    MeshData data_;
    std::unordered_map<Float3, std::uint32_t, BytesHash> numbers_;
};

// Reads the text form line by line.
class AsciiReader {
public:
    AsciiReader(std::string_view text, const std::string& path, StlMesh& mesh, Model& model)
        : lines_(text, path, LineForm::plain), mesh_(mesh), model_(model) {}

    void read() {
        while (lines_.next())
            if (const Words words = lines_.words(); !words.empty()) read_line(words);
        if (state_ != State::outside && state_ != State::solid) lines_.fail("the file breaks off within a facet");
        if (state_ == State::solid) model_.warnings.emplace_back("there is no endsolid: the file may have broken off");
        if (passed_over_.count > 0) model_.warnings.push_back(passed_over_.warning());
    }

private:
    enum class State { outside, solid, facet, loop };

    void read_line(const Words& words) {
        // Take the step of the keyword. Lines with other keywords are skipped.
        const std::string key = in_lower_case(words[0]);
        if (key == "solid") {
            step(key, State::outside, State::solid);
        } else if (key == "facet") {
            step(key, State::solid, State::facet);
            has_loop_ = false;
        } else if (key == "outer") {
            step(key, State::facet, State::loop);
            if (has_loop_) lines_.fail("a facet has a second loop");
            has_loop_ = true;
            corners_.clear();
        } else if (key == "vertex") {
            vertex(words);
        } else if (key == "endloop") {
            step(key, State::loop, State::facet);
            if (corners_.size() != 3)
                lines_.fail("a facet has " + std::to_string(corners_.size()) + " corners, not three");
        } else if (key == "endfacet") {
            step(key, State::facet, State::solid);
            if (!has_loop_) lines_.fail("a facet has no corners");
            mesh_.add(corners_, "line", lines_.number());
        } else if (key == "endsolid" || (key == "end" && words.size() > 1 && in_lower_case(words[1]) == "solid")) {
            step(key, State::solid, State::outside);
        } else {
            passed_over_.add(lines_.number());
        }
    }

    // Changes the state. Fails if the keyword is not allowed in the current one.
    void step(const std::string& key, State from, State to) {
        if (state_ != from) lines_.fail(key + " is not allowed here");
        state_ = to;
    }

    void vertex(const Words& words) {
        step("vertex", State::loop, State::loop);
        if (words.size() < 4) lines_.fail("vertex needs 3 numbers");
        corners_.push_back(
            {lines_.require_number(words[1]), lines_.require_number(words[2]), lines_.require_number(words[3])});
    }

    TextLines lines_;
    StlMesh& mesh_;
    Model& model_;
    State state_ = State::outside;
    bool has_loop_ = false;
    std::vector<Float3> corners_;
    PassedOver passed_over_;
};

// Reads the binary form. A triangle is a normal, three corners and two bytes, which some programs use for a colour.
void read_binary(std::string_view bytes, StlMesh& mesh, Model& model) {
    // Read the number of triangles.
    Cursor file(std::as_bytes(std::span(bytes)), "is no STL: it is shorter than the header of one");
    file.take(kStlHeader - 4);
    const std::uint64_t stated = file.little(4), held = file.rest().size() / kStlTriangle;
    demand(stated <= held,
           "breaks off: it states " + std::to_string(stated) + " triangles, and holds " + std::to_string(held));
    if (file.rest().size() > stated * kStlTriangle)
        model.warnings.push_back(std::to_string(file.rest().size() - stated * kStlTriangle) +
                                 " bytes behind the last triangle were passed over");
    // Read the triangles.
    for (std::uint64_t i = 0; i < stated; ++i) {
        Cursor triangle(file.take(kStlTriangle));
        triangle.take(12);
        const auto number = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(triangle.little(4))); };
        Float3 corners[3];
        for (Float3& c : corners) {
            c.x = number();
            c.y = number();
            c.z = number();
            demand(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z),
                   "triangle " + std::to_string(i) + " has a corner that is not finite");
        }
        mesh.add(corners, "triangle", i);
    }
}

}  // namespace

Model read_stl(std::string_view bytes, const std::string& path, const ModelOptions& options) {
    Model model;
    model.files = {path};
    StlMesh mesh(model);
    if (begins_with_solid(bytes) && !is_binary_stl(bytes))
        AsciiReader(bytes, path, mesh, model).read();
    else
        read_binary(bytes, mesh, model);
    MeshData data = mesh.take();
    require_faces(data, model, path, "there is no triangle");
    add_mesh(model, std::move(data), {default_material(options)}, options);
    return model;
}

}  // namespace limn
