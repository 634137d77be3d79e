#include "limn/math/perlin_lattice.h"

#include <numeric>
#include <utility>

namespace limn {

namespace {

// The generator SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014). Its n-th
// number is a hash of seed + n * 2^64 / golden ratio. It uses integers only, so its bits are the same on every
// platform.
class SplitMix64 {
public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    // Returns one of 2^53 equally spaced numbers in [-1, 1).
    double next_signed() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }
    // Returns an integer in [0, n), n <= 256. Its bias is at most n / 2^32, too small to be seen in 256 entries.
    std::size_t next_below(std::size_t n) { return static_cast<std::size_t>(((next() >> 32) * n) >> 32); }

private:
    std::uint64_t state_;
};

// Returns the unit vector along a point drawn uniformly from the cube [-1, 1)^3.
Vec3 random_gradient(SplitMix64& random) {
    Vec3 v;
    do {
        v.x = random.next_signed();
        v.y = random.next_signed();
        v.z = random.next_signed();
    } while (v == Vec3{});
    return normalize(v);
}

// Returns a random permutation of 0 to 255 by Durstenfeld's shuffle (Algorithm 235, CACM 7(7), 1964).
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
