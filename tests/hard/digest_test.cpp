// One number for all answers to a fixed corpus, the same in every build: g++ and clang, -O0, -O2, -O3 -march=native
// (tests/checks/compilers.py tries them). A change of it is a change of answers, to be explained where the constant is
// changed.
#include <bit>
#include <cstdint>

#include "catch.h"
#include "flat/scene.h"
#include "hard/corpus.h"
#include "limn/query/compiled_scene.h"
#include "support/text.h"

namespace limn::digest_test {

using namespace test;

namespace {

constexpr int kRays = 100000;
const std::string kHits = "0f8b7294870aa4f8";      // of both worlds
const std::string kSurfaces = "a9f6e9185783d8a2";  // positions, their error bounds, normals
// Compiled scenes have code of their own for the kinds of shape that they are made of.
const CorpusPart kParts[] = {
    {"meshes", [](Corpus& c, Random&) { corpus::add_meshes(c); }, "b4abf359f63957e6"},
    {"meshes and instances",
     [](Corpus& c, Random& random) {
         corpus::add_meshes(c);
         corpus::add_instances(c, random);
     },
     "e9ab45360a684d14"},
    {"spheres",
     [](Corpus& c, Random& random) {
         for (int i = 0; i < 8; ++i) corpus::add_spheres(c, random);
     },
     "54ebb9cdf34ab7da"},
    {"few spheres", [](Corpus& c, Random& random) { corpus::add_spheres(c, random); }, "f375c36a041e9638"},
    {"triangles and quads",
     [](Corpus& c, Random& random) {
         for (int i = 0; i < 4; ++i) corpus::add_flat_shapes(c, random);
     },
     "694942a9dc8b40f9"},
    {"few triangles and quads", [](Corpus& c, Random& random) { corpus::add_flat_shapes(c, random); },
     "6f0bc616e227a688"},
    {"a mesh in a room", [](Corpus& c, Random& random) { corpus::add_room(c, random); }, "742087f72a5c9674"},
};
const CorpusPart kLargeMesh = {"a large mesh", nullptr, "f499f4b39706f948"};
constexpr int kPartRays = 20000;

constexpr std::uint64_t kMiss = ~std::uint64_t{0};

// FNV-1a over the bytes, lowest first.
class Digest {
public:
    void add(std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte, value >>= 8) hash_ = (hash_ ^ (value & 0xff)) * 0x100000001b3;
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
    std::string text() const { return hexadecimal(hash_); }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

void add(Digest& digest, std::uint64_t primitive, double t, double u, double v) {
    digest.add(primitive);
    digest.add(t);
    digest.add(u);
    digest.add(v);
}

// RayHit leaves u and v of a sphere 0, and so does this: they are angles, which the C library works out.
class Described {
public:
    explicit Described(const Corpus& corpus) : objects_(corpus.scene.objects()) {
        for (std::size_t i = 0; i < corpus.round.size(); ++i)
            has_angles_.insert(has_angles_.end(), count_elements(*corpus.scene.objects()[i]), corpus.round[i]);
    }
    void add_hit(Digest& digest, const Ray& ray) const {
        const auto hit = objects_.hit(ray);
        if (!hit) return digest.add(kMiss);
        const bool no_uv = has_angles_[hit->element];
        add(digest, hit->element, hit->t, no_uv ? 0 : hit->u, no_uv ? 0 : hit->v);
    }

private:
    Bvh objects_;
    std::vector<bool> has_angles_;  // per element
};

// In bundles, which are traced together, and one by one.
std::vector<Ray> part_rays(const Corpus& corpus, Random& random) {
    std::vector<Ray> rays;
    for (int i = 0; i < kPartRays; ++i) {
        rays.push_back(corpus_ray(corpus, random, i));
        if (i % 64 < 32) continue;
        const Vec3 aside = random.unit();
        rays.back() = rays[rays.size() - 1 - static_cast<std::size_t>(i % 16)];
        rays.back().direction = rays.back().direction + 0x1p-12 * length(rays.back().direction) * aside;
    }
    return rays;
}

// Alone and in a batch, and whether there is any hit, against what the described objects answer, a mesh of which asks
// each of its triangles.
void check_part(const CorpusPart& part, const CompiledScene& compiled, const Corpus& corpus, Random& random,
                bool ask_described = true) {
    INFO(part.name);
    const std::vector<Ray> rays = part_rays(corpus, random);
    std::vector<RayHit> hits(rays.size());
    std::vector<std::uint8_t> occluded(rays.size());
    compiled.closest_hit(rays, hits);
    compiled.any_hit(rays, occluded);
    const Described objects(corpus);
    Digest alone, together, described;
    const auto add_hit = [](Digest& digest, const RayHit& hit) {
        if (hit.t == kInfinity) return digest.add(kMiss);
        add(digest, hit.primitive, hit.t, hit.u, hit.v);
    };
    std::size_t found = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool is_hit = hits[i].t < kInfinity;
        add_hit(together, hits[i]);
        add_hit(alone, compiled.closest_hit(rays[i]).value_or(RayHit{}));
        if (ask_described) objects.add_hit(described, rays[i]);
        found += is_hit ? 1 : 0;
        wrong += (occluded[i] != 0) != is_hit || compiled.any_hit(rays[i]) != is_hit ? 1 : 0;
    }
    if (ask_described) CHECK(described.text() == part.hits);
    CHECK(together.text() == part.hits);
    CHECK(alone.text() == part.hits);
    CHECK(wrong == 0);
    CHECK(found > rays.size() / 4);
    CHECK(found < rays.size());
}

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

TEST_CASE("Digest: scenes of some kinds of shape alone answer with the same bits in every build, also in batches",
          "[hard][digest]") {
    for (const CorpusPart& part : kParts) {
        Random random(20260503);
        Corpus corpus;
        part.add(corpus, random);
        if (corpus.balls.empty()) corpus.balls.push_back({{1, 0, -1}, 2});  // for tangents
        check_part(part, compile(corpus.scene), corpus, random);
    }
}

TEST_CASE("Digest: a mesh that is larger than the cache answers with the same bits in every build",
          "[hard][digest][large]") {
    Random random(20260504);
    Corpus corpus;
    const MeshData data = icosphere(8, 3);
    corpus.add(std::make_shared<Mesh>(data, nullptr));
    for (std::size_t i = 0; i < data.vertices.size(); i += 97)
        corpus.points.push_back(vertex(data, static_cast<std::uint32_t>(i)));
    corpus.balls.push_back({{0, 0, 0}, 3});
    const CompiledScene compiled = compile(corpus.scene);
    check_part(kLargeMesh, compiled, corpus, random, /*ask_described*/ false);
}

TEST_CASE("Digest: the described objects answer them with the same bits as the compiled scene", "[hard][digest]") {
    const Corpus corpus = make_corpus();
    const Described described(corpus);
    Digest digest;
    for_each_ray(corpus, [&](const Ray& ray) { described.add_hit(digest, ray); });
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

}  // namespace limn::digest_test
