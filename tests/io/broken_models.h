// Damaged and odd models, each with the verdict of load_model.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "catch.h"
#include "limn/core/error.h"
#include "limn/io/model.h"
#include "support/folder.h"

namespace limn::test {

struct ModelVerdict {
    std::string name, bytes;
    std::size_t triangles;  // 0: it is refused
    std::string said;       // a part of the message, or of the only warning; empty: there is no warning
};

inline std::size_t triangles_of(const Model& model) {
    std::size_t count = 0;
    for (const auto& mesh : model.meshes) count += mesh->data().triangles.size();
    return count;
}

inline void check_verdicts(const std::vector<ModelVerdict>& verdicts, const std::string& suffix) {
    const Folder folder;
    for (const auto& [name, bytes, triangles, said] : verdicts) {
        const std::string path = folder.write("model" + suffix, bytes);
        CAPTURE(name, said);
        try {
            const Model model = load_model(path);
            CAPTURE(model.warnings);
            CHECK(triangles_of(model) == triangles);
            CHECK(model.warnings.size() == (said.empty() ? 0 : 1));
            if (!said.empty() && !model.warnings.empty()) CHECK(model.warnings[0].find(said) != std::string::npos);
        } catch (const FileError& error) {
            const std::string message = error.what();
            CAPTURE(message);
            CHECK(triangles == 0);
            CHECK(message.starts_with(path + ": "));
            CHECK(message.find(said) != std::string::npos);
        }
    }
}

// Bytes as a file holds them.
inline std::string little(std::uint64_t value, std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
    return bytes;
}
inline std::string floats(std::initializer_list<float> values) {
    std::string bytes;
    for (const float v : values) bytes += little(std::bit_cast<std::uint32_t>(v), 4);
    return bytes;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t place = text.find(what);
    REQUIRE(place != std::string::npos);
    return text.replace(place, what.size(), by);
}

}  // namespace limn::test
