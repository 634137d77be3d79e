// The extinction along one ray, from boundaries whose stretches are known.
#include "render/media.h"

#include <map>

#include "property.h"
#include "support/pictures.h"

namespace limn::media_along_ray_test {

using namespace test;
using transport::FreeFlight;
using transport::MediaAlongRay;

namespace {

// A medium from x0 to x1, wide enough to hold every ray below.
struct Slab {
    double x0, x1, density;
    double albedo = 0;  // of one colour; the others have half of it
};

Object medium_of(const Slab& s) {
    return std::make_shared<ConstantMedium>(make_box({s.x0, -100, -100}, {s.x1, 100, 100}, nullptr), s.density,
                                            Color{s.albedo / 2, s.albedo, s.albedo / 2});
}

struct Case {
    std::vector<Slab> slabs;
    CompiledScene scene;
    Ray ray;

    // In units of x: t of the ray times its direction's x.
    double begin() const { return ray.origin.x + ray.t_min * ray.direction.x; }
    double end() const { return ray.t_max == kInfinity ? kInfinity : ray.origin.x + ray.t_max * ray.direction.x; }

    // Optical depth from the ray's begin to x, in scattering and in all.
    struct Depth {
        double scattering = 0, all = 0;
    };
    Depth depth_to(double x) const {
        const double slant = length(ray.direction) / ray.direction.x;
        Depth depth;
        for (const Slab& s : slabs) {
            const double part = s.density * slant * std::max(0.0, std::min({x, s.x1, end()}) - std::max(begin(), s.x0));
            depth.scattering += s.albedo * part, depth.all += part;
        }
        return depth;
    }
};

// Up to four slabs, beside, within and across each other, seen from anywhere; the phase function of slab i has row i.
Case random_case(std::uint64_t seed) {
    Random random(seed);
    std::vector<Slab> slabs;
    std::vector<Object> objects;
    for (std::size_t i = 0; i < 1 + random.index(4); ++i) {
        const double x0 = random.uniform(0, 4);
        const double albedo = random.chance(0.2) ? 0 : random.uniform(0.3, 1);
        slabs.push_back({x0, x0 + random.uniform(0.1, 4), random.uniform(0.1, 1.2), albedo});
        objects.push_back(medium_of(slabs.back()));
    }
    Ray ray{.origin = {random.uniform(-2, 6), random.uniform(-1, 1), random.uniform(-1, 1)},
            .direction = random.log_uniform(0.1, 10) * Vec3{1, random.uniform(-1, 1), random.uniform(-1, 1)}};
    if (random.chance(0.3)) ray.t_min = random.uniform(0, 2) / ray.direction.x;
    if (random.chance(0.5)) ray.t_max = ray.t_min + random.uniform(0, 6) / ray.direction.x;
    return {slabs, compile_with(sky(0), objects), ray};
}

}  // namespace

TEST_CASE("Media along a ray: the transmittance is exp(- the sum of density times length)", "[render][media]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        MediaAlongRay media;
        media.trace(c.scene.flat(), c.ray);
        const double truth = std::exp(-c.depth_to(kInfinity).all);
        RC_ASSERT(std::abs(media.transmittance() - truth) <= 1e-12);
        media.trace(c.scene.flat(), c.ray);  // as often as one likes
        RC_ASSERT(std::abs(media.transmittance() - truth) <= 1e-12);
    });
}

TEST_CASE("Media along a ray: a flight ends at the optical depth in scattering that was asked for, or not at all",
          "[render][media]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        MediaAlongRay media;
        media.trace(c.scene.flat(), c.ray);
        Random random(seed + 1);
        for (int i = 0; i < 5; ++i) {
            const double depth = -std::log(1 - random.uniform());
            const Case::Depth all = c.depth_to(kInfinity);
            const FreeFlight flight = media.sample(depth, random.uniform());
            if (std::abs(depth - all.scattering) < 1e-9) continue;
            RC_ASSERT(flight.scatters == (depth < all.scattering));
            if (!flight.scatters) {
                RC_ASSERT(std::abs(flight.depth - all.scattering) <= 1e-9);
                RC_ASSERT(std::abs(flight.weight - std::exp(all.scattering - all.all)) <= 1e-9);
                continue;
            }
            RC_ASSERT(flight.t > c.ray.t_min && flight.t <= c.ray.t_max);
            const Case::Depth there = c.depth_to(c.ray.origin.x + flight.t * c.ray.direction.x);
            RC_ASSERT(std::abs(there.scattering - depth) <= 1e-9);
            // The medium's extinction over its scattering, which the albedo makes good.
            double albedo = 0;
            for (std::size_t k = 0; k < c.slabs.size(); ++k)
                if (c.scene.flat().medium_shapes[k].phase == flight.phase) albedo = c.slabs[k].albedo;
            RC_ASSERT(std::abs(flight.weight * albedo - std::exp(there.scattering - there.all)) <= 1e-8);
        }
    });
}

TEST_CASE("Media along a ray: the flight that scatters at a place is the one that ends there", "[render][media]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        MediaAlongRay media;
        media.trace(c.scene.flat(), c.ray);
        Random random(seed + 1);
        const double depth = random.uniform(0, 2), choose = random.uniform();
        const FreeFlight flight = media.sample(depth, choose);
        if (!flight.scatters) RC_DISCARD("no flight ends");
        const double x = c.ray.origin.x + flight.t * c.ray.direction.x;
        double scattering = 0;
        for (const Slab& s : c.slabs) {
            if (std::min(std::abs(x - s.x0), std::abs(x - s.x1)) < 1e-9) RC_DISCARD("at a boundary");
            if (x > s.x0 && x < s.x1) scattering += s.density * s.albedo;
        }
        RC_ASSERT(std::abs(flight.density - scattering * std::exp(-depth)) <= 1e-9);
        const FreeFlight same = media.scatter_at(flight.t, choose);
        RC_ASSERT(same.scatters && same.t == flight.t && same.phase == flight.phase);
        RC_ASSERT(std::abs(same.weight - flight.weight) <= 1e-9 * flight.weight);
        RC_ASSERT(std::abs(same.density - flight.density) <= 1e-9);
        RC_ASSERT(!media.scatter_at(100 / c.ray.direction.x, choose).scatters);
    });
}

TEST_CASE("Media along a ray: light is scattered from the first medium that does, down to the depth that is asked for",
          "[render][media]") {
    const CompiledScene scene =
        compile_with(sky(0), {medium_of({1, 2, 1, 0}), medium_of({3, 4, 1, 0.5}), medium_of({6, 8, 0.5, 1})});
    MediaAlongRay media;
    media.trace(scene.flat(), {.origin = {0, 0, 0}, .direction = {0.5, 0, 0}});
    const auto check = [&](double deepest, double from, double to) {
        const auto stretch = media.scattering_stretch(deepest, 3);
        REQUIRE(stretch.has_value());
        CHECK(stretch->from == Approx(2 * from).epsilon(1e-13));
        CHECK(stretch->to == Approx(2 * to).epsilon(1e-13));
    };
    CHECK(!media.scattering_stretch(0.75, 3));
    check(1.25, 3, 3.25);
    check(2.25, 3, 6.5);
    check(10, 3, 8);
}

TEST_CASE("Media along a ray: of the media at the end of a flight each is chosen by its share of the scattering there",
          "[render][media]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        MediaAlongRay media;
        media.trace(c.scene.flat(), c.ray);
        Random random(seed + 1);
        const double depth = random.uniform();
        if (!media.sample(depth, 0).scatters) RC_DISCARD("no flight ends");
        constexpr int kChoices = 200;
        std::map<MaterialId, int> counts;
        double t = 0;
        for (int i = 0; i < kChoices; ++i) {
            const FreeFlight flight = media.sample(depth, (i + 0.5) / kChoices);
            RC_ASSERT(i == 0 || flight.t == t);
            t = flight.t;
            ++counts[flight.phase];
        }
        const double x = c.ray.origin.x + t * c.ray.direction.x;
        double total = 0;
        for (const Slab& s : c.slabs) {
            if (std::min(std::abs(x - s.x0), std::abs(x - s.x1)) < 1e-9) RC_DISCARD("at a boundary");
            if (x > s.x0 && x < s.x1) total += s.density * s.albedo;
        }
        for (std::size_t i = 0; i < c.slabs.size(); ++i) {
            const Slab& s = c.slabs[i];
            const double share = x > s.x0 && x < s.x1 ? s.density * s.albedo / total : 0;
            const MaterialId phase = c.scene.flat().medium_shapes[i].phase;
            RC_ASSERT(std::abs(counts[phase] - kChoices * share) <= 1);
        }
    });
}

TEST_CASE("Media along a ray: what begins behind its end, or ends before its begin, does not count",
          "[render][media]") {
    const CompiledScene scene = compile_with(sky(0), {medium_of({1, 2, 1}), medium_of({3, 4, 1})});
    MediaAlongRay media;
    const auto transmittance = [&](double x, double t_min, double t_max) {
        media.trace(scene.flat(), {.origin = {x, 0, 0}, .direction = {1, 0, 0}, .t_min = t_min, .t_max = t_max});
        return media.transmittance();
    };
    CHECK(transmittance(0, 0, 0.5) == 1);
    CHECK(transmittance(0, 2.25, 2.75) == 1);
    CHECK(transmittance(0, 4.5, kInfinity) == 1);
    CHECK(transmittance(5, 0, kInfinity) == 1);
    CHECK(transmittance(0, 1.25, 1.75) == Approx(std::exp(-0.5)).epsilon(1e-13));
    CHECK(transmittance(0, 1.5, 3.25) == Approx(std::exp(-0.75)).epsilon(1e-13));
    CHECK(transmittance(1.5, 0, 0.25) == Approx(std::exp(-0.25)).epsilon(1e-13));
}

TEST_CASE("Media along a ray: between the pieces of a boundary there is nothing", "[render][media]") {
    const auto pieces = std::make_shared<HittableList>(
        std::vector<Object>{make_box({1, -1, -1}, {2, 1, 1}, nullptr), make_box({4, -1, -1}, {7, 1, 1}, nullptr)});
    const CompiledScene scene = compile_with(sky(0), {std::make_shared<ConstantMedium>(pieces, 0.5, Color{})});
    MediaAlongRay media;
    const auto transmittance = [&](double x) {
        media.trace(scene.flat(), {.origin = {x, 0, 0}, .direction = {1, 0, 0}});
        return media.transmittance();
    };
    CHECK(transmittance(0) == Approx(std::exp(-2)).epsilon(1e-13));
    CHECK(transmittance(1.5) == Approx(std::exp(-1.75)).epsilon(1e-13));
    CHECK(transmittance(3) == Approx(std::exp(-1.5)).epsilon(1e-13));
    CHECK(transmittance(5) == Approx(std::exp(-1)).epsilon(1e-13));
}

TEST_CASE("Media along a ray: what rounding leaves of extinctions does not fill the space behind the media",
          "[render][media]") {
    // .1 + .2 + .3 - .1 - .2 - .3 is 2^-54 and more in double, times 2^50 an optical depth that one would see.
    const double far = 0x1p50;
    const CompiledScene scene = compile_with(sky(0), {medium_of({1, 4, 0.1}), medium_of({2, 5, 0.2}),
                                                      medium_of({3, 6, 0.3}), medium_of({far, far + 0x1p20, 0x1p-20})});
    MediaAlongRay media;
    media.trace(scene.flat(), {.origin = {0, 0, 0}, .direction = {1, 0, 0}});
    CHECK(media.transmittance() == Approx(std::exp(-3 * 0.6 - 1)).epsilon(1e-13));
}

TEST_CASE("Media along a ray: one without extinction changes nothing", "[render][media]") {
    const CompiledScene scene = compile_with(sky(0), {medium_of({1, 2, 0}), medium_of({1.5, 3, 2, 0.5})});
    MediaAlongRay media;
    media.trace(scene.flat(), {.origin = {0, 0, 0}, .direction = {1, 0, 0}});
    CHECK(media.transmittance() == Approx(std::exp(-3)).epsilon(1e-13));
    for (const double choose : {0.0, 0.5, 1 - 0x1p-53})
        CHECK(media.sample(0.5, choose).phase == scene.flat().medium_shapes[1].phase);
}

}  // namespace limn::media_along_ray_test
