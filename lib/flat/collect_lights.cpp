#include <algorithm>
#include <cmath>

#include "flat/light_tree.h"
#include "flat/reach.h"
#include "flat/steps.h"
#include "geometry/hit_error.h"
#include "geometry/mesh_triangle.h"

namespace limn::compiler {

namespace {

// A texture that cannot be sampled, as a whole or in part: it may ask for what only a traced hit knows.
bool is_user_defined(const flat::Scene& scene, TextureId id) {
    const TextureRecord& t = scene.textures[static_cast<std::size_t>(id)];
    return t.kind == TextureKind::user_defined ||
           (t.kind == TextureKind::checker && (is_user_defined(scene, t.even) || is_user_defined(scene, t.odd)));
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
        case TextureKind::user_defined: break;  // not sampled
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

// Of an emitter in instances of instances of instances more copies than these are left to scattering.
constexpr std::size_t kMaxLights = std::size_t{1} << 22;
// Triangles of meshes are worked out anew for each use where they would be more.
constexpr std::size_t kMostOwn = std::size_t{1} << 14;
// Of moving instances around an emitter: where it may be is known from all combinations of their ends.
constexpr int kMostMoving = 4;

// The way from a BLAS to the scene: the composed matrices at both ends of the shutter, and what they were composed of.
struct Seen {
    Transform at0, at1;
    std::vector<std::uint32_t> instances;  // rows, outermost first
    int moving = 0;                        // of these
    bool straight = true;                  // none of these turns or stretches while it moves
};

bool same_but_for_translation(const Transform& a, Transform b) {
    for (std::size_t i = 0; i < 3; ++i) b.rows[i][3] = a.rows[i][3];
    return a == b;
}

class LightCollector {
public:
    explicit LightCollector(flat::Scene& scene) : scene_(scene) {
        for (const MaterialRecord& m : scene.materials) {
            const bool is_sampled = m.emission != TextureId::none && !is_user_defined(scene, m.emission) &&
                                    (!flat::has_holes(m) || !is_user_defined(scene, m.opacity));
            brightness_.push_back(is_sampled ? typical_brightness(scene, m.emission) : 0);
        }
        emits_ = blases_that_reach(scene, [&](const PrimitiveRange& range) { return any_emits(range); });
        visit(BlasId::root, 0, {});
        add_sources();
        add_environment();
        build_light_tree(std::move(items_), scene.lights);
    }

private:
    void add_sources() {
        for (std::size_t row = 0; row < scene_.light_sources.size(); ++row) {
            const LightRecord& source = scene_.light_sources[row];
            const double strength = max_component(source.color);
            if (!(strength > 0)) continue;
            flat::Light light;
            light.number = row;
            light.origin = source.position;
            light.edge_u = -source.direction;
            light.radius = source.one_minus_cos;
            switch (source.kind) {
                case LightSourceKind::point: add_point(flat::LightKind::point, light, strength); break;
                case LightSourceKind::spot: add_point(flat::LightKind::spot, light, strength); break;
                case LightSourceKind::directional: add_distant(flat::LightKind::directional, light, strength); break;
                case LightSourceKind::sun: add_distant(flat::LightKind::sun, light, strength); break;
            }
        }
    }

    void add_point(flat::LightKind kind, flat::Light light, double strength) {
        light.kind = kind;
        const LightBounds bounds{flat::bounds_of(light), {{0, 0, 1}, flat::kNoNormals}, strength};
        items_.push_back({own(light), LightItem::kNoPrimitive, bounds});
    }

    void add_distant(flat::LightKind kind, flat::Light light, double irradiance) {
        light.kind = kind;
        const double one_minus_cos = light.radius;
        scene_.lights.distant.push_back({light, irradiance, std::sqrt(one_minus_cos * (2 - one_minus_cos))});
    }

    // A plane gets a quarter of what comes from all around, in the mean over its directions.
    void add_environment() {
        const flat::Environment& map = scene_.environment;
        if (map.is_sampled()) add_distant(flat::LightKind::environment, {}, map.scale * map.luminance / 4);
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
                add(row, number, seen);
        }
    }

    void enter(std::uint32_t row, std::uint64_t number, Seen seen) {
        const flat::Instance& instance = scene_.instances[row];
        const Transform& m0 = instance.world_from_object0;
        const Transform& m1 = instance.moving ? instance.world_from_object1 : m0;
        seen.at0 = seen.at0 * m0, seen.at1 = seen.at1 * m1;
        seen.instances.push_back(row);
        if (instance.moving) {
            if (++seen.moving > kMostMoving) return;
            seen.straight = seen.straight && same_but_for_translation(m0, m1);
        }
        visit(instance.blas, number, seen);
    }

    // The lights of one range, seen through instances.
    void add(std::uint32_t row, std::uint64_t number, const Seen& seen) {
        const PrimitiveRange& range = scene_.ranges[row];
        const bool planar = range.kind != PrimitiveKind::sphere && range.kind != PrimitiveKind::moving_sphere;
        const Transform inv = inverse(seen.at0);
        const bool are_many = scene_.lights.own.size() + range.count > kMostOwn;
        const bool placed = planar && (seen.moving > 0 || (range.kind == PrimitiveKind::mesh && are_many));
        const auto place = static_cast<std::uint32_t>(scene_.lights.places.size());
        std::size_t found = items_.size();
        for (std::uint64_t e = 0; e < range.count && items_.size() < kMaxLights; ++e) {
            if (!(brightness(material_of(scene_, range, e)) > 0)) continue;
            std::optional<flat::Light> light = planar ? flat_one(range, e, seen, inv) : sphere(range, e, seen, inv);
            if (!light) continue;
            light->number = number + e;
            LightItem& item = items_.emplace_back();
            item.number = light->number;
            item.bounds = planar && seen.moving > 0 ? bounds_of_moving(range, e, seen) : bounds_of(*light);
            item.ref = placed ? flat::LightRef{place, static_cast<std::uint32_t>(e)} : own(*light);
        }
        if (placed && items_.size() > found) add_place(row, number, seen, inv);
    }

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

    // Nothing where it has no area.
    std::optional<flat::Light> flat_one(const PrimitiveRange& range, std::uint64_t element, const Seen& seen,
                                        const Transform& inv) const {
        if (range.kind == PrimitiveKind::mesh &&
            is_degenerate(triangle_of(scene_, scene_.meshes[range.first_row], element)))
            return std::nullopt;
        const flat::Light light = planar_light(scene_, range, element, seen.at0, inv);
        return length_squared(cross(light.edge_u, light.edge_v)) > 0 ? std::optional(light) : std::nullopt;
    }

    // Nothing where the instances bend it, or turn it while it moves, nor where it has holes: through them scattering
    // finds its far side too, which is not drawn.
    std::optional<flat::Light> sphere(const PrimitiveRange& range, std::uint64_t element, const Seen& seen,
                                      const Transform& inv) const {
        SphereRecord s;
        primitives::with_row(scene_.rows, range.kind, range.first_row + element, [&](const auto& primitive) {
            if constexpr (requires { primitive.ball(); }) s = primitive.ball();
        });
        if (flat::has_holes(scene_.materials[static_cast<std::size_t>(s.material)])) return std::nullopt;
        const std::optional<double> scale = uniform_scale(seen.at0);
        // Texture coordinates belong to the object's own axes and side.
        const bool plain = flat::is_plain(scene_, scene_.materials[static_cast<std::size_t>(s.material)].emission);
        const bool own_axes = seen.at0 == Transform{} && s.radius > 0;
        if (!scale || !seen.straight || (!own_axes && !plain)) return std::nullopt;
        flat::Light light;
        light.kind = flat::LightKind::sphere;
        light.material = s.material;
        light.side =
            flat::side_of(scene_.materials[static_cast<std::size_t>(s.material)].sides, /*mirrored*/ s.radius < 0);
        light.textured = !plain;
        light.origin = transform_point(seen.at0, s.center0);
        light.edge_u = transform_point(seen.at1, s.center1) - light.origin;
        light.radius = *scale * std::abs(s.radius);
        const double reach = std::max(max_abs(light.origin), max_abs(light.origin + light.edge_u)) + light.radius;
        const double own_reach = std::max(max_abs(s.center0), max_abs(s.center1));
        light.position_error = transformed_error(seen.at0, inv, Point3{reach, reach, reach},
                                                 along_every_axis(gamma(16) * (own_reach + std::abs(s.radius))));
        return light;
    }

    LightBounds bounds_of(const flat::Light& light) const {
        const Box box = flat::bounds_of(light);
        const double radiance = brightness(light.material);
        if (light.kind == flat::LightKind::sphere)
            return {box, {{0, 0, 1}, flat::kNoNormals}, radiance * kPi * light.radius * light.radius};
        const Vec3 normal = cross(light.edge_u, light.edge_v), axis = normalize(normal);
        return {box, {axis, is_finite(axis) ? 1.0 : 0.0}, radiance * length(normal) * light.share};
    }

    // A point's place under a product of matrices, each linear in time, lies in the hull of its places for all
    // combinations of their ends (the product's Bernstein form has no negative weights).
    LightBounds bounds_of_moving(const PrimitiveRange& range, std::uint64_t element, const Seen& seen) const {
        LightBounds bounds;
        bounds.cone.axis = {0, 0, 1};
        for (unsigned ends = 0; ends < 1u << seen.moving; ++ends) {
            Transform m;
            unsigned moving = 0;
            for (const std::uint32_t row : seen.instances) {
                const flat::Instance& instance = scene_.instances[row];
                const bool last = instance.moving && (ends >> moving++ & 1) != 0;
                m = m * (last ? instance.world_from_object1 : instance.world_from_object0);
            }
            const LightBounds end = bounds_of(planar_light(scene_, range, element, m, inverse(m)));
            bounds.box.extend(end.box);
            bounds.strength += end.strength / (1u << seen.moving);
        }
        return bounds;
    }

    flat::Scene& scene_;
    std::vector<double> brightness_;  // by material; 0: does not emit
    std::vector<bool> emits_;         // by BLAS
    std::vector<LightItem> items_;
};

}  // namespace

void collect_lights(flat::Scene& scene) { LightCollector{scene}; }

}  // namespace limn::compiler
