// Embree as a contender of `limn bench`, which loads this module if it is installed.
#include <embree3/rtcore.h>
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>

#include "bench/contender.h"
#include "limn/math/error.h"
#include "module.h"

namespace limn::bench {
namespace {

alignas(64) constexpr int kAllLanes[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

// Traces rays in packets of kLanes. One lane means single rays. With kStreams it traces streams of 64 rays. Embree
// overwrites rays with results, so trace() copies the packets that prepare() has made.
template <int kLanes, bool kStreams>
class EmbreeSubject final : public Subject {
public:
    EmbreeSubject(const std::string& subject_name, std::shared_ptr<RTCSceneTy> scene)
        : Subject(subject_name), scene_(std::move(scene)) {}

    void prepare(const RaySet& set) override {
        set_ = &set;
        packets_.assign((set.rays.size() + kWidth - 1) / kWidth, {});
        t_.assign(packets_.size(), {});
        hits_.assign(set.any ? 0 : packets_.size(), {});
        // Lanes beyond the last ray repeat it.
        for (std::size_t i = 0; i < packets_.size() * kWidth; ++i) {
            const limn::Ray& from = set.rays[std::min(i, set.rays.size() - 1)];
            RTCRayNt<kLanes>& to = packets_[i / kWidth];
            const std::size_t k = i % kWidth;
            const Float3 origin = to_float3(from.origin), direction = to_float3(from.direction);
            to.org_x[k] = origin.x;
            to.org_y[k] = origin.y;
            to.org_z[k] = origin.z;
            to.dir_x[k] = direction.x;
            to.dir_y[k] = direction.y;
            to.dir_z[k] = direction.z;
            to.tnear[k] = static_cast<float>(from.t_min);
            to.tfar[k] = static_cast<float>(from.t_max);
            to.mask[k] = 0xffffffff;
        }
    }

    void trace(std::size_t first, std::size_t count) override {
        // Flush denormal numbers (FTZ and DAZ), as Embree expects. The mode is restored below for limn.
        const unsigned before = _mm_getcsr();
        _mm_setcsr(before | 0x8040);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = set_->coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        const std::size_t end = (first + count + kWidth - 1) / kWidth;
        for (std::size_t p = first / kWidth; p < end; p += kPackets) {
            const std::size_t packets = std::min(kPackets, end - p);
            alignas(64) Rays rays[kPackets];
            for (std::size_t k = 0; k < packets; ++k) {
                rays[k].ray = packets_[p + k];
                if (set_->any) continue;
                std::fill_n(rays[k].hit.geomID, kWidth, RTC_INVALID_GEOMETRY_ID);
                std::fill_n(rays[k].hit.instID[0], kWidth, RTC_INVALID_GEOMETRY_ID);
            }
            ask(context, rays, packets);
            for (std::size_t k = 0; k < packets; ++k) {
                std::copy_n(rays[k].ray.tfar, kWidth, t_[p + k].data());
                if (!set_->any) hits_[p + k] = rays[k].hit;
            }
        }
        _mm_setcsr(before);
    }

    RayHit answer(std::size_t i) const override {
        const std::size_t p = i / kWidth, k = i % kWidth;
        const double t = static_cast<double>(t_[p][k]);
        if (set_->any) return {.t = t < 0 ? 0 : kInfinity};  // Embree sets tfar = -inf for a hit
        return {.t = hits_[p].geomID[k] == RTC_INVALID_GEOMETRY_ID ? kInfinity : t};
    }

private:
    static constexpr std::size_t kWidth = kLanes;
    static constexpr std::size_t kPackets = kStreams ? 64 / kWidth : 1;  // packets of a call of Embree

    using Rays = RTCRayHitNt<kLanes>;

    // Calls Embree with packets of the type Rays. For any-hit queries Embree reads only their member `ray`.
    void ask(RTCIntersectContext& context, void* rays, std::size_t packets) const {
        const RTCScene scene = scene_.get();
        const bool any = set_->any;
        if constexpr (kStreams) {
            const auto n = static_cast<unsigned>(packets);
            any ? rtcOccludedNM(scene, &context, static_cast<RTCRayN*>(rays), kLanes, n, sizeof(Rays))
                : rtcIntersectNM(scene, &context, static_cast<RTCRayHitN*>(rays), kLanes, n, sizeof(Rays));
        } else if constexpr (kLanes == 1) {
            any ? rtcOccluded1(scene, &context, static_cast<RTCRay*>(rays))
                : rtcIntersect1(scene, &context, static_cast<RTCRayHit*>(rays));
        } else if constexpr (kLanes == 4) {
            any ? rtcOccluded4(kAllLanes, scene, &context, static_cast<RTCRay4*>(rays))
                : rtcIntersect4(kAllLanes, scene, &context, static_cast<RTCRayHit4*>(rays));
        } else if constexpr (kLanes == 8) {
            any ? rtcOccluded8(kAllLanes, scene, &context, static_cast<RTCRay8*>(rays))
                : rtcIntersect8(kAllLanes, scene, &context, static_cast<RTCRayHit8*>(rays));
        } else {
            any ? rtcOccluded16(kAllLanes, scene, &context, static_cast<RTCRay16*>(rays))
                : rtcIntersect16(kAllLanes, scene, &context, static_cast<RTCRayHit16*>(rays));
        }
    }

    const std::shared_ptr<RTCSceneTy> scene_;
    const RaySet* set_ = nullptr;
    std::vector<RTCRayNt<kLanes>> packets_;
    std::vector<std::array<float, kWidth>> t_;
    std::vector<RTCHitNt<kLanes>> hits_;  // empty for any-hit queries
};

// The bytes of memory that Embree uses, as its memory monitor reports them.
std::atomic<std::ptrdiff_t> bytes_held{0};

RTCDevice device() {
    static const RTCDevice the_device = [] {
        const RTCDevice made = rtcNewDevice("set_affinity=0");
        if (!made) throw Error("Embree does not start");
        const auto count = [](void* /*user*/, ssize_t bytes, bool /*after*/) {
            bytes_held += bytes;
            return true;
        };
        rtcSetDeviceMemoryMonitorFunction(made, count, nullptr);
        return made;
    }();
    return the_device;
}

using ScenePointer = std::shared_ptr<RTCSceneTy>;

ScenePointer new_scene(RTCSceneFlags flags) {
    const RTCScene scene = rtcNewScene(device());
    rtcSetSceneFlags(scene, flags);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    return {scene, rtcReleaseScene};
}

// Commits the geometry and adds it to the scene, which then owns it.
void attach(const ScenePointer& scene, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
}

// Copies the values to a new buffer. Embree allocates it with padding, because it reads 16 bytes of the last vertex.
void set_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const auto& values) {
    void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(values[0]), values.size());
    std::memcpy(buffer, values.data(), values.size() * sizeof(values[0]));
}

void attach_faces(const ScenePointer& scene, RTCGeometryType type, const std::vector<Float3>& vertices,
                  RTCFormat face_format, const auto& faces) {
    const RTCGeometry geometry = rtcNewGeometry(device(), type);
    set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
    set_buffer(geometry, RTC_BUFFER_TYPE_INDEX, face_format, faces);
    attach(scene, geometry);
}

void attach_quads(const ScenePointer& scene, const std::vector<Parallelogram>& quads) {
    std::vector<Float3> corners;
    std::vector<std::array<unsigned, 4>> faces;
    for (unsigned i = 0; const auto& [p, u, v] : quads) {
        for (const Point3& corner : {p, p + u, p + u + v, p + v}) corners.push_back(to_float3(corner));
        faces.push_back({i, i + 1, i + 2, i + 3});
        i += 4;
    }
    attach_faces(scene, RTC_GEOMETRY_TYPE_QUAD, corners, RTC_FORMAT_UINT4, faces);
}

void attach_balls(const ScenePointer& scene, const std::vector<Ball>& balls) {
    std::vector<std::array<float, 4>> points;
    for (const Ball& ball : balls) {
        const Float3 center = to_float3(ball.center);
        points.push_back({center.x, center.y, center.z, static_cast<float>(ball.radius)});
    }
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, points);
    attach(scene, geometry);
}

void attach_instance(const ScenePointer& scene, const ScenePointer& inner, const Transform& place) {
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, inner.get());
    float columns[12];
    for (std::size_t i = 0; i < 12; ++i) columns[i] = static_cast<float>(place.rows[i % 3][i / 3]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    attach(scene, geometry);
}

// Builds a scene with the subjects of Embree, or with the single subject of robust Embree.
template <bool kRobust>
BuiltScene build(const Geometry& geometry, Clock clock) {
    constexpr RTCSceneFlags kFlags = kRobust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
    // Set up the geometries. This is not timed.
    const std::ptrdiff_t before = bytes_held;
    const ScenePointer scene = new_scene(kFlags), inner = geometry.places.empty() ? scene : new_scene(kFlags);
    if (geometry.mesh) {
        const MeshData& mesh = geometry.mesh->data();
        attach_faces(inner, RTC_GEOMETRY_TYPE_TRIANGLE, mesh.vertices, RTC_FORMAT_UINT3, mesh.triangles);
    }
    if (!geometry.balls.empty()) attach_balls(scene, geometry.balls);
    if (!geometry.quads.empty()) attach_quads(scene, geometry.quads);
    for (const Transform& place : geometry.places) attach_instance(scene, inner, place);
    // Build.
    const double begin = seconds(clock);
    if (inner != scene) rtcCommitScene(inner.get());
    rtcCommitScene(scene.get());
    BuiltScene built{.seconds = seconds(clock) - begin, .bytes = 0, .subjects = {}};
    if (rtcGetDeviceError(device()) != RTC_ERROR_NONE) throw Error("Embree does not build " + geometry.name);
    built.bytes = static_cast<std::size_t>(bytes_held - before);
    // Make the subjects.
    built.subjects.push_back(std::make_unique<EmbreeSubject<1, false>>(kRobust ? "Embree robust" : "Embree", scene));
    if (kRobust) return built;
    built.subjects.push_back(std::make_unique<EmbreeSubject<4, false>>("Embree 4", scene));
    built.subjects.push_back(std::make_unique<EmbreeSubject<8, false>>("Embree 8", scene));
    built.subjects.push_back(std::make_unique<EmbreeSubject<16, false>>("Embree 16", scene));
    built.subjects.push_back(std::make_unique<EmbreeSubject<1, true>>("Embree 1M", scene));
    built.subjects.push_back(std::make_unique<EmbreeSubject<16, true>>("Embree 16M", scene));
    return built;
}

}  // namespace
}  // namespace limn::bench

extern "C" const char limn_module_id[] = LIMN_MODULE_ID;

extern "C" void limn_module(std::vector<limn::bench::Contender>& contenders) {
    contenders.push_back({.name = "Embree", .version = RTC_VERSION_STRING, .build = limn::bench::build<false>});
    contenders.push_back({.name = "Embree robust", .version = RTC_VERSION_STRING, .build = limn::bench::build<true>});
}
