#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "commands.h"
#include "json_output.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "limn/render/film.h"
#include "limn/scene/shape/mesh_edges.h"
#include "model_input.h"
#include "parse.h"
#include "program.h"
#include "text_file.h"

namespace limn::app {

namespace {

// The content of a file, as a table and as JSON.
struct Description {
    std::string table;
    Json json;
};

const char* yes_or_no(bool value) { return value ? "yes" : "no"; }

// Returns a corner of a bounding box as text. Coordinates are written as float32, like the vertices of a model, because
// they have fewer digits then. A coordinate of an instance outside the range of float32 is written as float64.
std::string corner(const Point3& p) {
    const auto text = [](double x) {
        const auto rounded = static_cast<float>(x);
        return std::isfinite(rounded) && (rounded != 0 || x == 0) ? fmt::format("{}", rounded) : fmt::format("{}", x);
    };
    return fmt::format("({}, {}, {})", text(p.x), text(p.y), text(p.z));
}

// Sums over the meshes of a model. A mesh with several instances counts once.
struct MeshSums {
    std::size_t triangles = 0;
    EdgeCounts edges;
    bool has_normals = false, has_uvs = false;  // true if any mesh has them
};

MeshSums sums_of(const Model& model) {
    MeshSums sums;
    for (const auto& mesh : model.meshes) {
        const MeshData& data = mesh->data();
        const EdgeCounts edges = count_edges(*mesh);
        sums.triangles += data.triangles.size();
        sums.edges.edges += edges.edges;
        sums.edges.open += edges.open;
        sums.edges.nonmanifold += edges.nonmanifold;
        sums.has_normals |= !data.normals.empty();
        sums.has_uvs |= !data.uvs.empty();
    }
    return sums;
}

std::vector<std::string> camera_names(const Model& model) {
    std::vector<std::string> names;
    for (const ModelCamera& camera : model.cameras) names.push_back(camera.name);
    return names;
}

// Returns the names of the parts: "object/group", or one of the two if the other is empty.
std::vector<std::string> part_names(const Model& model) {
    std::vector<std::string> names;
    for (const ModelPart& part : model.parts)
        names.push_back(part.object + (part.object.empty() || part.group.empty() ? "" : "/") + part.group);
    return names;
}

Description describe_model(const std::string& path, const Model& model) {
    const auto& [triangles, edges, has_normals, has_uvs] = sums_of(model);
    const Box box = model.bounds();

    // Write the table.
    Description d;
    const auto row = [&d](const char* name, const auto& value) {
        d.table += table_row(name, fmt::format("{}", value));
    };
    row("vertices", model.vertices);
    row("faces", model.faces);
    row("dropped faces", model.dropped_faces);
    row("triangles", triangles);
    row("degenerate triangles", model.degenerate_triangles);
    row("bounds", corner(box.lower) + " to " + corner(box.upper));
    row("edges", edges.edges);
    row("open edges", edges.open);
    row("non-manifold edges", edges.nonmanifold);
    row("closed", yes_or_no(edges.is_closed()));
    row("normals", yes_or_no(has_normals));
    row("texture coordinates", yes_or_no(has_uvs));
    if (!model.parts.empty()) row("parts", fmt::format("{}", fmt::join(part_names(model), ", ")));
    row("materials", model.materials.empty() ? "none" : fmt::format("{}", fmt::join(model.materials, ", ")));
    // Add what only some files have.
    if (model.meshes.size() > 1) row("meshes", model.meshes.size());
    if (model.instances.size() > 1) row("instances", model.instances.size());
    if (!model.cameras.empty()) row("cameras", fmt::format("{}", fmt::join(camera_names(model), ", ")));
    if (!model.lights.empty()) row("lights", model.lights.size());
    for (const std::string& warning : model.warnings) row("warning", warning);

    // Write the same as JSON.
    d.json = {
        {"file", path},
        {"kind", "model"},
        {"vertices", model.vertices},
        {"faces", model.faces},
        {"dropped_faces", model.dropped_faces},
        {"triangles", triangles},
        {"degenerate_triangles", model.degenerate_triangles},
        {"bounds",
         {{"lower", {box.lower.x, box.lower.y, box.lower.z}}, {"upper", {box.upper.x, box.upper.y, box.upper.z}}}},
        {"edges", edges.edges},
        {"open_edges", edges.open},
        {"nonmanifold_edges", edges.nonmanifold},
        {"closed", edges.is_closed()},
        {"normals", has_normals},
        {"texture_coordinates", has_uvs},
        {"parts", part_names(model)},
        {"materials", model.materials},
        {"meshes", model.meshes.size()},
        {"instances", model.instances.size()},
        {"cameras", camera_names(model)},
        {"lights", model.lights.size()},
        {"warnings", model.warnings},
    };
    return d;
}

// Returns the type of the channels: one if all have the same, otherwise a list.
std::string pixel_type(const std::vector<ImageChannel>& channels) {
    std::vector<std::string> types;
    for (const ImageChannel& channel : channels) types.push_back(channel.type);
    if (std::adjacent_find(types.begin(), types.end(), std::not_equal_to<>()) == types.end()) types.resize(1);
    return fmt::format("{}", fmt::join(types, ", "));
}

Description describe_image(const std::string& path, ImageInfo image) {
    std::ranges::sort(image.facts);
    std::vector<std::string> names;
    Json channels = Json::array(), json_facts = Json::object();
    for (const ImageChannel& channel : image.channels) {
        names.push_back(channel.name);
        channels.push_back({{"name", channel.name}, {"type", channel.type}});
    }

    Description d;
    d.table += table_row("size", fmt::format("{} x {}", image.width, image.height));
    if (const auto& whole = image.part_of)
        d.table += table_row(
            "part of", fmt::format("{} x {}, from ({}, {}) on", whole->width, whole->height, whole->left, whole->top));
    d.table += table_row("channels", fmt::format("{}", fmt::join(names, ", ")));
    d.table += table_row("pixel type", pixel_type(image.channels));
    for (const auto& [name, value] : image.facts) {
        json_facts[name] = value;
        d.table += table_row(name, value);
    }
    d.json = {{"file", path},           {"kind", "image"},      {"width", image.width},
              {"height", image.height}, {"channels", channels}, {"facts", json_facts}};
    return d;
}

Description describe_film(const std::string& path) {
    // Read the whole film, which fails if it is damaged or cut short.
    const Film film = Film::load(path);
    const FilmInfo& info = film.info();
    const Film::Counts counts = film.counts();
    const std::string shard = fmt::format("{}/{}", info.shard.index, info.shard.count);

    // Write the table.
    Description d;
    const auto row = [&d](const char* name, const auto& value) {
        d.table += table_row(name, fmt::format("{}", value));
    };
    row("film of", info.scene);
    row("size", fmt::format("{} x {}", info.width, info.height));
    if (const auto& c = info.crop) row("crop", fmt::format("{},{},{},{}", c->left, c->top, c->right, c->bottom));
    row("shard", shard);
    row("samples a pixel", film.mean_samples());
    row("finished", yes_or_no(film.is_finished()));
    row("adaptive", yes_or_no(!film.plan().rates.empty()));
    row("seed", info.seed);
    row("rays", counts.rays);
    row("seconds", film.seconds());
    row("bound to its program", yes_or_no(info.program != Hash128{}));

    // Write the same as JSON. `crop` is null if the film is of the whole picture.
    Json crop;
    if (const auto& c = info.crop) crop = {c->left, c->top, c->right, c->bottom};
    d.json = {{"file", path},
              {"kind", "film"},
              {"scene", info.scene},
              {"width", info.width},
              {"height", info.height},
              {"crop", crop},
              {"shard", shard},
              {"spp", film.mean_samples()},
              {"finished", film.is_finished()},
              {"adaptive", !film.plan().rates.empty()},
              {"seed", info.seed},
              {"rays", counts.rays},
              {"seconds", film.seconds()},
              {"bound_to_its_program", info.program != Hash128{}}};
    return d;
}

// Describes a file that is a model or an image. The model is tried first, because it needs no module for images.
template <class GetModel, class GetImage>
Description describe_either(const std::string& path, GetModel get_model, GetImage get_image) {
    try {
        return describe_model(path, from_files(get_model));
    } catch (const FileError& no_model) {
        try {
            return describe_image(path, get_image());
        } catch (const Error& no_image) {
            const std::string image_fault = no_image.what(), model_fault = no_model.what();
            if (image_fault == model_fault) throw;  // both are the same if the file cannot be opened
            throw Error(image_fault + "; as a model: " + model_fault);
        }
    }
}

Description describe(const std::string& path) {
    if (path == kStandardInput) {
        const std::string input = read_standard_input(), name = "standard input";
        const auto bytes = std::as_bytes(std::span(input));
        return describe_either(
            path, [&] { return load_model_from_memory(bytes, name); },
            [&] { return load_image_info_from_memory(bytes, name); });
    }
    if (is_film_file(path)) return describe_film(path);
    return describe_either(
        path, [&] { return load_model(path); }, [&] { return load_image_info(path); });
}

}  // namespace

int info_command(int argc, const char* const* argv) {
    Options options(
        "limn info",
        "Prints what a file holds: a model (OBJ, PLY, STL, glTF), a film, or an image with its size, channels and the "
        "facts of its render. The kind of file is told by its contents, not by its name.",
        "An open edge belongs to one triangle, a non-manifold edge to more than two. A model without open\n"
        "edges is closed. For this count vertices at the same place are one vertex, and triangles without\n"
        "area are left out.");
    std::string file;
    options.add({.name = "FILE",
                 .value = "",
                 .help = "The model, film or image; - for a model or image from standard input",
                 .required = true},
                file_name("FILE", file));
    JsonOption json_option(options);
    if (!options.parse(argc, argv)) return kDone;
    json_option.check({input_file(file)});

    const Description description = describe(file);
    json_option.write(description.table, description.json);
    return kDone;
}

}  // namespace limn::app
