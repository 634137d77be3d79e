#include "module.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "limn/core/error.h"

namespace limn::app {

namespace {

namespace fs = std::filesystem;

// Returns limn_module; null where `path` does not have it, for the reason in `problem`.
void* load(const fs::path& path, std::string& problem) {
    std::error_code unknown;  // dlopen then says what is wrong
    if (!fs::exists(path, unknown) && !unknown) {
        problem = "is not there";
        return nullptr;
    }
    void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) {
        problem = std::string("cannot be loaded (") + dlerror() + ")";
        return nullptr;
    }
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
