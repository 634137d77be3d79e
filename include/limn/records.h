/// \file
/// The party wall: plain records in which described objects state themselves to the compiler. They hold numbers and
/// ids, no behaviour. Whoever writes them keeps what they point to alive through `RecordSink::keep`.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "limn/core/box.h"
#include "limn/core/color.h"
#include "limn/core/fresnel.h"
#include "limn/core/mesh_view.h"
#include "limn/core/perlin_lattice.h"
#include "limn/core/surface.h"
#include "limn/core/transform.h"
#include "limn/core/vec.h"
#include "limn/image/image.h"
#include "limn/image/lookup.h"

namespace limn {

class Hittable;
class Texture;

enum class TextureId : std::uint32_t { none = 0xffffffff };
enum class MaterialId : std::uint32_t { none = 0xffffffff };
enum class GroupId : std::uint32_t { root = 0 };

// ---- textures ------------------------------------------------------------------------------------------------------

enum class TextureKind : std::uint8_t { solid, checker, image, noise, turbulence, marble, foreign };

struct TextureRecord {
    TextureKind kind = TextureKind::solid;
    Filter filter = Filter::bilinear;                          // image
    Wrap wrap = Wrap::repeat;                                  // image
    std::uint32_t data = 0;                                    // row of SceneRecords::images or ::lattices
    TextureId even = TextureId::none;                          // checker
    TextureId odd = TextureId::none;                           // checker
    double scale = 1;                                          // checker: side of a cell; noises: frequency
    Color color;                                               // solid: the colour; noises: multiplies
    const Texture* object = nullptr;                           // foreign
    Color (*value)(const Texture&, const Surface&) = nullptr;  // foreign
};
static_assert(sizeof(TextureRecord) == 64);

// ---- materials -----------------------------------------------------------------------------------------------------

enum class MaterialKind : std::uint8_t { lambertian, metal, dielectric, diffuse_light, isotropic, foreign };

/// How to call somebody else's material.
struct MaterialThunks {
    Color (*emitted)(const Material&, const Surface&);
    std::optional<ScatterSample> (*sample)(const Material&, const Surface&, const Vec3& out, const Random3&);
    ScatterValue (*value)(const Material&, const Surface&, const Vec3& out, const Vec3& in);
};

struct MaterialRecord {
    MaterialKind kind = MaterialKind::lambertian;
    Fresnel fresnel = Fresnel::exact;        // dielectric
    TextureId texture = TextureId::none;     // albedo, or radiance of a light
    double parameter = 0;                    // metal: fuzz; dielectric: index of refraction
    const Material* object = nullptr;        // foreign
    const MaterialThunks* thunks = nullptr;  // foreign
};
static_assert(sizeof(MaterialRecord) == 32);

// ---- shapes --------------------------------------------------------------------------------------------------------

enum class PrimitiveKind : std::uint8_t { sphere, moving_sphere, triangle, quad, mesh, instance, medium, foreign };

/// Centre moves on a straight line from center0 at time 0 to center1 at time 1.
struct SphereRecord {
    Point3 center0, center1;
    double radius = 1;  // negative: the normal points inward
    MaterialId material = MaterialId::none;
};
static_assert(sizeof(SphereRecord) == 64);

struct TriangleRecord {
    Point3 a, b, c;
    MaterialId material = MaterialId::none;
};
static_assert(sizeof(TriangleRecord) == 80);

/// corner + alpha edge_u + beta edge_v, alpha and beta in [0, 1].
struct QuadRecord {
    Point3 corner;
    Vec3 edge_u, edge_v;
    MaterialId material = MaterialId::none;
};
static_assert(sizeof(QuadRecord) == 80);

/// Arrays that the mesh's owner shares.
struct MeshRecord {
    MeshView arrays;
    std::vector<MaterialId> materials;  // by slot
};

/// A group seen through a matrix; a moving one is interpolated entry by entry.
struct InstanceRecord {
    Transform world_from_object0, world_from_object1;
    GroupId group = GroupId::root;
    bool moving = false;
};

/// A closed boundary and what fills it.
struct MediumRecord {
    GroupId boundary = GroupId::root;
    MaterialId phase = MaterialId::none;
    double density = 0;  // extinction, per world unit of length
};

/// What a foreign shape's intersection tells.
struct ForeignHit {
    double t = 0;
    Normal3 normal;          // outward, unit
    Normal3 shading_normal;  // zero: same as normal
    Vec3 position_error;     // beyond the rounding of origin + t direction
    double u = 0, v = 0;
    Uv uv;
    MaterialRef material;
    bool index_matched = false;
};

struct ForeignRecord {
    Box bounds;
    const Hittable* object = nullptr;
    bool (*hit)(const Hittable&, const Ray&, ForeignHit&) = nullptr;
};
static_assert(sizeof(ForeignRecord) == 64);

// ---- the whole -----------------------------------------------------------------------------------------------------

/// `count` primitives of one kind, in the order of description. For spheres, triangles, quads, foreign shapes: rows
/// first_row, first_row + 1, ... of their table. For a mesh, an instance or a medium: one row with `count` primitives.
/// `first_number` is the number of the first of them within the group.
struct PrimitiveRange {
    PrimitiveKind kind = PrimitiveKind::sphere;
    std::uint32_t first_row = 0;
    std::uint64_t first_number = 0;
    std::uint64_t count = 0;
};

struct GroupRecord {
    std::vector<PrimitiveRange> ranges;
    std::uint64_t primitives = 0;  // those of instanced groups counted once an instance
};

struct SceneRecords {
    std::vector<SphereRecord> spheres;  // still and moving
    std::vector<TriangleRecord> triangles;
    std::vector<QuadRecord> quads;
    std::vector<MeshRecord> meshes;
    std::vector<InstanceRecord> instances;
    std::vector<MediumRecord> media;
    std::vector<ForeignRecord> foreign;
    std::vector<GroupRecord> groups = std::vector<GroupRecord>(1);  // [0] is the scene itself
    std::vector<MaterialRecord> materials;
    std::vector<TextureRecord> textures;
    std::vector<std::shared_ptr<const Image>> images;
    std::vector<std::shared_ptr<const PerlinLattice>> lattices;
    std::vector<std::shared_ptr<const void>> kept;  // owners of what the records point to
};

}  // namespace limn
