// The program of figure LIMN_FIGURE.
#include <optional>
#include <string_view>

#include "figures.h"

#define LIMN_QUOTE(x) #x
#define LIMN_NAME(x) LIMN_QUOTE(x)

int main(int argc, char** argv) {
    constexpr std::string_view name = LIMN_NAME(LIMN_FIGURE);
    std::optional<limn::FigureInputs> inputs;
    if (name == "fig06_earth") inputs = limn::figures::kDefaultInputs;
    return limn::figure_main(argc, argv, name, limn::figures::LIMN_FIGURE, inputs);
}
