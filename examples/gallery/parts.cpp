#include "parts.h"

#include <cmath>
#include <numbers>

namespace limn::gallery {

Model load(const std::string& name) { return load_model(std::string(LIMN_GALLERY_MODELS "/") + name, {.crease = 60}); }

std::shared_ptr<const Mesh> knot(std::shared_ptr<const Material> material) {
    return std::make_shared<Mesh>(*load("knot.ply").meshes.front(), std::vector{std::move(material)});
}

MeshData lathe(const std::vector<ProfilePoint>& profile, int steps) {
    // Turn the points of the profile about the axis.
    MeshData data;
    const auto ring = static_cast<std::uint32_t>(steps);
    for (const ProfilePoint& p : profile)
        for (int i = 0; i < steps; ++i) {
            const double angle = 2 * std::numbers::pi * i / steps;
            data.vertices.push_back({static_cast<float>(p.radius * std::cos(angle)), static_cast<float>(p.height),
                                     static_cast<float>(-p.radius * std::sin(angle))});
        }
    // Connect neighbouring rings by triangles. A ring of radius 0 needs half of them.
    for (std::uint32_t k = 0; k + 1 < profile.size(); ++k)
        for (std::uint32_t i = 0; i < ring; ++i) {
            const std::uint32_t next = (i + 1) % ring;
            const std::uint32_t a = k * ring + i, b = k * ring + next, c = a + ring, d = b + ring;
            if (profile[k].radius > 0) data.triangles.push_back({a, b, d});
            if (profile[k + 1].radius > 0) data.triangles.push_back({a, d, c});
        }
    return smooth_normals(data, 40);
}

}  // namespace limn::gallery
