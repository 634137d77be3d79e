#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include "io/file_kind.h"
#include "io/model_reader.h"
#include "io/model_textures.h"
#include "io/mtl_look.h"
#include "io/obj_reader.h"
#include "io/text_lines.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "limn/scene/material/alpha_mask.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/material/normal_map.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/material/rough_dielectric.h"
#include "limn/scene/texture/image_texture.h"
#include "limn/scene/texture/solid.h"
#include "math/system/read_file.h"

namespace limn {

namespace {

namespace fs = std::filesystem;

// Returns the path that a name in an OBJ or MTL refers to. It is relative to that file. Windows programs write
// backslashes.
std::string beside(const std::string& file, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return (fs::path(file).parent_path() / name).string();
}

bool exists(const std::string& path) {
    std::error_code unusable;
    return fs::exists(path, unusable);
}

using MaterialPtr = std::shared_ptr<const Material>;
using TexturePtr = std::shared_ptr<const Texture>;

// The use of a picture. The same picture may have several.
enum class Use { color, opacity, normals, bumps };

// Reads the MTLs of an OBJ and makes the materials.
class MaterialLoader {
public:
    MaterialLoader(const ObjOptions& options, Model& model) : options_(options), model_(model) {}

    // Reads the MTLs that an mtllib names: one name, which may contain blanks, or several names. A missing one gets a
    // warning.
    void add_libraries(const ObjLibrary& library, const std::string& obj_path) {
        const std::string& names = library.names;
        const std::string at = "line " + std::to_string(library.line) + " of " + obj_path;
        if (names.empty()) return missing_.push_back(at + ": mtllib without the name of a file");
        if (exists(beside(obj_path, names))) return add_library(beside(obj_path, names));
        std::istringstream words(names);
        for (std::string name; words >> name;) {
            const std::string path = beside(obj_path, name);
            if (exists(path))
                add_library(path);
            else
                missing_.push_back(path + ": there is no such material library, which " + at +
                                   " names; faces with its materials get the default material");
        }
    }

    // Returns the default material and then one material for each name in Model::materials.
    std::vector<MaterialPtr> make_all() {
        std::vector<MaterialPtr> made{default_material(options_)};
        std::vector<std::string> unknown;
        for (const std::string& name : model_.materials) {
            const auto found = materials_.find(name);
            if (found == materials_.end()) unknown.push_back(in_quotes(name));
            has_pictures_.push_back(false);
            made.push_back(found == materials_.end() ? made[0] : make(name, found->second));
        }
        warn_of_unknown(unknown);
        warn_of_unused();
        model_.warnings.insert(model_.warnings.begin(), missing_.begin(), missing_.end());
        return made;
    }

    // Warns once for each material that has pictures and a face without texture coordinates.
    void warn_of_missing_uvs(const ObjFile& file) {
        for (const ObjFace& face : file.faces) {
            const auto has_no_uv = [](const ObjCorner& corner) { return corner.uv == ObjCorner::kNone; };
            if (face.slot == 0 || !has_pictures_[face.slot - 1] ||
                !std::ranges::any_of(file.corners_of(face), has_no_uv))
                continue;
            has_pictures_[face.slot - 1] = false;
            model_.warnings.push_back("material " + in_quotes(model_.materials[face.slot - 1]) +
                                      " has pictures, but its face of line " + std::to_string(face.line) +
                                      " has no texture coordinates");
        }
    }

private:
    void add_library(const std::string& path) {
        // Skip an MTL that has been read. At this stage, `files` holds the OBJ, followed by the MTLs.
        if (std::find(model_.files.begin() + 1, model_.files.end(), path) != model_.files.end()) return;
        model_.files.push_back(path);
        std::string text;
        try {
            text = read_file(path);
        } catch (const FileError& error) {
            return missing_.push_back(error.what());
        }
        if (const FileKind kind = kind_of_contents(text); !kind.name.empty() && !kind.may_be_text)
            return missing_.push_back(path + ": is no material library: it appears to be " + std::string(kind.name));
        parse_mtl(text, path, materials_, model_.warnings);
    }

    // Converts a material of an MTL, and collects the keywords that limn does not use for it.
    MaterialPtr make(const std::string& name, const MtlMaterial& m) {
        const MtlColors colors{clamped(m.emission, HUGE_VAL, "Ke", name), clamped(m.diffuse, 1, "Kd", name),
                               clamped(m.specular, 1, "Ks", name)};
        const MtlLook look = look_of(m, colors);
        for (const MtlMaterial::Word& word : m.unused) count_unused(m, name, word);
        for (const MtlMaterial::Word& word : words_without_use(m, look)) count_unused(m, name, word);
        if (look == MtlLook::light) return std::make_shared<DiffuseLight>(colors.emission);
        const MaterialPtr material = with_bumps(scattering(m, look, colors), m);
        return look == MtlLook::glass ? material : masked(material, m, name);
    }

    // Returns the material without its bumps and its opacity.
    MaterialPtr scattering(const MtlMaterial& m, MtlLook look, const MtlColors& colors) {
        const double index = m.index > 1 ? m.index : 1.5, roughness = roughness_of(m);
        switch (look) {
            case MtlLook::glass: return std::make_shared<RoughDielectric>(index, m.roughness.value_or(0));
            case MtlLook::metal: return std::make_shared<RoughConductor>(specular(m, colors), roughness);
            case MtlLook::metallic_roughness:
                return metallic_roughness_material(base(m, colors), *m.metallic, roughness, index);
            case MtlLook::plastic:
                return std::make_shared<Plastic>(base(m, colors), roughness, index, specular(m, colors));
            default: return std::make_shared<Lambertian>(base(m, colors));
        }
    }

    // Returns the base colour. With a map_Kd that cannot be read and no Kd, it is a grey of 0.6.
    TexturePtr base(const MtlMaterial& m, const MtlColors& colors) {
        const bool is_unsaid = !m.diffuse_map.name.empty() && !m.lines.contains("Kd");
        return color(m, m.diffuse_map, is_unsaid ? Color{0.6, 0.6, 0.6} : colors.diffuse);
    }

    TexturePtr specular(const MtlMaterial& m, const MtlColors& colors) {
        return color(m, m.specular_map, colors.specular);
    }

    // Returns the colours of a picture; `otherwise` if there is no picture, or if it cannot be read.
    TexturePtr color(const MtlMaterial& m, const MtlMap& map, const Color& otherwise) {
        const TexturePtr picture = texture(m, map, Use::color, 1, [](const std::string& path) {
            return scaled(load_image(path), {1, 1, 1}, 1);
        });
        return picture ? picture : std::make_shared<SolidColor>(otherwise);
    }

    // Applies the normal map or the bump map of a material.
    MaterialPtr with_bumps(const MaterialPtr& material, const MtlMaterial& m) {
        TexturePtr normals = texture(m, m.normals, Use::normals, 1,
                                     [](const std::string& path) { return load_image(path, Encoding::raw); });
        if (m.normals.name.empty())
            normals = texture(m, m.bump, Use::bumps, m.bump.height, [&](const std::string& path) {
                const Image picture = load_image(path, Encoding::raw);
                // Blender writes normal maps as map_Bump.
                return holds_normals(picture) ? scaled_normals(picture, m.bump.height)
                                              : normals_of_heights(picture, m.bump.height);
            });
        return normals ? std::make_shared<NormalMap>(material, normals) : material;
    }

    // Applies the opacity of a material.
    MaterialPtr masked(const MaterialPtr& material, const MtlMaterial& m, const std::string& name) {
        const double share = std::clamp(m.opacity, 0.0, 1.0);
        const TexturePtr opacity = texture(m, m.opacity_map, Use::opacity, share, [&](const std::string& path) {
            const std::optional<Image> alpha = load_alpha(path);
            return scaled(alpha ? *alpha : grey(load_image(path, Encoding::raw)), {share, share, share}, 1);
        });
        if (opacity) return std::make_shared<AlphaMask>(material, opacity);
        if (share == 0) model_.warnings.push_back("material " + in_quotes(name) + " is invisible: its d is 0");
        return share < 1 ? std::make_shared<AlphaMask>(material, share) : material;
    }

    // Collects a keyword that limn does not use for a material. Each keyword of an MTL gets one warning.
    void count_unused(const MtlMaterial& m, const std::string& name, const MtlMaterial::Word& word) {
        const auto [place, is_new] = unused_places_.try_emplace({m.file, word.text}, unused_.size());
        if (is_new)
            unused_.push_back({m.file + ": line " + std::to_string(word.line) + ": " + word.text + " of material " +
                                   in_quotes(name) + (word.text == kOtherWords ? " are not used" : " is not used"),
                               0});
        else
            ++unused_[place->second].other_materials;
    }

    void warn_of_unused() {
        for (const auto& [text, others] : unused_)
            model_.warnings.push_back(text + (others == 0 ? ""
                                              : others == 1
                                                  ? ", nor in one other material"
                                                  : ", nor in " + std::to_string(others) + " other materials"));
    }

    void warn_of_unknown(const std::vector<std::string>& names) {
        constexpr std::size_t kMost = 3;  // the number of materials that are named
        for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
            model_.warnings.push_back("unknown material " + names[i]);
        if (names.size() > kMost)
            model_.warnings.push_back("and " + std::to_string(names.size() - kMost) + " more unknown materials");
    }

    // Clamps a colour to [0, largest], with a warning that names the keyword and the material.
    Color clamped(const Color& c, double largest, const char* key, const std::string& name) {
        const Color result{std::clamp(c.r, 0.0, largest), std::clamp(c.g, 0.0, largest), std::clamp(c.b, 0.0, largest)};
        if (result != c) model_.warnings.push_back("material " + in_quotes(name) + ": " + key + " was clamped");
        return result;
    }

    // Returns the texture of load(path), where `path` names the picture of the map. Returns null if the map has no
    // picture, or if ModelOptions::textures is false. If the picture cannot be read, adds a warning and returns null.
    // Textures with the same path, use and number are shared.
    // \param number a parameter that the result of `load` depends on
    template <class Load>
    TexturePtr texture(const MtlMaterial& m, const MtlMap& map, Use use, double number, const Load& load) {
        if (map.name.empty() || !options_.textures) return nullptr;
        const std::string path = beside(m.file, map.name);
        const auto [found, is_new] = textures_.try_emplace({path, use, number});
        if (is_new && std::ranges::find(model_.files, path) == model_.files.end()) model_.files.push_back(path);
        if (is_new) try {
                found->second = std::make_shared<ImageTexture>(load(path));
            } catch (const FileError& error) {
                if (std::ranges::find(model_.warnings, error.what()) == model_.warnings.end())
                    model_.warnings.emplace_back(error.what());
            }
        if (found->second) has_pictures_.back() = true;
        return found->second;
    }

    const ObjOptions& options_;
    Model& model_;
    std::vector<bool> has_pictures_;    // for each of Model::materials, true if a picture of it could be read
    std::vector<std::string> missing_;  // the warnings that precede all others
    struct Unused {
        std::string text;  // the warning
        std::size_t other_materials;
    };
    std::vector<Unused> unused_;
    std::map<std::pair<std::string, std::string>, std::size_t> unused_places_;  // indices in unused_, by file and word
    std::map<std::string, MtlMaterial> materials_;
    std::map<std::tuple<std::string, Use, double>, TexturePtr> textures_;
};

}  // namespace

std::vector<std::shared_ptr<const Material>> load_obj_materials(const ObjFile& file, const std::string& obj_path,
                                                                const ObjOptions& options, Model& model) {
    MaterialLoader loader(options, model);
    for (const ObjLibrary& library : file.libraries) loader.add_libraries(library, obj_path);
    std::vector<std::shared_ptr<const Material>> materials = loader.make_all();
    loader.warn_of_missing_uvs(file);
    return materials;
}

}  // namespace limn
