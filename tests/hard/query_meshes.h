// Scenes for queries that count.
#pragma once

#include <string>
#include <vector>

#include "hard/exact_mesh.h"
#include "limn/scene/shape/constant_medium.h"
#include "limn/scene/shape/disk.h"

namespace limn::test {

inline CompiledScene compiled_mesh(const MeshData& data) {
    Scene scene;
    scene.add(std::make_shared<Mesh>(data, nullptr));
    return compile(scene);
}

inline bool same(const RayHit& a, const RayHit& b) {
    return a.t == b.t && a.object == b.object && a.element == b.element && a.u == b.u && a.v == b.v &&
           a.index_matched == b.index_matched && a.primitive == b.primitive;
}

/// Media, spheres, disks, instances, meshes and a ground that stands beside the tree.
inline ZooScene zoo_to_filter(Random& random) {
    std::vector<Object> objects{std::make_shared<Mesh>(icosphere(2), nullptr),
                                std::make_shared<Mesh>(u_shape(), nullptr),
                                make_box({-1, -1, -1}, {1, 1, 1}, nullptr),
                                ball({1, 0, 0}, 1),
                                ball({0, 1, 0}, -1),
                                std::make_shared<Disk>(Point3{0, 0, 0}, Vec3{1, 1, 1}, 2, nullptr),
                                std::make_shared<ConstantMedium>(ball({0, 0, 1}, 1), 1, Color{1, 1, 1}),
                                ball({0, -1e3, 0}, 998),
                                std::make_shared<Stranger>(ball({0, 0, 0}, 1.5))};
    for (int i = 0; i < 60; ++i) objects.push_back(random_instance(random, random_shape(random, random.index(5), 2)));
    return zoo_of("to filter", objects);
}

}  // namespace limn::test
