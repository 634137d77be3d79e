#include "architecture/rules.h"

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>

namespace limn::architecture {
namespace {

bool contains(const SourceTree& tree, const std::string& path) {
    return std::any_of(tree.begin(), tree.end(), [&](const SourceFile& file) { return file.path == path; });
}

std::string at(const SourceFile& file, int line, const std::string& what) {
    return file.path + ":" + std::to_string(line) + ": " + what;
}

std::string at(const SourceFile& file, std::ptrdiff_t offset, const std::string& what) {
    return at(file, 1 + static_cast<int>(std::count(file.code.begin(), file.code.begin() + offset, '\n')), what);
}

bool is_public(const SourceFile& file) { return file.path.starts_with("include/limn/"); }
bool is_lib(const SourceFile& file) { return file.path.starts_with("lib/"); }

// Names every place in the code that a pattern matches.
void find_all(const SourceFile& file, const std::regex& pattern, const std::string& what, Violations& found) {
    for (std::sregex_iterator match(file.code.begin(), file.code.end(), pattern), end; match != end; ++match)
        found.push_back(at(file, match->position(), what + ": " + match->str()));
}

struct Library {
    std::string name;
    std::regex include;  // of the path between quotes or brackets
    std::regex word;     // in the code
    std::regex home;     // the files that may use it
};

const std::vector<Library>& libraries() {
    const auto row = [](const char* name, const char* include, const char* word, const char* home) {
        return Library{name, std::regex(include), std::regex(word), std::regex(home)};
    };
    static const std::vector<Library> table{
        row("OpenImageIO", "OpenImageIO/.*", R"(\b(OIIO|OpenImageIO)\b)", R"(lib/io/.*\.cpp)"),
        row("stb", "(stb/)?stb_.*", R"(\bstbiw?_\w+)", R"(lib/io/.*\.cpp)"),
        row("tinyobjloader", "tiny_obj_.*", R"(\btinyobj\b)", R"(lib/io/.*\.cpp)"),
        row("oneTBB", "(tbb|oneapi)/.*", R"(\bnamespace\s+tbb\b|\b(tbb|oneapi)\s*::)", "lib/(render|compile|accel)/.*"),
        row("Random123", "Random123/.*", R"(\br123\b)", "lib/render/.*"),
        row("xxHash", "xxhash\\.h", R"(\bXXH\w+)", R"(lib/core/checksum\.cpp)"),
        row("Highway", "hwy/.*", R"(\bhwy\b)",
            R"(lib/((bsdf|lanes|lights|material|predicates|sampling|scene|shade|trace)/.*|query/normals\.cpp))"),
        row("fmt", "fmt/.*", R"(\bfmt\s*::)", "apps/.*"),
        row("CLI11", "CLI/.*", R"(\bCLI\s*::)", "apps/.*"),
        row("nlohmann-json", "nlohmann/.*", R"(\bnlohmann\b)", "lib/io/gltf.*"),
    };
    return table;
}

bool is_of_library(const Include& include) {
    return std::any_of(libraries().begin(), libraries().end(),
                       [&](const Library& library) { return std::regex_match(include.path, library.include); });
}

// std headers have neither a dot nor a slash; writing files safely and huge pages need POSIX.
bool is_std_or_posix(const SourceFile& file, const Include& include) {
    static const std::regex std_name("[a-z0-9_]+"), posix(R"((unistd|fcntl|sys/\w+)\.h)"),
        home(R"(lib/(core/(file_lock|huge_pages|replace_file)|io/image_checks)\.cpp)");
    return std::regex_match(include.path, std_name) ||
           (std::regex_match(include.path, posix) && std::regex_match(file.path, home));
}

int code_lines(const SourceFile& file) {
    std::istringstream in(file.code);
    int count = 0;
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find_first_not_of(" \t");
        count += first != std::string::npos && line[first] != '#' ? 1 : 0;
    }
    return count;
}

}  // namespace

Violations check_floors(const SourceTree& tree, const Floors& floors) {
    Violations found;
    for (const SourceFile& file : tree) {
        const std::string from = room_of(file.path);
        if (from.empty()) continue;
        if (!floors.knows(from)) found.push_back(at(file, 1, "the floors do not know the room " + from));
        for (const Include& include : file.includes) {
            const bool is_face = include.path.starts_with("limn/");
            const std::string target = (is_face ? "include/" : "lib/") + include.path;
            if (include.angle || !contains(tree, target)) continue;
            const std::string to = room_of(target);
            if (to.empty()) {
                found.push_back(at(file, include.line, "a room includes the umbrella"));
            } else if (!floors.allows(from, to, !is_header(file))) {
                found.push_back(at(file, include.line, from + " -> " + to + " is no arrow of the floors"));
            }
        }
    }
    return found;
}

Violations check_quoted_includes(const SourceTree& tree) {
    static const std::regex codec_home(R"(apps/common/image_(loader|module)\.cpp)");
    Violations found;
    for (const SourceFile& file : tree) {
        const bool is_program = file.path.starts_with("apps/") || file.path.starts_with("examples/");
        if (!is_public(file) && !is_lib(file) && !is_program) continue;
        for (const Include& include : file.includes) {
            const bool is_face = include.path.starts_with("limn/");
            const bool is_private = contains(tree, "lib/" + include.path);
            // limn's programs bring a codec of their own.
            if (include.path == "io/image_codec.h" && std::regex_match(file.path, codec_home)) continue;
            if (include.angle && !is_face) continue;
            if (include.path.find("../") != std::string::npos) {
                found.push_back(at(file, include.line, include.path + " climbs out of its folder"));
            } else if (is_face && !contains(tree, "include/" + include.path)) {
                found.push_back(at(file, include.line, "there is no public header " + include.path));
            } else if (!is_face && is_private && !is_lib(file)) {
                found.push_back(at(file, include.line, include.path + " is private to lib"));
            } else if (!is_face && !is_private && !is_program && !is_of_library(include)) {
                found.push_back(at(file, include.line, "there is no header " + include.path));
            }
        }
    }
    return found;
}

Violations check_libraries(const SourceTree& tree) {
    Violations found;
    for (const SourceFile& file : tree) {
        if (!is_public(file) && !is_lib(file)) continue;
        for (const Library& library : libraries()) {
            if (std::regex_match(file.path, library.home)) continue;
            find_all(file, library.word, library.name + " does not belong here", found);
            for (const Include& include : file.includes)
                if (std::regex_match(include.path, library.include))
                    found.push_back(at(file, include.line, library.name + " does not belong here: " + include.path));
        }
        for (const Include& include : file.includes) {
            if (include.angle && !is_of_library(include) && !is_std_or_posix(file, include))
                found.push_back(at(file, include.line, "not a header of std: " + include.path));
        }
    }
    return found;
}

Violations check_umbrella(const SourceTree& tree) {
    Violations found;
    const auto umbrella = std::find_if(tree.begin(), tree.end(),
                                       [](const SourceFile& file) { return file.path == "include/limn/limn.h"; });
    if (umbrella == tree.end()) return {"include/limn/limn.h: missing"};
    for (const SourceFile& file : tree) {
        if (!is_public(file) || &file == &*umbrella) continue;
        const std::string path = file.path.substr(std::string("include/").size());
        if (std::none_of(umbrella->includes.begin(), umbrella->includes.end(),
                         [&](const Include& include) { return include.path == path; }))
            found.push_back(umbrella->path + ":1: does not include " + path);
    }
    return found;
}

Violations check_virtuals(const SourceTree& tree) {
    static const std::regex head(R"(\b(?:class|struct)\s+(\w+)(?:\s+final)?\s*(?::[^;{]*)?\{)");
    static const std::regex function(R"(\bvirtual\b(?!\s*~))");
    Violations found;
    for (const SourceFile& file : tree) {
        if (!is_public(file) && !is_lib(file)) continue;
        const std::string& code = file.code;
        for (std::sregex_iterator match(code.begin(), code.end(), head), end; match != end; ++match) {
            auto close = code.begin() + match->position() + match->length();
            const auto open = close;
            for (int depth = 1; close != code.end() && depth > 0; ++close)
                depth += *close == '{' ? 1 : *close == '}' ? -1 : 0;
            const auto count = std::distance(std::sregex_iterator(open, close, function), std::sregex_iterator());
            if (count > 4)
                found.push_back(at(file, match->position(),
                                   (*match)[1].str() + " has " + std::to_string(count) + " virtual functions"));
        }
    }
    return found;
}

Violations check_flat(const SourceTree& tree) {
    static const std::regex virtual_word(R"(\bvirtual\b)");
    static const std::regex object(R"(\b(Hittable|Material|Texture)\b(\s*const\b)?\s*[*&]|)"
                                   R"(_ptr\s*<\s*(const\s+)?(limn::)?(Hittable|Material|Texture)\b)");
    Violations found;
    for (const SourceFile& file : tree) {
        if (!file.path.starts_with("lib/flat/")) continue;
        find_all(file, virtual_word, "dispatch in the flat scene", found);
        find_all(file, object, "a described object in the flat scene", found);
    }
    return found;
}

Violations check_pointers(const SourceTree& tree) {
    // `a & b.x` has spaces.
    static const std::regex coordinate(R"(&[A-Za-z_]\w*((\.|->)\w+|\[\w*\])*(\.|->)[xyzrgbuv]\b)");
    static const std::regex indexed(R"(\(&\w+((\.|->|\[)[\w\]]+)+\)\s*\[)");
    // Highway gathers from a pointer to the kind of number that lies there, among others.
    static const std::regex cast(R"((\bGatherIndex\((?:[^();]|\(\))*)?\breinterpret_cast\s*<(?!\s*(const\s+)?)"
                                 R"((char|unsigned char|std::byte|std::u?int8_t|std::u?intptr_t)\b)[^>]*>)");
    Violations found;
    for (const SourceFile& file : tree) {
        if (!is_public(file) && !is_lib(file)) continue;
        find_all(file, coordinate, "no pointer to one coordinate reaches another", found);
        find_all(file, indexed, "no pointer to a member reaches another", found);
        for (std::sregex_iterator match(file.code.begin(), file.code.end(), cast), end; match != end; ++match)
            if (!(*match)[1].matched)
                found.push_back(
                    at(file, match->position(), "objects are read as what they are, or as bytes: " + match->str()));
    }
    return found;
}

Violations check_clocks(const SourceTree& tree) {
    static const std::regex date(
        R"(\b(system_clock|high_resolution_clock|file_clock|utc_clock|last_write_time|CLOCK_REALTIME|)"
        R"(gettimeofday|localtime|gmtime|mktime|st_[acm]time?|std::time|time\(nullptr\)|time\(0\)))");
    Violations found;
    for (const SourceFile& file : tree)
        if (is_public(file) || is_lib(file) || file.path.starts_with("apps/common/") ||
            file.path.starts_with("apps/limn/"))
            find_all(file, date, "a date can go back", found);
    return found;
}

Violations check_elementary(const SourceTree& tree) {
    static const std::regex function(
        R"(\bstd::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log2?|log10|log1p|pow|cbrt)\b(?!::))");
    static const std::regex home(R"(lib/image/(compare|encode|error_image)\.cpp)");
    Violations found;
    for (const SourceFile& file : tree)
        if ((is_public(file) || is_lib(file)) && !std::regex_match(file.path, home))
            find_all(file, function, "core/elementary.h has the same bits everywhere", found);
    return found;
}

Violations check_lengths(const SourceTree& tree) {
    static const std::regex figure(R"(examples/figures/fig\d\d_\w+\.cpp)"), custom(R"(examples/custom_\w+\.cpp)");
    Violations found;
    for (const SourceFile& file : tree) {
        const bool is_figure = std::regex_match(file.path, figure);
        const int limit = file.path == "examples/minimal.cpp"                ? 25
                          : is_figure || std::regex_match(file.path, custom) ? 60
                          : file.path.starts_with("cmake/")                  ? 80
                                                                             : 400;
        const int lines = is_figure ? code_lines(file) : file.lines;
        if (lines > limit)
            found.push_back(at(file, lines, std::to_string(lines) + " lines, more than " + std::to_string(limit)));
    }
    return found;
}

}  // namespace limn::architecture
