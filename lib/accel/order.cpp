#include "accel/order.h"

#include <limits>

namespace limn::accel {

void set_order(WideNode& node) {
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    std::uint32_t present = 0;
    while (present < kWidth && node.child[present] != WideNode::kAbsent) ++present;
    // An octant and its opposite have opposite orders.
    for (std::uint32_t octant = 0; octant < 4; ++octant) {
        float along[kWidth];  // twice the centre, along the octant's diagonal
        std::uint32_t rank[kWidth] = {};
        for (std::uint32_t c = 0; c < kWidth; ++c) {
            const float x = node.lower[0][c] + node.upper[0][c], y = node.lower[1][c] + node.upper[1][c],
                        z = node.lower[2][c] + node.upper[2][c];
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
            word |= c << 4 * rank[c];
            opposite |= c << 4 * (c < present ? present - 1 - rank[c] : rank[c]);
        }
        node.order[octant] = word;
        node.order[7 - octant] = opposite;
    }
}

}  // namespace limn::accel
