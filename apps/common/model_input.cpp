#include "model_input.h"

#include <iostream>
#include <iterator>

namespace limn::app {

std::string read_standard_input() { return {std::istreambuf_iterator<char>(std::cin), {}}; }

Model read_model(const std::string& path, const ModelOptions& options) {
    if (path != kStandardInput) return load_model(path, options);
    const std::string bytes = read_standard_input();
    return load_model_from_memory(std::as_bytes(std::span(bytes)), "standard input", options);
}

std::string input_file(const std::string& path) { return path == kStandardInput ? "" : path; }

}  // namespace limn::app
