#include "architecture/source_tree.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace limn::architecture {
namespace {

// Drops comments, and the contents of literals unless `keep_literals`. Line ends stay, so that lines keep their
// numbers.
std::string strip(std::string_view text, bool keep_literals) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view two = text.substr(i, 2);
        // A quote between digits (1'000) separates them and opens nothing.
        const bool separator = text[i] == '\'' && i > 0 && std::isxdigit(static_cast<unsigned char>(text[i - 1]));
        if (two == "//") {
            i = std::min(text.find('\n', i), text.size()) - 1;
        } else if (two == "/*") {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size());
            for (const char c : text.substr(i, end - i))
                if (c == '\n') out += c;
            i = end + 1;
        } else if (two == "R\"") {
            const std::size_t open = std::min(text.find('(', i), text.size());
            const std::string close = ")" + std::string(text.substr(i + 2, open - i - 2)) + "\"";
            i = std::min(text.find(close, open), text.size() - close.size()) + close.size() - 1;
            out += "\"\"";
        } else if ((text[i] == '"' || text[i] == '\'') && !separator) {
            const std::size_t begin = i;
            for (++i; i < text.size() && text[i] != text[begin] && text[i] != '\n'; ++i)
                if (text[i] == '\\') ++i;
            out += keep_literals ? std::string(text.substr(begin, i + 1 - begin)) : std::string(2, text[begin]);
        } else {
            out += text[i];
        }
    }
    return out;
}

std::vector<Include> find_includes(const std::string& code) {
    static const std::regex directive(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
    std::vector<Include> includes;
    std::istringstream lines(code);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        if (std::smatch match; std::regex_search(line, match, directive))
            includes.push_back({match[2], match[1] == "<", number});
    return includes;
}

}  // namespace

SourceFile::SourceFile(std::string path_, std::string_view text)
    : path(std::move(path_)), lines(static_cast<int>(std::count(text.begin(), text.end(), '\n'))) {
    if (!path.ends_with(".h") && !path.ends_with(".cpp")) return;
    code = strip(text, false);
    includes = find_includes(strip(text, true));
}

SourceTree read_tree(const std::string& root, const std::vector<std::string>& folders) {
    SourceTree tree;
    for (const std::string& folder : folders) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(root) / folder)) {
            const std::string suffix = entry.path().extension().string();
            if (suffix != ".h" && suffix != ".cpp" && suffix != ".cmake" && suffix != ".in") continue;
            std::ifstream in(entry.path(), std::ios::binary);
            const std::string text(std::istreambuf_iterator<char>(in), {});
            if (!in) throw std::runtime_error("cannot read " + entry.path().string());
            tree.emplace_back(std::filesystem::relative(entry.path(), root).generic_string(), text);
        }
    }
    std::sort(tree.begin(), tree.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    return tree;
}

bool is_header(const SourceFile& file) { return file.path.ends_with(".h"); }

std::string room_of(std::string_view path) {
    for (const std::string_view top : {"include/limn/", "lib/"}) {
        if (!path.starts_with(top)) continue;
        const std::string_view inside = path.substr(top.size());
        const std::size_t slash = inside.find('/');
        const std::string_view name = inside.substr(slash == std::string_view::npos ? 0 : inside.rfind('/') + 1);
        const std::string stem(name.substr(0, name.find('.')));
        if (stem == "records" || stem == "record_sink") return stem;
        return slash == std::string_view::npos ? "" : std::string(inside.substr(0, slash));
    }
    return "";
}

}  // namespace limn::architecture
