#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "bench/transport_scenes.h"
#include "limn/math/error.h"
#include "limn/records/record_sink.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/material/rough_dielectric.h"

namespace limn::bench {
namespace {

using app::Json;

// Throws an Error unless `told` is true. It says that the description for the peers has no `what`.
void require(bool told, const char* what) {
    if (!told) throw Error(std::string("describe: the peers are not told of ") + what);
}

Json triple(const auto& v) { return {v.x, v.y, v.z}; }
Json triple(const Color& c) { return {c.r, c.g, c.b}; }
Json triple(const Index3& t) { return {t.a, t.b, t.c}; }
Json pair(const Float2& uv) { return {uv.u, uv.v}; }

Json list(const auto& elements, const auto& to_json) {
    Json all = Json::array();
    for (const auto& element : elements) all.push_back(to_json(element));
    return all;
}

// Returns an image as its size and its linear values times `scale`, row by row from the top.
Json picture(const Image& image, double scale = 1) {
    const auto scaled = [scale](float v) { return Json(scale * static_cast<double>(v)); };
    return {{"width", image.width()}, {"height", image.height()}, {"values", list(image.values(), scaled)}};
}

Json no_shapes() { return {{"spheres", Json::array()}, {"meshes", Json::array()}, {"media", Json::array()}}; }

// Converts scene records to JSON in world space.
class Description {
public:
    explicit Description(const SceneRecords& records) : records_(records) {}

    // Adds the shapes of a BLAS to the lists "spheres", "meshes" and "media" of `all`, transformed by `place`.
    void add_shapes(BlasId id, const Transform& place, Json& all) const {
        for (const PrimitiveRange& range : records_.blases[static_cast<std::size_t>(id)].ranges) {
            // Convert the primitives by their kind.
            if (range.kind == PrimitiveKind::instance) {
                const InstanceRecord& instance = records_.instances[range.first_row];
                require(!instance.moving, "moving instances");
                add_shapes(instance.blas, place * instance.world_from_object0, all);
            } else if (range.kind == PrimitiveKind::sphere) {
                require(place == Transform{}, "spheres within instances");
                for (const SphereRecord& s : std::span(records_.spheres).subspan(range.first_row, range.count))
                    all["spheres"].push_back(
                        {{"center", triple(s.center0)}, {"radius", s.radius}, {"material", material(s.material)}});
            } else if (range.kind == PrimitiveKind::quad) {
                add_quads(std::span(records_.quads).subspan(range.first_row, range.count), place, all);
            } else if (range.kind == PrimitiveKind::mesh) {
                all["meshes"].push_back(mesh(records_.meshes[range.first_row], place));
            } else {
                require(range.kind == PrimitiveKind::medium, "shapes of other kinds");
                const MediumRecord& m = records_.media[range.first_row];
                const MaterialRecord& phase = records_.materials.at(static_cast<std::size_t>(m.phase));
                require(phase.kind == "isotropic", "other phase functions");
                Json boundary = no_shapes();
                add_shapes(m.boundary, place, boundary);
                all["media"].push_back(
                    {{"boundary", boundary}, {"density", m.density}, {"albedo", texture(phase.albedo)}});
            }
        }
    }

private:
    // Adds quads as meshes. Adjacent quads of the same material become one mesh, so that a box is a closed mesh.
    void add_quads(std::span<const QuadRecord> quads, const Transform& place, Json& all) const {
        while (!quads.empty()) {
            const MaterialId id = quads.front().material;
            Json vertices = Json::array(), triangles = Json::array();
            for (int n = 0; !quads.empty() && quads.front().material == id; n += 4, quads = quads.subspan(1)) {
                const auto& [corner, u, v, _] = quads.front();
                for (const Point3& p : {corner, corner + u, corner + u + v, corner + v})
                    vertices.push_back(triple(transform_point(place, p)));
                triangles.push_back({n, n + 1, n + 2});
                triangles.push_back({n, n + 2, n + 3});
            }
            all["meshes"].push_back({{"vertices", vertices}, {"triangles", triangles}, {"material", material(id)}});
        }
    }

    Json mesh(const MeshRecord& m, const Transform& place) const {
        const auto& slots = m.arrays.material_slots;
        require(std::ranges::adjacent_find(slots, std::not_equal_to()) == slots.end(), "meshes of several materials");
        const auto point = [&](const Float3& v) { return triple(transform_point(place, {v.x, v.y, v.z})); };
        const auto normal = [back = limn::inverse(place)](const Float3& n) {
            return triple(normalize(Vec3(transform_normal(back, {n.x, n.y, n.z}))));
        };
        return {{"vertices", list(m.arrays.vertices, point)},
                {"triangles", list(m.arrays.triangles, [](const Index3& t) { return triple(t); })},
                {"normals", list(m.arrays.normals, normal)},
                {"uvs", list(m.arrays.uvs, pair)},
                {"material", material(m.materials.at(slots.empty() ? 0 : slots[0]))}};
    }

    Json material(MaterialId id) const {
        const MaterialRecord& m = records_.materials.at(static_cast<std::size_t>(id));
        Json told = lobe(m);
        if (m.normal_map != TextureId::none) told["normal_map"] = texture(m.normal_map);
        if (m.opacity != TextureId::none) told["opacity"] = texture(m.opacity);
        require(m.opacity_cutoff == 0, "a cutoff of opacities");
        return told;
    }

    // Returns the scattering or emission of a material.
    Json lobe(const MaterialRecord& m) const {
        if (m.kind == "lambertian") return {{"kind", "lambertian"}, {"color", texture(m.albedo)}};
        if (m.kind == "diffuse-light") {
            require(m.sides == Sides::both, "one-sided lamps");
            return {{"kind", "light"}, {"color", texture(m.emission)}};
        }
        if (m.kind == "metal") {
            require(m.parameters.as<Metal::Parameters>().fuzz == 0, "metal that is not a mirror");
            return {{"kind", "mirror"}, {"color", texture(m.albedo)}};
        }
        if (m.kind == "dielectric") {
            const auto glass = m.parameters.as<Dielectric::Parameters>();
            require(glass.exact_fresnel == 1, "Schlick's approximation");
            return {{"kind", "glass"}, {"index", glass.index}};
        }
        const auto require_plain = [](double alpha_x, double alpha_y) {
            require(alpha_x != 0 && alpha_x == alpha_y, "brushed or smooth microfacets");
        };
        if (m.kind == "rough-dielectric") {
            const auto glass = m.parameters.as<RoughDielectric::Parameters>();
            require_plain(glass.alpha_x, glass.alpha_y);
            return {{"kind", "rough-glass"}, {"index", glass.index}, {"alpha", glass.alpha_x}};
        }
        require(m.kind == "rough-conductor", "materials of other classes");
        const auto metal = m.parameters.as<RoughConductor::Parameters>();
        require_plain(metal.alpha_x, metal.alpha_y);
        const TextureRecord& reflectance = records_.textures.at(static_cast<std::size_t>(m.albedo));
        require(reflectance.kind == TextureKind::solid, "metals that are not of one colour");
        return {{"kind", "rough-conductor"},
                {"reflectance", triple(reflectance.color)},
                {"edge_tint", {metal.edge_tint_r, metal.edge_tint_g, metal.edge_tint_b}},
                {"alpha", metal.alpha_x}};
    }

    Json texture(TextureId id) const {
        const TextureRecord& t = records_.textures.at(static_cast<std::size_t>(id));
        if (t.kind == TextureKind::solid) return triple(t.color);
        if (t.kind == TextureKind::checker)
            return {{"cell", t.scale}, {"even", texture(t.even)}, {"odd", texture(t.odd)}};
        require(t.kind == TextureKind::image, "noise");
        require(t.filter == Filter::bilinear && t.wrap == Wrap::repeat, "other filters and wraps");
        return {{"picture", picture(*records_.images.at(t.data))}};
    }

    const SceneRecords& records_;
};

Json describe_light(const LightSource& light) {
    const auto* sun = std::get_if<SunLight>(&light);
    require(sun, "lights that are neither shapes nor suns");
    const Json direction = triple(sun->direction), irradiance = triple(sun->irradiance);
    return {{"direction", direction}, {"irradiance", irradiance}, {"angular_radius", sun->angular_radius}};
}

Json describe_camera(const Camera& c) {
    const double focus = c.focus_distance.value_or(length(c.look_at - c.look_from));
    const double half_angle = c.aperture_angle * std::numbers::pi / 360;
    return {{"look_from", triple(c.look_from)},
            {"look_at", triple(c.look_at)},
            {"up", triple(c.up)},
            {"vertical_fov", c.vertical_fov},
            {"focus_distance", focus},
            {"lens_radius", focus * std::tan(half_angle)}};
}

}  // namespace

Json describe_scene(const Figure& figure) {
    const Scene& scene = figure.scene;
    RecordSink sink;
    for (const auto& object : scene.objects()) object->lower(sink);
    Json json = no_shapes();
    Description(sink.records()).add_shapes(BlasId::root, Transform{}, json);
    json["max_depth"] = figure.settings.max_depth;
    json["camera"] = describe_camera(figure.camera);
    json["background"] = {{"bottom", triple(scene.background.bottom)}, {"top", triple(scene.background.top)}};
    json["suns"] = list(scene.lights(), describe_light);
    const EnvironmentMap* map = scene.environment.get();
    require(!map || map->world_from_map() == Transform{}, "turned environment maps");
    json["environment"] = map ? picture(*map->image(), map->scale()) : Json();
    return json;
}

}  // namespace limn::bench
