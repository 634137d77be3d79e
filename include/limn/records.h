/// \file
/// The intermediate representation: plain records that described objects write for the compiler. They hold numbers and
/// ids, no behaviour. A program that describes scenes and derives classes needs none of them. Whoever writes them keeps
/// what they point to alive through `RecordSink::keep`.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
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
namespace bsdf {
struct AlbedoTable;
struct Lobe;
}  // namespace bsdf

/// Rows of the tables of SceneRecords.
///@{
enum class TextureId : std::uint32_t { none = 0xffffffff };
enum class MaterialId : std::uint32_t { none = 0xffffffff };
/// The scene itself, the object of an instance, or the boundary of a medium.
enum class BlasId : std::uint32_t { root = 0 };
///@}

// ---- textures ------------------------------------------------------------------------------------------------------

/// The built-in textures, and user-defined ones.
enum class TextureKind : std::uint8_t { solid, checker, image, noise, turbulence, marble, user_defined };

/// One texture; each field is of the kinds named beside it.
struct TextureRecord {
    TextureKind kind = TextureKind::solid;                     ///< decides which fields count
    Filter filter = Filter::bilinear;                          ///< image
    Wrap wrap = Wrap::repeat;                                  ///< image
    std::uint32_t data = 0;                                    ///< image, noises: row of the images or lattices
    TextureId even = TextureId::none;                          ///< checker
    TextureId odd = TextureId::none;                           ///< checker
    double scale = 1;                                          ///< checker: side of a cell; noises: frequency
    Color color;                                               ///< solid: the colour; noises: multiplies
    const Texture* object = nullptr;                           ///< user-defined; not owning
    Color (*value)(const Texture&, const Surface&) = nullptr;  ///< user-defined: what to call on it
};
static_assert(sizeof(TextureRecord) == 64);

// ---- materials -----------------------------------------------------------------------------------------------------

/// On which sides of a surface a lamp shines: on that of the outward normal, which is the front, or the other.
enum class Sides : std::uint8_t { both, front, back };

/// Whether the side that a ray comes from shines.
constexpr bool shines(Sides sides, bool front_face) {
    return sides == Sides::both || (sides == Sides::front) == front_face;
}

/// How to call a user-defined material.
struct MaterialThunks {
    /// Material::emitted, Material::sample and Material::value.
    ///@{
    Color (*emitted)(const Material&, const Surface&);
    std::optional<ScatterSample> (*sample)(const Material&, const Surface&, const Vec3& out, const Random3&);
    ScatterValue (*value)(const Material&, const Surface&, const Vec3& out, const Vec3& in);
    ///@}
};

/// The `kind` of user-defined materials.
inline constexpr std::string_view kUserDefinedMaterial = "user-defined";

/// What some materials say beside albedo and parameter.
struct MaterialDetails {
    static constexpr std::size_t kNumbers = 6;  ///< at most

    /// Of the lobe, which says which is which: numbers, a second texture (none: white), and the albedos of its
    /// microsurface, where it has one.
    ///@{
    std::array<double, kNumbers> numbers{};
    TextureId texture = TextureId::none;
    std::shared_ptr<const bsdf::AlbedoTable> albedo_table{}, coat_albedo_table{};
    ///@}

    TextureId normal_map = TextureId::none;  ///< of all lobes: what bends the shading normal, see NormalMap
    TextureId opacity = TextureId::none;     ///< of all lobes: how much light the surface stops, see AlphaMask
    double opacity_cutoff = 0;               ///< over 0: all where the opacity is at least that, none elsewhere
    bool tangents = false;                   ///< asks for Surface::dp_du and dp_dv
};

/// One material.
struct MaterialRecord {
    std::string_view kind = "";              ///< "lambertian", "diffuse-light", ...; of static lifetime
    const bsdf::Lobe* lobe = nullptr;        ///< how it scatters; null: it absorbs all light
    TextureId texture = TextureId::none;     ///< albedo, which scales what the lobe scatters; none: white
    TextureId emission = TextureId::none;    ///< radiance; none: it does not emit
    Sides sides = Sides::both;               ///< that emit
    double parameter = 0;                    ///< of the lobe: what the material says
    Fresnel fresnel = Fresnel::exact;        ///< dielectric
    bool specular = false;                   ///< Material::value is zero for all directions
    const Material* object = nullptr;        ///< user-defined; not owning
    const MaterialThunks* thunks = nullptr;  ///< user-defined: how to call it; of static lifetime
    std::shared_ptr<const MaterialDetails> details = nullptr;  ///< null: it says no more
};

// ---- shapes --------------------------------------------------------------------------------------------------------

/// What can be hit, or entered: the tables of SceneRecords.
enum class PrimitiveKind : std::uint8_t {
    sphere,
    moving_sphere,
    triangle,
    quad,
    mesh,
    instance,
    medium,
    user_defined,
    disk
};

/// Centre moves on a straight line from center0 at time 0 to center1 at time 1.
struct SphereRecord {
    /// A negative radius turns the normal inward.
    ///@{
    Point3 center0, center1;
    double radius = 1;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(SphereRecord) == 64);

/// A flat triangle; the outward normal is (b - a) x (c - a).
struct TriangleRecord {
    /// Vertices, not on one line, and what they are made of.
    ///@{
    Point3 a, b, c;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(TriangleRecord) == 80);

/// corner + u edge_u + v edge_v, u and v in [0, 1]; the outward normal is edge_u x edge_v.
struct QuadRecord {
    /// The edges are neither zero nor parallel.
    ///@{
    Point3 corner;
    Vec3 edge_u, edge_v;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(QuadRecord) == 80);

/// The points of the plane through center across normal, as far as radius from it; the normal, of any length, points
/// outward.
struct DiskRecord {
    /// The normal is not zero, the radius above 0.
    ///@{
    Point3 center;
    Vec3 normal;
    double radius = 1;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(DiskRecord) == 64);

/// Arrays that the mesh's owner shares.
struct MeshRecord {
    MeshView arrays;                      ///< valid as long as the owner
    std::vector<MaterialId> materials;    ///< by slot; at least one
    std::shared_ptr<const void> owner{};  ///< of the arrays; RecordSink::mesh sets it
};

/// An instanced subtree seen through a matrix; a moving matrix is interpolated entry by entry.
struct InstanceRecord {
    /// The matrices at time 0 and 1, the same for a still instance; `blas` is another one than root.
    ///@{
    Transform world_from_object0, world_from_object1;
    BlasId blas = BlasId::root;
    bool moving = false;
    ///@}
};

/// A closed boundary and what fills it.
struct MediumRecord {
    BlasId boundary = BlasId::root;       ///< another one than root
    MaterialId phase = MaterialId::none;  ///< the phase function, with the albedo
    double density = 0;                   ///< extinction, per world unit of length
};

/// The hit of a user-defined shape: as Hit, but for the form of material and uv.
struct UserDefinedHit {
    double t = 0;                ///< in units of the ray's direction
    Normal3 normal;              ///< geometric, outward, unit
    Normal3 shading_normal;      ///< zero: same as normal
    Vec3 position_error;         ///< beyond the rounding of origin + t direction
    double u = 0;                ///< surface parameter
    double v = 0;                ///< surface parameter
    Uv uv;                       ///< texture coordinates
    MaterialRef material;        ///< none: black
    bool index_matched = false;  ///< the boundary of a medium
};

/// A user-defined shape.
struct UserDefinedRecord {
    Box bounds;                                                           ///< Hittable::bounds
    const Hittable* object = nullptr;                                     ///< not owning
    bool (*hit)(const Hittable&, const Ray&, UserDefinedHit&) = nullptr;  ///< Hittable::hit on it; false: a miss
};
static_assert(sizeof(UserDefinedRecord) == 64);

// ---- lights that are no shapes -------------------------------------------------------------------------------------

/// How a light record shines.
enum class LightSourceKind : std::uint8_t { point, spot, directional, sun };

/// A light without a shape: see limn/scene/lights.h.
struct LightRecord {
    LightSourceKind kind = LightSourceKind::point;  ///< decides which fields count
    Color color;                                    ///< point, spot: intensity; directional, sun: irradiance
    Point3 position;                                ///< point, spot
    Vec3 direction;                                 ///< unit, into which it shines; of all but a point
    double cos_inner = 1;                           ///< spot: of the angle up to which it has all of its intensity
    double cos_outer = 0;                           ///< spot: of the angle from which on it has none
    double one_minus_cos = 0;                       ///< sun: 1 - cos of its angular radius
};

/// An equirectangular map: see EnvironmentMap.
struct EnvironmentRecord {
    std::shared_ptr<const Image> image{};  ///< null: there is none
    Transform world_from_map{};            ///< turns and mirrors only
    double scale = 1;                      ///< of the radiance
};

// ---- the whole -----------------------------------------------------------------------------------------------------

/// `count` primitives of one kind, in the order of description. For a mesh, an instance or a medium: one row with
/// `count` primitives. For the others: rows first_row, first_row + 1, ... of their table.
/// `first_number` is the index of the first of them within the BLAS.
struct PrimitiveRange {
    /// As said above.
    ///@{
    PrimitiveKind kind = PrimitiveKind::sphere;
    std::uint32_t first_row = 0;
    std::uint64_t first_number = 0;
    std::uint64_t count = 0;
    ///@}
};

/// What one tree is built over, a bottom-level acceleration structure.
struct BlasRecord {
    std::vector<PrimitiveRange> ranges;  ///< in the order of description
    std::uint64_t primitives = 0;        ///< those of instanced BLASes counted once an instance
};

/// All records of one scene.
struct SceneRecords {
    /// The tables that ranges and ids are rows of. Still and moving spheres share one.
    ///@{
    std::vector<SphereRecord> spheres;
    std::vector<TriangleRecord> triangles;
    std::vector<QuadRecord> quads;
    std::vector<DiskRecord> disks;
    std::vector<MeshRecord> meshes;
    std::vector<InstanceRecord> instances;
    std::vector<MediumRecord> media;
    std::vector<UserDefinedRecord> user_defined;
    std::vector<MaterialRecord> materials;
    std::vector<TextureRecord> textures;
    std::vector<std::shared_ptr<const Image>> images;
    std::vector<std::shared_ptr<const PerlinLattice>> lattices;
    std::vector<LightRecord> lights;
    ///@}

    EnvironmentRecord environment;                                ///< in place of the background, if it has an image
    std::vector<BlasRecord> blases = std::vector<BlasRecord>(1);  ///< row 0 is the scene itself
    std::vector<std::shared_ptr<const void>> kept;                ///< owners of what the records point to
    std::vector<std::string> tags;  ///< of user-defined objects, in the order of description
    bool untagged = false;          ///< whether there are such objects without one
};

}  // namespace limn
