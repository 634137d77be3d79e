#include "bench/embree_subjects.h"

#include <immintrin.h>

#include <algorithm>
#include <limits>

#include "bench/embree_queries.h"

namespace limn::bench {

namespace {

constexpr float kMiss = std::numeric_limits<float>::infinity();
// Sizes of streams, in rays, with which this processor is fastest.
constexpr std::size_t kStream = 64;

// Embree expects its callers to flush denormal numbers. limn must not be measured with that.
class FlushDenormals {
public:
    FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }  // FTZ and DAZ
    ~FlushDenormals() { _mm_setcsr(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned before_;
};

RTCIntersectContext context_for(const RaySet& set) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = set.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

struct Found {
    float t, u, v;
    unsigned primitive, geometry;
};

class EmbreeSubject : public Subject {
public:
    EmbreeSubject(std::string name, RTCScene scene) : Subject(std::move(name)), scene_(scene) {}

protected:
    RTCScene scene() const { return scene_; }
    const RaySet& set() const { return *set_; }
    void remember(const RaySet& set) { set_ = &set; }

    // An occluded ray comes back with tfar = -inf.
    static Answer any_answer(float t) { return {.t = t < 0 ? 0 : kInfinity}; }
    static Answer closest_answer(float t, float u, float v, unsigned primitive, unsigned geometry) {
        if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
        return {.t = static_cast<double>(t),
                .u = static_cast<double>(u),
                .v = static_cast<double>(v),
                .primitive = primitive};
    }

private:
    RTCScene scene_;
    const RaySet* set_ = nullptr;
};

// One ray at a time, or streams of them (kStreams).
template <bool kStreams>
class Single final : public EmbreeSubject {
public:
    using EmbreeSubject::EmbreeSubject;

    void prepare(const RaySet& set) override {
        remember(set);
        found_.assign(set.any ? 0 : set.rays.size(), {});
        occluded_.assign(set.any ? set.rays.size() : 0, 0.f);
        rays_.assign(set.rays.size(), {});
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            const limn::Ray& from = set.rays[i];
            RTCRay& to = rays_[i];
            const auto f = [](double x) { return static_cast<float>(x); };
            to.org_x = f(from.origin.x), to.org_y = f(from.origin.y), to.org_z = f(from.origin.z);
            to.dir_x = f(from.direction.x), to.dir_y = f(from.direction.y), to.dir_z = f(from.direction.z);
            to.tnear = f(from.t_min), to.tfar = f(from.t_max);
            to.mask = 0xffffffff;
            to.id = static_cast<unsigned>(i);
        }
    }

    void trace(std::size_t first, std::size_t count) override {
        const FlushDenormals flush;
        RTCIntersectContext context = context_for(set());
        const std::size_t end = first + count;
        if constexpr (kStreams) {
            if (set().any) {
                RTCRay rays[kStream];
                for (std::size_t i = first; i < end; i += kStream) {
                    const std::size_t n = std::min(kStream, end - i);
                    std::copy_n(&rays_[i], n, rays);
                    rtcOccluded1M(scene(), &context, rays, static_cast<unsigned>(n), sizeof(RTCRay));
                    for (std::size_t k = 0; k < n; ++k) occluded_[i + k] = rays[k].tfar;
                }
            } else {
                RTCRayHit rays[kStream];
                for (std::size_t i = first; i < end; i += kStream) {
                    const std::size_t n = std::min(kStream, end - i);
                    for (std::size_t k = 0; k < n; ++k) fill(rays[k], i + k);
                    rtcIntersect1M(scene(), &context, rays, static_cast<unsigned>(n), sizeof(RTCRayHit));
                    for (std::size_t k = 0; k < n; ++k) keep(rays[k], i + k);
                }
            }
        } else if (set().any) {
            for (std::size_t i = first; i < end; ++i) {
                RTCRay ray = rays_[i];
                rtcOccluded1(scene(), &context, &ray);
                occluded_[i] = ray.tfar;
            }
        } else {
            for (std::size_t i = first; i < end; ++i) {
                RTCRayHit ray;
                fill(ray, i);
                rtcIntersect1(scene(), &context, &ray);
                keep(ray, i);
            }
        }
    }

    Answer answer(std::size_t i) const override {
        if (set().any) return any_answer(occluded_[i]);
        const Found& f = found_[i];
        return closest_answer(f.t, f.u, f.v, f.primitive, f.geometry);
    }

private:
    void fill(RTCRayHit& to, std::size_t i) const {
        to.ray = rays_[i];
        to.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        to.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
    void keep(const RTCRayHit& from, std::size_t i) {
        found_[i] = {from.ray.tfar, from.hit.u, from.hit.v, from.hit.primID, from.hit.geomID};
    }

    std::vector<RTCRay> rays_;
    std::vector<Found> found_;
    std::vector<float> occluded_;
};

// Packets of so many lanes, one at a time or streams of them.
template <int kLanes, bool kStreams>
class Packets final : public EmbreeSubject {
public:
    using EmbreeSubject::EmbreeSubject;

    void prepare(const RaySet& set) override {
        remember(set);
        const std::size_t packets = (set.rays.size() + kWidth - 1) / kWidth;
        rays_.assign(packets, {});
        found_.assign(set.any ? 0 : packets, {});
        occluded_.assign(set.any ? packets * kWidth : 0, 0.f);
        for (std::size_t i = 0; i < packets * kWidth; ++i) {
            RaysOf& to = rays_[i / kWidth];
            const std::size_t k = i % kWidth;
            // A lane without a ray is one whose interval is empty.
            if (i >= set.rays.size()) {
                to.dir_x[k] = 1, to.tnear[k] = kMiss, to.tfar[k] = -kMiss;
                continue;
            }
            const limn::Ray& from = set.rays[i];
            const auto f = [](double x) { return static_cast<float>(x); };
            to.org_x[k] = f(from.origin.x), to.org_y[k] = f(from.origin.y), to.org_z[k] = f(from.origin.z);
            to.dir_x[k] = f(from.direction.x), to.dir_y[k] = f(from.direction.y), to.dir_z[k] = f(from.direction.z);
            to.tnear[k] = f(from.t_min), to.tfar[k] = f(from.t_max);
            to.mask[k] = 0xffffffff;
            to.id[k] = static_cast<unsigned>(i);
        }
    }

    void trace(std::size_t first, std::size_t count) override {
        const FlushDenormals flush;
        RTCIntersectContext context = context_for(set());
        const std::size_t begin = first / kWidth, end = (first + count + kWidth - 1) / kWidth;
        if constexpr (kStreams)
            trace_streams(context, begin, end);
        else
            trace_packets(context, begin, end);
    }

    Answer answer(std::size_t i) const override {
        if (set().any) return any_answer(occluded_[i]);
        const FoundOf& f = found_[i / kWidth];
        const std::size_t k = i % kWidth;
        return closest_answer(f.t[k], f.u[k], f.v[k], f.primitive[k], f.geometry[k]);
    }

private:
    using Packet = PacketOf<kLanes>;
    using RaysOf = typename Packet::Ray;
    using RayHits = typename Packet::RayHit;
    static constexpr std::size_t kWidth = kLanes;
    static constexpr std::size_t kPackets = kStream / kWidth;

    struct FoundOf {
        float t[kWidth], u[kWidth], v[kWidth];
        unsigned primitive[kWidth], geometry[kWidth];
    };

    void trace_packets(RTCIntersectContext& context, std::size_t begin, std::size_t end) {
        alignas(64) int all[kWidth], some[kWidth];
        for (std::size_t k = 0; k < kWidth; ++k) {
            all[k] = -1;
            some[k] = k < set().rays.size() % kWidth ? -1 : 0;
        }
        for (std::size_t p = begin; p < end; ++p) {
            const int* valid = (p + 1) * kWidth <= set().rays.size() ? all : some;
            if (set().any) {
                RaysOf rays = rays_[p];
                Packet::occluded(valid, scene(), &context, &rays);
                std::copy_n(rays.tfar, kWidth, &occluded_[p * kWidth]);
            } else {
                RayHits rays;
                fill(rays, p);
                Packet::intersect(valid, scene(), &context, &rays);
                keep(rays, p);
            }
        }
    }

    void trace_streams(RTCIntersectContext& context, std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; p += kPackets) {
            const std::size_t n = std::min(kPackets, end - p);
            if (set().any) {
                RaysOf rays[kPackets];
                std::copy_n(&rays_[p], n, rays);
                rtcOccludedNM(scene(), &context, reinterpret_cast<RTCRayN*>(rays), kLanes, static_cast<unsigned>(n),
                              sizeof(RaysOf));
                for (std::size_t k = 0; k < n; ++k) std::copy_n(rays[k].tfar, kWidth, &occluded_[(p + k) * kWidth]);
            } else {
                RayHits rays[kPackets];
                for (std::size_t k = 0; k < n; ++k) fill(rays[k], p + k);
                rtcIntersectNM(scene(), &context, reinterpret_cast<RTCRayHitN*>(rays), kLanes, static_cast<unsigned>(n),
                               sizeof(RayHits));
                for (std::size_t k = 0; k < n; ++k) keep(rays[k], p + k);
            }
        }
    }

    void fill(RayHits& to, std::size_t p) const {
        to.ray = rays_[p];
        std::fill_n(to.hit.geomID, kWidth, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(to.hit.instID[0], kWidth, RTC_INVALID_GEOMETRY_ID);
    }

    void keep(const RayHits& from, std::size_t p) {
        FoundOf& to = found_[p];
        std::copy_n(from.ray.tfar, kWidth, to.t);
        std::copy_n(from.hit.u, kWidth, to.u);
        std::copy_n(from.hit.v, kWidth, to.v);
        std::copy_n(from.hit.primID, kWidth, to.primitive);
        std::copy_n(from.hit.geomID, kWidth, to.geometry);
    }

    std::vector<RaysOf> rays_;
    std::vector<FoundOf> found_;
    std::vector<float> occluded_;
};

}  // namespace

std::vector<std::unique_ptr<Subject>> embree_subjects(const std::string& name, RTCScene scene) {
    std::vector<std::unique_ptr<Subject>> subjects;
    subjects.push_back(std::make_unique<Single<false>>(name, scene));
    subjects.push_back(std::make_unique<Packets<4, false>>(name + " 4", scene));
    subjects.push_back(std::make_unique<Packets<8, false>>(name + " 8", scene));
    subjects.push_back(std::make_unique<Packets<16, false>>(name + " 16", scene));
    subjects.push_back(std::make_unique<Single<true>>(name + " 1M", scene));
    subjects.push_back(std::make_unique<Packets<16, true>>(name + " 16M", scene));
    return subjects;
}

}  // namespace limn::bench
