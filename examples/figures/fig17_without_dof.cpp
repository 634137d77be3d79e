// "Without DOF": the balls of figure 13 through a pinhole.
#include "figures.h"

namespace limn::figures {

Figure fig17_without_dof(const FigureInputs& inputs) {
    Figure figure = fig13_dielectric(inputs);
    figure.name = __func__;
    figure.camera.aperture_angle = 0;
    return figure;
}

}  // namespace limn::figures
