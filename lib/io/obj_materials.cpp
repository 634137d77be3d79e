#include "io/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "io/read_file.h"
#include "io/text_lines.h"
#include "limn/core/error.h"
#include "limn/io/image_io.h"
#include "limn/material/dielectric.h"
#include "limn/material/diffuse_light.h"
#include "limn/material/lambertian.h"
#include "limn/material/metal.h"
#include "limn/texture/image_texture.h"

namespace limn {

namespace {

namespace fs = std::filesystem;

// A path in an OBJ or MTL file is relative to that file; Windows programs write backslashes.
std::string beside(const std::string& file, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return (fs::path(file).parent_path() / name).string();
}

bool exists(const std::string& path) {
    std::error_code unusable;
    return fs::exists(path, unusable);
}

Color to_color(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }

class MaterialLoader {
public:
    MaterialLoader(bool textures, Model& model)
        : textures_wanted_(textures), files_(model.files), warnings_(model.warnings) {}

    // `names`: what stands behind mtllib, one name, which may contain blanks, or several.
    void add_libraries(const std::string& names, const std::string& obj_path) {
        if (names.empty()) return warnings_.push_back(obj_path + ": mtllib without the name of a file");
        if (exists(beside(obj_path, names))) return add_library(beside(obj_path, names));
        std::istringstream words(names);
        for (std::string name; words >> name;) {
            const std::string path = beside(obj_path, name);
            if (exists(path))
                add_library(path);
            else
                warnings_.push_back(path + ": there is no such material library");
        }
    }

    std::shared_ptr<const Material> make(const std::string& name, const std::shared_ptr<const Material>& fallback) {
        const auto found = materials_.find(name);
        if (found != materials_.end()) return make(name, found->second);
        warnings_.push_back("unknown material " + in_quotes(name));
        return fallback;
    }

private:
    void add_library(const std::string& path) {
        files_.push_back(path);
        std::string text;
        try {
            text = read_file(path);
        } catch (const FileError& error) {
            warnings_.emplace_back(error.what());
            return;
        }
        std::map<std::string, MtlMaterial> added;
        parse_mtl(text, path, added, warnings_);
        for (auto& [name, material] : added) {
            if (!material.diffuse_map.empty()) material.diffuse_map = beside(path, material.diffuse_map);
            materials_.try_emplace(name, std::move(material));
        }
    }

    // The table in limn/io/obj.h, from the top.
    std::shared_ptr<const Material> make(const std::string& name, const MtlMaterial& m) {
        const auto illumination_is = [&m](std::initializer_list<int> models) {
            return std::find(models.begin(), models.end(), m.illumination) != models.end();
        };
        const Color emission = clamped(to_color(m.emission), HUGE_VAL, "Ke", name);
        const Color diffuse = clamped(to_color(m.diffuse), 1, "Kd", name);
        const Color specular = clamped(to_color(m.specular), 1, "Ks", name);
        if (!is_black(emission)) return std::make_shared<DiffuseLight>(emission);
        if (m.opacity < 1 || illumination_is({4, 6, 7, 9}))
            return std::make_shared<Dielectric>(m.index > 1 ? m.index : 1.5);
        // The roughness of the microfacets whose lobe is as wide as Phong's with exponent Ns (Walter et al., Microfacet
        // Models for Refraction through Rough Surfaces, EGSR 2007, section 5.2).
        if (illumination_is({3, 5, 8}) || luminance(specular) > luminance(diffuse))
            return std::make_shared<Metal>(specular, std::min(1.0, std::sqrt(2 / (std::max(m.shininess, 0.0) + 2))));
        if (textures_wanted_ && !m.diffuse_map.empty())
            if (const auto image = load_texture(m.diffuse_map))
                return std::make_shared<Lambertian>(std::make_shared<ImageTexture>(image));
        return std::make_shared<Lambertian>(diffuse);
    }

    Color clamped(const Color& c, double largest, const char* key, const std::string& name) {
        const Color result{std::clamp(c.r, 0.0, largest), std::clamp(c.g, 0.0, largest), std::clamp(c.b, 0.0, largest)};
        if (result != c) warnings_.push_back("material " + in_quotes(name) + ": " + key + " was clamped");
        return result;
    }

    // Null, with a warning, if it cannot be read.
    std::shared_ptr<const Image> load_texture(const std::string& path) {
        const auto [found, is_new] = textures_.try_emplace(path);
        if (!is_new) return found->second;
        files_.push_back(path);
        try {
            Image image = load_image(path);
            // An albedo; a floating-point file may hold anything, NaN included.
            for (float& v : image.values()) v = v > 0 ? std::min(v, 1.0f) : 0;
            found->second = std::make_shared<const Image>(std::move(image));
        } catch (const FileError& error) {
            warnings_.emplace_back(error.what());
        }
        return found->second;
    }

    bool textures_wanted_;
    std::vector<std::string>& files_;
    std::vector<std::string>& warnings_;
    std::map<std::string, MtlMaterial> materials_;
    std::map<std::string, std::shared_ptr<const Image>> textures_;
};

}  // namespace

std::vector<std::shared_ptr<const Material>> load_obj_materials(const ObjFile& file, const std::string& obj_path,
                                                                const std::shared_ptr<const Material>& fallback,
                                                                bool textures, Model& model) {
    MaterialLoader loader(textures, model);
    for (const std::string& names : file.libraries) loader.add_libraries(names, obj_path);
    std::vector<std::shared_ptr<const Material>> materials;
    for (const std::string& name : file.materials) materials.push_back(loader.make(name, fallback));
    return materials;
}

}  // namespace limn
