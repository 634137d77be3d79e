#include "bench/session.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>

#include "bench/limn_contender.h"
#include "bench/scenes.h"

namespace limn::bench {

namespace {

// Small scenes are built so fast that a few rounds say little. They get more rounds, until so many seconds are spent,
// or so many rounds.
constexpr double kLeastBuilding = 0.05;
constexpr int kMostBuilds = 200;

bool is_batch(const std::string& subject) { return subject.starts_with("limn "); }

bool is_robust(const std::string& name) { return name.ends_with("robust"); }

// The names of Embree's modes are longer than that of its scene. Single rays of the default scene count too: if they
// are fastest, they are its best mode.
bool is_peer_mode(const std::string& subject) { return subject.starts_with("Embree") && !is_robust(subject); }

const Timing* fastest(const std::vector<Timing>& timings, bool (*counts)(const std::string&)) {
    const Timing* best = nullptr;
    for (const Timing& t : timings)
        if (counts(t.subject) && !t.seconds.empty() &&
            (best == nullptr || spread_of(t.seconds).median < spread_of(best->seconds).median))
            best = &t;
    return best;
}

class Session {
public:
    Session(const Plan& plan, const std::vector<std::shared_ptr<const Contender>>& peers, const Watch& watch)
        : plan_(plan), peers_(peers), watch_(watch) {}

    std::vector<SceneResult> run() {
        for (const std::string& name : plan_.scenes)
            if (goes_on()) measure_scene([&] { return make_scene(name, plan_.scale); });
        for (const std::string& path : plan_.models)
            if (goes_on()) measure_scene([&] { return load_scene(path); });
        return std::move(results_);
    }

private:
    bool goes_on() {
        const auto scenes = static_cast<double>(plan_.scenes.size() + plan_.models.size());
        going_ = going_ && watch_((static_cast<double>(scenes_done_) + part_) / scenes);
        return going_;
    }

    template <class Make>
    void measure_scene(const Make& make) {
        part_ = 0;
        const Geometry geometry = make();
        SceneResult& result = results_.emplace_back();
        result.name = geometry.name;
        result.primitives = stored_primitives(geometry);
        measure_builds(geometry, result);
        if (goes_on()) measure_rays(geometry, result);
        ++scenes_done_;
    }

    void measure_builds(const Geometry& geometry, SceneResult& result) {
        const LimnContender limn;
        for (const int threads : plan_.threads) {
            // This limits what Embree does in an arena of its own, too.
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
            BuildRow& row = result.builds.emplace_back();
            row.threads = threads;
            std::vector<const Contender*> builders{&limn};
            for (const auto& peer : peers_)
                if (!is_robust(peer->name())) builders.push_back(peer.get());  // which builds as its plain scene does
            for (const Contender* builder : builders)
                row.timings.push_back({.subject = builder->name(), .seconds = {}, .mismatches = 0});
            const Clock clock = threads == 1 ? Clock::process : Clock::wall;
            double spent = 0;
            for (int round = 0; round < plan_.build_rounds || spent < kLeastBuilding; ++round) {
                if (plan_.build_rounds == 0 || round == kMostBuilds) break;
                for (std::size_t i = 0; i < builders.size() && goes_on(); ++i) {
                    const double seconds = builders[i]->build(geometry, clock)->seconds();
                    spent += seconds;
                    row.timings[i].seconds.push_back(seconds);
                }
                if (!going_) break;
            }
        }
    }

    void measure_rays(const Geometry& geometry, SceneResult& result) {
        const LimnScene limn(describe(geometry));
        std::vector<std::unique_ptr<BuiltScene>> built;
        std::vector<std::unique_ptr<Subject>> subjects = limn.subjects();
        result.bytes.emplace_back("limn", limn.bytes());
        for (const auto& peer : peers_) {
            built.push_back(peer->build(geometry, Clock::wall));
            result.bytes.emplace_back(peer->name(), built.back()->bytes());
            auto more = built.back()->subjects();
            // Of the robust scene single rays are enough.
            if (is_robust(peer->name())) more.resize(1);
            for (auto& subject : more) subjects.push_back(std::move(subject));
        }
        std::vector<RaySet> sets = make_rays(geometry, limn.compiled(), plan_.rays);
        if (!plan_.kinds.empty())
            std::erase_if(sets, [&](const RaySet& set) {
                return std::find(plan_.kinds.begin(), plan_.kinds.end(), set.name) == plan_.kinds.end();
            });
        const auto measurements =
            static_cast<double>(sets.size() * plan_.threads.size() * subjects.size()) * (plan_.rounds + 1);
        for (const RaySet& set : sets) {
            for (const int threads : plan_.threads) {
                if (!goes_on()) return;
                RayRow& row = result.rows.emplace_back();
                row.rays = set.name, row.count = set.rays.size(), row.any = set.any, row.threads = threads;
                row.timings = measure(subjects, set, threads, plan_.rounds, [&] {
                    part_ += 1 / measurements;
                    return goes_on();
                });
                for (std::size_t i = 1; i < row.timings.size(); ++i)
                    if (is_batch(row.timings[i].subject))
                        row.differences += differences(*subjects[0], *subjects[i], set.rays.size());
            }
        }
    }

    const Plan& plan_;
    const std::vector<std::shared_ptr<const Contender>>& peers_;
    const Watch& watch_;
    std::vector<SceneResult> results_;
    std::size_t scenes_done_ = 0;
    double part_ = 0;  // of the scene's measurements that is done
    bool going_ = true;
};

}  // namespace

const Timing* RayRow::find(const std::string& subject) const {
    const auto found =
        std::find_if(timings.begin(), timings.end(), [&](const Timing& t) { return t.subject == subject; });
    return found == timings.end() || found->seconds.empty() ? nullptr : &*found;
}

const Timing* RayRow::best_batch() const { return fastest(timings, is_batch); }
const Timing* RayRow::best_peer() const { return fastest(timings, is_peer_mode); }

double RayRow::million_a_second(const Timing& timing) const {
    return static_cast<double>(count) / spread_of(timing.seconds).median * 1e-6;
}

std::vector<SceneResult> run_session(const Plan& plan, const std::vector<std::shared_ptr<const Contender>>& peers,
                                     const Watch& watch) {
    return Session(plan, peers, watch).run();
}

}  // namespace limn::bench
