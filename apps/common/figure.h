/// \file
/// Figures: scenes with a camera and settings. figure_main is the program of one figure; `limn render` makes one from a
/// model.
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

/// A scene to render, with a camera and settings. Options on the command line replace parts of the camera and settings.
struct Figure {
    std::string name;  ///< written to the report and the picture's header
    Scene scene;
    Camera camera;
    RenderSettings settings;
};

/// The files that a figure reads.
struct FigureInputs {
    std::string texture;  ///< path of a picture, or empty
    Encoding texture_encoding = Encoding::automatic;
};

/// Runs the program of a figure: reads the options (see render_options.h), calls `make`, renders, and writes the files
/// of -o; without -o, --film and --shard it writes `name`.exr and `name`.png. Never throws.
/// \param make makes the figure. It is called once to render, or once with `defaults` for --help. It must have no side
/// effects.
/// \param defaults if given, the program has the options --texture and --texture-encoding with these defaults
/// \returns the exit status: 0, 1, 2, 130 or 143 (see program.h)
int figure_main(int argc, char** argv, std::string_view name, const std::function<Figure(const FigureInputs&)>& make,
                const std::optional<FigureInputs>& defaults = std::nullopt);

}  // namespace limn
