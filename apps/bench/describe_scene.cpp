#include "bench/describe_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "limn/core/error.h"
#include "limn/material/rough_conductor.h"
#include "limn/record_sink.h"

namespace limn::bench {

namespace {

using app::Json;

[[noreturn]] void refuse(const char* what) { throw Error(std::string("describe: the peers are not told of ") + what); }

Json triple(const Point3& p) { return {p.x, p.y, p.z}; }
Json triple(const Vec3& v) { return {v.x, v.y, v.z}; }
Json triple(const Color& c) { return {c.r, c.g, c.b}; }

// Row by row from the top, linear.
Json picture(const Image& image, double scale = 1) {
    std::vector<double> values;
    for (const float v : image.values()) values.push_back(scale * static_cast<double>(v));
    return {{"width", image.width()}, {"height", image.height()}, {"values", values}};
}

// The index of refraction whose reflectance and edge tint a RoughConductor keeps: see there.
ComplexIndex index_of(const Color& reflectance, const std::array<double, MaterialDetails::kNumbers>& tint) {
    ComplexIndex index;
    const auto component = [](double r, double g, double& eta, double& k) {
        const double root = std::sqrt(r);
        eta = g * (1 - r) / (1 + r) + (1 - g) * (1 + root) / (1 - root);
        k = std::sqrt(std::max(0.0, (r * (eta + 1) * (eta + 1) - (eta - 1) * (eta - 1)) / (1 - r)));
    };
    component(reflectance.r, tint[0], index.eta.r, index.k.r);
    component(reflectance.g, tint[1], index.eta.g, index.k.g);
    component(reflectance.b, tint[2], index.eta.b, index.k.b);
    return index;
}

class Description {
public:
    explicit Description(const SceneRecords& records) : records_(records) {}

    Json blas(BlasId id, const Transform& place) const {
        Json shapes = {
            {"spheres", Json::array()}, {"quads", Json::array()}, {"meshes", Json::array()}, {"media", Json::array()}};
        add_blas(id, place, shapes);
        return shapes;
    }

private:
    void add_blas(BlasId id, const Transform& place, Json& shapes) const {
        for (const PrimitiveRange& range : records_.blases[static_cast<std::size_t>(id)].ranges) {
            // One row is one primitive or, of a mesh, instance or medium, many.
            const std::uint64_t rows =
                range.kind == PrimitiveKind::sphere || range.kind == PrimitiveKind::quad ? range.count : 1;
            for (std::uint64_t i = 0; i < rows; ++i) add_row(range.kind, range.first_row + i, place, shapes);
        }
    }

    void add_row(PrimitiveKind kind, std::size_t row, const Transform& place, Json& shapes) const {
        switch (kind) {
            case PrimitiveKind::sphere: return shapes["spheres"].push_back(sphere(records_.spheres[row], place));
            case PrimitiveKind::quad: return shapes["quads"].push_back(quad(records_.quads[row], place));
            case PrimitiveKind::mesh: return shapes["meshes"].push_back(mesh(records_.meshes[row], place));
            case PrimitiveKind::medium: return shapes["media"].push_back(medium(records_.media[row], place));
            case PrimitiveKind::instance: {
                const InstanceRecord& instance = records_.instances[row];
                if (instance.moving) refuse("moving instances");
                return add_blas(instance.blas, place * instance.world_from_object0, shapes);
            }
            default: refuse("shapes of other kinds");
        }
    }

    Json sphere(const SphereRecord& s, const Transform& place) const {
        if (!(place == Transform{})) refuse("spheres within instances");
        return {{"center", triple(s.center0)}, {"radius", s.radius}, {"material", material(s.material)}};
    }

    Json quad(const QuadRecord& q, const Transform& place) const {
        return {{"corner", triple(transform_point(place, q.corner))},
                {"edge_u", triple(transform_vector(place, q.edge_u))},
                {"edge_v", triple(transform_vector(place, q.edge_v))},
                {"material", material(q.material)}};
    }

    Json mesh(const MeshRecord& m, const Transform& place) const {
        const auto& slots = m.arrays.material_slots;
        if (std::ranges::adjacent_find(slots, std::not_equal_to()) != slots.end()) refuse("many-coloured meshes");
        Json vertices = Json::array(), triangles = Json::array(), normals = Json::array(), uvs = Json::array();
        const Transform object_from_world = limn::inverse(place);
        for (const Float3& n : m.arrays.normals)
            normals.push_back(triple(normalize(Vec3(transform_normal(object_from_world, {n.x, n.y, n.z})))));
        for (const Float2& uv : m.arrays.uvs) uvs.push_back({uv.u, uv.v});
        for (const Float3& v : m.arrays.vertices) vertices.push_back(triple(transform_point(place, {v.x, v.y, v.z})));
        for (const Index3& t : m.arrays.triangles) triangles.push_back({t.a, t.b, t.c});
        return {{"vertices", vertices},
                {"triangles", triangles},
                {"normals", normals},
                {"uvs", uvs},
                {"material", material(m.materials.at(slots.empty() ? 0 : slots[0]))}};
    }

    Json medium(const MediumRecord& m, const Transform& place) const {
        const MaterialRecord& phase = records_.materials.at(static_cast<std::size_t>(m.phase));
        if (phase.kind != "isotropic") refuse("phase functions of other classes");
        return {{"boundary", blas(m.boundary, place)}, {"density", m.density}, {"albedo", texture(phase.texture)}};
    }

    Json material(MaterialId id) const {
        const MaterialRecord& m = records_.materials.at(static_cast<std::size_t>(id));
        Json told = lobe(m);
        if (!m.details) return told;
        if (m.details->normal_map != TextureId::none) told["normal_map"] = texture(m.details->normal_map);
        if (m.details->opacity != TextureId::none) {
            if (m.details->opacity_cutoff != 0) refuse("a cutoff of opacities");
            told["opacity"] = texture(m.details->opacity);
        }
        return told;
    }

    Json lobe(const MaterialRecord& m) const {
        if (m.kind == "lambertian") return {{"kind", "lambertian"}, {"color", texture(m.texture)}};
        if (m.kind == "diffuse-light") {
            if (m.sides != Sides::both) refuse("one-sided lamps");
            return {{"kind", "light"}, {"color", texture(m.emission)}};
        }
        if (m.kind == "metal") {
            if (m.parameter != 0) refuse("metal that is not a mirror");
            return {{"kind", "mirror"}, {"color", texture(m.texture)}};
        }
        if (m.kind == "dielectric") {
            if (m.fresnel != Fresnel::exact) refuse("Schlick's approximation");
            return {{"kind", "glass"}, {"index", m.parameter}};
        }
        if (m.kind != "rough-conductor" && m.kind != "rough-dielectric") refuse("materials of other classes");
        const auto& numbers = m.details->numbers;
        if (numbers[3] != numbers[4] || numbers[3] == 0) refuse("brushed or smooth microfacets");
        if (m.kind == "rough-dielectric")
            return {{"kind", "rough-glass"}, {"index", m.parameter}, {"alpha", numbers[3]}};
        const TextureRecord& reflectance = records_.textures.at(static_cast<std::size_t>(m.texture));
        if (reflectance.kind != TextureKind::solid) refuse("metals that are not of one colour");
        const ComplexIndex index = index_of(reflectance.color, numbers);
        return {{"kind", "rough-conductor"}, {"eta", triple(index.eta)}, {"k", triple(index.k)}, {"alpha", numbers[3]}};
    }

    // A colour, the two of a checker, or a picture.
    Json texture(TextureId id) const {
        const TextureRecord& t = records_.textures.at(static_cast<std::size_t>(id));
        if (t.kind == TextureKind::solid) return triple(t.color);
        if (t.kind == TextureKind::image) {
            if (t.filter != Filter::bilinear || t.wrap != Wrap::repeat) refuse("other filters and wraps");
            return {{"picture", picture(*records_.images.at(t.data))}};
        }
        if (t.kind != TextureKind::checker) refuse("noise");
        return {{"cell", t.scale}, {"even", texture(t.even)}, {"odd", texture(t.odd)}};
    }

    const SceneRecords& records_;
};

Json describe_suns(const Scene& scene) {
    Json suns = Json::array();
    for (const LightSource& light : scene.lights()) {
        const auto* sun = std::get_if<SunLight>(&light);
        if (!sun) refuse("lights that are no shapes, but for suns");
        suns.push_back({{"direction", triple(sun->direction)},
                        {"irradiance", triple(sun->irradiance)},
                        {"angular_radius", sun->angular_radius}});
    }
    return suns;
}

Json describe_environment(const Scene& scene) {
    if (!scene.environment) return {};
    if (!(scene.environment->world_from_map() == Transform{})) refuse("turned environment maps");
    return picture(*scene.environment->image(), scene.environment->scale());
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
    RecordSink sink;
    for (const auto& object : figure.scene.objects()) object->lower(sink);
    Json json = {{"name", figure.name},
                 {"max_depth", figure.settings.max_depth},
                 {"camera", describe_camera(figure.camera)},
                 {"background",
                  {{"bottom", triple(figure.scene.background.bottom)}, {"top", triple(figure.scene.background.top)}}}};
    json["suns"] = describe_suns(figure.scene);
    json["environment"] = describe_environment(figure.scene);
    json.update(Description(sink.records()).blas(BlasId::root, Transform{}));
    return json;
}

}  // namespace limn::bench
