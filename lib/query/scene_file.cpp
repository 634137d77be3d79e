#include "query/scene_file.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "bsdf/albedo_table.h"
#include "core/checksum.h"
#include "core/chunk_file.h"
#include "flat/tables.h"
#include "limn/core/error.h"
#include "material/lobes.h"

namespace limn::query {

namespace {

constexpr ChunkFormat kScenes{"compiled scene", "limnscen", "scenlimn"};
constexpr std::uint32_t kFormat = 1;

// All that a material's record says but how it scatters, which its kind says.
struct PlainMaterial {
    TextureId texture, emission;
    double parameter;
    std::uint64_t fresnel, sides, specular, has_details;
};

constexpr std::uint32_t kNoList = 0xffffffff;  // of names of materials

struct PlainDetails {
    std::array<double, MaterialDetails::kNumbers> numbers;
    TextureId texture, normal_map, opacity;
    std::uint32_t tangents;
    double opacity_cutoff;
};

struct MeshArrays {
    std::vector<Float3> vertices, normals;
    std::vector<Index3> triangles;
    std::vector<Float2> uvs;
    std::vector<std::uint32_t> material_slots;
};

template <class T>
void require_plain(const T&) {
    static_assert(std::is_trivially_copyable_v<T>);
}

std::uint32_t layout() {
    Checksum sum;
    const flat::Scene scene;
    flat::each_value(scene, [&](const auto& value) { require_plain(value), sum.add(sizeof(value)); });
    flat::each_table(scene, [&]<class Table>(const Table&) {
        static_assert(std::is_trivially_copyable_v<typename Table::value_type>);
        sum.add(sizeof(typename Table::value_type));
    });
    sum.add(sizeof(PlainMaterial)), sum.add(sizeof(PlainDetails)), sum.add(sizeof(PerlinLattice));
    return static_cast<std::uint32_t>(sum.value());
}

// ---- writing -------------------------------------------------------------------------------------------------------

void require_own(const flat::Scene& s) {
    const auto refuse = [](const char* what) {
        throw ArgumentError(std::string("CompiledScene::save: the scene has user-defined ") + what);
    };
    if (!s.user_defined.empty()) refuse("shapes");
    if (s.features.user_defined_textures) refuse("textures");
    for (const MaterialRecord& m : s.materials)
        if (known_material(m.kind) == nullptr) refuse("materials");
}

class SceneWriter {
public:
    SceneWriter(const flat::Scene& scene, const std::string& path)
        : scene_(scene), file_(path, kScenes, scene_file_versions()) {}

    void write() {
        std::vector<std::byte> values;
        flat::each_value(scene_, [&](const auto& value) {
            const auto bytes = std::as_bytes(std::span(&value, 1));
            values.insert(values.end(), bytes.begin(), bytes.end());
        });
        file_.chunk(values);
        flat::each_table(scene_, [&](const auto& table) { put(table); });
        put(scene_.name), put(scene_.feature_names);
        put_material_names();
        put_number(scene_.materials.size());
        for (const MaterialRecord& m : scene_.materials) {
            put(m.kind);
            put(std::array{PlainMaterial{m.texture, m.emission, m.parameter, static_cast<std::uint64_t>(m.fresnel),
                                         static_cast<std::uint64_t>(m.sides), m.specular ? 1u : 0u,
                                         m.details ? 1u : 0u}});
            if (m.details) put_details(*m.details);
        }
        put_number(scene_.meshes.size());
        for (const flat::Mesh& mesh : scene_.meshes) {
            const MeshView& a = mesh.arrays;
            put(mesh.materials), put(mesh.places);
            put(a.vertices), put(a.normals), put(a.triangles), put(a.uvs), put(a.material_slots);
        }
        put_number(scene_.images.size());
        for (const auto& image : scene_.images) put_image(*image);
        put_number(scene_.environment.image ? 1 : 0);
        if (scene_.environment.image) put_image(*scene_.environment.image);
        put_number(scene_.lattices.size());
        for (const auto& lattice : scene_.lattices) put(std::span(lattice.get(), 1));
        file_.finish();
    }

private:
    template <class Table>
    void put(const Table& table) {
        file_.chunk(std::as_bytes(std::span(table)));
    }
    void put_details(const MaterialDetails& d) {
        put(std::array{
            PlainDetails{d.numbers, d.texture, d.normal_map, d.opacity, d.tangents ? 1u : 0u, d.opacity_cutoff}});
        for (const auto& table : {d.albedo_table, d.coat_albedo_table}) {
            put_number(table ? table->rows : 0);
            if (table) put(table->albedo), put(table->mean);
        }
    }
    // Each list of names once, and which of them an object has.
    void put_material_names() {
        std::vector<const std::vector<std::string>*> lists;
        std::vector<std::uint32_t> list_of_object;
        for (const auto& names : scene_.material_names) {
            const auto found = names ? std::ranges::find(lists, names.get()) : lists.end();
            list_of_object.push_back(names ? static_cast<std::uint32_t>(found - lists.begin()) : kNoList);
            if (names && found == lists.end()) lists.push_back(names.get());
        }
        put_number(lists.size());
        for (const auto* names : lists) {
            put_number(names->size());
            for (const std::string& name : *names) put(name);
        }
        put(list_of_object);
    }
    void put_image(const Image& image) {
        put(std::array{image.width(), image.height()});
        put(image.values());
    }
    void put_number(std::size_t number) { put(std::array{std::uint64_t{number}}); }

    const flat::Scene& scene_;
    ChunkWriter file_;
};

// ---- reading -------------------------------------------------------------------------------------------------------

class SceneReader {
public:
    explicit SceneReader(const std::string& path) : file_(path, kScenes, versions_) {
        if (versions_[0] != kFormat)
            file_.fail("is a compiled scene of format " + std::to_string(versions_[0]) +
                       "; this version of limn reads format " + std::to_string(kFormat));
        if (versions_[1] != layout()) file_.fail("is a compiled scene of another version of limn");
    }

    void read(flat::Scene& s) {
        const std::vector<std::byte> values = file_.chunk("its values");
        std::size_t at = 0;
        flat::each_value(s, [&](auto& value) {
            if (values.size() - at < sizeof(value)) file_.fail_damaged("its values");
            std::memcpy(&value, &values[at], sizeof(value));
            at += sizeof(value);
        });
        flat::each_table(s, [&](auto& table) { get(table); });
        get(s.name), get(s.feature_names);
        read_material_names(s);
        s.materials.resize(get_number());
        for (MaterialRecord& m : s.materials) read_material(m);
        s.meshes.resize(get_number());
        for (flat::Mesh& mesh : s.meshes) read_mesh(mesh);
        s.images.resize(get_number());
        for (auto& image : s.images) read_image(image);
        if (get_number() > 0) read_image(s.environment.image);
        s.lattices.resize(get_number());
        for (auto& lattice : s.lattices) {
            auto own = std::make_shared<PerlinLattice>();
            get_one(*own);
            lattice = own;
        }
        file_.finish();
    }

private:
    template <class Table>
    void get(Table& table) {
        file_.table("a table", table);
    }
    template <class T>
    void get_one(T& value) {
        const std::vector<std::byte> bytes = file_.chunk("a value", sizeof(T), sizeof(T));
        std::memcpy(&value, bytes.data(), sizeof(T));
    }
    // Of things that take a chunk each, at least.
    std::size_t get_number() {
        std::uint64_t number = 0;
        get_one(number);
        if (number > file_.left() / ChunkReader::kLeastChunk) file_.fail("is cut short");
        return static_cast<std::size_t>(number);
    }

    void read_material_names(flat::Scene& s) {
        std::vector<std::shared_ptr<std::vector<std::string>>> lists(get_number());
        for (auto& names : lists) {
            names = std::make_shared<std::vector<std::string>>(get_number());
            for (std::string& name : *names) get(name);
        }
        std::vector<std::uint32_t> list_of_object;
        get(list_of_object);
        for (const std::uint32_t list : list_of_object) {
            if (list != kNoList && list >= lists.size()) file_.fail_damaged("names of materials");
            s.material_names.push_back(list == kNoList ? nullptr : lists[list]);
        }
    }

    void read_material(MaterialRecord& m) {
        std::string kind;
        get(kind);
        const KnownMaterial* const known = known_material(kind);
        if (known == nullptr) file_.fail("has a material that this version of limn does not know: " + kind);
        PlainMaterial plain{};
        get_one(plain);
        m.kind = known->kind, m.lobe = known->lobe;
        m.texture = plain.texture, m.emission = plain.emission, m.parameter = plain.parameter;
        m.fresnel = static_cast<Fresnel>(plain.fresnel), m.sides = static_cast<Sides>(plain.sides);
        m.specular = plain.specular != 0;
        if (plain.has_details != 0) m.details = std::make_shared<MaterialDetails>(get_details());
    }

    MaterialDetails get_details() {
        PlainDetails plain{};
        get_one(plain);
        MaterialDetails d;
        d.numbers = plain.numbers, d.texture = plain.texture;
        d.normal_map = plain.normal_map, d.opacity = plain.opacity, d.opacity_cutoff = plain.opacity_cutoff;
        d.tangents = plain.tangents != 0;
        for (auto* table : {&d.albedo_table, &d.coat_albedo_table}) {
            bsdf::AlbedoTable own;
            std::uint64_t rows = 0;
            get_one(rows);
            if (rows == 0) continue;
            own.rows = static_cast<std::size_t>(rows);
            get(own.albedo), get(own.mean);
            *table = std::make_shared<bsdf::AlbedoTable>(std::move(own));
        }
        return d;
    }

    void read_mesh(flat::Mesh& mesh) {
        const auto own = std::make_shared<MeshArrays>();
        get(mesh.materials), get(mesh.places);
        get(own->vertices), get(own->normals), get(own->triangles), get(own->uvs), get(own->material_slots);
        if (own->triangles.empty()) {
            mesh.slots = std::move(own->material_slots);
            mesh.arrays.material_slots = mesh.slots;
            return;
        }
        mesh.arrays = {own->vertices, own->triangles, own->normals, own->uvs, own->material_slots};
        mesh.owner = own;
    }

    void read_image(std::shared_ptr<const Image>& image) {
        std::array<int, 2> size{};
        get_one(size);
        std::vector<float> values;
        get(values);
        const auto [width, height] = size;
        if (width < 1 || height < 1 ||
            values.size() / 3 / static_cast<std::size_t>(width) != static_cast<std::size_t>(height) ||
            values.size() % (3 * static_cast<std::size_t>(width)) != 0)
            file_.fail_damaged("an image");
        auto own = std::make_shared<Image>(width, height);
        std::ranges::copy(values, own->values().begin());
        image = own;
    }

    std::array<std::uint32_t, 2> versions_{};
    ChunkReader file_;
};

}  // namespace

std::array<std::uint32_t, 2> scene_file_versions() { return {kFormat, layout()}; }

void write_scene(const flat::Scene& scene, const std::string& path) {
    require_own(scene);
    SceneWriter(scene, path).write();
}

flat::Scene read_scene(const std::string& path) {
    flat::Scene scene;
    SceneReader(path).read(scene);
    return scene;
}

}  // namespace limn::query
