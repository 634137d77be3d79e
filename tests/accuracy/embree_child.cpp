// The child process that asks Embree: see embree_protocol.h. Single-threaded; killed by the rays that kill it.
#include <embree3/rtcore.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "accuracy/embree_protocol.h"

namespace {

using namespace limn::accuracy;

class Scenes {
public:
    Scenes() : device_(rtcNewDevice("threads=1,set_affinity=0")) {}

    void build(const EmbreeTalk& talk) {
        for (std::uint32_t mode = 0; mode < kModes; ++mode) {
            if (scenes_[mode]) rtcReleaseScene(scenes_[mode]);
            const RTCSceneFlags flags = mode == 1 ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
            scenes_[mode] = talk.has_transform ? instanced(talk, flags) : plain(talk, flags);
        }
    }

    EmbreeAnswer trace(const EmbreeRay& question, std::uint32_t mode) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit r{};
        r.ray.org_x = question.origin[0], r.ray.org_y = question.origin[1], r.ray.org_z = question.origin[2];
        r.ray.dir_x = question.direction[0], r.ray.dir_y = question.direction[1], r.ray.dir_z = question.direction[2];
        r.ray.tnear = question.t_min, r.ray.tfar = question.t_max;
        r.ray.mask = 0xffffffff;
        r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scenes_[mode], &context, &r);
        if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {std::numeric_limits<float>::infinity(), 0, 0, 0};
        return {r.ray.tfar, r.hit.u, r.hit.v, r.hit.primID};
    }

private:
    RTCScene plain(const EmbreeTalk& talk, RTCSceneFlags flags) const {
        const RTCGeometryType type = talk.corners == 1   ? RTC_GEOMETRY_TYPE_SPHERE_POINT
                                     : talk.corners == 3 ? RTC_GEOMETRY_TYPE_TRIANGLE
                                                         : RTC_GEOMETRY_TYPE_QUAD;
        const std::size_t width = talk.corners == 1 ? 4 : 3;
        RTCGeometry geometry = rtcNewGeometry(device_, type);
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                 width == 4 ? RTC_FORMAT_FLOAT4 : RTC_FORMAT_FLOAT3,
                                                 width * sizeof(float), talk.vertex_count);
        std::copy_n(talk.vertices, width * talk.vertex_count, static_cast<float*>(vertices));
        if (talk.corners > 1) {
            void* indices = rtcSetNewGeometryBuffer(
                geometry, RTC_BUFFER_TYPE_INDEX, 0, talk.corners == 3 ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT4,
                talk.corners * sizeof(std::uint32_t), talk.index_count / talk.corners);
            std::copy_n(talk.indices, talk.index_count, static_cast<std::uint32_t*>(indices));
        }
        return committed(geometry, flags);
    }

    RTCScene instanced(const EmbreeTalk& talk, RTCSceneFlags flags) const {
        RTCScene inner = plain(talk, flags);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, inner);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, talk.transform);
        rtcReleaseScene(inner);  // the instance holds it
        return committed(geometry, flags);
    }

    RTCScene committed(RTCGeometry geometry, RTCSceneFlags flags) const {
        rtcCommitGeometry(geometry);
        RTCScene scene = rtcNewScene(device_);
        rtcSetSceneFlags(scene, flags);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
        return scene;
    }

    RTCDevice device_;
    RTCScene scenes_[kModes] = {};
};

}  // namespace

int main() {
    void* memory = mmap(nullptr, sizeof(EmbreeTalk), PROT_READ | PROT_WRITE, MAP_SHARED, kSharedMemory, 0);
    if (memory == MAP_FAILED) {
        std::fputs("limn_accuracy_embree: is started by limn_accuracy\n", stderr);
        return 2;
    }
    EmbreeTalk& talk = *static_cast<EmbreeTalk*>(memory);
    Scenes scenes;
    for (char order; read(STDIN_FILENO, &order, 1) == 1;) {
        if (order == kBuildScene) {
            scenes.build(talk);
        } else {
            for (std::uint32_t next; (next = talk.progress) < talk.ray_count * kModes; talk.progress = next + 1)
                talk.answers[next % kModes][next / kModes] = scenes.trace(talk.rays[next / kModes], next % kModes);
        }
        if (write(STDOUT_FILENO, &kDone, 1) != 1) return 1;
    }
}
