// One number for all answers to a fixed corpus, the same in every build: g++ and clang, -O0, -O2, -O3 -march=native
// (tests/hard/builds.sh tries them). A change of it is a change of answers, to be explained where the constant is
// changed.
#include <bit>
#include <cstdint>
#include <cstdio>

#include "catch.h"
#include "hard/corpus.h"
#include "limn/render/compiled_scene.h"

using namespace limn;
using namespace limn::test;

namespace {

constexpr int kRays = 100000;
const std::string kHits = "0f8b7294870aa4f8";      // of both worlds
const std::string kSurfaces = "a9f6e9185783d8a2";  // positions, their error bounds, normals

// FNV-1a over the bytes, lowest first.
class Digest {
public:
    void add(std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte, value >>= 8) hash_ = (hash_ ^ (value & 0xff)) * 0x100000001b3;
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
    std::string text() const {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
        return digits;
    }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

void add(Digest& digest, std::uint64_t primitive, double t, double u, double v) {
    digest.add(primitive);
    digest.add(t);
    digest.add(u);
    digest.add(v);
}

constexpr std::uint64_t kMiss = ~std::uint64_t{0};

template <class Visit>
void for_each_ray(const Corpus& corpus, const Visit& visit) {
    Random random(20260502);
    for (int i = 0; i < kRays; ++i) visit(corpus_ray(corpus, random, i));
}

}  // namespace

TEST_CASE("Digest: the compiled scene answers 1e5 awkward rays with the same bits in every build", "[hard][digest]") {
    const Corpus corpus = make_corpus();
    const CompiledScene compiled = compile(corpus.scene);
    Digest digest;
    int hits = 0;
    for_each_ray(corpus, [&](const Ray& ray) {
        const auto hit = compiled.closest_hit(ray);
        if (!hit) return digest.add(kMiss);
        ++hits;
        add(digest, hit->primitive, hit->t, hit->u, hit->v);
    });
    CHECK(digest.text() == kHits);
    CHECK(hits > kRays / 3);
    CHECK(hits < kRays);
}

// RayHit leaves u and v of a sphere 0, and so does this: they are angles, which the C library works out.
TEST_CASE("Digest: the described objects answer them with the same bits as the compiled scene", "[hard][digest]") {
    const Corpus corpus = make_corpus();
    const Bvh described(corpus.scene.objects());
    std::vector<bool> angles;  // per element
    for (std::size_t i = 0; i < corpus.round.size(); ++i)
        angles.insert(angles.end(), count_elements(*corpus.scene.objects()[i]), corpus.round[i]);
    Digest digest;
    for_each_ray(corpus, [&](const Ray& ray) {
        const auto hit = described.hit(ray);
        if (!hit) return digest.add(kMiss);
        const bool no_uv = angles[hit->element];
        add(digest, hit->element, hit->t, no_uv ? 0 : hit->u, no_uv ? 0 : hit->v);
    });
    CHECK(digest.text() == kHits);
}

TEST_CASE("Digest: the points hit, their error bounds and normals have the same bits in every build",
          "[hard][digest]") {
    const Corpus corpus = make_corpus();
    const CompiledScene compiled = compile(corpus.scene);
    Digest digest;
    for_each_ray(corpus, [&](const Ray& ray) {
        const auto hit = compiled.closest_hit(ray);
        if (!hit) return;
        const Surface s = compiled.surface_at(ray, *hit);
        digest.add(s.position - Point3{});
        digest.add(s.position_error);
        digest.add(Vec3(s.normal));
        digest.add(std::uint64_t{s.front_face});
        digest.add(s.spawn_ray(Vec3(s.normal), 0).origin - Point3{});
    });
    CHECK(digest.text() == kSurfaces);
}
