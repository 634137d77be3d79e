/// \file
/// Models from files or standard input.
#pragma once

#include <string>

#include "limn/io/model.h"

namespace limn::app {

/// The path that stands for standard input.
inline constexpr const char* kStandardInput = "-";

/// Reads standard input to its end.
std::string read_standard_input();

/// Reads a model from a file, or from standard input if `path` is kStandardInput. Throws what load_model throws.
Model read_model(const std::string& path, const ModelOptions& options = {});

/// Returns the path, or an empty string if it is kStandardInput: a file that no output may replace.
std::string input_file(const std::string& path);

}  // namespace limn::app
