#include "io/mtl.h"

#include <algorithm>
#include <cmath>

#include "io/text_lines.h"

namespace limn {

namespace {

using Words = std::vector<std::string_view>;

// The options of a texture, which precede its name.
struct MapOptions {
    std::size_t words = 1;          // number of words before the name, the keyword included
    std::size_t multiplier = 0;     // index of the word with the number of -bm; 0: there is no -bm
    bool are_there_others = false;  // true if there are options other than -bm
};

// Finds the options on a line (Wavefront, MTL Material Format v4.2, 1995, "Options for texture map statements").
MapOptions options_of(const Words& words) {
    MapOptions options;
    // Step over options and their arguments, up to the first word that is neither.
    std::size_t& place = options.words;
    while (place < words.size()) {
        const std::string_view option = words[place];
        if (option == "-bm") {
            options.multiplier = place + 1;
            place += 2;
            continue;
        }
        if (is_one_of(option, {"-blendu", "-blendv", "-boost", "-cc", "-clamp", "-colorspace", "-imfchan", "-texres",
                               "-type"})) {
            place += 2;
        } else if (option == "-mm") {
            place += 3;
        } else if (is_one_of(option, {"-o", "-s", "-t"})) {
            // Take up to three numbers; the second and the third may be left out.
            const std::size_t last = place + 3;
            for (++place; place <= last && place < words.size() && parse_float(words[place]);) ++place;
        } else {
            break;
        }
        options.are_there_others = true;
    }
    place = std::min(place, words.size());
    return options;
}

// Implements parse_mtl(): reads an MTL line by line.
class MtlParser {
public:
    MtlParser(std::string_view text, const std::string& path, std::map<std::string, MtlMaterial>& materials,
              std::vector<std::string>& warnings)
        : lines_(text, path), path_(path), materials_(materials), warnings_(warnings) {}

    void parse() {
        while (lines_.next())
            if (const Words words = lines_.words(); !words.empty()) parse_line(words);
        if (!has_material_) warnings_.push_back(path_ + ": has no material: no newmtl has a name");
    }

private:
    void parse_line(const Words& words) {
        const std::string_view key = words[0];
        // Call the reader of the keyword. Ka is skipped: it is for ambient light, which a path tracer does not have.
        if (key == "newmtl") {
            material(std::string(lines_.name()));
        } else if (MtlMap* const to = map_of(key)) {
            map(words, *to);
        } else if (key == "Kd") {
            color(words, current().diffuse);
        } else if (key == "Ks") {
            color(words, current().specular);
        } else if (key == "Ke") {
            color(words, current().emission);
        } else if (key == "Ns") {
            current().shininess = number(words);
        } else if (key == "Ni") {
            current().index = number(words);
        } else if (key == "Pr") {
            current().roughness = share(words);
        } else if (key == "Pm") {
            current().metallic = share(words);
        } else if (key == "d") {
            current().opacity = number(words);
        } else if (key == "Tr") {
            transparency(number(words));
        } else if (key == "illum") {
            illumination(number(words));
        } else if (key != "Ka") {
            unused(key);
        }
    }

    // Returns the material that the current line belongs to. Lines before the first newmtl are checked, but
    // their values are discarded. So are the lines of a second material of the same name.
    MtlMaterial& current() { return current_ ? *current_ : nobody_; }

    // Starts a material.
    void material(const std::string& name) {
        current_ = nullptr;
        nobody_ = {};
        if (name.empty()) return warn("newmtl without a name");
        has_material_ = true;
        const auto [place, is_new] = materials_.try_emplace(name);
        if (!is_new) return warn("material " + in_quotes(name) + " is defined twice; the first definition is used");
        current_ = &place->second;
        current_->file = path_;
    }

    // Returns the picture of the current material that a keyword names; null if it isn't a keyword of a picture.
    MtlMap* map_of(std::string_view key) {
        if (key == "map_Kd") return &current().diffuse_map;
        if (key == "map_Ks") return &current().specular_map;
        if (key == "map_d") return &current().opacity_map;
        if (is_one_of(key, {"map_Bump", "map_bump", "bump"})) return &current().bump;
        return key == "norm" ? &current().normals : nullptr;
    }

    void map(const Words& words, MtlMap& to) {
        const MapOptions options = options_of(words);
        const std::string word(words[0]), name(lines_.name(options.words));
        if (name.empty()) return warn(word + " without the name of a file");
        const bool has_height = &to == &current().bump && options.multiplier > 0;
        if (options.are_there_others || (options.multiplier > 0 && !has_height))
            warn("the options of " + word + " are not used" + (has_height ? ", except -bm" : ""));
        to = {name, word, has_height ? double{lines_.require_number(words[options.multiplier])} : 1};
        note(word);
    }

    void color(const Words& words, Color& to) {
        if (words.size() > 1 && (words[1] == "spectral" || words[1] == "xyz")) return warn("only RGB colours are read");
        if (words.size() < 2) lines_.fail(std::string(words[0]) + " needs a number");
        if (words.size() == 3) lines_.fail(std::string(words[0]) + " needs one number or three");
        // One number is the value of all three components.
        const auto at = [&](std::size_t i) { return double{lines_.require_number(words[words.size() == 2 ? 1 : i])}; };
        to = Color{at(1), at(2), at(3)};
        note(words[0]);
    }

    // Reads the number of a line. The option -halo of d is skipped.
    double number(const Words& words) {
        const std::size_t place = words[0] == "d" && words.size() > 1 && words[1] == "-halo" ? 2 : 1;
        if (words.size() <= place) lines_.fail(std::string(words[0]) + " needs a number");
        const double value = lines_.require_number(words[place]);
        note(words[0]);
        return value;
    }

    // Reads a number and clamps it to [0, 1].
    double share(const Words& words) {
        const double value = number(words), within = std::clamp(value, 0.0, 1.0);
        if (within != value) warn(std::string(words[0]) + " was clamped");
        return within;
    }

    // Sets the opacity to 1 - Tr, unless the material has a d. Some programs write the same number as d and as Tr. In
    // that case only d counts, before or after Tr.
    void transparency(double value) {
        if (!current().lines.contains("d")) current().opacity = 1 - value;
    }

    void illumination(double value) {
        const bool is_known = value >= 0 && value <= 10 && value == std::floor(value);
        if (!is_known) warn("illum is not in 0 to 10 and is not used");
        current().illumination = is_known ? std::optional(static_cast<int>(value)) : std::nullopt;
    }

    // Records a keyword that limn does not use. After the first 20, only "other words" is recorded.
    void unused(std::string_view key) {
        constexpr std::size_t kMost = 20;
        std::vector<MtlMaterial::Word>& words = current().unused;
        const std::string text = words.size() < kMost ? shortened(key) : kOtherWords;
        const auto is_text = [&](const MtlMaterial::Word& word) { return word.text == text; };
        if (std::none_of(words.begin(), words.end(), is_text)) words.push_back({text, lines_.number()});
    }

    // Records the line of a keyword that has been read.
    void note(std::string_view key) { current().lines[std::string(key)] = lines_.number(); }

    void warn(const std::string& problem) {
        warnings_.push_back(path_ + ": line " + std::to_string(lines_.number()) + ": " + problem);
    }

    TextLines lines_;
    const std::string& path_;
    std::map<std::string, MtlMaterial>& materials_;
    std::vector<std::string>& warnings_;
    bool has_material_ = false;
    MtlMaterial* current_ = nullptr;  // null if the lines are discarded
    MtlMaterial nobody_;              // gets the values of discarded lines
};

}  // namespace

void parse_mtl(std::string_view text, const std::string& path, std::map<std::string, MtlMaterial>& materials,
               std::vector<std::string>& warnings) {
    MtlParser(text, path, materials, warnings).parse();
}

}  // namespace limn
