#include "module.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "limn/math/error.h"

namespace limn::app {

namespace {

namespace fs = std::filesystem;

// Returns the address of limn_module in the module at `path`. If there is none, returns null and sets `problem`.
void* load(const fs::path& path, std::string& problem) {
    // Load the file. If it is unknown whether the file exists, dlopen reports the problem.
    std::error_code unknown;
    if (!fs::exists(path, unknown) && !unknown) {
        problem = "is not there";
        return nullptr;
    }
    void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) {
        problem = std::string("cannot be loaded (") + dlerror() + ")";
        return nullptr;
    }
    // Check that the module was built for this program.
    const auto* const id = static_cast<const char*>(dlsym(module, "limn_module_id"));
    if (id == nullptr || std::string(id) != LIMN_MODULE_ID) {
        problem = id ? "is a module of limn " + std::string(id) + ", not of " LIMN_MODULE_ID : "is no module of limn";
        return nullptr;
    }
    void* const found = dlsym(module, "limn_module");
    if (found == nullptr) problem = "has no limn_module";
    return found;
}

}  // namespace

void* load_module(const std::string& name) {
    const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
    std::string tried;
    for (const fs::path& place : {folder, folder / LIMN_MODULE_FOLDER}) {
        const fs::path path = (place / (name + ".so")).lexically_normal();
        std::string problem;
        if (void* const module = load(path, problem)) return module;
        tried += (tried.empty() ? "" : "; ") + path.string() + " " + problem;
    }
    throw Error("cannot load the module " + name + ": " + tried);
}

}  // namespace limn::app
