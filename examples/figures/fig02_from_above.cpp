// "Looking from point3(-6, 10, 3)": the balls of figure 1 from above, through a pinhole and with a wider view.
#include "figures.h"

namespace limn::figures {

Figure fig02_from_above(const FigureInputs& inputs) {
    Figure figure = fig01_bouncing_spheres(inputs);
    figure.name = __func__;
    figure.camera = {.look_from = {-6, 10, 3}, .vertical_fov = 40};
    return figure;
}

}  // namespace limn::figures
