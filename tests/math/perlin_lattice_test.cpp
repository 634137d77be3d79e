#include "limn/math/perlin_lattice.h"

#include <algorithm>

#include "catch.h"

namespace limn::perlin_lattice_test {

TEST_CASE("PerlinLattice: made of SplitMix64's own sequence, so that pictures stay what they are", "[core][perlin]") {
    // The generator's published test vector for this seed.
    const std::uint64_t sequence[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u};
    const auto in_minus_one_to_one = [](std::uint64_t n) { return static_cast<double>(n >> 11) * 0x1p-52 - 1; };
    const PerlinLattice lattice = PerlinLattice::from_seed(1234567);
    CHECK(lattice.gradients[0] == normalize(Vec3{in_minus_one_to_one(sequence[0]), in_minus_one_to_one(sequence[1]),
                                                 in_minus_one_to_one(sequence[2])}));
    // Durstenfeld's shuffle with the 769th number on, as another program works it out.
    const auto begins_with = [](const std::array<std::uint8_t, 256>& p, const std::array<int, 6>& first) {
        return std::equal(first.begin(), first.end(), p.begin());
    };
    CHECK(begins_with(lattice.perm_x, {4, 101, 244, 79, 165, 87}));
    CHECK(begins_with(lattice.perm_y, {160, 44, 102, 12, 255, 238}));
    CHECK(begins_with(lattice.perm_z, {232, 124, 112, 200, 194, 75}));
    CHECK((lattice.perm_x[255] == 162 && lattice.perm_y[255] == 101 && lattice.perm_z[255] == 132));
}

}  // namespace limn::perlin_lattice_test
