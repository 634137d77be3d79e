#include <algorithm>
#include <charconv>
#include <limits>
#include <map>

#include "io/obj_reader.h"
#include "io/text_lines.h"
#include "limn/math/error.h"

namespace limn {

namespace {

using Words = std::vector<std::string_view>;

// The largest number of corners on a line of the text for tinyobjloader. Under a sanitizer that intercepts calls of the
// C library, tinyobjloader takes a time that grows with the square of a line's length.
constexpr std::size_t kCornersPerLine = 1000;

// Implements clean_obj(): checks the lines of an OBJ, one after the other, and collects the text for tinyobjloader.
class ObjCleaner {
public:
    ObjCleaner(std::string_view text, const std::string& path, ObjFile& file, Model& model)
        : lines_(text, path), file_(file), model_(model) {}

    std::string clean(const std::string& path) {
        while (lines_.next())
            if (const Words words = lines_.words(); !words.empty()) clean_line(words);
        if (passed_over_.count == 0) return std::move(text_);
        if (!has_statement_)
            throw FileError(path, "line " + std::to_string(passed_over_.first) + ": " + in_quotes(first_word_) +
                                      " is no statement of an OBJ, nor is any other line");
        model_.warnings.push_back(passed_over_.warning());
        return std::move(text_);
    }

private:
    void clean_line(const Words& words) {
        const std::string_view key = words[0];
        if (key == "v") {
            numbers(words, 3, 3, vertices_);
        } else if (key == "vt") {
            numbers(words, 1, 2, uvs_);
        } else if (key == "vn") {
            numbers(words, 3, 3, normals_);
        } else if (key == "f") {
            face(words);
        } else if (key == "usemtl") {
            material(std::string(lines_.name()));
        } else if (key == "mtllib") {
            file_.libraries.push_back({std::string(lines_.name()), lines_.number()});
        } else if (key == "o") {
            object_ = lines_.name();
            group_.clear();
        } else if (key == "g") {
            group_ = lines_.name();
        } else if (!is_one_of(key, {"s", "l", "p"})) {  // smoothing groups, lines and points are not used
            return pass_over(key);
        }
        has_statement_ = true;
    }

    void pass_over(std::string_view key) {
        if (passed_over_.count == 0) first_word_ = key;
        passed_over_.add(lines_.number());
    }

    // Checks that all words after the first are numbers, at least `needed` of them. Writes the first `kept`;
    // tinyobjloader takes missing ones for 0. The rest (a weight, a vertex colour) is not used. Adds 1 to `count`.
    void numbers(const Words& words, std::size_t needed, std::size_t kept, std::size_t& count) {
        if (words.size() <= needed)
            lines_.fail(std::string(words[0]) + " needs " + std::to_string(needed) + " numbers");
        text_ += words[0];
        for (std::size_t i = 1; i < words.size(); ++i) {
            const float value = lines_.require_number(words[i]);
            if (i <= kept) append_number(text_ += ' ', value);
        }
        text_ += '\n';
        ++count;
    }

    void face(const Words& words) {
        for (std::size_t i = 1; i < words.size(); ++i) {
            if (i % kCornersPerLine == 1) text_ += "\nf";
            corner(words[i]);
        }
        text_ += '\n';
        begin_part();
        file_.faces.push_back({lines_.number(), corners_, words.size() - 1, slot_});
        corners_ += words.size() - 1;
    }

    // Checks and writes a corner of a face: v, v/vt, v//vn or v/vt/vn. An empty vt or vn counts as left out.
    void corner(std::string_view word) {
        const std::size_t counts[3] = {vertices_, uvs_, normals_};
        const char* names[3] = {"vertex", "texture coordinate", "normal"};
        std::string_view parts[3];
        std::string_view rest = word;
        // Split the word at its slashes.
        for (std::string_view& part : parts) {
            part = rest.substr(0, rest.find('/'));
            rest.remove_prefix(std::min(rest.size(), part.size() + 1));
        }
        const bool too_many = std::count(word.begin(), word.end(), '/') > 2;
        if (parts[0].empty() || too_many) lines_.fail(in_quotes(word) + " is not a corner of a face");
        // Write the indices that are given.
        text_ += ' ';
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == 2 && parts[2].empty()) break;
            if (i == 1 && parts[1].empty() && parts[2].empty()) break;
            if (i > 0) text_ += '/';
            if (!parts[i].empty()) text_ += std::to_string(index(parts[i], counts[i], names[i]));
        }
    }

    // Converts an index of a corner to one that is counted from 1. A negative index counts back from the last of the
    // `count` elements so far. A positive one may refer to a later element; parse_obj() checks it when all are known.
    int index(std::string_view word, std::size_t count, const char* name) {
        const auto refuse = [&](const std::string& problem) {
            lines_.fail("a face refers to " + std::string(name) + " " + shortened(word) + ", " + problem);
        };
        const std::string_view digits = word.substr(word.starts_with('+') && !word.starts_with("+-") ? 1 : 0);
        long long value = 0;
        const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error == std::errc::invalid_argument || stop != digits.data() + digits.size())
            refuse("which is not a number");
        if (value == 0 && error == std::errc{}) refuse("but they are counted from 1");
        if (value < 0) value += static_cast<long long>(count) + 1;
        if (error != std::errc{} || value > std::numeric_limits<int>::max() || value < 1)
            refuse("but only " + std::to_string(count) + " are defined so far");
        return static_cast<int>(value);
    }

    // Starts a new part of the model if the object or the group has changed since the last face.
    void begin_part() {
        const ModelPart last = model_.parts.empty() ? ModelPart{} : model_.parts.back();
        if (object_ != last.object || group_ != last.group)
            model_.parts.push_back({object_, group_, file_.faces.size()});
    }

    // Makes `name` the material of the faces that follow.
    void material(const std::string& name) {
        const auto [found, is_new] = slots_.try_emplace(name, static_cast<std::uint32_t>(slots_.size()) + 1);
        if (is_new) model_.materials.push_back(name);
        slot_ = found->second;
    }

    TextLines lines_;
    ObjFile& file_;
    Model& model_;
    std::string text_;
    std::map<std::string, std::uint32_t> slots_;  // the material slot of each name
    // The slot, object and group of the faces that follow.
    std::uint32_t slot_ = 0;
    std::string object_, group_;
    // The numbers of elements so far.
    std::size_t vertices_ = 0, uvs_ = 0, normals_ = 0, corners_ = 0;
    PassedOver passed_over_;
    std::string first_word_;  // the first word of the first line that was passed over
    bool has_statement_ = false;
};

}  // namespace

std::string clean_obj(std::string_view text, const std::string& path, ObjFile& file, Model& model) {
    return ObjCleaner(text, path, file, model).clean(path);
}

}  // namespace limn
