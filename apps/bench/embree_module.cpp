// Embree as a contender, in a module that `limn bench` loads if it is installed.
#include <embree3/rtcore.h>

#include <atomic>
#include <cstring>

#include "bench/embree_subjects.h"
#include "bench/peer_module.h"
#include "limn/core/error.h"
#include "module.h"

namespace limn::bench {

namespace {

// The memory that Embree holds, as its callback reports it.
std::atomic<std::ptrdiff_t> bytes_held{0};

bool count_bytes(void* /*user*/, ssize_t bytes, bool /*after*/) {
    bytes_held += bytes;
    return true;
}

RTCDevice device() {
    static const RTCDevice the_device = [] {
        const RTCDevice made = rtcNewDevice("set_affinity=0");
        if (!made) throw Error("Embree does not start");
        rtcSetDeviceMemoryMonitorFunction(made, count_bytes, nullptr);
        return made;
    }();
    return the_device;
}

class EmbreeScene final : public BuiltScene {
public:
    EmbreeScene(const Geometry& geometry, bool robust, std::string name, Clock clock)
        : name_(std::move(name)), flags_(robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE), scene_(new_scene()) {
        const std::ptrdiff_t before = bytes_held;
        // Setting up is not timed, and neither is limn's description. From there on all work is Embree's.
        RTCScene inner = geometry.mesh && !geometry.places.empty() ? new_scene() : nullptr;
        if (geometry.mesh) attach_mesh(geometry.mesh->data(), inner ? inner : scene_);
        if (!geometry.balls.empty()) attach_balls(geometry.balls);
        if (!geometry.quads.empty()) attach_quads(geometry.quads);
        for (const Transform& place : geometry.places) attach_instance(inner, place);
        const Stopwatch watch(clock);
        for (RTCGeometry g : geometries_) rtcCommitGeometry(g);
        if (inner) rtcCommitScene(inner);
        for (RTCGeometry g : instances_) rtcCommitGeometry(g);
        rtcCommitScene(scene_);
        seconds_ = watch.seconds();
        for (RTCGeometry g : geometries_) rtcReleaseGeometry(g);
        for (RTCGeometry g : instances_) rtcReleaseGeometry(g);
        if (inner) rtcReleaseScene(inner);  // the instances hold it
        bytes_ = static_cast<std::size_t>(bytes_held - before) + shared_bytes_;
        if (rtcGetDeviceError(device()) != RTC_ERROR_NONE) throw Error("Embree does not build " + geometry.name);
    }
    ~EmbreeScene() override { rtcReleaseScene(scene_); }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    double seconds() const override { return seconds_; }
    std::size_t bytes() const override { return bytes_; }
    std::vector<std::unique_ptr<Subject>> subjects() const override { return embree_subjects(name_, scene_); }

private:
    RTCScene new_scene() const {
        const RTCScene scene = rtcNewScene(device());
        rtcSetSceneFlags(scene, flags_);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
        return scene;
    }

    RTCGeometry new_geometry(RTCGeometryType type, RTCScene scene) {
        const RTCGeometry geometry = rtcNewGeometry(device(), type);
        rtcAttachGeometry(scene, geometry);
        (type == RTC_GEOMETRY_TYPE_INSTANCE ? instances_ : geometries_).push_back(geometry);
        return geometry;
    }

    void attach_mesh(const MeshData& mesh, RTCScene scene) {
        const RTCGeometry geometry = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE, scene);
        // Embree reads 16 bytes of the last vertex: an array of its own, which counts as if it were shared.
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Float3),
                                                 mesh.vertices.size());
        std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(Float3));
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                                   sizeof(Index3), mesh.triangles.size());
        shared_bytes_ += mesh.triangles.size() * sizeof(Index3);
    }

    void attach_balls(const std::vector<Ball>& balls) {
        const RTCGeometry geometry = new_geometry(RTC_GEOMETRY_TYPE_SPHERE_POINT, scene_);
        auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                               4 * sizeof(float), balls.size()));
        for (const Ball& ball : balls)
            for (const double x : {ball.center.x, ball.center.y, ball.center.z, ball.radius})
                *to++ = static_cast<float>(x);
    }

    void attach_quads(const std::vector<Parallelogram>& quads) {
        const RTCGeometry geometry = new_geometry(RTC_GEOMETRY_TYPE_QUAD, scene_);
        auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               sizeof(Float3), 4 * quads.size()));
        for (const Parallelogram& q : quads)
            for (const Point3& p : {q.corner, q.corner + q.edge_u, q.corner + q.edge_u + q.edge_v, q.corner + q.edge_v})
                for (const double x : {p.x, p.y, p.z}) *to++ = static_cast<float>(x);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), quads.size()));
        for (unsigned i = 0; i < 4 * quads.size(); ++i) index[i] = i;
    }

    void attach_instance(RTCScene inner, const Transform& place) {
        const RTCGeometry geometry = new_geometry(RTC_GEOMETRY_TYPE_INSTANCE, scene_);
        rtcSetGeometryInstancedScene(geometry, inner);
        float columns[12];
        for (std::size_t i = 0; i < 12; ++i) columns[i] = static_cast<float>(place.rows[i % 3][i / 3]);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    }

    std::string name_;
    RTCSceneFlags flags_;
    RTCScene scene_;
    std::vector<RTCGeometry> geometries_, instances_;
    double seconds_ = 0;
    std::size_t bytes_ = 0, shared_bytes_ = 0;
};

class EmbreeContender final : public Contender {
public:
    explicit EmbreeContender(bool robust) : robust_(robust) {}
    std::string name() const override { return robust_ ? "Embree robust" : "Embree"; }
    std::string version() const override { return RTC_VERSION_STRING; }
    std::unique_ptr<BuiltScene> build(const Geometry& geometry, Clock clock) const override {
        return std::make_unique<EmbreeScene>(geometry, robust_, name(), clock);
    }

private:
    bool robust_;
};

}  // namespace

}  // namespace limn::bench

extern "C" const char limn_module_id[] = LIMN_MODULE_ID;

extern "C" void limn_module(std::vector<std::shared_ptr<const limn::bench::Contender>>& peers) {
    for (const bool robust : {false, true}) peers.push_back(std::make_shared<limn::bench::EmbreeContender>(robust));
}
