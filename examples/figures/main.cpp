// Renders the figure that LIMN_FIGURE names.
#include "figure_program.h"

int main(int argc, char** argv) { return limn::figures::figure_program(LIMN_FIGURE, argc, argv); }
