#include "figure_program.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "figures.h"

namespace limn::figures {

namespace {

// A figure, by its name.
struct Program {
    std::string_view name;
    Figure (*make)(const FigureInputs& inputs);
};
#define LIMN_FIGURE_PROGRAM(name) {#name, name},
constexpr Program kPrograms[] = {LIMN_FIGURES(LIMN_FIGURE_PROGRAM)};
#undef LIMN_FIGURE_PROGRAM

}  // namespace

int figure_program(std::string_view name, int argc, char** argv) {
    const auto program =
        std::find_if(std::begin(kPrograms), std::end(kPrograms), [&](const Program& p) { return p.name == name; });
    if (program == std::end(kPrograms)) throw std::logic_error("figures.h has no line for " + std::string(name));
    std::optional<FigureInputs> inputs;
    if (name == "fig06_earth") inputs = kDefaultInputs;
    return figure_main(argc, argv, name, program->make, inputs);
}

}  // namespace limn::figures
