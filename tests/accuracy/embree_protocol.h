// How limn_accuracy and its child limn_accuracy_embree talk: a block of shared memory holds question and answers, a
// byte down one pipe says that there is work, a byte up the other that it is done. A child that dies over a ray leaves
// in `progress` which one it was.
#pragma once

#include <atomic>
#include <cstdint>

#include "accuracy/question.h"

namespace limn::accuracy {

inline constexpr int kSharedMemory = 3;                              // the file descriptor in the child
inline constexpr char kBuildScene = 's', kTrace = 't', kDone = 'd';  // the bytes
inline constexpr std::uint32_t kMaxVertices = 65536, kMaxIndices = 131072;
inline constexpr std::uint32_t kModes = 2;  // default, robust

struct EmbreeRay {
    float origin[3], direction[3], t_min, t_max;
};
struct EmbreeAnswer {
    float t, u, v;  // t: infinity for a miss
    std::uint32_t primitive;
};

struct EmbreeTalk {
    // The scene: a sphere (x, y, z, radius) if there are no indices, else triangles or quads.
    std::uint32_t vertex_count, index_count, corners;  // corners of a face: 1, 3 or 4
    std::uint32_t has_transform;
    float transform[12];  // rows of three, column by column
    float vertices[4 * kMaxVertices];
    std::uint32_t indices[kMaxIndices];

    std::uint32_t ray_count;
    std::atomic<std::uint32_t> progress;  // ray * kModes + mode that comes next
    EmbreeRay rays[kBatch];
    EmbreeAnswer answers[kModes][kBatch];
};

}  // namespace limn::accuracy
