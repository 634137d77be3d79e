#include "accel/node.h"

#include <algorithm>
#include <limits>

namespace limn::accel {

namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

}  // namespace

Node empty_node() {
    Node node;
    for (std::size_t a = 0; a < 3; ++a) {
        std::fill_n(node.planes[a], kWidth, kEndless);
        std::fill_n(node.planes[3 + a], kWidth, -kEndless);
    }
    std::fill_n(node.child, kWidth, kNothing);
    std::fill_n(node.order, kWidth, 0x01234567u);
    return node;
}

void set_box(Node& node, std::size_t slot, const FloatBox& box) {
    for (std::size_t a = 0; a < 3; ++a) node.planes[a][slot] = box.lower[a], node.planes[3 + a][slot] = box.upper[a];
}

void set_order(Node& node) {
    std::uint32_t present = 0;
    while (present < kWidth && node.child[present] != kNothing) ++present;
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
}

}  // namespace limn::accel
