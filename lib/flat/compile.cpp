#include "flat/compile.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "flat/steps.h"
#include "math/require.h"

namespace limn::compiler {

namespace {

// Fills the tables of the kinds with a row for each primitive. The rows of a range stay consecutive; its first_row is
// set to their new place.
void fill_rows(const SceneRecords& records, flat::Scene& out) {
    primitives::for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
        std::vector<Kind>& rows = std::get<std::vector<Kind>>(out.rows);
        for (PrimitiveRange& range : out.ranges) {
            if (range.kind != Kind::kKind) continue;
            const auto first = (records.*Kind::kRecords).begin() + range.first_row;
            range.first_row = static_cast<std::uint32_t>(rows.size());
            std::for_each_n(first, range.count, [&](const auto& record) { rows.emplace_back(record); });
        }
    });
}

// Moves the records to the tables of the scene.
void move_tables(SceneRecords&& records, flat::Scene& out) {
    // Concatenate the ranges of all BLASes.
    for (const BlasRecord& blas : records.blases) {
        flat::Blas& packed = out.blases.emplace_back();
        packed.first_range = static_cast<std::uint32_t>(out.ranges.size());
        packed.range_count = static_cast<std::uint32_t>(blas.ranges.size());
        out.ranges.insert(out.ranges.end(), blas.ranges.begin(), blas.ranges.end());
    }
    // Fill the tables of shapes.
    fill_rows(records, out);
    out.primitives = records.blases.front().primitives;
    for (MeshRecord& mesh : records.meshes) out.meshes.push_back({std::move(mesh), {}, {}});
    out.user_defined = std::move(records.user_defined);
    out.medium_shapes = std::move(records.media);
    for (const InstanceRecord& instance : records.instances) {
        out.instances.emplace_back().blas = instance.blas;
        place_instance(out.instances.back(), instance.world_from_object0, instance.world_from_object1);
    }
    // Move the other tables.
    out.materials = std::move(records.materials);
    out.textures = std::move(records.textures);
    out.images = std::move(records.images);
    out.lattices = std::move(records.lattices);
    out.kept = std::move(records.kept);
}

// Sets the features of the scene and their names.
void gather_features(flat::Scene& s) {
    // Find the features.
    flat::Features& f = s.features;
    f.user_defined_shapes = !s.user_defined.empty();
    for (const flat::Instance& instance : s.instances) f.moving_instances |= instance.moving;
    bool smooth_normals = false, textures = false;
    for (const flat::Mesh& mesh : s.meshes) smooth_normals |= !mesh.arrays.normals.empty();
    for (const TextureRecord& t : s.textures) {
        textures |= t.kind != TextureKind::solid;
        f.user_defined_textures |= t.kind == TextureKind::user_defined;
        f.texture_coordinates |= t.kind == TextureKind::image;
    }
    for (const MaterialRecord& m : s.materials) {
        f.user_defined_materials |= m.kind == kUserDefinedMaterial;
        f.tangents |= m.uses_tangents;
    }
    f.texture_coordinates |= f.user_defined_textures || f.user_defined_materials || f.user_defined_shapes;
    const bool has_map = s.environment != nullptr;
    f.background = !has_map && (!is_black(s.background_bottom) || !is_black(s.background_top));

    // Write their names.
    const auto name = [&](bool present, const char* feature) {
        if (!present) return;
        if (!s.feature_names.empty()) s.feature_names += ' ';
        s.feature_names += feature;
    };
    std::apply([&]<class... Kind>(const std::vector<Kind>&... rows) { (name(!rows.empty(), Kind::kName), ...); },
               s.rows);
    name(!s.meshes.empty(), "mesh");
    name(smooth_normals, "smooth-normals");
    name(!s.instances.empty(), "instance");
    name(f.moving_instances, "moving-instance");
    name(f.user_defined_shapes, "foreign-shape");
    name(!s.media.empty(), "medium");
    name(textures, "texture");
    name(f.user_defined_textures, "foreign-texture");
    name(f.user_defined_materials, "foreign-material");
    name(s.lights.size() > 0 || !s.light_sources.empty(), "light");
    name(f.background, "background");
    name(has_map, "environment");
}

// Allocates the places of meshes without normals and texture coordinates. build_trees() fills them.
void reserve_places(flat::Scene& s) {
    for (flat::Mesh& mesh : s.meshes) {
        const MeshView& arrays = mesh.arrays;
        if (arrays.normals.empty() && arrays.uvs.empty()) mesh.places.assign(arrays.triangles.size(), flat::kNothing);
    }
}

// Releases the arrays of meshes whose vertices are in the tree. Releases `kept` if there are no user-defined objects.
void release_arrays(flat::Scene& s) {
    for (flat::Mesh& mesh : s.meshes) {
        if (mesh.arrays.triangles.empty() || mesh.places.empty()) continue;
        mesh.slots.assign(mesh.arrays.material_slots.begin(), mesh.arrays.material_slots.end());
        mesh.arrays = {};
        mesh.arrays.material_slots = mesh.slots;
        mesh.owner.reset();
    }
    const flat::Features& f = s.features;
    if (!f.user_defined_shapes && !f.user_defined_materials && !f.user_defined_textures) s.kept.clear();
}

// Fills Scene::object_guide, with about one entry for each primitive or, if there are many, two for each object.
void name_objects(flat::Scene& s) {
    const std::uint64_t most = std::max<std::uint64_t>(4096, 2 * s.first_of_object.size());
    while (s.primitives >> s.object_shift > most) ++s.object_shift;
    s.object_guide.assign((s.primitives >> s.object_shift) + 2, 0);
    std::uint32_t object = 0;
    for (std::size_t i = 0; i < s.object_guide.size(); ++i) {
        while (object + 1 < s.first_of_object.size() && s.first_of_object[object + 1] <= i << s.object_shift) ++object;
        s.object_guide[i] = object;
    }
}

// Counts the stored primitives without a material. Boundaries of media need none.
void count_unassigned(flat::Scene& s) {
    // Visit each BLAS once, from the root on.
    std::vector<bool> seen(s.blases.size(), false);
    std::vector<BlasId> open{BlasId::root};
    while (!open.empty()) {
        const auto id = static_cast<std::size_t>(open.back());
        open.pop_back();
        if (seen[id]) continue;
        seen[id] = true;
        for (const PrimitiveRange& range : flat::ranges_of(s, s.blases[id])) {
            if (range.kind == PrimitiveKind::instance) open.push_back(s.instances[range.first_row].blas);
            const bool has_row = range.kind != PrimitiveKind::instance && range.kind != PrimitiveKind::medium &&
                                 range.kind != PrimitiveKind::user_defined;
            for (std::uint64_t e = 0; has_row && e < range.count; ++e)
                s.unassigned += flat::material_of(s, range, e) == MaterialId::none ? 1 : 0;
        }
    }
}

// Returns the memory of the scene in bytes.
std::size_t memory_of(const flat::Scene& s) {
    const auto bytes = [](const auto&... tables) {
        return (std::size_t{0} + ... + (tables.size() * sizeof(tables[0])));
    };
    std::size_t sum = sizeof(s) + bytes(s.meshes, s.instances, s.user_defined, s.materials, s.textures, s.kept);
    sum += std::apply(bytes, s.rows);
    sum += bytes(s.blases, s.ranges, s.references, s.nodes, s.lines, s.first_of_object, s.object_guide);
    sum += bytes(s.list.entries, s.list.planar, s.list.round);
    sum += bytes(s.medium_shapes, s.media, s.medium_instances);
    const flat::LightTable& l = s.lights;
    sum += bytes(l.own, l.places, l.instances, l.refs, l.strength_before, l.guide, l.nodes, l.by_number, l.distant);
    sum += bytes(s.light_sources);
    for (const flat::Mesh& mesh : s.meshes) {
        const MeshView& a = mesh.arrays;
        sum += bytes(a.vertices, a.triangles, a.normals, a.uvs, a.material_slots, mesh.materials, mesh.places);
    }
    for (const auto& image : s.images) sum += image->values().size_bytes();
    if (const flat::Environment* e = s.environment.get()) {
        sum += sizeof(*e) + bytes(e->row_luminance, e->band_cosine, e->band_before, e->column_before);
        sum += e->image->values().size_bytes();
    }
    return sum + s.lattices.size() * sizeof(PerlinLattice);
}

}  // namespace

void place_instance(flat::Instance& instance, const Transform& at_time0, const Transform& at_time1) {
    instance.world_from_object0 = at_time0;
    instance.world_from_object1 = at_time1;
    instance.moving = !(at_time0 == at_time1);
    instance.object_from_world = instance.moving ? Transform{} : inverse(at_time0);
    instance.object_from_world_error = instance.moving ? InverseError{} : inverse_error(at_time0);
}

void derive(flat::Scene& s) {
    place_media(s);
    collect_lights(s);
    gather_features(s);
    release_arrays(s);
    s.digest = digest_of(s);
    s.memory_bytes = memory_of(s);
}

flat::Scene flatten(const limn::Scene& scene) {
    // Check the background.
    const auto start = std::chrono::steady_clock::now();
    require(is_radiance(scene.background.bottom), "compile: Scene::background.bottom must be finite and not negative");
    require(is_radiance(scene.background.top), "compile: Scene::background.top must be finite and not negative");
    // Describe the objects as records.
    RecordSink sink;
    flat::Scene out;
    for (const auto& object : scene.objects()) {
        out.material_names.push_back(scene.material_names(out.first_of_object.size()));
        out.first_of_object.push_back(sink.primitives());
        object->lower(sink);
    }
    // Digest the description and move the records to the scene's tables.
    out.unmoved_digest = digest_of_unmoved(sink.records(), scene);
    out.untagged = sink.records().untagged;
    move_tables(std::move(sink).take(), out);
    if (!out.user_defined.empty())  // their records point into the described objects
        for (const auto& object : scene.objects()) out.kept.push_back(object);
    out.name = scene.name;
    out.background_bottom = scene.background.bottom;
    out.background_top = scene.background.top;
    out.light_sources = scene.lights();
    // Build the trees and all that follows from them.
    reserve_places(out);
    build_trees(out);
    name_objects(out);
    if (scene.environment) out.environment = tabulate(*scene.environment);
    count_unassigned(out);
    derive(out);
    out.compile_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
}

}  // namespace limn::compiler
