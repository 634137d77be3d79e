// One of a scene's lights.
#pragma once

#include "flat/scene.h"

namespace limn::test {

inline flat::Light light_of(const flat::Scene& scene, std::size_t rank, double time) {
    flat::Light room;
    return flat::light_at(scene, rank, time, room);
}

}  // namespace limn::test
