/// \file
/// limn's intermediate representation: plain records of numbers and ids, without behaviour. The shapes, materials and
/// textures of a Scene write records to a RecordSink, and compile() builds the compiled scene from them. A program
/// needs records only if a class of its own overrides `lower`.
///
/// Raw pointers and spans in a record don't own what they point to. The code that writes the record gives the owner to
/// RecordSink::keep.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limn/image/image.h"
#include "limn/image/lookup.h"
#include "limn/math/box.h"
#include "limn/math/color.h"
#include "limn/math/mesh_view.h"
#include "limn/math/perlin_lattice.h"
#include "limn/math/surface.h"
#include "limn/math/transform.h"
#include "limn/math/vec.h"

namespace limn {

class Hittable;
class Texture;
namespace bsdf {
struct AlbedoTable;
struct Lobe;
}  // namespace bsdf

/// The row of a texture in SceneRecords::textures. `none` refers to no texture.
enum class TextureId : std::uint32_t { none = 0xffffffff };
/// The row of a material in SceneRecords::materials. `none` refers to no material.
enum class MaterialId : std::uint32_t { none = 0xffffffff };
/// The row of a bottom-level acceleration structure (BLAS) in SceneRecords::blases. `root` is the scene itself. Every
/// other BLAS holds the object of an instance or the boundary of a medium.
enum class BlasId : std::uint32_t { root = 0 };

// ---- textures ------------------------------------------------------------------------------------------------------

/// The kind of a texture: one of limn's own, or a class of the user.
enum class TextureKind : std::uint8_t { solid, checker, image, noise, turbulence, marble, user_defined };

/// One texture. The comment of a field names the kinds that use it. "Perlin" means noise, turbulence and marble.
struct TextureRecord {
    TextureKind kind = TextureKind::solid;                     ///< decides which of the other fields are used
    Filter filter = Filter::bilinear;                          ///< image: interpolation between texels
    Wrap wrap = Wrap::repeat;                                  ///< image: lookup outside [0, 1]
    std::uint32_t data = 0;                                    ///< image: row of the images; Perlin: of the lattices
    TextureId even = TextureId::none;                          ///< checker: texture of the even cells
    TextureId odd = TextureId::none;                           ///< checker: texture of the odd cells
    double scale = 1;                                          ///< checker: side of a cell; Perlin: cells per unit
    Color color;                                               ///< solid: the colour; Perlin: factor of the noise
    const Texture* object = nullptr;                           ///< user_defined: the texture; not owning
    Color (*value)(const Texture&, const Surface&) = nullptr;  ///< user_defined: calls Texture::value of `object`
};
static_assert(sizeof(TextureRecord) == 64);

// ---- materials -----------------------------------------------------------------------------------------------------

/// The sides of a surface that emit light. The front is the side of the outward normal.
enum class Sides : std::uint8_t { both, front, back };

/// Returns true if `sides` includes the side that a ray comes from. `front_face` is true if that side is the front.
constexpr bool emits_on(Sides sides, bool front_face) {
    return sides == Sides::both || (sides == Sides::front) == front_face;
}

/// Functions that call a user-defined material.
struct MaterialThunks {
    /// Calls the virtual function of the same name: Material::emitted, Material::sample or Material::value.
    ///@{
    Color (*emitted)(const Material&, const Surface&);
    std::optional<ScatterSample> (*sample)(const Material&, const Surface&, const Vec3& out, const Random3&);
    ScatterValue (*value)(const Material&, const Surface&, const Vec3& out, const Vec3& in);
    ///@}
};

/// MaterialRecord::kind of every user-defined material.
inline constexpr std::string_view kUserDefinedMaterial = "user-defined";

/// The parameters of a lobe as a list of numbers. Every material with such parameters declares a struct that names them
/// in the order of the list, for example Metal::Parameters.
struct LobeParameters {
    static constexpr std::size_t kMost = 6;  ///< the most parameters that a lobe can have

    std::array<double, kMost> numbers{};  ///< the parameters, followed by zeros

    LobeParameters() = default;
    /// Stores the parameters of a struct.
    template <template <class> class Named>
    LobeParameters(const Named<double>& named) {
        static_assert(sizeof(named) <= sizeof(numbers) && sizeof(named) % sizeof(double) == 0);
        std::memcpy(numbers.data(), &named, sizeof(named));
    }
    /// Returns the parameters by name. \pre they were stored from the same struct
    template <template <class> class Named>
    Named<double> as() const {
        Named<double> named;
        std::memcpy(&named, numbers.data(), sizeof(named));
        return named;
    }
};

/// One material.
struct MaterialRecord {
    std::string_view kind = "";              ///< "lambertian", "diffuse-light", ...; of static lifetime
    const bsdf::Lobe* lobe = nullptr;        ///< functions that scatter; null: the surface absorbs all light
    TextureId albedo = TextureId::none;      ///< albedo, reflectance or base colour; none: white
    TextureId factors = TextureId::none;     ///< colour that multiplies parameters of the lobe; none: white
    TextureId emission = TextureId::none;    ///< emitted radiance; none: the surface doesn't emit
    TextureId normal_map = TextureId::none;  ///< texture that bends the shading normal, see NormalMap; none: not bent
    TextureId opacity = TextureId::none;     ///< texture whose red is the opacity, see AlphaMask; none: opaque
    Sides sides = Sides::both;               ///< sides that emit
    bool specular = false;                   ///< true if Material::value is zero for all directions
    bool uses_tangents = false;              ///< true if the material uses Surface::dp_du and Surface::dp_dv
    double opacity_cutoff = 0;               ///< above 0: opaque if opacity >= opacity_cutoff, else fully transparent
    LobeParameters parameters{};             ///< parameters of the lobe
    std::shared_ptr<const bsdf::AlbedoTable> albedo_table{};       ///< albedos of its microfacets; null: not used
    std::shared_ptr<const bsdf::AlbedoTable> coat_albedo_table{};  ///< albedos of a MetallicRoughness's coat
    const Material* object = nullptr;                              ///< user-defined: the material; not owning
    const MaterialThunks* thunks = nullptr;  ///< user-defined: functions that call `object`; of static lifetime
};

// ---- shapes --------------------------------------------------------------------------------------------------------

/// The kind of a primitive. Each kind has a table in SceneRecords; still and moving spheres share one.
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

/// A sphere whose centre moves on a straight line from center0 at time 0 to center1 at time 1.
struct SphereRecord {
    /// A negative radius turns the normal inward.
    ///@{
    Point3 center0, center1;
    double radius = 1;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(SphereRecord) == 64);

/// A flat triangle. Its outward normal is (b - a) x (c - a).
struct TriangleRecord {
    /// The vertices are not collinear.
    ///@{
    Point3 a, b, c;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(TriangleRecord) == 80);

/// The parallelogram corner + u edge_u + v edge_v with u and v in [0, 1]. Its outward normal is edge_u x edge_v.
struct QuadRecord {
    /// The edges are neither zero nor parallel.
    ///@{
    Point3 corner;
    Vec3 edge_u, edge_v;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(QuadRecord) == 80);

/// The disk around `center` in the plane perpendicular to `normal`.
struct DiskRecord {
    /// The normal points outward. It has any length but zero. The radius is above 0.
    ///@{
    Point3 center;
    Vec3 normal;
    double radius = 1;
    MaterialId material = MaterialId::none;
    ///@}
};
static_assert(sizeof(DiskRecord) == 64);

/// A triangle mesh. The record refers to the arrays of the described mesh and shares their ownership.
struct MeshRecord {
    MeshView arrays;                      ///< valid while `owner` exists
    std::vector<MaterialId> materials;    ///< by material slot; at least one
    std::shared_ptr<const void> owner{};  ///< owner of the arrays; RecordSink::mesh sets it
};

/// An instance: a BLAS placed by an affine transform. A moving transform is interpolated entry by entry.
struct InstanceRecord {
    /// The matrices at time 0 and at time 1. They are equal if `moving` is false. `blas` is never the root.
    ///@{
    Transform world_from_object0, world_from_object1;
    BlasId blas = BlasId::root;
    bool moving = false;
    ///@}
};

/// A homogeneous medium inside a closed boundary.
struct MediumRecord {
    BlasId boundary = BlasId::root;       ///< never the root
    MaterialId phase = MaterialId::none;  ///< phase function, including the single-scattering albedo
    double density = 0;                   ///< extinction per world unit of length
};

/// The hit of a user-defined shape. It holds what Hit holds, with the material and the texture coordinates in the form
/// that compiled code uses.
struct UserDefinedHit {
    double t = 0;                ///< ray parameter, in units of the ray's direction
    Normal3 normal;              ///< geometric normal, outward, unit
    Normal3 shading_normal;      ///< interpolated normal, unit; zero: same as `normal`
    Vec3 position_error;         ///< bound on the error of the hit point, beyond the rounding of origin + t direction
    double u = 0;                ///< surface parameter
    double v = 0;                ///< surface parameter
    Uv uv;                       ///< texture coordinates
    MaterialRef material;        ///< none: black
    bool index_matched = false;  ///< true for the boundary of a medium
};

/// A user-defined shape.
struct UserDefinedRecord {
    Box bounds;                                                           ///< Hittable::bounds of `object`
    const Hittable* object = nullptr;                                     ///< the shape; not owning
    bool (*hit)(const Hittable&, const Ray&, UserDefinedHit&) = nullptr;  ///< calls Hittable::hit; false for a miss
};
static_assert(sizeof(UserDefinedRecord) == 64);

// ---- the whole -----------------------------------------------------------------------------------------------------

/// A run of consecutive primitives of one kind in a BLAS. A mesh, an instance or a medium is a range of its own: it has
/// one row, and `count` is the number of its triangles or of the primitives of its BLAS. A range of any other kind has
/// one row for each primitive: first_row, first_row + 1, ...
struct PrimitiveRange {
    PrimitiveKind kind = PrimitiveKind::sphere;  ///< decides the table that `first_row` refers to
    std::uint32_t first_row = 0;                 ///< row of the first primitive
    std::uint64_t first_number = 0;              ///< index of the first primitive within the BLAS
    std::uint64_t count = 0;                     ///< number of primitives
};

/// The primitives of one BLAS, over which one tree is built.
struct BlasRecord {
    std::vector<PrimitiveRange> ranges;  ///< in the order of description
    std::uint64_t primitives = 0;        ///< number of primitives; an instanced one counts for each instance
};

/// All records of one scene.
struct SceneRecords {
    /// A table of records. Ranges and ids refer to its rows. Still and moving spheres share one table.
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
    ///@}

    std::vector<BlasRecord> blases = std::vector<BlasRecord>(1);  ///< row 0 is the scene itself
    std::vector<std::shared_ptr<const void>> kept;                ///< owners of what the records point to
    std::vector<std::string> tags;  ///< Tagged::tag of the user-defined objects, in the order of description
    bool untagged = false;          ///< true if a user-defined object has no tag
};

}  // namespace limn
