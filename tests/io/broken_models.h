// Damaged and odd models, each with the verdict of load_model.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "catch.h"
#include "limn/io/model.h"
#include "limn/math/error.h"
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

/// Loads `bytes`. Either they are a model whose every index is in range and every coordinate finite, or they are
/// refused by their name. \returns the message without the name; nothing where they load
inline std::string fault_of_model(const std::string& bytes) {
    try {
        const Model model = load_model_from_memory(std::as_bytes(std::span(bytes)), "damaged");
        for (const auto& mesh : model.meshes) {
            const MeshData& data = mesh->data();
            for (const Index3& t : data.triangles) REQUIRE(std::max({t.a, t.b, t.c}) < data.vertices.size());
            for (const Float3& v : data.vertices)
                REQUIRE((std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)));
        }
        CHECK(triangles_of(model) > 0);
        CHECK(model.dropped_faces < model.faces);
        return "";
    } catch (const FileError& error) {
        const std::string message = error.what();
        CAPTURE(message);
        REQUIRE(message.starts_with("damaged: "));
        return message.substr(9);
    }
}

/// The law of every reader: wherever a file breaks off, and whatever byte is changed, it is refused or sound. `mark`
/// bytes at its beginning, by which the format is known, are left as they are. Both outcomes occur often enough.
inline void check_damage(const std::vector<std::string>& files, std::size_t mark, std::size_t fewest_loaded) {
    std::mt19937 generator(17);
    for (const std::string& whole : files) {
        for (int i = 0; i < 200; ++i) {
            const std::size_t size = generator() % whole.size();
            CAPTURE(size);
            fault_of_model(whole.substr(0, size));
        }
        std::size_t loaded = 0;
        for (int i = 0; i < 1000; ++i) {
            std::string bytes = whole;
            const std::size_t place = mark + generator() % (bytes.size() - mark);
            bytes[place] = static_cast<char>(generator());
            CAPTURE(place, static_cast<int>(bytes[place]));
            loaded += fault_of_model(bytes).empty();
        }
        CHECK(loaded > fewest_loaded);
        CHECK(loaded < 1000);
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
