#include "limn/core/perlin_lattice.h"

#include <numeric>
#include <utility>

namespace limn {

namespace {

// SplitMix64: the n-th number is a hash of seed + n golden ratios (Steele, Lea, Flood, Fast Splittable Pseudorandom
// Number Generators, OOPSLA 2014). Integers only, so the bits are the same everywhere.
class SplitMix64 {
public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    // In [-1, 1), 53 bits.
    double next_signed() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }
    // In [0, n), n <= 256: the bias, n / 2^32 at most, is far below what 256 entries can show.
    std::size_t next_below(std::size_t n) { return static_cast<std::size_t>(((next() >> 32) * n) >> 32); }

private:
    std::uint64_t state_;
};

Vec3 random_gradient(SplitMix64& random) {
    Vec3 v;
    do {
        v.x = random.next_signed(), v.y = random.next_signed(), v.z = random.next_signed();
    } while (v == Vec3{});
    return normalize(v);
}

// Durstenfeld's shuffle (Algorithm 235, CACM 7(7), 1964).
std::array<std::uint8_t, 256> random_permutation(SplitMix64& random) {
    std::array<std::uint8_t, 256> p;
    std::iota(p.begin(), p.end(), std::uint8_t{0});
    for (std::size_t i = p.size() - 1; i > 0; --i) std::swap(p[i], p[random.next_below(i + 1)]);
    return p;
}

}  // namespace

PerlinLattice PerlinLattice::from_seed(std::uint64_t seed) {
    SplitMix64 random(seed);
    PerlinLattice lattice;
    for (Vec3& gradient : lattice.gradients) gradient = random_gradient(random);
    lattice.perm_x = random_permutation(random);
    lattice.perm_y = random_permutation(random);
    lattice.perm_z = random_permutation(random);
    return lattice;
}

}  // namespace limn
