#include "bench/peer_module.h"
#include "limn/core/error.h"
#include "module.h"

namespace limn::bench {

std::vector<std::shared_ptr<const Contender>> load_peers(std::vector<std::string>& notes) {
    std::vector<std::shared_ptr<const Contender>> peers;
    try {
        reinterpret_cast<PeerList*>(app::load_module("limn_bench_embree"))(peers);
    } catch (const Error& e) {
        notes.push_back(std::string("without Embree: ") + e.what());
    }
    return peers;
}

}  // namespace limn::bench
