// "With DOF": the balls of figure 13 through a wide lens, with the middle ball in focus.
#include "figures.h"

namespace limn::figures {

Figure fig18_with_dof(const FigureInputs& inputs) {
    Figure figure = fig13_dielectric(inputs);
    figure.name = __func__;
    figure.camera.aperture_angle = 10;
    figure.camera.focus_distance = 3.4;
    return figure;
}

}  // namespace limn::figures
