#include "house.h"

#include <fmt/format.h>

namespace limn::test {

std::string house_obj(double scale) {
    constexpr int kCorners[][3] = {{-3, 0, -2}, {3, 0, -2}, {3, 0, 2},  {-3, 0, 2}, {-3, 3, -2},
                                   {3, 3, -2},  {3, 3, 2},  {-3, 3, 2}, {-3, 5, 0}, {3, 5, 0}};
    std::string obj;
    for (const auto& c : kCorners) {
        const auto scaled = [&](int i) { return static_cast<float>(c[i] * scale); };
        obj += fmt::format("v {} {} {}\n", scaled(0), scaled(1), scaled(2));
    }
    return obj + "f 1 2 3 4\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 5 8 9\nf 2 6 7 3\nf 6 10 7\nf 5 9 10 6\nf 7 10 9 8\n";
}

}  // namespace limn::test
