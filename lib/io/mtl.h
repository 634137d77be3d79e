// MTL files, checked.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limn/core/color.h"

namespace limn {

// Stands for the words of a material beyond the most that are named.
inline constexpr const char* kOtherWords = "other words";

// A picture of a material.
struct MtlMap {
    std::string name;   // as the file has it; empty: none
    std::string word;   // before it
    double height = 1;  // -bm
};

struct MtlMaterial {
    std::string file;                            // the MTL
    Color diffuse, specular, emission;           // Kd, Ks, Ke
    double shininess = 0, index = 1;             // Ns, Ni
    double opacity = 1;                          // d, else 1 - Tr
    std::optional<int> illumination;             // illum, 0 to 10
    std::optional<double> roughness, metallic;   // Pr, Pm
    MtlMap diffuse_map, specular_map;            // map_Kd, map_Ks
    MtlMap opacity_map, bump, normals;           // map_d; map_Bump, map_bump or bump; norm
    std::map<std::string, std::size_t> lines{};  // of the words that were read, the last one of each
    struct Word {
        std::string text;
        std::size_t line;
    };
    std::vector<Word> unused{};  // words that limn has no use for, or kOtherWords, each once, in the order of the file
};

/// Adds the materials of an MTL file to `materials`; the first of a name stays. \throws FileError naming `path` and the
/// line of a malformed number
void parse_mtl(std::string_view text, const std::string& path, std::map<std::string, MtlMaterial>& materials,
               std::vector<std::string>& warnings);

}  // namespace limn
