#include "accel/order.h"

namespace limn::accel {

void set_order(WideNode& node) {
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        float key[kWidth];
        std::uint32_t slot[kWidth];
        std::uint32_t sorted = 0;
        for (std::uint32_t c = 0; c < kWidth; ++c) {
            float along = 0;  // twice the centre, along the octant's diagonal
            for (std::size_t a = 0; a < 3; ++a) {
                const float center = node.lower[a][c] + node.upper[a][c];
                along += (octant >> a & 1) != 0 ? -center : center;
            }
            const bool absent = node.child[c] == WideNode::kAbsent;
            std::uint32_t at = sorted++;
            for (; at > 0 && !absent && along < key[at - 1]; --at) key[at] = key[at - 1], slot[at] = slot[at - 1];
            key[at] = along, slot[at] = c;
        }
        std::uint32_t word = 0;
        for (std::uint32_t k = 0; k < kWidth; ++k) word |= slot[k] << 4 * k;
        node.order[octant] = word;
    }
}

}  // namespace limn::accel
