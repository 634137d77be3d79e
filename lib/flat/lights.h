// Emitters that can be sampled, and the tree by which one of many is chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "limn/math/box.h"
#include "limn/math/transform.h"
#include "limn/math/vec.h"
#include "limn/records/records.h"

namespace limn::flat {

// Below this solid angle (in steradians) the inversion that places samples has lost two thirds of its digits: such a
// light is small or seen almost edge-on, and gives little light however it is sampled.
inline constexpr double kSmallSolidAngle = 1e-5;
// From so many radii away a point drawn by area is as good as one by solid angle: the density per solid angle goes with
// the cube of the distance (the height over the plane is the same for all its points), so it varies by
// ((1 + 1/3) / (1 - 1/3))^3 = 8 at the very most, mostly by far less. Measured on figures 12 and 15: 1.5 to 4 are the
// same within 3 %, and never by area takes a sixth more time per error on figure 15.
inline constexpr double kFarSquared = 3.0 * 3.0;

// A patch: a part of a parallelogram, as its primitive says. From `point` on they are rows of Scene::light_sources, and
// from `directional` on they are infinitely far away; the last one is Scene::environment.
enum class LightKind : std::uint8_t {
    triangle,
    parallelogram,
    rectangle,
    sphere,
    patch,
    point,
    spot,
    directional,
    sun,
    environment
};

// Lights without extent count as if they filled this solid angle (in steradians), so little that light sampling has all
// the weight against scattering, which never finds them. A power of two: nothing is rounded by it.
inline constexpr double kNoSolidAngle = 0x1p-100;

// An emitter in world space.
struct Light {
    LightKind kind = LightKind::triangle;
    PrimitiveKind primitive = PrimitiveKind::quad;
    bool textured = false;  // its radiance is not the same everywhere
    std::int8_t side = 0;   // that shines: 1: of edge_u x edge_v, outside; -1: the other, inside; 0: both
    MaterialId material = MaterialId::none;
    std::uint64_t number = 0;  // of its primitive; its row in Scene::light_sources
    Point3 origin;             // a triangle's first vertex, a patch's corner, a sphere's centre at time 0; a point
    Vec3 edge_u, edge_v;  // of triangle and patch; of a sphere edge_u is the motion of its centre; of a directional
                          // light or sun edge_u is the unit direction towards it
    double radius = 0;    // of a sphere; of a sun 1 - cos of its angular radius
    double share = 1;     // of planar ones: how much of the parallelogram they are
    Vec3 position_error;  // of points computed on it
};

// Emitters of one range where instances put it, whose numbers are those of the range: triangles of a large mesh, and
// planar shapes that instances move.
struct LightPlace {
    std::uint32_t range = 0;           // row of Scene::ranges
    std::uint32_t first_instance = 0;  // in LightTable::instances; outermost first
    std::uint32_t instance_count = 0;  // 0 where nothing moves: then the matrices count
    bool transformed = false;          // the matrices are not the identity
    std::uint64_t first_number = 0;
    Transform world_from_object, object_from_world;
};

struct LightRef {
    static constexpr std::uint32_t kOwn = 0xffffffff;  // a place: `element` is a row of LightTable::own
    std::uint32_t place = kOwn;
    std::uint32_t element = 0;
};

// Of spheres, which look alike from everywhere, in place of the cosine of the spread.
inline constexpr float kNoNormals = -1;

// Some lights, in a box, and the directions of their planes' normals, in a cone around an axis and its opposite. The
// box is rounded outward.
struct LightNode {
    float center[3], half[3];  // half of the box's sides
    float axis[3];
    float cos_spread;     // of the cone's angle, at most a right one, where normals go anywhere; or kNoNormals
    float strength;       // sum of radiance times area, or of the disc that a sphere is seen as; in all 1
    std::uint32_t end;    // of its lights' ranks; they begin where those of the node to the left end
    std::uint32_t right;  // its second child, the first one being the next node; 0 in a leaf
};
static_assert(sizeof(LightNode) == 52);

struct LightNumber {
    std::uint64_t number;  // of the primitive
    std::uint32_t rank;
};

// A light that is infinitely far away, and how much of it is expected at a receiver.
struct DistantLight {
    Light light;
    double irradiance;  // of a plane across its direction; of the environment the mean over all planes
    double spread;      // sine of its angular radius
};
// What stands for the number of a primitive where a ray meets the distant light [k]: this and k.
inline constexpr std::uint64_t kFirstDistant = std::uint64_t{1} << 63;

// Lights are known by their rank: their place in the order of the tree's leaves, and behind them that in `distant`.
struct LightTable {
    std::vector<Light> own;
    std::vector<LightPlace> places;
    std::vector<std::uint32_t> instances;  // rows of Scene::instances
    std::vector<LightRef> refs;            // by rank
    std::vector<double> strength_before;   // sums of the strengths by rank, from 0 to 1; one more than there are lights
    std::vector<std::uint32_t> guide;    // [k]: the last rank with strength_before at most k / size(), k = 0 ... size()
    std::vector<LightNode> nodes;        // none for a single light
    std::vector<LightNumber> by_number;  // ascending
    double strength = 0;                 // of all in the tree, before it became 1: radiance times area
    std::vector<DistantLight> distant;

    std::size_t size() const { return refs.size(); }  // of those in the tree
    bool empty() const { return refs.empty() && distant.empty(); }
};

struct Scene;

// Light::side, of a light whose normal is the opposite of the shape's outward one if it is mirrored.
std::int8_t side_of(Sides sides, bool mirrored);

// Whether a texture is the same everywhere.
bool is_plain(const Scene& scene, TextureId texture);

// Of all that it covers while the shutter is open.
Box bounds_of(const Light& light);

// A point of a planar one by area, as weights of the edges.
Uv sample_area(const Light& light, double u, double v);

// The light of a rank as it stands at a time: of the table, or made in `room`. \pre there is such a light
const Light& light_at(const Scene& scene, std::size_t rank, double time, Light& room);

// A planar one of a place under a matrix; without edges where the primitive is not planar.
Light planar_light(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, const Transform& m,
                   const Transform& inverse_of_m);

}  // namespace limn::flat
