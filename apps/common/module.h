/// \file
/// Modules: shared objects that limn's programs load when they need them, together with the libraries that these link.
#pragma once

#include <string>

namespace limn::app {

/// Loads the module `name`.so. It is searched in two folders: that of the program (for a build), and LIMN_MODULE_FOLDER
/// relative to it (for an installation). The module stays loaded. A second call returns the same address.
/// \returns the address of the module's symbol limn_module
/// \throws Error with the paths that were tried and the problem of each
void* load_module(const std::string& name);

}  // namespace limn::app

/// The id that each module exports: limn's version and a digest of the headers between program and module
/// that apps/CMakeLists.txt lists. A module with another id than the program's is refused.
extern "C" const char limn_module_id[];
