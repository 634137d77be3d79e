#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

#include "core/read_file.h"
#include "io/file_kind.h"
#include "io/model_reader.h"
#include "io/mtl.h"
#include "io/obj_reader.h"
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

// What becomes of a material: the table of docs/models.md.
enum class Look { light, glass, metal, diffuse };

Look look_of(const MtlMaterial& m, const Color& emission, const Color& diffuse, const Color& specular) {
    if (!is_black(emission)) return Look::light;
    if (!m.diffuse_map.empty()) return Look::diffuse;
    if (!m.illumination) {
        if (m.opacity < 1) return Look::glass;
        return luminance(specular) > luminance(diffuse) ? Look::metal : Look::diffuse;
    }
    switch (*m.illumination) {
        case 3:
        case 5:
        case 8: return is_black(specular) ? Look::diffuse : Look::metal;
        case 4:
        case 6:
        case 7:
        case 9: return Look::glass;
        default: return Look::diffuse;
    }
}

// The words that limn knows, but that this material has no use for.
std::vector<std::string> words_without_use(const MtlMaterial& m, Look look, const Color& specular) {
    const int illumination = m.illumination.value_or(-1);
    std::vector<std::string> words;
    if (look == Look::light && !m.diffuse_map.empty()) words.emplace_back("map_Kd");
    if (look != Look::glass && m.opacity < 1) words.emplace_back(m.lines.contains("d") ? "d" : "Tr");
    // Without Ks, 0, 1 and 10 say.
    const bool has_highlight = illumination != 0 && illumination != 1 && illumination != 10;
    if (look == Look::diffuse && has_highlight && !is_black(specular)) words.emplace_back("Ks");
    const bool is_as_illum_says = illumination <= 2 || look == Look::metal || look == Look::glass;
    if (!is_as_illum_says) words.emplace_back("illum");
    return words;
}

class MaterialLoader {
public:
    MaterialLoader(const ObjOptions& options, Model& model) : options_(options), model_(model) {}

    void add_libraries(const ObjLibrary& library, const std::string& obj_path) {
        const std::string& names = library.names;  // one name, which may contain blanks, or several
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

    std::vector<std::shared_ptr<const Material>> make_all() {
        std::vector<std::shared_ptr<const Material>> made{default_material(options_)};
        std::vector<std::string> unknown;
        for (const std::string& name : model_.materials) {
            const auto found = materials_.find(name);
            if (found == materials_.end()) unknown.push_back(in_quotes(name));
            made.push_back(found == materials_.end() ? made[0] : make(name, found->second));
        }
        warn_of_unknown(unknown);
        warn_of_unused();
        model_.warnings.insert(model_.warnings.begin(), missing_.begin(), missing_.end());
        return made;
    }

private:
    void add_library(const std::string& path) {
        // Behind the OBJ itself, so far.
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

    std::shared_ptr<const Material> make(const std::string& name, const MtlMaterial& m) {
        const Color emission = clamped(m.emission, HUGE_VAL, "Ke", name);
        const Color diffuse = clamped(m.diffuse, 1, "Kd", name);
        const Color specular = clamped(m.specular, 1, "Ks", name);
        const Look look = look_of(m, emission, diffuse, specular);
        for (const MtlMaterial::Word& word : m.unused) count_unused(m, name, word);
        for (const std::string& word : words_without_use(m, look, specular))
            count_unused(m, name, {word, m.lines.at(word)});
        switch (look) {
            case Look::light: return std::make_shared<DiffuseLight>(emission);
            case Look::glass: return std::make_shared<Dielectric>(m.index > 1 ? m.index : 1.5);
            // The roughness of the microfacets whose lobe is as wide as Phong's with exponent Ns (Walter et al.,
            // Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, section 5.2).
            case Look::metal:
                return std::make_shared<Metal>(specular,
                                               std::min(1.0, std::sqrt(2 / (std::max(m.shininess, 0.0) + 2))));
            case Look::diffuse: break;
        }
        if (options_.textures && !m.diffuse_map.empty())
            if (const auto image = load_texture(beside(m.file, m.diffuse_map)))
                return std::make_shared<Lambertian>(std::make_shared<ImageTexture>(image));
        const bool is_unsaid = !m.diffuse_map.empty() && !m.lines.contains("Kd");
        return std::make_shared<Lambertian>(is_unsaid ? Color{0.6, 0.6, 0.6} : diffuse);
    }

    // One warning for each word of a file.
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
        constexpr std::size_t kMost = 3;  // are named
        for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
            model_.warnings.push_back("unknown material " + names[i]);
        if (names.size() > kMost)
            model_.warnings.push_back("and " + std::to_string(names.size() - kMost) + " more unknown materials");
    }

    Color clamped(const Color& c, double largest, const char* key, const std::string& name) {
        const Color result{std::clamp(c.r, 0.0, largest), std::clamp(c.g, 0.0, largest), std::clamp(c.b, 0.0, largest)};
        if (result != c) model_.warnings.push_back("material " + in_quotes(name) + ": " + key + " was clamped");
        return result;
    }

    // Null, with a warning, if it cannot be read.
    std::shared_ptr<const Image> load_texture(const std::string& path) {
        const auto [found, is_new] = textures_.try_emplace(path);
        if (!is_new) return found->second;
        model_.files.push_back(path);
        try {
            Image image = load_image(path);
            // An albedo; a floating-point file may hold anything, NaN included.
            for (float& v : image.values()) v = v > 0 ? std::min(v, 1.0f) : 0;
            found->second = std::make_shared<const Image>(std::move(image));
        } catch (const FileError& error) {
            model_.warnings.emplace_back(error.what());
        }
        return found->second;
    }

    const ObjOptions& options_;
    Model& model_;
    std::vector<std::string> missing_;  // warnings that stand before all others
    struct Unused {
        std::string text;
        std::size_t other_materials;
    };
    std::vector<Unused> unused_;
    std::map<std::pair<std::string, std::string>, std::size_t> unused_places_;  // by file and word
    std::map<std::string, MtlMaterial> materials_;
    std::map<std::string, std::shared_ptr<const Image>> textures_;
};

}  // namespace

std::vector<std::shared_ptr<const Material>> load_obj_materials(const ObjFile& file, const std::string& obj_path,
                                                                const ObjOptions& options, Model& model) {
    MaterialLoader loader(options, model);
    for (const ObjLibrary& library : file.libraries) loader.add_libraries(library, obj_path);
    return loader.make_all();
}

}  // namespace limn
