// "Before anti-aliasing": one ray through the centre of each pixel.
#include "figures.h"

namespace limn::figures {

Figure fig03_before_antialiasing(const FigureInputs& inputs) {
    Figure figure = fig10_specular(inputs);
    figure.name = __func__;
    figure.settings.samples_per_pixel = 1;
    figure.settings.antialias = false;
    return figure;
}

}  // namespace limn::figures
