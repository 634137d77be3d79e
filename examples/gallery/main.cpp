// Renders the picture that LIMN_PICTURE names.
#include "gallery.h"

#define LIMN_TEXT_OF(name) #name
#define LIMN_TEXT(name) LIMN_TEXT_OF(name)

int main(int argc, char** argv) {
    return limn::figure_main(argc, argv, LIMN_TEXT(LIMN_PICTURE),
                             [](const limn::FigureInputs&) { return limn::gallery::LIMN_PICTURE(); });
}
