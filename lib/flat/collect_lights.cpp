#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "flat/light_tree.h"
#include "flat/reach.h"
#include "flat/steps.h"
#include "geometry/hit_error.h"
#include "geometry/mesh_triangle.h"

namespace limn::compiler {

namespace {

// Returns true if a texture, or a part of it, is user-defined. Lights with a user-defined texture cannot be
// sampled, because the texture may need data that only a traced hit has.
bool is_user_defined(const flat::Scene& scene, TextureId id) {
    const TextureRecord& t = scene.textures[static_cast<std::size_t>(id)];
    return t.kind == TextureKind::user_defined ||
           (t.kind == TextureKind::checker && (is_user_defined(scene, t.even) || is_user_defined(scene, t.odd)));
}

// Returns a brightness that represents the whole texture when a light is chosen. A wrong guess costs noise, not bias.
// Returns 0 if the texture is black everywhere.
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
        case TextureKind::user_defined: break;  // not sampled
    }
    return 0;
}

// Returns the factor by which a matrix changes lengths, or nothing if it doesn't change all lengths alike.
std::optional<double> uniform_scale(const Transform& m) {
    const Vec3 x{m.rows[0][0], m.rows[1][0], m.rows[2][0]}, y{m.rows[0][1], m.rows[1][1], m.rows[2][1]},
        z{m.rows[0][2], m.rows[1][2], m.rows[2][2]};
    const double s = dot(x, x);
    const double off = std::max({std::abs(dot(y, y) - s), std::abs(dot(z, z) - s), std::abs(dot(x, y)),
                                 std::abs(dot(y, z)), std::abs(dot(z, x))});
    // Allow for the rounding of products of rotations.
    return off <= 1e-12 * s ? std::optional(std::sqrt(s)) : std::nullopt;
}

// The largest number of lights in the tree. Further emitters, such as those of instances of instances, are left to
// scattering.
constexpr std::size_t kMaxLights = std::size_t{1} << 22;
// The largest number of stored lights. Triangles of meshes that would make more are computed when they are used.
constexpr std::size_t kMostOwn = std::size_t{1} << 14;
// The largest number of moving instances around an emitter. The bounds of the emitter are computed from all
// combinations of the instances' matrices at time 0 and 1.
constexpr int kMostMoving = 4;

// The instances that contain a BLAS.
struct Seen {
    Transform at0, at1;                    // products of their matrices, at time 0 and 1
    std::vector<std::uint32_t> instances;  // their rows, outermost first
    int moving = 0;                        // number of moving ones
    bool straight = true;                  // true if none of them turns or stretches while it moves
};

bool same_but_for_translation(const Transform& a, Transform b) {
    for (std::size_t i = 0; i < 3; ++i) b.rows[i][3] = a.rows[i][3];
    return a == b;
}

class LightCollector {
public:
    explicit LightCollector(flat::Scene& scene) : scene_(scene) {
        // Find the materials and BLASes that emit.
        for (const MaterialRecord& m : scene.materials) {
            const bool is_sampled = m.emission != TextureId::none && !is_user_defined(scene, m.emission) &&
                                    (!flat::has_holes(m) || !is_user_defined(scene, m.opacity));
            brightness_.push_back(is_sampled ? typical_brightness(scene, m.emission) : 0);
        }
        emits_ = blases_that_reach(scene, [&](const PrimitiveRange& range) { return any_emits(range); });
        // Collect the lights.
        visit(BlasId::root, 0, {});
        for (const LightSource& source : scene.light_sources)
            std::visit([&](const auto& described) { add_source(flat::light_from(described)); }, source);
        if (scene.environment && scene.environment->is_sampled())
            add_source(flat::EnvironmentLight{scene.environment.get()});
        build_light_tree(std::move(items_), scene.lights);
    }

private:
    // Adds a light that is no surface, if it isn't black.
    template <class Kind>
    void add_source(const Kind& light) {
        const auto bounds = light.bounds();
        if constexpr (std::is_same_v<decltype(bounds), const flat::DistantBounds>) {
            if (bounds.irradiance > 0) scene_.lights.distant.push_back({light, bounds});
        } else {
            if (bounds.strength > 0) items_.push_back({own(light), LightItem::kNoPrimitive, bounds});
        }
    }

    double brightness(MaterialId id) const {
        return id == MaterialId::none ? 0 : brightness_[static_cast<std::size_t>(id)];
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

    // Adds the lights of a BLAS. \param first_number number in the scene of its first primitive
    void visit(BlasId id, std::uint64_t first_number, const Seen& seen) {
        if (!emits_[static_cast<std::size_t>(id)] || items_.size() >= kMaxLights) return;
        const flat::Blas blas = flat::blas_at(scene_, id);
        for (std::uint32_t i = 0; i < blas.range_count; ++i) {
            const std::uint32_t row = blas.first_range + i;
            const PrimitiveRange range = scene_.ranges[row];
            const std::uint64_t number = first_number + range.first_number;
            if (range.kind == PrimitiveKind::instance)
                enter(range.first_row, number, seen);
            else if (range.kind != PrimitiveKind::medium && any_emits(range))
                add_range(row, number, seen);
        }
    }

    // Adds the lights of an instance.
    void enter(std::uint32_t row, std::uint64_t number, Seen seen) {
        const flat::Instance& instance = scene_.instances[row];
        const Transform& m0 = instance.world_from_object0;
        const Transform& m1 = instance.moving ? instance.world_from_object1 : m0;
        seen.at0 = seen.at0 * m0;
        seen.at1 = seen.at1 * m1;
        seen.instances.push_back(row);
        if (instance.moving) {
            if (++seen.moving > kMostMoving) return;
            seen.straight = seen.straight && same_but_for_translation(m0, m1);
        }
        visit(instance.blas, number, seen);
    }

    // Adds the lights of a range. \param number number in the scene of its first primitive
    void add_range(std::uint32_t row, std::uint64_t number, const Seen& seen) {
        // Decide whether its lights are stored or computed when they are used.
        const PrimitiveRange& range = scene_.ranges[row];
        const bool planar = range.kind != PrimitiveKind::sphere && range.kind != PrimitiveKind::moving_sphere;
        const Transform inv = inverse(seen.at0);
        const bool are_many = scene_.lights.own.size() + range.count > kMostOwn;
        const bool placed = planar && (seen.moving > 0 || (range.kind == PrimitiveKind::mesh && are_many));
        const auto place = static_cast<std::uint32_t>(scene_.lights.places.size());
        // Add each light.
        const std::size_t first_item = items_.size();
        for (std::uint64_t e = 0; e < range.count && items_.size() < kMaxLights; ++e) {
            const double radiance = brightness(material_of(scene_, range, e));
            if (!(radiance > 0)) continue;
            if (!planar) {
                if (std::optional<flat::SphereLight> light = sphere(range, e, seen, inv)) {
                    light->number = number + e;
                    items_.push_back({own(*light), number + e, light->bounds(radiance)});
                }
            } else if (std::optional<flat::PlanarLight> light = planar_one(range, e, seen, inv)) {
                light->number = number + e;
                const flat::LightBounds bounds =
                    seen.moving > 0 ? bounds_of_moving(range, e, seen, radiance) : light->bounds(radiance);
                const flat::LightRef ref = placed ? flat::LightRef{place, static_cast<std::uint32_t>(e)} : own(*light);
                items_.push_back({ref, number + e, bounds});
            }
        }
        if (placed && items_.size() > first_item) add_place(row, number, seen, inv);
    }

    // Stores a light.
    flat::LightRef own(const flat::Light& light) {
        scene_.lights.own.push_back(light);
        return {flat::LightRef::kOwn, static_cast<std::uint32_t>(scene_.lights.own.size() - 1)};
    }

    void add_place(std::uint32_t row, std::uint64_t number, const Seen& seen, const Transform& inv) {
        flat::LightPlace place;
        place.range = row;
        place.first_number = number;
        if (seen.moving > 0) {
            std::vector<std::uint32_t>& instances = scene_.lights.instances;
            place.first_instance = static_cast<std::uint32_t>(instances.size());
            place.instance_count = static_cast<std::uint32_t>(seen.instances.size());
            instances.insert(instances.end(), seen.instances.begin(), seen.instances.end());
        }
        place.transformed = !(seen.at0 == Transform{});
        place.world_from_object = seen.at0;
        place.object_from_world = inv;
        scene_.lights.places.push_back(place);
    }

    // Returns a planar light as it is at time 0, or nothing if it has no area.
    std::optional<flat::PlanarLight> planar_one(const PrimitiveRange& range, std::uint64_t element, const Seen& seen,
                                                const Transform& inv) const {
        if (range.kind == PrimitiveKind::mesh &&
            is_degenerate(triangle_of(scene_, scene_.meshes[range.first_row], element)))
            return std::nullopt;
        const flat::PlanarLight light = planar_light(scene_, range, element, seen.at0, inv);
        return length_squared(cross(light.edge_u, light.edge_v)) > 0 ? std::optional(light) : std::nullopt;
    }

    // Returns a sphere, or nothing if it can't be sampled:
    // - The instances scale it unevenly, or turn or stretch it while it moves.
    // - It has holes. Scattering finds the far side through them, but the samples are on the near side alone.
    // - It has a texture, and is in instances or has a negative radius. Texture coordinates belong to the object's own
    //   axes and side.
    std::optional<flat::SphereLight> sphere(const PrimitiveRange& range, std::uint64_t element, const Seen& seen,
                                            const Transform& inv) const {
        // Check whether it can be sampled.
        SphereRecord s;
        primitives::with_row(scene_.rows, range.kind, range.first_row + element, [&](const auto& primitive) {
            if constexpr (requires { primitive.ball(); }) s = primitive.ball();
        });
        const MaterialRecord& material = scene_.materials[static_cast<std::size_t>(s.material)];
        if (flat::has_holes(material)) return std::nullopt;
        const std::optional<double> scale = uniform_scale(seen.at0);
        const bool plain = flat::is_plain(scene_, material.emission);
        const bool own_axes = seen.at0 == Transform{} && s.radius > 0;
        if (!scale || !seen.straight || (!own_axes && !plain)) return std::nullopt;
        // Transform it to world space.
        flat::SphereLight light;
        light.material = s.material;
        light.side = flat::side_of(material.sides, /*mirrored*/ s.radius < 0);
        light.textured = !plain;
        light.center = transform_point(seen.at0, s.center0);
        light.motion = transform_point(seen.at1, s.center1) - light.center;
        light.radius = *scale * std::abs(s.radius);
        // Bound the error of its points.
        const double reach = std::max(max_abs(light.center), max_abs(light.center + light.motion)) + light.radius;
        const double own_reach = std::max(max_abs(s.center0), max_abs(s.center1));
        light.position_error = transformed_error(seen.at0, inv, Point3{reach, reach, reach},
                                                 along_every_axis(gamma(16) * (own_reach + std::abs(s.radius))));
        return light;
    }

    // Returns the bounds of a planar light in moving instances. A product of matrices that are each linear in time
    // takes a point to the convex hull of its positions for all combinations of the matrices at time 0 and 1, because
    // the Bernstein form of the product has no negative weights.
    flat::LightBounds bounds_of_moving(const PrimitiveRange& range, std::uint64_t element, const Seen& seen,
                                       double radiance) const {
        flat::LightBounds bounds;
        bounds.cone.axis = {0, 0, 1};
        for (unsigned ends = 0; ends < 1u << seen.moving; ++ends) {
            Transform m;
            unsigned moving = 0;
            for (const std::uint32_t row : seen.instances) {
                const flat::Instance& instance = scene_.instances[row];
                const bool last = instance.moving && (ends >> moving++ & 1) != 0;
                m = m * (last ? instance.world_from_object1 : instance.world_from_object0);
            }
            const flat::LightBounds end = planar_light(scene_, range, element, m, inverse(m)).bounds(radiance);
            bounds.box.extend(end.box);
            bounds.strength += end.strength / (1u << seen.moving);
        }
        return bounds;
    }

    flat::Scene& scene_;
    std::vector<double> brightness_;  // by material; 0 if it doesn't emit
    std::vector<bool> emits_;         // by BLAS
    std::vector<LightItem> items_;
};

}  // namespace

void collect_lights(flat::Scene& scene) { LightCollector{scene}; }

}  // namespace limn::compiler
