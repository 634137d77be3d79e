/// \file
#pragma once

#include <string>

#include "limn/io/model.h"

namespace limn::app {

/// What a command names in place of a file to read from standard input.
inline constexpr const char* kStandardInput = "-";

/// All bytes of standard input.
std::string read_standard_input();

/// The model in a file, or from standard input. \throws as load_model
Model read_model(const std::string& path, const ModelOptions& options = {});

/// The path if it names a file that is read, otherwise empty.
std::string input_file(const std::string& path);

}  // namespace limn::app
