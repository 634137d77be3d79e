// The lights of a scene, and the tree by which one of many is chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "flat/lights.h"
#include "limn/math/transform.h"

namespace limn::flat {

// A range of planar lights and the instances that contain it. It saves the lights of the range from being stored: they
// are computed when they are used. A large mesh is stored so, and planar shapes that move with an instance.
struct LightPlace {
    std::uint32_t range = 0;           // row of Scene::ranges
    std::uint32_t first_instance = 0;  // row of LightTable::instances; the outermost instance is first
    std::uint32_t instance_count = 0;  // 0 if no instance moves; the matrices are used then
    bool transformed = false;          // true if the matrices are not the identity
    std::uint64_t first_number = 0;    // number in the scene of the first primitive of the range
    Transform world_from_object, object_from_world;
};

// Refers to a light in a table.
struct LightRef {
    static constexpr std::uint32_t kOwn = 0xffffffff;
    std::uint32_t place = kOwn;  // row of LightTable::places, or kOwn
    std::uint32_t element = 0;   // index in the range of the place, or row of LightTable::own
};

// A node of the light tree, which bounds the lights below it. The box is rounded outward.
struct LightNode {
    float center[3], half[3];  // half of the box's sides
    float axis[3];             // see Cone
    float cos_spread;
    float strength;       // see LightBounds; divided by the sum over all lights
    std::uint32_t end;    // one past the last rank of its lights; its first rank is `end` of the node to the left
    std::uint32_t right;  // its second child, or 0 for a leaf; the first child is the next node
};
static_assert(sizeof(LightNode) == 52);

// The rank of the light that is a primitive.
struct LightNumber {
    std::uint64_t number;  // number of the primitive in the scene
    std::uint32_t rank;
};

// A light that is infinitely far away.
struct DistantLight {
    Light light;
    DistantBounds bounds;
};
// A ray that hits distant light k reports kFirstDistant + k as the number of the primitive.
inline constexpr std::uint64_t kFirstDistant = std::uint64_t{1} << 63;

// All lights. The rank of a light is its position in the order of the tree's leaves. The ranks of distant lights follow
// those of the tree, in the order of `distant`.
struct LightTable {
    std::vector<Light> own;                // lights that are stored as they are
    std::vector<LightPlace> places;        // where the other lights are computed from
    std::vector<std::uint32_t> instances;  // rows of Scene::instances
    std::vector<LightRef> refs;            // by rank
    std::vector<double> strength_before;   // by rank, sums of the strengths before it, from 0 to 1; one more at the end
    std::vector<std::uint32_t> guide;    // [k]: the last rank with strength_before <= k / size(), for k = 0 ... size()
    std::vector<LightNode> nodes;        // none for a single light
    std::vector<LightNumber> by_number;  // ascending
    double strength = 0;                 // sum of the strengths of the tree's lights before they were divided by it
    std::vector<DistantLight> distant;

    std::size_t size() const { return refs.size(); }  // number of lights in the tree
    bool empty() const { return refs.empty() && distant.empty(); }
};

struct Scene;

// Returns SurfaceLight::side.
//
// \param mirrored true if the light's outside is the shape's inside
std::int8_t side_of(Sides sides, bool mirrored);

// Returns true if a texture is the same everywhere.
bool is_plain(const Scene& scene, TextureId texture);

// Returns the light of a rank at a time. A light that moves or is not stored is written to `room`, and the result
// refers to `room`. Otherwise it refers to the table. \pre rank < size of the tree plus number of distant lights
const Light& light_at(const Scene& scene, std::size_t rank, double time, Light& room);

// Returns a planar light of a range under a matrix.
PlanarLight planar_light(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, const Transform& m,
                         const Transform& inverse_of_m);

}  // namespace limn::flat
