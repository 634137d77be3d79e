// "After anti-aliasing": 100 rays, spread over the area of each pixel.
#include "figures.h"

namespace limn::figures {

Figure fig04_after_antialiasing(const FigureInputs& inputs) {
    Figure figure = fig10_specular(inputs);
    figure.name = __func__;
    figure.settings.samples_per_pixel = 100;
    return figure;
}

}  // namespace limn::figures
