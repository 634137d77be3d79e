#include "compile/lights.h"

#include <algorithm>
#include <cmath>

#include "compile/reach.h"
#include "core/hit_error.h"
#include "core/mesh_triangle.h"

namespace limn::compiler {

namespace {

// A texture that cannot be sampled, as a whole or in part: it may ask for what only a traced hit knows.
bool is_foreign(const flat::Scene& scene, TextureId id) {
    const TextureRecord& t = scene.textures[static_cast<std::size_t>(id)];
    return t.kind == TextureKind::foreign ||
           (t.kind == TextureKind::checker && (is_foreign(scene, t.even) || is_foreign(scene, t.odd)));
}

// A brightness that stands for the whole texture when lights are weighed against each other; a wrong guess costs noise,
// not bias. Zero where all is black.
double typical_brightness(const flat::Scene& scene, TextureId id) {
    const TextureRecord& t = scene.textures[static_cast<std::size_t>(id)];
    switch (t.kind) {
        case TextureKind::solid: return max_component(t.color);
        case TextureKind::checker: return (typical_brightness(scene, t.even) + typical_brightness(scene, t.odd)) / 2;
        case TextureKind::image: {
            const auto values = scene.images[t.data]->values();
            double sum = 0;
            for (const float v : values) sum += v;
            return sum / static_cast<double>(values.size()) * 3;
        }
        case TextureKind::noise:
        case TextureKind::turbulence:
        case TextureKind::marble: return max_component(t.color) / 2;
        case TextureKind::foreign: break;  // not sampled
    }
    return 0;
}

// How the composed matrix changes lengths, if it changes all alike; else nothing.
std::optional<double> uniform_scale(const Transform& m) {
    const Vec3 x{m.rows[0][0], m.rows[1][0], m.rows[2][0]}, y{m.rows[0][1], m.rows[1][1], m.rows[2][1]},
        z{m.rows[0][2], m.rows[1][2], m.rows[2][2]};
    const double s = dot(x, x);
    const double off = std::max({std::abs(dot(y, y) - s), std::abs(dot(z, z) - s), std::abs(dot(x, y)),
                                 std::abs(dot(y, z)), std::abs(dot(z, x))});
    // Products of rotations are off by their rounding.
    return off <= 1e-12 * s ? std::optional(std::sqrt(s)) : std::nullopt;
}

// Right angles but for rounding.
bool is_rectangle(const flat::Light& light) {
    return std::abs(dot(light.edge_u, light.edge_v)) <= 1e-12 * length(light.edge_u) * length(light.edge_v);
}

// Of an emitter in instances of instances of instances more copies than these are left to scattering.
constexpr std::size_t kMaxLights = std::size_t{1} << 22;

class LightCollector {
public:
    explicit LightCollector(flat::Scene& scene) : scene_(scene) {
        for (const MaterialRecord& m : scene.materials) {
            const bool is_sampled = m.kind == MaterialKind::diffuse_light && !is_foreign(scene, m.texture);
            brightness_.push_back(is_sampled ? typical_brightness(scene, m.texture) : 0);
        }
        emits_ = groups_that_reach(scene, [&](const PrimitiveRange& range) { return any_emits(range); });
        visit(GroupId::root, 0, Transform{});
        weigh();
    }

private:
    double brightness(MaterialId id) const {
        return id == MaterialId::none ? 0 : brightness_[static_cast<std::size_t>(id)];
    }

    bool is_solid(MaterialId id) const {
        const TextureId texture = scene_.materials[static_cast<std::size_t>(id)].texture;
        return scene_.textures[static_cast<std::size_t>(texture)].kind == TextureKind::solid;
    }

    bool any_emits(const PrimitiveRange& range) const {
        if (range.kind == PrimitiveKind::mesh) {
            const auto& ids = scene_.meshes[range.first_row].materials;
            return std::any_of(ids.begin(), ids.end(), [&](MaterialId id) { return brightness(id) > 0; });
        }
        for (std::uint64_t i = 0; i < range.count; ++i)
            if (brightness(material_of(scene_, range, i)) > 0) return true;
        return false;
    }

    void visit(GroupId id, std::uint64_t first_number, const Transform& world_from_group) {
        if (!emits_[static_cast<std::size_t>(id)] || scene_.lights.size() >= kMaxLights) return;
        const flat::Group group = flat::group_at(scene_, id);
        for (std::uint32_t i = 0; i < group.range_count; ++i) {
            const PrimitiveRange range = scene_.ranges[group.first_range + i];
            const std::uint64_t number = first_number + range.first_number;
            if (range.kind == PrimitiveKind::instance) {
                const flat::Instance& instance = scene_.instances[range.first_row];
                if (!instance.moving) visit(instance.group, number, world_from_group * instance.world_from_object0);
            } else if (range.kind != PrimitiveKind::medium && any_emits(range)) {
                for (std::uint64_t e = 0; e < range.count; ++e) add(range, e, number + e, world_from_group);
            }
        }
    }

    void add(const PrimitiveRange& range, std::uint64_t element, std::uint64_t number, const Transform& m) {
        flat::Light light;
        light.number = number;
        light.material = material_of(scene_, range, element);
        if (!(brightness(light.material) > 0)) return;
        const auto row = range.first_row + element;
        const Transform inv = inverse(m);
        const auto sphere = [&](const Point3& center, const Vec3& motion, double radius) {
            const std::optional<double> scale = uniform_scale(m);
            // Texture coordinates belong to the object's own axes and side.
            const bool own_axes = m == Transform{} && radius > 0;
            if (!scale || (!own_axes && !is_solid(light.material))) return false;
            light.kind = flat::LightKind::sphere;
            light.origin = transform_point(m, center);
            light.edge_u = transform_vector(m, motion);
            light.radius = *scale * std::abs(radius);
            const double reach = std::max(max_abs(light.origin), max_abs(light.origin + light.edge_u)) + light.radius;
            const double own_reach = std::max(max_abs(center), max_abs(center + motion));
            light.position_error = transformed_error(m, inv, Point3{reach, reach, reach},
                                                     along_every_axis(gamma(16) * (own_reach + std::abs(radius))));
            return true;
        };
        const auto planar = [&](flat::LightKind kind, const Point3& origin, const Vec3& u, const Vec3& v) {
            light.kind = kind;
            light.origin = transform_point(m, origin);
            light.edge_u = transform_vector(m, u);
            light.edge_v = transform_vector(m, v);
            const double reach = max_abs(light.origin) + max_abs(light.edge_u) + max_abs(light.edge_v);
            light.position_error = transformed_error(m, inv, Point3{reach, reach, reach}, planar_error(origin, u, v));
            return length_squared(cross(light.edge_u, light.edge_v)) > 0;
        };
        bool usable = false;
        if (range.kind == PrimitiveKind::sphere) {
            const flat::Sphere& s = scene_.spheres[row];
            usable = sphere(s.center, {}, s.radius);
        } else if (range.kind == PrimitiveKind::moving_sphere) {
            const flat::MovingSphere& s = scene_.moving_spheres[row];
            usable = sphere(s.center0, s.center1 - s.center0, s.radius);
        } else if (range.kind == PrimitiveKind::quad) {
            const flat::Quad& q = scene_.quads[row];
            usable = planar(flat::LightKind::parallelogram, q.corner, q.edge_u, q.edge_v);
            if (is_rectangle(light)) light.kind = flat::LightKind::rectangle;
        } else if (range.kind == PrimitiveKind::triangle) {
            const flat::Triangle& t = scene_.triangles[row];
            usable = planar(flat::LightKind::triangle, t.a, t.b - t.a, t.c - t.a);
        } else {
            const TriangleVertices v = triangle_vertices(scene_.meshes[range.first_row].arrays, element);
            usable = !is_degenerate(v) && planar(flat::LightKind::triangle, v.a, v.b - v.a, v.c - v.a);
        }
        if (usable) scene_.lights.push_back(light);
    }

    static double area(const flat::Light& light) {
        if (light.kind == flat::LightKind::sphere) return 4 * kPi * light.radius * light.radius;
        const double parallelogram = length(cross(light.edge_u, light.edge_v));
        return light.kind == flat::LightKind::triangle ? parallelogram / 2 : parallelogram;
    }

    // Half by power, half alike: power alone starves a weak light in the places that it is closest to.
    void weigh() {
        double total = 0;
        for (const flat::Light& light : scene_.lights) total += brightness(light.material) * area(light);
        const auto count = static_cast<double>(scene_.lights.size());
        double below = 0;
        for (flat::Light& light : scene_.lights) {
            const double share = brightness(light.material) * area(light) / total;
            light.pick = std::isfinite(share) ? (share + 1 / count) / 2 : 1 / count;
            light.pick_below = below;
            below += light.pick;
        }
        for (flat::Light& light : scene_.lights) light.pick /= below, light.pick_below /= below;
    }

    flat::Scene& scene_;
    std::vector<double> brightness_;  // by material; 0: does not emit
    std::vector<bool> emits_;         // by group
};

}  // namespace

void collect_lights(flat::Scene& scene) { LightCollector{scene}; }

}  // namespace limn::compiler
