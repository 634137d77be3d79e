// Parses and checks MTL files.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limn/math/color.h"

namespace limn {

// The text that replaces all unused keywords of a material after the first 20.
inline constexpr const char* kOtherWords = "other words";

// A picture of a material.
struct MtlMap {
    std::string name;   // the path in the MTL; empty if there is no picture
    std::string word;   // the keyword, "map_Kd" for example
    double height = 1;  // the bump multiplier, -bm
};

// A material as the MTL states it.
struct MtlMaterial {
    std::string file;                            // path of the MTL
    Color diffuse, specular, emission;           // Kd, Ks, Ke
    double shininess = 0, index = 1;             // Ns, Ni
    double opacity = 1;                          // d, else 1 - Tr
    std::optional<int> illumination;             // illum, 0 to 10
    std::optional<double> roughness, metallic;   // Pr, Pm
    MtlMap diffuse_map, specular_map;            // map_Kd, map_Ks
    MtlMap opacity_map, bump, normals;           // map_d; map_Bump, map_bump or bump; norm
    std::map<std::string, std::size_t> lines{};  // the line of each keyword that was read; the last, if there are more
    struct Word {
        std::string text;
        std::size_t line;
    };
    std::vector<Word> unused{};  // the keywords that limn does not use, or kOtherWords, each once, in the file's order
};

// Adds the materials of an MTL file to `materials`. If several have the same name, the first one is kept, with a
// warning.
// \throws FileError naming `path` and the line if a number is missing or malformed
void parse_mtl(std::string_view text, const std::string& path, std::map<std::string, MtlMaterial>& materials,
               std::vector<std::string>& warnings);

}  // namespace limn
