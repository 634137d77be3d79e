/// \file
/// A picture to make, and the main function of the programs that make one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "limn/io/image_io.h"
#include "limn/render/settings.h"
#include "limn/scene/camera.h"
#include "limn/scene/scene.h"

namespace limn {

/// A scene, and how it is pictured unless the command line says otherwise.
struct Figure {
    std::string name;  ///< goes into the report and the picture's header
    Scene scene;
    Camera camera;
    RenderSettings settings;
};

/// What a figure reads.
struct FigureInputs {
    std::string texture;
    Encoding texture_encoding = Encoding::automatic;
};

/// The whole of a figure's program: reads the options (see render_options.h), calls `make`, renders, and writes
/// NAME.exr and NAME.png or what -o names. Never throws.
/// \param defaults given: the program takes --texture and --texture-encoding, and these are what it uses without them
/// \returns the exit status: 0, 1, 2, 130 or 143 (see program.h)
int figure_main(int argc, char** argv, std::string_view name, const std::function<Figure(const FigureInputs&)>& make,
                const std::optional<FigureInputs>& defaults = std::nullopt);

}  // namespace limn
