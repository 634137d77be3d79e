#include "accel/node.h"

#include <algorithm>
#include <limits>

namespace limn::accel {

Node make_node(std::span<const FloatBox> boxes) {
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    Node node;
    std::fill_n(node.child, kWidth, kNothing);
    for (std::size_t a = 0; a < 3; ++a) {
        std::fill_n(node.planes[a], kWidth, kEndless);
        std::fill_n(node.planes[3 + a], kWidth, -kEndless);
        for (std::size_t c = 0; c < boxes.size(); ++c)
            node.planes[a][c] = boxes[c].lower[a], node.planes[3 + a][c] = boxes[c].upper[a];
    }
    const auto present = static_cast<std::uint32_t>(boxes.size());
    // An octant and its opposite have opposite orders.
    for (std::uint32_t octant = 0; octant < 4; ++octant) {
        float along[kWidth];              // twice the centre, along the octant's diagonal
        std::uint32_t rank[kWidth] = {};  // from the nearest on
        for (std::uint32_t c = 0; c < kWidth; ++c) {
            const float x = node.planes[0][c] + node.planes[3][c], y = node.planes[1][c] + node.planes[4][c],
                        z = node.planes[2][c] + node.planes[5][c];
            along[c] = (octant & 1 ? -x : x) + (octant & 2 ? -y : y) + z;
        }
        // An absent child's is NaN; that of one without bounds is NaN or endless. They all come last, in their order.
        for (std::uint32_t c = 0; c < kWidth; ++c)
            if (!(along[c] < kEndless)) along[c] = kEndless;
        for (std::uint32_t other = 0; other < kWidth; ++other)
            for (std::uint32_t c = 0; c < kWidth; ++c)
                rank[c] +=
                    static_cast<std::uint32_t>(along[other] < along[c]) |
                    (static_cast<std::uint32_t>(along[other] == along[c]) & static_cast<std::uint32_t>(other < c));
        std::uint32_t word = 0, opposite = 0;
        for (std::uint32_t c = 0; c < kWidth; ++c) {
            word |= c << 4 * (kWidth - 1 - rank[c]);
            opposite |= c << 4 * (kWidth - 1 - (c < present ? present - 1 - rank[c] : rank[c]));
        }
        node.order[octant] = word;
        node.order[7 - octant] = opposite;
    }
    return node;
}

}  // namespace limn::accel
