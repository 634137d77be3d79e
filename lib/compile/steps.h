// What compile.cpp takes one after the other, in files of their own.
#pragma once

#include "flat/scene.h"
#include "limn/core/hash128.h"
#include "limn/records.h"
#include "limn/scene/background.h"

namespace limn::compiler {

// Of all that a scene's pictures depend on: the same from every compiler, instruction set and number of threads. The
// first of all but where instances stand, the second of that and the scene's instances.
Hash128 digest_of_unmoved(const SceneRecords& records, const Background& background);
Hash128 digest_of(const flat::Scene& scene);

// Sets its matrices and what follows from them.
void place_instance(flat::Instance& instance, const Transform& at_time0, const Transform& at_time1);

// What follows from the tables, the trees and where instances stand: media, lights, features, the digest. Gives up
// arrays that the trees repeat.
void derive(flat::Scene& scene);

// Builds the tree of every BLAS. \pre the tables and the BLASes' ranges are filled
void build_trees(flat::Scene& scene);

// Of that, the tree over the primitives of one BLAS: the BLAS of an instance, or the scene's own. Sets the BLAS's
// root, bounds, extent and scale; of the scene itself Scene::list, too. The BLASes of its instances are built already.
// \throws ArgumentError if there are too many
void build_blas_tree(flat::Scene& scene, flat::Blas& blas);

// Lists every medium where instances put it. \pre the trees are built
void place_media(flat::Scene& scene);

// Fills the tables by which directions towards the map are drawn; none where all is black.
void tabulate(const EnvironmentRecord& record, flat::Environment& environment);

// Fills scene.lights with every emitter that can be sampled: the sources, the environment, and of a diffuse light
// meshes, triangles, quads, disks and spheres, not under more than four moving instances, spheres not under one that
// bends them, none with a user-defined texture. What is left out is found by scattering alone.
void collect_lights(flat::Scene& scene);

}  // namespace limn::compiler
