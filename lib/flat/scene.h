// The compiled scene: plain tables, whose rows are referred to by typed ids. There are no virtual functions. The only
// pointers to described objects are those to user-defined shapes, materials and textures, which are called through
// function pointers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "flat/environment.h"
#include "flat/light_table.h"
#include "flat/list.h"
#include "flat/tree.h"
#include "geometry/mesh_triangle.h"
#include "geometry/ray_frame.h"
#include "geometry/registry.h"
#include "limn/math/box.h"
#include "limn/math/color.h"
#include "limn/math/hash128.h"
#include "limn/math/math.h"
#include "limn/records/records.h"
#include "math/system/huge_pages.h"

namespace limn::flat {

// The hit that traversal keeps: a primitive and its t. u, v, the normal and the material are computed once, for the
// final hit.
struct RawHit {
    static constexpr std::uint64_t kMiss = ~std::uint64_t{0};
    double t = kInfinity;
    std::uint64_t primitive = kMiss;  // its number in the scene; instanced primitives count once for each instance
};
static_assert(sizeof(RawHit) == 16);

// The primitive that a leaf of the tree refers to.
struct Reference {
    std::uint32_t range;    // row of Scene::ranges
    std::uint32_t element;  // within the range
};
static_assert(sizeof(Reference) == 8);

// A mesh. If it has neither normals nor texture coordinates, its vertices are stored only in the blocks of the tree,
// and `arrays` has nothing but material slots. For such a mesh:
// - places[i] is the place of triangle i in the tree: kMaxBlock * p + its lane in the block, where p is the first row
// of
//   the block in Scene::lines. The place is kNothing if the triangle has no area, because it isn't in the tree then.
// - `slots` owns the material slots.
struct Mesh : MeshRecord {
    std::vector<std::uint32_t> places, slots;
};
using UserDefined = UserDefinedRecord;

struct Instance {
    Transform world_from_object0, world_from_object1;
    Transform object_from_world;  // inverse matrix of a still instance; if it moves, each ray computes its own
    BlasId blas = BlasId::root;
    bool moving = false;
    InverseError object_from_world_error{};  // the rounding error of object_from_world
};

// Returns the matrix of the instance at a time in [0, 1].
inline Transform world_from_object(const Instance& instance, double time) {
    return instance.moving ? interpolate(instance.world_from_object0, instance.world_from_object1, time)
                           : instance.world_from_object0;
}

// The primitives of one tree (a bottom-level acceleration structure). They are numbered from 0 in each BLAS.
struct Blas {
    Child root = kNothing;
    std::uint32_t first_range = 0;  // rows of Scene::ranges, sorted by first_number
    std::uint32_t range_count = 0;
    Box bounds;
    double extent = 0;       // the largest finite coordinate in the tree
    float packed_error = 0;  // the largest error of rounding a triangle or quad to the floats of its block
    double cost = 0;         // expected cost of a ray that intersects the bounds: see accel::BuildSettings
    double scale = 1;        // multiplies the nodes' boxes: a power of two that keeps them in the range of float
};

// One occurrence of a medium in the scene, with the instances that contain it, outermost first.
struct Medium {
    std::uint32_t shape = 0;           // row of Scene::medium_shapes
    std::uint32_t first_instance = 0;  // row of Scene::medium_instances
    std::uint32_t instance_count = 0;
    std::uint64_t first_number = 0;  // number in the scene of the first primitive of its boundary
    Box bounds;                      // bounds in world space
    double scattered = 1;            // upper bound of the albedo; 1 if it's unknown
};

// Optional features that the scene uses.
struct Features {
    bool moving_instances = false, user_defined_shapes = false;
    bool user_defined_materials = false, user_defined_textures = false;
    bool texture_coordinates = false;  // true if a texture or user-defined material may use them
    bool tangents = false;             // true if a material may use Surface::dp_du and dp_dv
    bool background = false;
};

// The sizes of the tables before the root's tree is built, which is the last. When instances move, the tables are cut
// to these sizes and only the root's tree is rebuilt.
struct BelowRoot {
    std::size_t nodes = 0, lines = 0, references = 0;
    std::uint64_t kinds = 0;
    std::uint64_t stored_primitives = 0, degenerate = 0;
};

struct Scene {
    std::string name;
    primitives::Tables rows;  // the tables of kinds that have a row for each primitive
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<UserDefined> user_defined;

    std::vector<Blas> blases;  // [0] is the scene itself
    std::vector<PrimitiveRange> ranges;
    std::vector<Reference> references;
    HugeVector<Node> nodes;
    HugeVector<Line> lines;                      // the blocks of leaves
    PrimitiveList list;                          // all primitives of a small scene, or the large ones
    std::vector<std::uint64_t> first_of_object;  // number of the first primitive of each object, ascending
    // object_guide[i] is the object of primitive i * 2^object_shift.
    std::vector<std::uint32_t> object_guide;
    unsigned object_shift = 0;

    std::vector<MediumRecord> medium_shapes;
    std::vector<Medium> media;
    double media_extent = 0;  // the largest finite coordinate of the bounds of media
    std::vector<std::uint32_t> medium_instances;
    LightTable lights;

    std::vector<MaterialRecord> materials;
    std::vector<TextureRecord> textures;
    std::vector<std::shared_ptr<const Image>> images;
    std::vector<std::shared_ptr<const PerlinLattice>> lattices;
    std::vector<LightSource> light_sources;
    Color background_bottom, background_top;         // used if there is no environment map
    std::unique_ptr<const Environment> environment;  // null if the scene has no map

    // Scene::material_names of each object, or null.
    std::vector<std::shared_ptr<const std::vector<std::string>>> material_names;
    std::vector<std::shared_ptr<const void>> kept;  // owners of arrays and user-defined objects
    Features features;
    unsigned kinds = 0;  // set of the kinds of primitives in the trees: see bit()
    std::string feature_names;
    Hash128 digest{};          // digest of the description
    Hash128 unmoved_digest{};  // digest of the description without the matrices of instances
    bool untagged = false;     // true if it has user-defined objects that the digest doesn't cover
    std::uint64_t primitives = 0, stored_primitives = 0, degenerate = 0;
    BelowRoot below_root;
    std::size_t unassigned = 0;  // stored primitives without a material
    std::size_t memory_bytes = 0;
    double compile_seconds = 0;
};

// The greatest depth of nested instances, including those in the boundary of a medium.
inline constexpr std::uint32_t kMaxNesting = 16;

// The position of a primitive in the tables: the instances that contain it, outermost first, its range, and its index
// in the range.
struct Place {
    std::uint32_t instances[kMaxNesting];
    std::uint32_t depth = 0;
    std::uint32_t range = 0;  // row of Scene::ranges
    std::uint64_t element = 0;
    bool index_matched = false;  // true if it belongs to the boundary of a medium
};

// Finds the primitive with the given number in a BLAS. \pre number < number of primitives of the BLAS
Place locate(const Scene& scene, std::uint64_t number, BlasId blas = BlasId::root);

// Returns the number of the object that a primitive belongs to.
inline std::size_t object_of(const Scene& scene, std::uint64_t number) {
    const std::uint64_t i = number >> scene.object_shift;
    const std::uint32_t first = scene.object_guide[i], last = scene.object_guide[i + 1];
    if (first == last) return first;
    const auto objects = scene.first_of_object.begin();
    return static_cast<std::size_t>(std::upper_bound(objects + first + 1, objects + last + 1, number) - objects - 1);
}

// Returns the material of one primitive. Returns `none` for instances and media, and for user-defined shapes, which
// return their material with each hit.
MaterialId material_of(const Scene& scene, const PrimitiveRange& range, std::uint64_t element);

// Returns true if the material has an opacity (limn/scene/material/alpha_mask.h).
inline bool has_holes(const MaterialRecord& material) { return material.opacity != TextureId::none; }

// Returns the vertices of a triangle of a mesh, exactly as described.
// \pre if the mesh has no arrays, the triangle is in the tree
TriangleVertices triangle_of(const Scene& scene, const Mesh& mesh, std::uint64_t element);

// Calls visit() with the row of a primitive or with the triangle of a mesh. Does nothing for kinds without a table.
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
