#include "bench/contender.h"

#include <hwy/targets.h>

#include "limn/core/error.h"
#include "limn/render/render.h"
#include "module.h"

namespace limn::bench {
namespace {

// limn by its public queries: ray by ray, or in batches.
class LimnSubject final : public Subject {
public:
    // \param batch the rays of each query; 0 for the query of a single ray
    // \param targets the instruction sets that limn may use
    LimnSubject(const std::string& subject_name, std::shared_ptr<const CompiledScene> scene, std::size_t batch,
                std::int64_t targets)
        : Subject(subject_name), scene_(std::move(scene)), batch_(batch), targets_(targets) {}

    void prepare(const RaySet& set) override {
        set_ = &set;
        hits_.assign(set.any ? 0 : set.rays.size(), {});
        occluded_.assign(set.any ? set.rays.size() : 0, 0);
    }

    void trace(std::size_t first, std::size_t count) override {
        hwy::GetChosenTarget().Update(targets_);
        const std::vector<Ray>& rays = set_->rays;
        const std::size_t end = first + count;
        if (batch_ != 0)
            for (std::size_t i = first; i < end; i += batch_) trace_batch(i, std::min(batch_, end - i));
        else if (set_->any)
            for (std::size_t i = first; i < end; ++i) occluded_[i] = scene_->any_hit(rays[i]) ? 1 : 0;
        else
            for (std::size_t i = first; i < end; ++i) hits_[i] = scene_->closest_hit(rays[i]).value_or(RayHit{});
    }

    Answer answer(std::size_t i) const override {
        if (set_->any) return {.t = occluded_[i] != 0 ? 0 : kInfinity};
        const RayHit& hit = hits_[i];
        return {.t = hit.t, .u = hit.u, .v = hit.v, .primitive = hit.primitive};
    }

private:
    void trace_batch(std::size_t first, std::size_t count) {
        const std::span<const Ray> rays = std::span(set_->rays).subspan(first, count);
        if (set_->any)
            scene_->any_hit(rays, std::span(occluded_).subspan(first, count));
        else
            scene_->closest_hit(rays, std::span(hits_).subspan(first, count));
    }

    const std::shared_ptr<const CompiledScene> scene_;
    const std::size_t batch_;
    const std::int64_t targets_;
    const RaySet* set_ = nullptr;
    std::vector<RayHit> hits_;
    std::vector<std::uint8_t> occluded_;
};

}  // namespace

BuiltScene build_limn(const Geometry& geometry, Clock clock) {
    const Scene description = describe(geometry);  // is not timed
    const double begin = seconds(clock);
    const auto scene = std::make_shared<const CompiledScene>(compile(description));
    BuiltScene built{.seconds = seconds(clock) - begin, .bytes = scene->stats().memory_bytes, .subjects = {}};
    const auto add = [&](const std::string& name, std::size_t batch, std::int64_t targets) {
        built.subjects.push_back(std::make_unique<LimnSubject>(name, scene, batch, targets));
    };
    const std::int64_t all = hwy::SupportedTargets(), better_than_avx2 = all & (HWY_AVX2 - 1);
    add("limn", 0, all);
    if (better_than_avx2 != 0) {
        add("AVX2", 0, all & ~better_than_avx2);
        add("AVX2 batch", 4096, all & ~better_than_avx2);
    }
    add("limn batch", 4096, all);
    for (const std::size_t size : {1, 8, 64, 65536}) add("limn batch " + std::to_string(size), size, all);
    return built;
}

std::vector<Contender> load_contenders(std::vector<std::string>& notes) {
    std::vector<Contender> contenders{{.name = "limn", .version = version(), .build = build_limn}};
    try {
        reinterpret_cast<AddContenders*>(app::load_module("limn_bench_embree"))(contenders);
    } catch (const Error& e) {
        notes.push_back(std::string("without Embree: ") + e.what());
    }
    return contenders;
}

}  // namespace limn::bench
