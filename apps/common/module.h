/// \file
/// Modules: parts of limn's programs that are loaded when they are needed, and with them the libraries that they link.
#pragma once

#include <string>

namespace limn::app {

/// Loads the module `name`.so: beside the program, as built, or from where it is installed. Nothing else is searched.
/// The module stays loaded. A second call returns the same.
/// \returns the address of what the module exports as limn_module
/// \throws Error naming the paths tried, and what is wrong with each
void* load_module(const std::string& name);

}  // namespace limn::app

/// Each module exports it: limn's version and a digest of the headers between program and module (apps/CMakeLists.txt).
extern "C" const char limn_module_id[];
