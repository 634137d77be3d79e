#include <algorithm>
#include <set>

#include "io/clean_text.h"
#include "io/text_lines.h"

namespace limn {

namespace {

using Words = std::vector<std::string_view>;

// The words before a texture's name: map_Kd and its options (Wavefront, MTL Material Format v4.2, 1995, "Options for
// texture map statements").
std::size_t words_before_name(const Words& words) {
    const auto is_one_of = [](std::string_view word, std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), word) != names.end();
    };
    std::size_t place = 1;
    while (place < words.size()) {
        const std::string_view option = words[place];
        if (is_one_of(option, {"-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-colorspace", "-imfchan",
                               "-texres", "-type"})) {
            place += 2;
        } else if (option == "-mm") {
            place += 3;
        } else if (is_one_of(option, {"-o", "-s", "-t"})) {
            const std::size_t last = place + 3;  // the second and third number may be left out
            for (++place; place <= last && place < words.size() && parse_float(words[place]);) ++place;
        } else {
            break;
        }
    }
    return std::min(place, words.size());
}

class MtlCleaner {
public:
    MtlCleaner(std::string_view text, const std::string& path) : lines_(text, path), path_(path) {}

    CleanMtl clean() {
        while (lines_.next()) clean_line(lines_.words());
        return std::move(result_);
    }

private:
    void clean_line(const Words& words) {
        if (words.empty()) return;
        const std::string_view key = words[0];
        if (key == "newmtl") {
            material(std::string(lines_.name()));
        } else if (key == "map_Kd") {
            map(words);
        } else if (key == "Kd" || key == "Ks" || key == "Ke") {
            color(words);
        } else if (key == "Ns" || key == "Ni" || key == "d" || key == "Tr" || key == "illum") {
            const bool is_halo = key == "d" && words.size() > 1 && words[1] == "-halo";
            numbers(key, Words(words.begin() + (is_halo ? 2 : 1), words.end()), 1);
        }
    }

    void material(const std::string& name) {
        is_used_ = !name.empty() && names_.insert(name).second;
        if (name.empty())
            warn("newmtl without a name");
        else if (!is_used_)
            warn("material " + in_quotes(name) + " is there already; the first one stays");
        add("newmtl", {std::to_string(result_.materials.size())});
        if (is_used_) result_.materials.push_back(name);
    }

    void map(const Words& words) {
        const std::size_t before_name = words_before_name(words);
        const std::string name(lines_.name(before_name));
        if (name.empty()) return warn("map_Kd without the name of a file");
        if (before_name > 1) warn("the options of map_Kd are not used");
        add("map_Kd", {std::to_string(result_.maps.size())});
        if (is_used_) result_.maps.push_back(name);
    }

    void color(const Words& words) {
        if (words.size() > 1 && (words[1] == "spectral" || words[1] == "xyz")) return warn("only RGB colours are read");
        if (words.size() == 3) lines_.fail(std::string(words[0]) + " needs one number or three");
        // One number stands for all three.
        numbers(words[0], words.size() == 2 ? Words(3, words[1]) : Words(words.begin() + 1, words.end()), 3);
    }

    void numbers(std::string_view key, const Words& words, std::size_t count) {
        if (words.size() < count) lines_.fail(std::string(key) + " needs a number");
        std::vector<std::string> texts(count);
        for (std::size_t i = 0; i < count; ++i) append_number(texts[i], lines_.require_number(words[i]));
        add(key, texts);
    }

    // A line of the clean text, unless it belongs to no material.
    void add(std::string_view key, const std::vector<std::string>& values) {
        if (!is_used_) return;
        result_.text += key;
        for (const std::string& value : values) result_.text += ' ' + value;
        result_.text += '\n';
    }

    void warn(const std::string& problem) {
        result_.warnings.push_back(path_ + ": line " + std::to_string(lines_.number()) + ": " + problem);
    }

    TextLines lines_;
    const std::string& path_;
    CleanMtl result_;
    std::set<std::string> names_;
    bool is_used_ = false;  // the current material
};

}  // namespace

CleanMtl clean_mtl(std::string_view text, const std::string& path) { return MtlCleaner(text, path).clean(); }

}  // namespace limn
