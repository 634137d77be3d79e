// The compiled scene: plain tables and typed ids. No virtual functions, no pointer to a described object but to
// user-defined shapes, materials and textures, which are called through their thunks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/huge_pages.h"
#include "flat/environment.h"
#include "flat/lights.h"
#include "flat/list.h"
#include "flat/tree.h"
#include "limn/core/box.h"
#include "limn/core/color.h"
#include "limn/core/hash128.h"
#include "limn/core/math.h"
#include "limn/records.h"
#include "predicates/mesh_triangle.h"
#include "predicates/ray_frame.h"
#include "primitives/registry.h"

namespace limn::flat {

// What traversal carries: which primitive, and the t that decides between two. u, v, normal and material are worked out
// once, for the hit that is kept.
struct RawHit {
    static constexpr std::uint64_t kMiss = ~std::uint64_t{0};
    double t = kInfinity;
    std::uint64_t primitive = kMiss;  // its number in the scene, instanced primitives counted once an instance
};
static_assert(sizeof(RawHit) == 16);

// A primitive as a leaf names it.
struct Reference {
    std::uint32_t range;    // row of Scene::ranges
    std::uint32_t element;  // within the range
};
static_assert(sizeof(Reference) == 8);

// A mesh without normals and texture coordinates has no arrays but slots of its own: its vertices are those that are
// packed in the tree, at places[triangle], a pair of words in Scene::blocks times kMaxBlock plus the lane.
struct Mesh : MeshRecord {
    std::vector<std::uint32_t> places, slots;
};
using UserDefined = UserDefinedRecord;

struct Instance {
    Transform world_from_object0, world_from_object1;
    Transform object_from_world;  // of a still one
    BlasId blas = BlasId::root;
    bool moving = false;
    InverseError object_from_world_error{};
};

inline Transform world_from_object(const Instance& instance, double time) {
    return instance.moving ? interpolate(instance.world_from_object0, instance.world_from_object1, time)
                           : instance.world_from_object0;
}

// Primitives under one tree. Numbers count from 0 in each BLAS.
struct Blas {
    Child root = kNothing;
    std::uint32_t first_range = 0;  // rows of Scene::ranges, sorted by first_number
    std::uint32_t range_count = 0;
    Box bounds;
    double extent = 0;       // the largest finite coordinate in the tree
    float packed_error = 0;  // how far packed numbers are from those that they stand for: 0 where those are floats
    double cost = 0;         // expected, of a ray that meets the bounds: see accel::BuildSettings
    double scale = 1;        // of the nodes' boxes: a power of two, which keeps them in the range of float
};

// A medium where it stands in the scene: seen through instances, outermost first.
struct Medium {
    std::uint32_t shape = 0;           // row of Scene::medium_shapes
    std::uint32_t first_instance = 0;  // in Scene::medium_instances
    std::uint32_t instance_count = 0;
    std::uint64_t first_number = 0;  // of its boundary's primitives, in the scene
    Box bounds;                      // in world space
    double scattered = 1;            // share of the extinction that may scatter: the largest albedo, 1 where unknown
};

struct Features {
    bool moving_instances = false, user_defined_shapes = false;
    bool user_defined_materials = false, user_defined_textures = false;
    bool texture_coordinates = false;  // may be asked for by a texture or a user-defined material
    bool tangents = false;             // the same of Surface::dp_du and dp_dv
    bool background = false;
};

// What there is before the scene's own tree, the last, is built. Moving instances leaves it as it is.
struct BelowRoot {
    std::size_t nodes = 0, block_words = 0, references = 0;
    std::uint64_t kinds = 0;
    std::uint64_t stored_primitives = 0, degenerate = 0;
};

struct Scene {
    std::string name;
    primitives::Tables rows;  // of kinds with one for each primitive
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<UserDefined> user_defined;

    std::vector<Blas> blases;  // [0] is the scene itself
    std::vector<PrimitiveRange> ranges;
    std::vector<Reference> references;
    HugeVector<Node> nodes;
    HugeVector<std::uint32_t> blocks;            // see Block
    PrimitiveList list;                          // of small scenes, and of large primitives beside the tree
    bool is_larger_than_cache = false;           // so that batches of rays are better off waiting for memory by turns
    std::vector<std::uint64_t> first_of_object;  // number of the first primitive of each object, ascending
    std::vector<std::uint32_t> object_of;        // by number, in scenes of few primitives, where a search would show

    std::vector<MediumRecord> medium_shapes;
    std::vector<Medium> media;
    double media_extent = 0;  // the largest finite coordinate of their bounds
    std::vector<std::uint32_t> medium_instances;
    LightTable lights;

    std::vector<MaterialRecord> materials;
    std::vector<TextureRecord> textures;
    std::vector<std::shared_ptr<const Image>> images;
    std::vector<std::shared_ptr<const PerlinLattice>> lattices;
    std::vector<LightRecord> light_sources;
    Color background_bottom, background_top;  // unless there is an environment
    Environment environment;

    // Of each object, or null: of the material slots of its meshes but the first.
    std::vector<std::shared_ptr<const std::vector<std::string>>> material_names;
    std::vector<std::shared_ptr<const void>> kept;  // owners of arrays and user-defined objects
    Features features;
    unsigned kinds = 0;  // of primitives in the trees: see bit()
    std::string feature_names;
    Hash128 digest{};  // of what was compiled, and the part of it that moving instances leaves as it is
    Hash128 unmoved_digest{};
    bool untagged = false;  // it has user-defined objects that the digest does not know
    std::uint64_t primitives = 0, stored_primitives = 0, degenerate = 0;
    BelowRoot below_root;
    std::size_t unassigned = 0;  // stored primitives without a material
    std::size_t memory_bytes = 0;
    double compile_seconds = 0;
};

// Instances may nest this deep, those of a medium's boundary included.
inline constexpr std::uint32_t kMaxNesting = 16;

// Where a primitive stands: the instances around it, outermost first, then its range and place in it.
struct Place {
    std::uint32_t instances[kMaxNesting];
    std::uint32_t depth = 0;
    std::uint32_t range = 0;
    std::uint64_t element = 0;
    bool index_matched = false;  // part of a medium's boundary
};

// \pre number < primitives of the BLAS
Place locate(const Scene& scene, std::uint64_t number, BlasId blas = BlasId::root);

// The object that a primitive belongs to.
inline std::size_t object_of(const Scene& scene, std::uint64_t number) {
    if (!scene.object_of.empty()) return scene.object_of[number];
    if (scene.first_of_object.size() <= 1) return 0;
    const auto after = std::upper_bound(scene.first_of_object.begin(), scene.first_of_object.end(), number);
    return static_cast<std::size_t>(after - scene.first_of_object.begin() - 1);
}

// Of one primitive; none for those without a row of their own, and for user-defined shapes, which tell theirs with each
// hit.
MaterialId material_of(const Scene& scene, const PrimitiveRange& range, std::uint64_t element);

// Whether it has an opacity (limn/material/alpha_mask.h).
inline bool has_holes(const MaterialRecord& material) {
    return material.details && material.details->opacity != TextureId::none;
}

// Exactly as described.
TriangleVertices triangle_of(const Scene& scene, const Mesh& mesh, std::uint64_t element);

// visit(the row of a primitive, or the triangle of a mesh), if there is one.
template <class Visit>
void with_primitive(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, const Visit& visit) {
    if (range.kind == PrimitiveKind::mesh)
        visit(primitives::Triangle(triangle_of(scene, scene.meshes[range.first_row], element)));
    else
        primitives::with_row(scene.rows, range.kind, range.first_row + element, visit);
}

inline const Blas& blas_at(const Scene& s, BlasId id) { return s.blases[static_cast<std::size_t>(id)]; }

inline std::span<const PrimitiveRange> ranges_of(const Scene& s, const Blas& blas) {
    return std::span(s.ranges).subspan(blas.first_range, blas.range_count);
}

}  // namespace limn::flat
