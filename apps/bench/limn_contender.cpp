#include "bench/limn_contender.h"

namespace limn::bench {

namespace {

// Results have the form of the public queries.
class LimnSubject : public Subject {
public:
    LimnSubject(std::string name, const CompiledScene& scene, std::size_t chunk = 4096)
        : Subject(std::move(name), chunk), scene_(scene) {}

    void prepare(const RaySet& set) override {
        set_ = &set;
        hits_.assign(set.any ? 0 : set.rays.size(), {});
        occluded_.assign(set.any ? set.rays.size() : 0, 0);
    }

    Answer answer(std::size_t i) const override {
        if (set_->any) return {.t = occluded_[i] != 0 ? 0 : kInfinity};
        const RayHit& hit = hits_[i];
        return {.t = hit.t, .u = hit.u, .v = hit.v, .primitive = hit.primitive};
    }

protected:
    const CompiledScene& scene() const { return scene_; }
    const RaySet& set() const { return *set_; }
    std::vector<RayHit>& hits() { return hits_; }
    std::vector<std::uint8_t>& occluded() { return occluded_; }

private:
    const CompiledScene& scene_;
    const RaySet* set_ = nullptr;
    std::vector<RayHit> hits_;
    std::vector<std::uint8_t> occluded_;
};

class Single final : public LimnSubject {
public:
    using LimnSubject::LimnSubject;

    void trace(std::size_t first, std::size_t count) override {
        const Ray* const rays = set().rays.data();
        if (set().any) {
            for (std::size_t i = first; i < first + count; ++i) occluded()[i] = scene().any_hit(rays[i]) ? 1 : 0;
        } else {
            for (std::size_t i = first; i < first + count; ++i)
                hits()[i] = scene().closest_hit(rays[i]).value_or(RayHit{});
        }
    }
};

class Batch final : public LimnSubject {
public:
    using LimnSubject::LimnSubject;

    void trace(std::size_t first, std::size_t count) override {
        const std::span<const Ray> rays = std::span(set().rays).subspan(first, count);
        if (set().any)
            scene().any_hit(rays, std::span(occluded()).subspan(first, count));
        else
            scene().closest_hit(rays, std::span(hits()).subspan(first, count));
    }
};

}  // namespace

LimnScene::LimnScene(const Scene& scene, Clock clock)
    : watch_(clock), scene_(compile(scene)), seconds_(watch_.seconds()) {}

std::vector<std::unique_ptr<Subject>> LimnScene::subjects() const {
    std::vector<std::unique_ptr<Subject>> subjects;
    subjects.push_back(std::make_unique<Single>("limn", scene_));
    subjects.push_back(std::make_unique<Batch>("limn batch", scene_, 4096));
    subjects.push_back(std::make_unique<Batch>("limn whole", scene_, std::size_t{1} << 16));
    return subjects;
}

std::unique_ptr<BuiltScene> LimnContender::build(const Geometry& geometry, Clock clock) const {
    return std::make_unique<LimnScene>(describe(geometry), clock);
}

}  // namespace limn::bench
