#include <dlfcn.h>

#include <filesystem>

#include "bench/peer_module.h"

namespace limn::bench {

std::vector<std::shared_ptr<const Contender>> load_peers(std::vector<std::string>& notes) {
    std::vector<std::shared_ptr<const Contender>> peers;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    const std::string name = "limn_bench_embree.so";
    std::string why = name + " is not there";
    // Beside the program as built, or where it is installed.
    for (const std::filesystem::path& path : {folder / name, folder / LIMN_MODULE_FOLDER / name}) {
        if (!std::filesystem::exists(path)) continue;
        void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module == nullptr) {
            why = dlerror();
            continue;
        }
        reinterpret_cast<PeerList*>(dlsym(module, "limn_bench_peers"))(peers);  // stays loaded until the end
        return peers;
    }
    notes.push_back("without Embree: " + why);
    return peers;
}

}  // namespace limn::bench
