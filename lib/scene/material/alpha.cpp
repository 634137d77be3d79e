#include "scene/material/alpha.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "bsdf/albedo_table.h"
#include "scene/material/albedo.h"

namespace limn {

using bsdf::kLeastAlpha;

Alphas checked_alphas(const Roughness& r, const std::string& material) {
    const double u = checked_share(r.u, material + ": roughness"), v = checked_share(r.v, material + ": roughness");
    if (u * u < kLeastAlpha && v * v < kLeastAlpha) return {0, 0};
    return {std::max(u * u, kLeastAlpha), std::max(v * v, kLeastAlpha)};
}

std::shared_ptr<const bsdf::AlbedoTable> albedo_table_of(double alpha_x, double alpha_y, double eta) {
    return std::make_shared<const bsdf::AlbedoTable>(
        bsdf::albedo_of(std::max(alpha_x, kLeastAlpha), std::max(alpha_y, kLeastAlpha), eta));
}

std::shared_ptr<const bsdf::AlbedoTable> albedo_table_by_roughness(double eta) {
    static std::mutex mutex;
    static std::map<double, std::weak_ptr<const bsdf::AlbedoTable>> tables;
    const std::lock_guard lock(mutex);
    std::weak_ptr<const bsdf::AlbedoTable>& known = tables[eta];
    std::shared_ptr<const bsdf::AlbedoTable> table = known.lock();
    if (!table) known = table = std::make_shared<const bsdf::AlbedoTable>(bsdf::albedo_by_roughness(eta));
    return table;
}

}  // namespace limn
