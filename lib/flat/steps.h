// The steps of compilation, each in a file of its own. compile.cpp calls them.
#pragma once

#include <memory>

#include "flat/scene.h"
#include "limn/math/hash128.h"
#include "limn/records/records.h"
#include "limn/scene/scene.h"

namespace limn::compiler {

// The digest of a scene covers everything that its pictures depend on. It is the same for every compiler, instruction
// set and number of threads.

// Returns the digest of a description without the matrices of its instances. \param records those of the scene's
// objects
Hash128 digest_of_unmoved(const SceneRecords& records, const limn::Scene& scene);

// Returns the digest of `unmoved_digest` and the matrices of the scene's instances.
Hash128 digest_of(const flat::Scene& scene);

// Sets the matrices of an instance and the fields that are computed from them.
void place_instance(flat::Instance& instance, const Transform& at_time0, const Transform& at_time1);

// Computes media, lights, features and the digest from the tables and trees. Releases the arrays of meshes whose
// vertices are in the trees.
void derive(flat::Scene& scene);

// Builds the tree of every BLAS. \pre the tables and the BLASes' ranges are filled
void build_trees(flat::Scene& scene);

// Builds the tree of one BLAS. Sets its root, bounds, extent, scale, packed_error and cost. For the root BLAS it also
// sets Scene::list. Throws ArgumentError if there are too many primitives.
// \pre the BLASes of its instances are built
void build_blas_tree(flat::Scene& scene, flat::Blas& blas);

// Fills Scene::media with every occurrence of a medium. \pre the trees are built
void place_media(flat::Scene& scene);

// Computes the tables for sampling directions towards a map. They are empty if it's black.
std::unique_ptr<const flat::Environment> tabulate(const EnvironmentMap& map);

// Fills Scene::lights with every emitter that can be sampled:
// - light sources and the environment map
// - up to 2^22 triangles, quads, disks and spheres whose material emits. Exceptions are materials with a user-defined
//   texture or opacity, and primitives in more than four moving instances. collect_lights.cpp has more exceptions for
//   spheres.
// All other emitters are found by scattering alone.
void collect_lights(flat::Scene& scene);

}  // namespace limn::compiler
