#include "compile/compile.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "compile/steps.h"
#include "core/require.h"

namespace limn::compiler {

namespace {

// Every record of such a kind is in one range, which stays a range.
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

flat::Instance pack(const InstanceRecord& record) {
    flat::Instance instance{record.world_from_object0, record.world_from_object1, {}, record.group, record.moving};
    if (record.moving) return instance;  // inverted anew for each ray
    instance.object_from_world = inverse(record.world_from_object0);
    instance.lost = inverse_error(record.world_from_object0);
    return instance;
}

void move_tables(SceneRecords&& records, flat::Scene& out) {
    for (const GroupRecord& group : records.groups) {
        flat::Group& packed = out.groups.emplace_back();
        packed.first_range = static_cast<std::uint32_t>(out.ranges.size());
        packed.range_count = static_cast<std::uint32_t>(group.ranges.size());
        out.ranges.insert(out.ranges.end(), group.ranges.begin(), group.ranges.end());
    }
    fill_rows(records, out);
    out.primitives = records.groups.front().primitives;
    for (MeshRecord& mesh : records.meshes) out.meshes.push_back({std::move(mesh), {}, {}});
    out.foreign = std::move(records.foreign);
    out.medium_shapes = std::move(records.media);
    for (const InstanceRecord& instance : records.instances) out.instances.push_back(pack(instance));
    out.materials = std::move(records.materials);
    out.textures = std::move(records.textures);
    out.images = std::move(records.images);
    out.lattices = std::move(records.lattices);
    out.kept = std::move(records.kept);
}

void gather_features(flat::Scene& s) {
    flat::Features& f = s.features;
    f.foreign_shapes = !s.foreign.empty();
    for (const flat::Instance& instance : s.instances) f.moving_instances |= instance.moving;
    bool smooth_normals = false, textures = false;
    for (const flat::Mesh& mesh : s.meshes) smooth_normals |= !mesh.arrays.normals.empty();
    for (const TextureRecord& t : s.textures) {
        textures |= t.kind != TextureKind::solid;
        f.foreign_textures |= t.kind == TextureKind::foreign;
        f.texture_coordinates |= t.kind == TextureKind::image;
    }
    for (const MaterialRecord& m : s.materials) f.foreign_materials |= m.kind == kUserDefinedMaterial;
    f.texture_coordinates |= f.foreign_textures || f.foreign_materials || f.foreign_shapes;
    f.background = !is_black(s.background_bottom) || !is_black(s.background_top);

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
    name(f.foreign_shapes, "foreign-shape");
    name(!s.media.empty(), "medium");
    name(textures, "texture");
    name(f.foreign_textures, "foreign-texture");
    name(f.foreign_materials, "foreign-material");
    name(!s.lights.empty(), "light");
    name(f.background, "background");
}

// Meshes whose vertices are all that there is of them get places, to be filled with the tree.
void reserve_places(flat::Scene& s) {
    for (flat::Mesh& mesh : s.meshes) {
        const MeshView& arrays = mesh.arrays;
        if (arrays.normals.empty() && arrays.uvs.empty()) mesh.places.assign(arrays.triangles.size(), flat::kNothing);
    }
}

// Gives up the arrays that the tree repeats, and owners of what no foreign object is there to use.
void release_arrays(flat::Scene& s) {
    const bool fits = s.blocks.size() / 2 * flat::kMaxBlock < flat::kNothing;
    for (flat::Mesh& mesh : s.meshes) {
        if (!fits) mesh.places = {};
        if (mesh.places.empty()) continue;
        mesh.slots.assign(mesh.arrays.material_slots.begin(), mesh.arrays.material_slots.end());
        mesh.arrays = {};
        mesh.arrays.material_slots = mesh.slots;
        mesh.owner.reset();
    }
    const flat::Features& f = s.features;
    if (!f.foreign_shapes && !f.foreign_materials && !f.foreign_textures) s.kept.clear();
}

constexpr std::uint64_t kFewPrimitives = 4096;

void name_objects(flat::Scene& s) {
    if (s.first_of_object.size() < 2 || s.primitives > kFewPrimitives) return;
    s.object_of.resize(s.primitives);
    for (std::size_t i = 0; i < s.first_of_object.size(); ++i)
        std::fill(s.object_of.begin() + static_cast<std::ptrdiff_t>(s.first_of_object[i]), s.object_of.end(),
                  static_cast<std::uint32_t>(i));
}

// Rays wait for memory where the tree is larger than the cache that a core can count on, unless they meet so many of
// its nodes that most were asked for long before.
constexpr std::size_t kCacheBytes = std::size_t{32} << 20;
constexpr double kCostOfManyNodes = 48;

void judge_memory(flat::Scene& s) {
    const std::size_t bytes = s.nodes.size() * sizeof(s.nodes[0]) + s.blocks.size() * sizeof(s.blocks[0]);
    s.is_larger_than_cache = bytes > kCacheBytes && s.groups.front().cost < kCostOfManyNodes;
}

// Shapes that can be seen but have no material. Boundaries of media need none.
void count_unassigned(flat::Scene& s) {
    std::vector<bool> seen(s.groups.size(), false);
    std::vector<GroupId> open{GroupId::root};
    while (!open.empty()) {
        const auto id = static_cast<std::size_t>(open.back());
        open.pop_back();
        if (seen[id]) continue;
        seen[id] = true;
        for (const PrimitiveRange& range : flat::ranges_of(s, s.groups[id])) {
            if (range.kind == PrimitiveKind::instance) open.push_back(s.instances[range.first_row].group);
            const bool has_row = range.kind != PrimitiveKind::instance && range.kind != PrimitiveKind::medium &&
                                 range.kind != PrimitiveKind::foreign;
            for (std::uint64_t e = 0; has_row && e < range.count; ++e)
                s.unassigned += flat::material_of(s, range, e) == MaterialId::none ? 1 : 0;
        }
    }
}

std::size_t memory_of(const flat::Scene& s) {
    const auto bytes = [](const auto&... tables) {
        return (std::size_t{0} + ... + (tables.size() * sizeof(tables[0])));
    };
    const flat::LightTable& lights = s.lights;
    std::size_t sum = sizeof(s) + std::apply(bytes, s.rows) +
                      bytes(s.meshes, s.instances, s.foreign, s.groups, s.ranges, s.references, s.nodes, s.blocks,
                            s.first_of_object, s.object_of, s.medium_shapes, s.media, s.materials, s.textures, s.kept) +
                      bytes(lights.own, lights.places, lights.refs, lights.nodes, lights.by_number,
                            lights.strength_before, lights.guide, lights.instances) +
                      bytes(s.list.entries, s.list.planar, s.list.round);
    for (const flat::Mesh& mesh : s.meshes) {
        const MeshView& a = mesh.arrays;
        sum += bytes(a.vertices, a.triangles, a.normals, a.uvs, a.material_slots, mesh.materials, mesh.places);
    }
    for (const auto& image : s.images) sum += image->values().size_bytes();
    return sum + s.lattices.size() * sizeof(PerlinLattice);
}

}  // namespace

flat::Scene flatten(const limn::Scene& scene) {
    const auto start = std::chrono::steady_clock::now();
    require(is_radiance(scene.background.bottom), "compile: Scene::background.bottom must be finite and not negative");
    require(is_radiance(scene.background.top), "compile: Scene::background.top must be finite and not negative");
    RecordSink sink;
    flat::Scene out;
    for (const auto& object : scene.objects()) {
        out.first_of_object.push_back(sink.primitives());
        object->lower(sink);
    }
    out.digest = digest(sink.records(), scene.background);
    out.untagged = sink.records().untagged;
    move_tables(std::move(sink).take(), out);
    if (!out.foreign.empty())  // their records point into the described objects
        for (const auto& object : scene.objects()) out.kept.push_back(object);
    out.name = scene.name;
    out.background_bottom = scene.background.bottom;
    out.background_top = scene.background.top;
    reserve_places(out);
    build_trees(out);
    judge_memory(out);
    name_objects(out);
    place_media(out);
    collect_lights(out);
    gather_features(out);
    release_arrays(out);
    count_unassigned(out);
    out.memory_bytes = memory_of(out);
    out.compile_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
}

}  // namespace limn::compiler
