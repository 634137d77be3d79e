#include "flat/steps.h"
#include "geometry/registry.h"
#include "math/system/checksum.h"

namespace limn::compiler {

namespace {

// A checksum of records. They are added field by field, because the padding between fields isn't defined.
class SceneChecksum {
public:
    Hash128 digest() const { return sum_.digest(); }

    template <class... Fields>
    void add(const Fields&... fields) {
        (add_one(fields), ...);
    }

    // Adds the number of records, then each record by add_record().
    template <class Record, class Function>
    void table(const std::vector<Record>& records, const Function& add_record) {
        sum_.add(std::uint64_t{records.size()});
        for (const Record& record : records) add_record(record);
    }
    // Adds an array of records that consist of 4-byte numbers without padding.
    template <class Numbers>
    void array(std::span<const Numbers> numbers) {
        static_assert(sizeof(Numbers) % 4 == 0 && alignof(Numbers) == 4);
        sum_.add(std::uint64_t{numbers.size()});
        sum_.add(std::as_bytes(numbers));
    }
    void text(const std::string& text) { sum_.add(text); }

private:
    template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
    void add_one(Number number) { sum_.add(number); }
    void add_one(const Color& c) { add(c.r, c.g, c.b); }
    void add_one(const Transform& m) {
        for (const auto& row : m.rows)
            for (const double entry : row) add(entry);
    }
    void add_one(const Box& b) { add(b.lower, b.upper); }
    template <class Vector>
    requires requires(Vector v) { v.x, v.y, v.z; }
    void add_one(const Vector& v) { add(v.x, v.y, v.z); }

    Checksum sum_;
};

// Adds the tables of textures and materials.
void add_textures(const SceneRecords& r, SceneChecksum& sum) {
    sum.table(r.textures, [&](const TextureRecord& t) {
        sum.add(t.kind, t.filter, t.wrap, t.data, t.even, t.odd, t.scale, t.color);
    });
    sum.table(r.images, [&](const std::shared_ptr<const Image>& image) {
        sum.add(image->width(), image->height());
        sum.array(image->values());
    });
    sum.table(r.lattices, [&](const std::shared_ptr<const PerlinLattice>& lattice) {
        for (const Vec3& gradient : lattice->gradients) sum.add(gradient);
        for (const auto* permutation : {&lattice->perm_x, &lattice->perm_y, &lattice->perm_z})
            for (const std::uint8_t entry : *permutation) sum.add(entry);
    });
    sum.table(r.materials, [&](const MaterialRecord& m) {
        sum.text(std::string(m.kind));
        for (const double number : m.parameters.numbers) sum.add(number);
        sum.add(m.albedo, m.factors, m.emission, m.sides, m.normal_map, m.opacity, m.opacity_cutoff);
    });
}

void add_meshes(const SceneRecords& r, SceneChecksum& sum) {
    sum.table(r.meshes, [&](const MeshRecord& mesh) {
        const MeshView& a = mesh.arrays;
        sum.array(a.vertices);
        sum.array(a.triangles);
        sum.array(a.normals);
        sum.array(a.uvs);
        sum.array(a.material_slots);
        sum.table(mesh.materials, [&](MaterialId material) { sum.add(material); });
    });
}

// Adds the numbers of a light.
template <class Light>
void add_fields(const Light& light, SceneChecksum& sum) {
    std::apply([&](const auto&... field) { sum.add(field...); }, light.fields());
}

}  // namespace

Hash128 digest_of_unmoved(const SceneRecords& r, const limn::Scene& scene) {
    // Add the background, textures, materials and shapes.
    SceneChecksum sum;
    sum.add(scene.background.bottom, scene.background.top);
    add_textures(r, sum);
    add_meshes(r, sum);
    primitives::for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
        const auto& records = r.*Kind::kRecords;
        if constexpr (requires { Kind::fields(records[0]); })
            sum.table(records, [&](const auto& record) {
                std::apply([&](const auto&... field) { sum.add(field...); }, Kind::fields(record));
            });
    });
    // Add the structure of the scene: instances, media, user-defined objects and BLASes.
    sum.table(r.instances, [&](const InstanceRecord& i) { sum.add(i.blas); });
    sum.table(r.media, [&](const MediumRecord& m) { sum.add(m.boundary, m.phase, m.density); });
    sum.table(r.user_defined, [&](const UserDefinedRecord& f) { sum.add(f.bounds); });
    sum.table(r.blases, [&](const BlasRecord& blas) {
        sum.table(blas.ranges, [&](const PrimitiveRange& range) {
            sum.add(range.kind, range.first_row, range.first_number, range.count);
        });
    });
    sum.table(r.tags, [&](const std::string& tag) { sum.text(tag); });
    // Add the lights and the environment map.
    sum.table(scene.lights(), [&](const LightSource& source) {
        sum.add(std::uint64_t{source.index()});
        std::visit([&](const auto& described) { add_fields(flat::light_from(described), sum); }, source);
    });
    if (const EnvironmentMap* map = scene.environment.get()) {
        const Image& image = *map->image();
        sum.add(image.width(), image.height(), map->world_from_map(), map->scale());
        sum.array(image.values());
    }
    return sum.digest();
}

Hash128 digest_of(const flat::Scene& scene) {
    Checksum sum;
    for (const std::uint64_t word : scene.unmoved_digest) sum.add(word);
    for (const flat::Instance& i : scene.instances) {
        sum.add(std::as_bytes(std::span(i.world_from_object0.rows)));
        sum.add(i.moving);
        if (i.moving) sum.add(std::as_bytes(std::span(i.world_from_object1.rows)));
    }
    return sum.digest();
}

}  // namespace limn::compiler
